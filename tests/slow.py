"""Which tests README's command leaves to CI: read from the marks in their files, not by running.

`tests/README.md` lists these files, with what is dear in them and the stage of `.ci/run` that runs
them; `test_slow.py` holds the list against the marks.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LIST = ROOT / "tests/README.md"
WHOLE = re.compile(r"^pytestmark = (?:\[\s*)?pytest\.mark\.slow\b", re.MULTILINE)
FEW = ("few", "few_labs")
"""These mark all parameters but one."""
ROW = re.compile(
    r"^\| `(?P<file>[\w/.-]+)` \| (?P<how_many>all|some) \| (?P<why>[^|]+) "
    r"\| (?P<stage>[^|]+) \|$",
    re.MULTILINE,
)


def is_slow_whole(file: Path) -> bool:
    """Whether each test in it is slow, as its `pytestmark` says, with `slow` first."""
    return bool(WHOLE.search(file.read_text("utf-8")))


def folders_of_tests(course: Path = ROOT) -> list[Path]:
    """The tests of each package, and those that span packages."""
    return [*sorted(course.glob("packages/*/tests")), course / "tests"]


def slow_files(course: Path = ROOT) -> Iterator[tuple[str, str]]:
    """Each file with slow tests: its place, and whether `all` of them or `some` are."""
    for file in sorted(
        file for tests in folders_of_tests(course) for file in tests.rglob("test_*.py")
    ):
        if is_slow_whole(file):
            yield str(file.relative_to(course)), "all"
        elif how_many := _how_many(ast.parse(file.read_text("utf-8"))):
            yield str(file.relative_to(course)), how_many


def _how_many(module: ast.Module) -> str:
    """`all`, `some` or nothing; a mark within a parameter or `few` is of some."""
    if not any(_marks(node) for node in ast.walk(module)):
        return ""
    tests = [node for node in module.body if isinstance(node, ast.FunctionDef)]
    tests = [test for test in tests if test.name.startswith("test_")]
    return "all" if all(any(map(_is_slow, test.decorator_list)) for test in tests) else "some"


def _marks(node: ast.AST) -> bool:
    called = isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in FEW
    return called or _is_slow(node)


def _is_slow(node: ast.AST) -> bool:
    return isinstance(node, ast.Attribute) and ast.unparse(node) == "pytest.mark.slow"
