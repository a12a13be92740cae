"""The table of figures: each row is whole, and what it says to type is there to be typed."""

from __future__ import annotations

import ast
import re
import runpy
import shlex
import subprocess
from collections.abc import Callable, Iterator
from contextlib import redirect_stderr
from dataclasses import astuple, dataclass
from datetime import date
from functools import cache
from io import StringIO
from pathlib import Path

import pytest

from roslings.course import all_labs, root
from roslings_launcher.cli import parser

BENCH = root() / "tests" / "bench"
TABLE = BENCH / "README.md"
LINES_AT_MOST, NOTE_AT_MOST = 200, 2
COLUMNS = ["figure", "goal", "today", "machine", "date", "command"]
SUBJECTS = (
    "gate",
    "check",
    "class",
    "truth",
    "proofs",
    "ros2",
    "drills",
    "site",
    "memory",
    "walls",
)
PYTHON = ".venv/bin/python"
USAGE = re.compile(
    r"^ *(?:\S*python3? )tests/bench/(?P<name>\w+\.py)(?P<words>.*?)(?: {2,}.*)?$", re.M
)
TOKEN = re.compile(r"\.\.\.|[][|]|\w[\w-]*")
SETS = re.compile(r"[A-Z_]+=")
"""A word before the command that sets a variable."""


@dataclass(frozen=True)
class Row:
    """One figure."""

    figure: str
    goal: str
    today: str
    machine: str
    date: str
    command: str


# --- the rows ----------------------------------------------------------------------------------


def cells(line: str) -> list[str]:
    """What stands between the bars.

    >>> cells("| a | `b` |")
    ['a', '`b`']
    """
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def sections(text: str) -> dict[str, list[str]]:
    """Each heading with the lines below it."""
    parts = re.split(r"^## (.+)$", text, flags=re.M)[1:]
    return {
        title: [line for line in body.splitlines() if line]
        for title, body in zip(parts[::2], parts[1::2], strict=True)
    }


def rows_in(lines: list[str]) -> list[list[str]]:
    """The cells of each row of a section, without the head of its table."""
    return [cells(line) for line in lines if line.startswith("|")][2:]


def machines(text: str) -> set[str]:
    """The words for machines that the head of the file explains."""
    return set(re.findall(r"`(\w+)`:", text.split("\n## ")[0]))


def wrong_in(row: list[str], known: set[str], ours: pytest.Config) -> Iterator[str]:
    """Each thing that is wrong in a row."""
    if len(row) != len(COLUMNS) or not all(row):
        yield f"not all columns: {row}"
        return
    figure = Row(*row)
    measured = [cell != "-" for cell in (figure.today, figure.machine, figure.date)]
    if any(measured) != all(measured):
        yield f"{figure.figure}: a value has a machine and a day"
    if figure.date != "-" and not is_day(figure.date):
        yield f"{figure.figure}: no day: {figure.date}"
    if figure.machine != "-" and figure.machine.split()[0] not in known:
        yield f"{figure.figure}: no machine of the file's head: {figure.machine}"
    found = re.fullmatch(r"`([^`]+)`", figure.command)
    complaint = "no command" if found is None else refused(shlex.split(found[1]), ours)
    if complaint:
        yield f"{figure.figure}: {complaint}"


def is_day(text: str) -> bool:
    """A day as ISO 8601 has it, with its dashes."""
    try:
        return date.fromisoformat(text).isoformat() == text
    except ValueError:
        return False


# --- the commands ------------------------------------------------------------------------------


def refused(words: list[str], ours: pytest.Config) -> str | None:
    """Why a command cannot be typed here; None where it can."""
    while SETS.match(words[0]):
        if not is_read(words[0].partition("=")[0]):
            return f"nothing reads {words[0]}"
        words = words[1:]
    if words[0] == "time":
        words = words[1:]
    command, *rest = words
    if command == "./roslings":
        return refused_by_roslings(rest, ours)
    if command == PYTHON and rest and rest[0].startswith("tests/bench/"):
        return refused_by_bench(root() / rest[0], rest[1:])
    if command == "bash" and rest == [".ci/run"]:
        return None if (root() / rest[0]).is_file() else f"no file {rest[0]}"
    return f"not known: {shlex.join(words)}"


