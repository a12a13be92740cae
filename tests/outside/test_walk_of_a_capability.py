"""CONTRIBUTING's walk "Add a capability", done as it is written."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from from_outside import CONFORMS, install, run
from played import furnish

from sources import ROOT
from until_told import Checked, checked, run_until_told

TEXT = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
WALK = TEXT[TEXT.index("## Add a capability") : TEXT.index("## Add a verb")]
FILE = re.compile(r"^# (\S+\.(?:py|toml))\n")
SOLUTION = "labs/nodes/solution/rover_status"


def blocks(language: str) -> list[str]:
    """The walk's code of a language that is not a file's whole text."""
    return [each for each in _all(language) if not FILE.match(each)]


def _all(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", WALK, re.DOTALL | re.MULTILINE)


def put(file: Path, old: str, new: str) -> None:
    """The second text in place of the first, which is there once."""
    text = file.read_text("utf-8")
    assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in {file.name}"
    file.write_text(text.replace(old, new), "utf-8")


@pytest.fixture
def environment(tmp_path: Path) -> dict[str, str]:
    """The package of the walk is installed, and the course is one that uses it."""
    source = tmp_path / "described"
    for text in (*_all("toml"), *_all("python")):
        name = FILE.match(text)
        if name:
            (source / name[1]).parent.mkdir(parents=True, exist_ok=True)
            (source / name[1]).write_text(text, "utf-8")
    assert "python -m pip install --no-deps ./described" in WALK
    install(source, tmp_path / "site")
    course = tmp_path / "course"
    write_course(course)
    own = {"PYTHONPATH": str(tmp_path / "site"), "ROSLINGS_COURSE": str(course)}
    return {**os.environ, **own}


def write_course(course: Path) -> None:
    """The lab of the walk, with a word, points and a check more."""
    shutil.copytree(ROOT / "labs/nodes", course / "labs/nodes")
    (course / "graders").mkdir()
    shutil.copy(ROOT / "graders/grade_nodes.py", course / "graders")
    word, points = blocks("yaml")
    card = course / "labs/nodes/card.yaml"
    others = "    other_names: [/left/first, /right/second]\n"
    put(card, others, others + word)
    (was,) = re.findall(r"(?m)^  parameter: 8 .*\n", card.read_text("utf-8"))
    put(card, was, points)
    uses, _ = blocks("python")
    with (course / "graders/grade_nodes.py").open("a", encoding="utf-8") as grader:
        grader.write("\n\n" + uses)


def test_it_conforms(environment: dict[str, str]) -> None:
    """As those of roslings; and its word has a line in the task."""
    assert "13 hold" in run(environment, "-c", CONFORMS.format(package="described"))
    run(environment, "-m", "roslings.course.task", "nodes")
    task = Path(environment["ROSLINGS_COURSE"]) / "labs/nodes/task.md"
    assert "| parameters | each has a description |" in task.read_text("utf-8")


def test_a_capability_that_needs_more_than_roslings_has_is_refused(
    environment: dict[str, str], tmp_path: Path
) -> None:
    """`./roslings` could not install it: nobody would be graded."""
    site = shutil.copytree(environment["PYTHONPATH"], tmp_path / "more")
    (metadata,) = site.glob("described-*.dist-info/METADATA")
    text = metadata.read_text("utf-8").replace("\n\n", "\n", 1)
    metadata.write_text(text.rstrip() + "\nRequires-Dist: left-pad>=1\n")
    done = subprocess.run(
        [sys.executable, "-m", "roslings", "release", "--to", str(tmp_path / "edition")],
        env={**environment, "PYTHONPATH": str(site)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2, done.stdout
    assert "described 0.1.0 needs left-pad>=1" in done.stderr
    assert not (tmp_path / "edition").exists()


@pytest.mark.slow
def test_an_edition_brings_the_package(environment: dict[str, str], tmp_path: Path) -> None:
    """The engine and the package of the walk are in it: the check is there without an install."""
    told = run(environment, "-m", "roslings", "release", "--to", "edition", cwd=tmp_path)
    assert "described 0.1.0" in told
    edition = tmp_path / "edition"
    furnish(edition)
    package = shutil.copytree(ROOT / SOLUTION, tmp_path / "rover_status")
    describe(package)
    done = run_until_told(
        [edition / "roslings", "check", "nodes", package, "--json", "verdict.json"],
        cwd=tmp_path,
        env={"PATH": "/usr/bin:/bin:/usr/sbin:/sbin", "HOME": str(tmp_path)},
    )
    assert done.returncode == 0, done.stdout + done.stderr
    verdict = json.loads((tmp_path / "verdict.json").read_bytes())
    assert "described" in [check["id"] for check in verdict["checks"]]


@pytest.mark.slow
def test_the_lab_asks_for_descriptions(environment: dict[str, str], tmp_path: Path) -> None:
    """The solution lacks one and is told so; with the walk's line it has all points again."""

    def of(package: Path) -> Checked:
        return checked("nodes", package, folder=tmp_path, env=environment)

    package = shutil.copytree(ROOT / SOLUTION, tmp_path / "rover_status")
    without = of(package)
    assert without.outcomes("fail") == ["described"]
    assert without.verdict["score"] == 98
    assert "the parameter period has a description" in without.ran.stdout
    describe(package)
    assert of(package).verdict["score"] == 100


def describe(package: Path) -> None:
    """The walk's line, and what it needs."""
    code = package / "rover_status/minimal_publisher.py"
    (was,) = re.findall(r"(?m)^ +self\.declare_parameter\(.*\n", code.read_text("utf-8"))
    put(code, was, blocks("python")[1])
    imported = "from rclpy.executors import"
    put(code, imported, f"from rcl_interfaces.msg import ParameterDescriptor\n{imported}")
    depends = "  <exec_depend>rclpy</exec_depend>\n"
    put(package / "package.xml", depends, depends + depends.replace("rclpy", "rcl_interfaces"))
