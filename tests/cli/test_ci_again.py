"""What CI does with a test that failed beside others: unsteady if it passes alone, else wrong."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from test_unsteady import read

from costs import without_group
from roslings.course import root

pytestmark = pytest.mark.slow

AGAIN = root() / ".ci" / "again.py"
EARLIER = {"test": "tests/a.py::test_old", "outcome": "failed"}
STEADY = {"test": "tests/a.py::test_steady", "outcome": "passed"}
WRONG_ALONE = "tests/a.py::test_wrong"
WRONG_THE_SECOND_TIME = "tests/a.py::test_second"
RUNNER = """#!/bin/sh
echo "$@" >>asked
case "$*" in
    *test_wrong*) exit 1 ;;
    *test_second*) [ "$(wc -l <asked)" = 1 ] ;;
esac
"""


def again(folder: Path, *names: str) -> subprocess.CompletedProcess[str]:
    """Run it after a stage in which these tests failed; one of an earlier stage does not count."""
    tests = [EARLIER, STEADY, *({"test": name, "outcome": "failed"} for name in names)]
    (folder / "costs").write_text("".join(f"{json.dumps(each)}\n" for each in tests), "utf-8")
    (folder / "stages").write_text("3 2 0 The machine\n40 70 1 The tests\n", "utf-8")
    (folder / "roslings").write_text(RUNNER, "utf-8")
    (folder / "roslings").chmod(0o755)
    command = [sys.executable, str(AGAIN), "costs", "1", "stages"]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def test_what_passes_twice_alone_is_named_and_forgiven(tmp_path: Path) -> None:
    """The stage has passed, and the test is told."""
    done = again(tmp_path, "tests/b.py::test_late[a b]")
    assert done.returncode == 0
    assert "UNSTEADY" in done.stdout and "tests/b.py::test_late[a b]" in done.stdout
    (line,) = (each for each in done.stdout.splitlines() if each.startswith("- "))
    (entry,) = read(line)
    assert entry.test == "tests/b.py::test_late[a b]" and len(entry.reason) > 10
    assert (tmp_path / "unsteady").read_text("utf-8") == "tests/b.py::test_late[a b]\n"
    assert (tmp_path / "stages").read_text() == "3 2 0 The machine\n40 70 0 The tests\n"
    asked = (tmp_path / "asked").read_text().splitlines()
    assert len(asked) == 2 and "test_old" not in asked[0] and "test_steady" not in asked[0]


@pytest.mark.parametrize(
    "names",
    [
        (WRONG_ALONE,),
        (WRONG_THE_SECOND_TIME,),
        ("tests/b.py::test_late", WRONG_ALONE),
        tuple(f"tests/b.py::test_{number}" for number in range(7)),
        (),
    ],
)
def test_what_is_wrong_alone_stays_wrong(tmp_path: Path, names: tuple[str, ...]) -> None:
    """Also one that passes once, many at once, and a stage that broke without a failed test."""
    assert again(tmp_path, *names).returncode == 1
    assert not (tmp_path / "unsteady").exists()
    assert "1 The tests" in (tmp_path / "stages").read_text()


@pytest.mark.parametrize(
    ("told", "name"),
    [
        ("tests/a.py::test_it@browser", "tests/a.py::test_it"),
        ("tests/a.py::test_it[a]@browser", "tests/a.py::test_it[a]"),
        ("tests/a.py::test_it[a@b]", "tests/a.py::test_it[a@b]"),
        ("tests/a.py::test_it[a@b]@site", "tests/a.py::test_it[a@b]"),
        ("tests/a.py::test_it", "tests/a.py::test_it"),
    ],
)
def test_a_test_is_asked_for_by_its_own_name(told: str, name: str) -> None:
    """A group is no part of it: pytest would not find it."""
    assert without_group(told) == name
