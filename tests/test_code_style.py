"""The rules of the code that a machine can check."""

from __future__ import annotations

import ast
import re
import statistics
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from roslings.course import root

ENGINE = root() / "src" / "roslings"
ROOMS_BELOW = {
    "evidence": set[str](),
    "verdict": set[str](),
    "rates": {"evidence"},
    "near": {"evidence"},
    "endings": {"evidence"},
    "timeline": {"evidence"},
    "leaving": set[str](),
    "keyboard": set[str](),
    "rtps": set[str](),
    "course": set[str](),
    "lessons": set[str](),
    "arena": {"evidence", "rtps"},
    "rosbag2": set[str](),
    "stand_ins": {"rosbag2"},
    "probe": {"evidence", "near", "rates", "arena", "rosbag2"},
    "workspace": {"evidence", "verdict", "course", "arena"},
    "experiment": {
        "evidence", "near", "rates", "rtps", "endings", "timeline", "course", "arena", "probe",
        "workspace", "devices",
    },
    "judge": {
        "evidence", "verdict", "near", "rates", "endings", "timeline", "course", "experiment",
        "devices",
    },
    "drills": {
        "evidence", "verdict", "near", "timeline", "course", "arena", "probe", "workspace",
        "experiment", "judge", "report",
    },
    "report": {"evidence", "verdict", "near", "rates"},
    "checking": {
        "course", "evidence", "verdict", "timeline", "experiment", "judge", "report", "saving",
        "workspace",
    },
    "saving": {"course", "evidence", "experiment", "report", "verdict"},
    "batch": {
        "evidence", "verdict", "course", "arena", "workspace", "experiment", "judge", "report",
        "saving",
    },
    "authoring": {
        "course", "workspace", "experiment", "judge", "batch", "bootstrap", "installed", "evidence",
        "report", "drills",
    },
    "export": {"course", "authoring", "workspace"},
    "doctor": set[str](),
    "bootstrap": set[str](),
    "installed": {"bootstrap"},
    "devices": {"keyboard"},
    "ros2": {
        "evidence", "near", "rates", "endings", "rtps", "leaving", "keyboard", "arena", "probe",
        "report", "doctor", "rosbag2",
    },
    "jupyter": {"lessons", "workspace"},
    "notebook": {
        "evidence", "near", "course", "lessons", "workspace", "arena", "probe", "report", "devices",
        "ros2",
    },
}  # fmt: skip
"""Room to the rooms that it may import: the arrows run one way."""

TEACHING_ROOMS = ("doctor", "bootstrap", "ros2")
"""They tell of /chatter as every guide does, as an example."""


def run(*command: str) -> str:
    """What a tool prints; empty where it is content."""
    done = subprocess.run(
        [sys.executable, "-m", *command], cwd=root(), capture_output=True, text=True, check=False
    )
    return "" if done.returncode == 0 else done.stdout + done.stderr


def engine_files() -> list[Path]:
    """Every Python file of the engine."""
    return sorted(ENGINE.rglob("*.py"))


def functions(tree: ast.AST) -> Iterator[ast.FunctionDef]:
    """Every function of a file."""
    return (node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef))


def body_lines(function: ast.FunctionDef) -> int:
    """Lines of a function's body, without its docstring."""
    body = function.body[1:] if ast.get_docstring(function) else function.body
    return (body[-1].end_lineno or 0) - body[0].lineno + 1 if body else 0


def test_ruff_has_nothing_to_say() -> None:
    """Lint."""
    assert run("ruff", "check", "--quiet") == ""


def test_the_code_is_formatted() -> None:
    """Format."""
    assert run("ruff", "format", "--check", "--quiet") == ""


def test_the_types_hold() -> None:
    """mypy, strict."""
    assert run("mypy", "src/roslings", "graders") == ""


def test_functions_are_short() -> None:
    """Median at most 5 lines, 90th percentile at most 20."""
    lengths = sorted(
        body_lines(function)
        for file in engine_files()
        for function in functions(ast.parse(file.read_text("utf-8")))
    )
    assert statistics.median(lengths) <= 5
    assert lengths[int(len(lengths) * 0.9)] <= 20


@pytest.mark.parametrize("room", ROOMS_BELOW)
def test_the_arrows_run_one_way(room: str) -> None:
    """A room imports only the rooms that it may know."""
    files = list((ENGINE / room).rglob("*.py")) or [ENGINE / f"{room}.py"]
    known = {
        match
        for file in files
        for match in re.findall(
            r"^\s*(?:from|import) roslings\.(\w+)", file.read_text("utf-8"), re.MULTILINE
        )
    }
    assert known - {room} <= ROOMS_BELOW[room]


def test_the_engine_names_no_lab() -> None:
    """What is special to a lab stands in its card and its grader."""
    words = re.compile(r"/chatter\b|Hello robotics|grade_topics|labs/topics")
    rooms = [ENGINE / room for room in ROOMS_BELOW if room not in TEACHING_ROOMS]
    files = [file for room in rooms for file in room.rglob("*.py")]
    named = {
        f"{file.relative_to(ENGINE)}: {code}"
        for file in files
        for code in strings_of(ast.parse(file.read_text("utf-8")))
        if words.search(code)
    }
    assert named == set()


def strings_of(tree: ast.AST) -> Iterator[str]:
    """Every text in a file that is no docstring."""
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
    doc = {
        id(node.body[0].value)
        for node in ast.walk(tree)
        if isinstance(node, documented) and node.body and isinstance(node.body[0], ast.Expr)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in doc:
            yield node.value


def test_help_needs_the_standard_library_alone() -> None:
    """`./roslings --help` runs where nothing is installed."""
    source = "import sys; from roslings.cli import main; main(['--help'])"
    environment = {"PYTHONPATH": str(root() / "src")}
    done = subprocess.run(
        [sys.executable, "-S", "-c", source], env=environment, capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "check" in done.stdout


def test_nothing_names_this_machine() -> None:
    """No tracked file carries a path of the machine that it was written on."""
    paths = re.compile(rf"{re.escape(str(root()))}/|/(?:root)/\.|pyenv/versions/\d")
    listed = subprocess.run(
        ["git", "ls-files"], cwd=root(), capture_output=True, text=True, check=True
    )
    guilty = [
        name
        for name in listed.stdout.splitlines()
        if (file := root() / name).suffix not in (".png",) and file.is_file()
        and paths.search(file.read_text("utf-8", errors="replace"))
    ]  # fmt: skip
    assert guilty == []
