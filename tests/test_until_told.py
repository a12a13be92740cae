"""A live verdict is asked for in one place, which asks again only while nobody can tell."""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from slow import folders_of_tests
from until_told import MOST_TRIES, run_until_told, until_told

HERE = Path(__file__).parent
ROOT = HERE.parent
LAUNCHER, CLASS = "packages/roslings-launcher/tests", "packages/roslings-class/tests"
LOOKS_ON = {
    f"{LAUNCHER}/test_bootstrap_first_use.py": "its course is pretended, and grades nothing",
    "tests/cli/test_platforms.py": "what it checks is refused, or only read",
    "tests/bench": "it measures, and holds no verdict",
    f"{CLASS}/batch/test_batch_rooms.py": "what it checks is refused",
    f"{CLASS}/export/test_export_played.py": "a platform's own script asks, once",
    "packages/roslings-prove/tests/test_mistakes_of_authors.py": "a broken grader never tells",
    "tests/lab_folders/test_lab_folders.py": "a broken folder never tells",
    "tests/days/test_first_page.py": "its terminal asks; the other test looks at the clock alone",
}
"""Files that start `check` of a lab by themselves, and why."""
STATUS = """
import sys
from pathlib import Path
asked, codes = Path("asked"), sys.argv[1:]
number = len(asked.read_text()) if asked.exists() else 0
asked.write_text("." * (number + 1))
sys.exit(int(codes[number]))
"""


@pytest.mark.parametrize(
    ("codes", "status", "asked"),
    [("0", 0, 1), ("30", 0, 2), ("31", 1, 2), ("10", 1, 1), ("20", 2, 1), ("3333", 3, MOST_TRIES)],
)
def test_only_what_is_open_is_asked_again(
    codes: str, status: int, asked: int, tmp_path: Path
) -> None:
    """A wrong answer is never asked for twice; nor is a right one."""
    ran = run_until_told([sys.executable, "-c", STATUS, *codes], cwd=tmp_path)
    assert (ran.returncode, len((tmp_path / "asked").read_text())) == (status, asked)


def test_any_answer_may_be_asked_for() -> None:
    """The last one is given where all are open."""
    answers = iter("abcd")
    assert until_told(lambda: next(answers), lambda told: told < "z") == "c"


def commands(tree: ast.AST) -> Iterator[list[ast.expr]]:
    """Lists, tuples and arguments, where they could be a command's words."""
    for node in ast.walk(tree):
        if isinstance(node, ast.List | ast.Tuple):
            yield node.elts
        elif isinstance(node, ast.Call):
            yield node.args


def checks_a_solution(words: list[ast.expr]) -> bool:
    """`check LAB --solution`, or with a package that has a variable for a name."""
    for number, word in enumerate(words):
        if isinstance(word, ast.Constant) and word.value == "check":
            rest = [ast.unparse(each) for each in words[number + 1 :]]
            return "'--solution'" in rest or "'--json'" in rest
    return False


def test_nobody_asks_for_a_verdict_elsewhere() -> None:
    """Who types `check ... --solution` or `--json` in a test does it by until_told.py."""
    alone = []
    files = (file for tests in folders_of_tests() for file in tests.rglob("*.py"))
    for file in sorted(files):
        name, text = file.relative_to(ROOT).as_posix(), file.read_text("utf-8")
        if file.parent == HERE or name.startswith(tuple(LOOKS_ON)) or "until_told import" in text:
            continue
        if any(map(checks_a_solution, commands(ast.parse(text)))):
            alone.append(name)
    assert alone == []


def test_what_looks_on_is_there() -> None:
    """A file that went leaves the table."""
    assert [name for name in LOOKS_ON if not (ROOT / name).exists()] == []
