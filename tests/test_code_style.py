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
from sources import code_of, our_modules, python_path, sources

ENGINE = code_of("roslings")


def run(*command: str) -> str:
    """What a tool prints; empty where it is content."""
    done = subprocess.run(
        [sys.executable, "-m", *command], cwd=root(), capture_output=True, text=True, check=False
    )
    return "" if done.returncode == 0 else done.stdout + done.stderr


def engine_files() -> list[Path]:
    """Every Python file of our packages, and those beside graders."""
    return [*our_modules(), *sorted((root() / "graders").glob("*/*.py"))]


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


def test_the_formatter_is_held_off_nowhere() -> None:
    """One way to write for all: nobody's editor moves a line that somebody else has set by hand."""
    off = re.compile(r"#\s*(?:fmt|yapf):\s*(?:skip|off)")
    words = ["git", "ls-files", "-z", "*.py"]
    listed = subprocess.run(words, cwd=root(), capture_output=True, text=True, check=True).stdout
    files = [root() / name for name in listed.split("\0") if name]
    assert [file for file in files if off.search(file.read_text("utf-8"))] == []


@pytest.mark.xdist_group("mypy")  # one after the other: they share what mypy has read
def test_the_types_hold() -> None:
    """mypy, strict."""
    assert run("mypy", *map(str, sources()), "graders") == ""


def test_functions_are_short() -> None:
    """Median at most 5 lines, 90th percentile at most 20."""
    lengths = sorted(
        body_lines(function)
        for file in engine_files()
        for function in functions(ast.parse(file.read_text("utf-8")))
    )
    assert statistics.median(lengths) <= 5
    assert lengths[int(len(lengths) * 0.9)] <= 20


def test_the_arrows_run_one_way() -> None:
    """Layers, a pure judge, capabilities of their own, no circle: contracts in pyproject.toml."""
    linter = Path(sys.executable).with_name("lint-imports")
    done = subprocess.run(
        [linter, "--no-cache"], cwd=root(), capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_engine_names_no_lab() -> None:
    """What is special to a lab stands in its card and its grader."""
    words = re.compile(r"/chatter\b|Hello robotics|grade_topics|labs/topics")
    files = sorted(ENGINE.rglob("*.py"))
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
    source = "import sys; from roslings_launcher.cli import main; main(['--help'])"
    environment = {"PYTHONPATH": python_path()}
    done = subprocess.run(
        [sys.executable, "-S", "-c", source],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
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
        if (file := root() / name).suffix not in (".png",)
        and file.is_file()
        and paths.search(file.read_text("utf-8", errors="replace"))
    ]
    assert guilty == []