def is_read(variable: str) -> bool:
    """Whether a program or a test of the repository looks at this variable."""
    places = ["packages/*.py", "tests/*.py"]
    found = subprocess.run(
        ["git", "grep", "-q", f'"{variable}"', "--", *places], cwd=root(), check=False
    )
    return found.returncode == 0


def refused_by_roslings(words: list[str], ours: pytest.Config) -> str | None:
    """By the reader of words that `./roslings` has; what follows `test` is for pytest."""
    if words[:1] == ["test"]:
        return refused_by_pytest(words[1:], ours)
    said = StringIO()
    try:
        with redirect_stderr(said):
            options = parser().parse_args(words)
    except SystemExit:
        return said.getvalue()
    unknown = set(getattr(options, "labs", ())) - names_of_labs()
    return f"no such lab: {', '.join(unknown)}" if unknown else None


def refused_by_pytest(words: list[str], ours: pytest.Config) -> str | None:
    """A file that is not there, or an option that the pytest of this run does not have."""
    for word in words:
        if word.startswith("-"):
            try:
                ours.getoption(word.partition("=")[0])
            except ValueError as fault:
                return str(fault)
        elif "/" in word and not (root() / word).exists():
            return f"no file {word}"
    return None


def refused_by_bench(script: Path, words: list[str]) -> str | None:
    """By the script's own reader of words; where it has none, by the usage in its first lines."""
    if not script.is_file():
        return f"no file {script.name}"
    if "argparse" in script.read_text("utf-8"):
        said = StringIO()
        try:
            with redirect_stderr(said):
                reader_of(script)(words)
        except SystemExit:
            return said.getvalue()
        return None
    typed = "".join(f" {word}" for word in words)
    if any(re.fullmatch(pattern_of(usage), typed) for usage in usages(script)):
        return None
    return f"{script.name} does not take {typed.strip()!r}"


@cache
def reader_of(script: Path) -> Callable[[list[str]], object]:
    """The function of a script that reads its words."""
    reads: Callable[[list[str]], object] = runpy.run_path(str(script))["options_in"]
    return reads


def usages(script: Path) -> list[str]:
    """What may follow the script's name, one text for each way that its first lines show."""
    said = ast.get_docstring(ast.parse(script.read_text("utf-8")), clean=False) or ""
    return [each["words"] for each in USAGE.finditer(said) if each["name"] == script.name]


def pattern_of(usage: str) -> str:
    """The words that a usage allows, as a regular expression.

    >>> bool(re.fullmatch(pattern_of("[error | speed] [N]"), " speed 3"))
    True
    >>> bool(re.fullmatch(pattern_of("[error | speed] [N]"), " moon"))
    False
    """
    pattern: list[str] = []
    last = ""
    for token in TOKEN.findall(usage):
        if token == "...":
            pattern[-1] = f"(?:{last})+"
            continue
        last = {"[": "(?:", "]": ")?", "|": "|"}.get(token) or f" {word_for(token)}"
        pattern.append(last)
    return "".join(pattern)


def word_for(token: str) -> str:
    """What may stand for a word of a usage: one in capitals names what is to be put there."""
    if not token.isupper():
        return re.escape(token)
    any_of = {"LAB": names_of_labs, "ROGUE": names_of_rogues, "PART": parts_of_ros2}
    if token in any_of:
        return f"(?:{'|'.join(map(re.escape, any_of[token]()))})"
    return r"\S+" if token == "PYTHON_WITH_ROS" else r"\d+"


@cache
def names_of_labs() -> frozenset[str]:
    """All of the course."""
    return frozenset(lab.name for lab in all_labs())


@cache
def names_of_rogues() -> frozenset[str]:
    """As `memory.py` takes them."""
    return frozenset(value_of("memory.py", "FLOODS"))


@cache
def parts_of_ros2() -> frozenset[str]:
    """As `ros2.py` takes them."""
    return frozenset(value_of("ros2.py", "PARTS"))


