"""A name says what it is outside its file: no two classes share one, and ROS's words are used."""

from __future__ import annotations

import ast
import re
from collections import defaultdict
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

from roslings.course import root
from sources import our_modules

KEPT: Mapping[str, str] = {
    "DoesNotStop": "Faults of e-stop and of the serial bridge: verdicts and mutants name both so.",
    "Shutdown": "ROS's launch has an action and an event of this name.",
    "StopsLate": "Faults of actions and of e-stop: verdicts and mutants name both so.",
    "TooFast": "Faults of a topic's rate and of the wheels: verdicts and mutants name both so.",
}
"""Class that stands in two files, to why."""

IMPORTED = frozenset(("launch", "launch_ros", "rclpy", "rosbag2_py", "tf2_ros", "graders"))
"""Modules that students import, by the names that they know them by."""

IN_PLACE = {
    "eye": "node, or camera model",
    "ear": "subscription, or listener",
    "mouth": "publisher",
    "spout": "output",
    "kin": "build cache",
}
"""A word that says nothing to who knows ROS, to those that do."""
WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])")


def files() -> list[Path]:
    """Every Python file of our packages, all graders, and what lies beside them."""
    return [*our_modules(), *sorted((root() / "graders").rglob("*.py"))]


@cache
def classes() -> Mapping[str, list[str]]:
    """Name of each class at the top of a file, to the files; those of one file alone aside."""
    found: defaultdict[str, list[str]] = defaultdict(list)
    for file in files():
        for node in ast.parse(file.read_text("utf-8")).body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                found[node.name].append(file.relative_to(root()).as_posix())
    return found


def test_no_two_files_have_a_class_of_one_name() -> None:
    """Who reads an import, or a trace, knows which one is meant."""
    shared = {name: where for name, where in classes().items() if len(where) > 1}
    assert {name: where for name, where in shared.items() if name not in KEPT} == {}


def test_what_is_kept_is_there_twice() -> None:
    """Where one of both has another name by now, there is nothing to explain."""
    assert [name for name in KEPT if len(classes().get(name, ())) < 2] == []


def names_of(file: Path) -> Iterator[str]:
    """The module's own name, and those of its classes and functions."""
    yield file.parent.name if file.stem == "__init__" else file.stem
    for node in ast.walk(ast.parse(file.read_text("utf-8"))):
        if isinstance(node, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            yield node.name


def odd_words(name: str) -> list[str]:
    """`RoverEars`, `no_ear_events`: ear; not `hear`, not `early`."""
    words = (word.lower() for word in WORD.findall(name))
    return [word for word in words if word in IN_PLACE or word.removesuffix("s") in IN_PLACE]


def test_words_are_told_from_parts_of_words() -> None:
    """A search that finds nothing anywhere proves nothing."""
    assert odd_words("RoverEars") == ["ears"]
    assert odd_words("_build_as_kin") == ["kin"]
    assert odd_words("Eye") == ["eye"]
    assert odd_words("hear_early_kind_YEAR") == []


def test_classes_functions_and_modules_have_the_words_of_the_field() -> None:
    """A node is a node, and a subscription a subscription."""
    odd = {
        f"{file.relative_to(root())}: {name}"
        for file in files()
        for name in names_of(file)
        if odd_words(name)
    }
    assert odd == set()


def test_no_folder_of_tests_hides_a_module() -> None:
    """Pytest puts a test file's folder before all others: a `launch` in it hides the real one."""
    beside = {file.parent for file in root().glob("packages/*/tests/**/test_*.py")}
    beside |= {file.parent for file in (root() / "tests").rglob("test_*.py")}
    hiding = [
        folder.relative_to(root()).as_posix()
        for parent in beside
        for folder in parent.iterdir()
        if folder.is_dir() and folder.name in IMPORTED
    ]
    assert hiding == []
