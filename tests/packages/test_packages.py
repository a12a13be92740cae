"""The packages: what stands on what, and what each of them is made of."""

from __future__ import annotations

import ast
import re
import sys
from functools import cache
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest

import alone
from sources import ROOT

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

PACKAGES = sorted(ROOT.glob("packages/*/pyproject.toml"))
IMPORTS = (ast.Import, ast.ImportFrom)
OF_A_STUDENT = "healthy"
"""A package that the doctor's exercises break is as a student writes it."""
OF_ROS = re.compile(r"ros-|rclpy$|.*-(?:msgs|interfaces|python)$")
OF_WHEELS = ("ros-doctor", "ros2-on-pip")
"""For people without the course."""


@cache
def brought() -> dict[str, set[str]]:
    """Modules, to the distributions that bring them; none for ROS, which may be a sourced one."""
    found = {name: set(map(canonical, dists)) for name, dists in packages_distributions().items()}
    return {
        name: set() if any(map(OF_ROS.match, dists)) else dists for name, dists in found.items()
    }


def layers() -> list[list[str]]:
    """The contract in pyproject.toml, from the top; import names."""
    linter = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"]
    (contract,) = (each for each in linter["contracts"] if each.get("id") == "packages")
    return [layer.split(" | ") for layer in contract["layers"]]


def picture() -> str:
    """The contract, drawn."""
    lines = ["   ".join(name.replace("_", "-") for name in layer) for layer in layers()]
    return "\n    |\n".join(lines)


def test_the_picture_is_drawn_from_the_contract() -> None:
    """So it cannot lie: `lint-imports` holds the same lines."""
    assert f"```text\n{picture()}\n```" in (ROOT / "CONTRIBUTING.md").read_text("utf-8")


def test_each_package_stands_in_the_contract() -> None:
    """By the name that is imported; and each has what makes it one."""
    names = {name.replace("_", "-") for layer in layers() for name in layer}
    assert names == {file.parent.name for file in PACKAGES}
    for file in PACKAGES:
        (module,) = (each.parent for each in file.parent.glob("src/*/__init__.py"))
        assert module.name == file.parent.name.replace("-", "_")
        for part in ("README.md", "entry_points.txt", "tests"):
            assert (file.parent / part).exists(), file.parent / part


@pytest.mark.parametrize("file", PACKAGES, ids=lambda file: file.parent.name)
def test_a_package_says_that_it_needs_what_it_imports(file: Path) -> None:
    """Of ours, directly or through another one; so do its tests, which are run alone."""
    needed = stands_on(file.parent.name)
    for module in (*file.parent.glob("src/**/*.py"), *file.parent.glob("tests/**/*.py")):
        for name in ours_in(module):
            assert name in needed, f"{module.relative_to(ROOT)} imports {name}"


def stands_on(name: str) -> set[str]:
    """Itself, and all of ours that it needs, by the names that are imported."""
    return {each.name.replace("-", "_") for each in alone.Package(name).ours}


def test_the_engine_stands_on_all_below_it() -> None:
    """No dependency of it says so, for its wheel holds them; the contract does."""
    places = [layer[0] for layer in layers()]
    below = layers()[places.index("roslings") + 1 :]
    assert stands_on("roslings") == {"roslings", *(each for layer in below for each in layer)}


@pytest.mark.parametrize("file", PACKAGES, ids=lambda file: file.parent.name)
def test_a_package_says_who_made_it_and_for_what(file: Path) -> None:
    """As an index shows it; its Pythons are those that it lets in."""
    said = tomllib.loads(file.read_text("utf-8"))["project"]
    assert said["authors"] == [{"name": "The roslings authors"}]
    assert said["keywords"]
    words = said["classifiers"]
    pythons = re.findall(r":: 3\.(\d+)", "\n".join(words))
    first, after = re.fullmatch(r">=3\.(\d+),<3\.(\d+)", said["requires-python"]).groups()  # type: ignore[union-attr]
    assert pythons == [str(minor) for minor in range(int(first), int(after))]
    assert [word for word in words if word.startswith("License ::")] == []  # `license` says it


def ours_in(module: Path) -> set[str]:
    """Packages of ours that a module imports, wherever in it, or names to be imported."""
    names = {name for layer in layers() for name in layer}
    tree = ast.parse(module.read_text("utf-8"))
    told = [each for node in ast.walk(tree) for each in named_by(node)]
    return {each for each in told if each in names}


def named_by(node: ast.AST) -> list[str]:
    """First words of the modules that a node imports, or that a text of it names."""
    if isinstance(node, ast.Import):
        return [each.name.partition(".")[0] for each in node.names]
    if isinstance(node, ast.ImportFrom):
        return [(node.module or "").partition(".")[0]]
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        found = re.fullmatch(r"(\w+)\.(\w+)(?:\.\w+)*(?::\w+)?", node.value)
        return [found[1]] if found and there_is(found[1], found[2]) else []
    return []


def there_is(package: str, module: str) -> bool:
    """Whether two words name a module of ours, and not a file or a folder."""
    return any(
        (folder / module).is_dir() or (folder / f"{module}.py").is_file()
        for folder in ROOT.glob(f"packages/*/src/{package}")
    )


@pytest.mark.parametrize("name", alone.names())
def test_a_package_says_what_it_needs_of_others(name: str) -> None:
    """Itself, or one that it stands on: each module of a wheel that its code or its tests name."""
    package = alone.Package(name)
    needed = {canonical(need) for each in package.ours for need in each.needed}
    tests = needed | {canonical(need) for need in package.theirs}
    for folder, said in (("src", needed), ("tests", tests)):
        for module in sorted(package.folder.glob(f"{folder}/**/*.py")):
            if OF_A_STUDENT not in module.parts:
                named = {top: brought()[top] for top in theirs_in(module) if brought()[top]}
                assert [top for top, by in named.items() if not by & said] == [], module


def theirs_in(module: Path) -> set[str]:
    """First words of what it imports, wherever in it, that a wheel has brought."""
    nodes = ast.walk(ast.parse(module.read_text("utf-8")))
    names = {each for node in nodes if isinstance(node, IMPORTS) for each in named_by(node)}
    return {name for name in names - ours_in(module) if name in brought()}


def canonical(need: str) -> str:
    """The name of a distribution, as the index spells it."""
    return re.sub(r"[-_.]+", "-", re.split(r"[\s=<>!~;\[]", need, maxsplit=1)[0]).lower()


def test_each_package_is_tried_alone() -> None:
    """By a file of its own, which is left out of a landing where nothing that it reads is new."""
    there = {file.name for file in (ROOT / "tests/packages").glob("test_alone_*.py")}
    names = {file.parent.name.replace("-", "_") for file in PACKAGES}
    assert there == {f"test_alone_{name}.py" for name in names}


@pytest.mark.parametrize("name", OF_WHEELS)
def test_who_has_no_course_is_told_of_none(name: str) -> None:
    """Its page shows commands that are there after `pip install`."""
    text = (ROOT / "packages" / name / "README.md").read_text("utf-8")
    assert f"pip install {name}" in text
    assert "./roslings" not in text