def value_of(script: str, name: str) -> tuple[str, ...]:
    """A table of words in a script, which is not run."""
    for line in ast.parse((BENCH / script).read_text("utf-8")).body:
        if isinstance(line, ast.Assign) and ast.unparse(line.targets[0]) == name:
            return tuple(ast.literal_eval(line.value))
    raise LookupError(name)


# --- the tests ---------------------------------------------------------------------------------


def test_each_row_is_whole_and_its_command_can_be_typed(pytestconfig: pytest.Config) -> None:
    """All columns, a day, a machine that the head explains, words that the program takes."""
    text = TABLE.read_text("utf-8")
    found = [row for lines in sections(text).values() for row in rows_in(lines)]
    assert len(found) > len(SUBJECTS)
    known = machines(text)
    assert [wrong for row in found for wrong in wrong_in(row, known, pytestconfig)] == []


def test_the_file_is_tables_and_no_diary() -> None:
    """Short, one table under each heading with the same columns, two lines below it at most."""
    text = TABLE.read_text("utf-8")
    assert len(text.splitlines()) <= LINES_AT_MOST
    for title, lines in sections(text).items():
        assert cells(lines[0]) == COLUMNS, title
        after = lines[2 + len(rows_in(lines)) :]
        assert all(line.startswith("|") for line in lines[: len(lines) - len(after)]), title
        assert len(after) <= NOTE_AT_MOST, title


@pytest.mark.parametrize("subject", SUBJECTS)
def test_each_subject_has_a_table_with_rows(subject: str) -> None:
    """A heading names it."""
    found = [
        lines
        for title, lines in sections(TABLE.read_text("utf-8")).items()
        if subject in re.findall(r"[a-z0-9]+", title.lower())
    ]
    assert len(found) == 1 and rows_in(found[0])


@pytest.mark.parametrize(
    "script", [file for file in sorted(BENCH.glob("*.py")) if usages(file)], ids=lambda f: f.name
)
def test_each_bench_has_a_row(script: Path) -> None:
    """What nobody is told of is not measured."""
    assert f" tests/bench/{script.name}" in TABLE.read_text("utf-8")


GOOD = Row("speed", "-", "3 s", "free", "2026-11-26", "`./roslings prove topics --contract`")


@pytest.mark.parametrize(
    "changed",
    [
        {"goal": ""},
        {"date": "26 November"},
        {"date": "2026-11-31"},
        {"date": "20261126"},
        {"date": "-"},
        {"machine": "moon"},
        {"machine": "-"},
        {"command": "./roslings status"},
        {"command": "`./roslings fly`"},
        {"command": "`./roslings prove topics --no-such`"},
        {"command": "`./roslings prove moon`"},
        {"command": "`./roslings test tests/moon.py`"},
        {"command": "`./roslings test --no-such`"},
        {"command": "`NO_SUCH=1 ./roslings status`"},
        {"command": f"`{PYTHON} tests/bench/moon.py`"},
        {"command": "`bash .ci/moon`"},
        {"command": f"`{PYTHON} tests/bench/rates.py moon 3`"},
        {"command": "`ls tests`"},
        {"command": f"`{PYTHON} tests/bench/half_done.py moon`"},
        {"command": f"`{PYTHON} tests/bench/check.py labs 3`"},
        {"command": f"`{PYTHON} tests/bench/check.py --fast`"},
        {"command": f"`{PYTHON} tests/bench/memory.py moon`"},
        {"command": f"`{PYTHON} tests/bench/truth.py 10`"},
        {"command": f"`{PYTHON} tests/bench/truth.py 10 --file x --no-such`"},
    ],
    ids=str,
)
def test_a_row_that_is_wrong_is_seen(changed: dict[str, str], pytestconfig: pytest.Config) -> None:
    """One thing changed in a row that is right."""
    wrong_row = Row(**{**vars(GOOD), **changed})
    assert [*wrong_in([*astuple(GOOD)], {"free"}, pytestconfig)] == []
    assert len([*wrong_in([*astuple(wrong_row)], {"free"}, pytestconfig)]) == 1
