"""Runs test files, one after the other, and makes a record of each that passes.

It works in the clone that it lies in. Whatever else opens a file there meanwhile is recorded as a
need, so it is best done where nobody works.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from machine import TABLE
from needed.opened import Opened, Watch
from needed.records import Record, made_with
from needed.tree import Tree, few
from roslings.commands.test import plugins_without_use

LESSONS = "days/*/lesson.ipynb"
ASKED = "slow and not twice"
"""What the gate asks for, and may leave out."""
RUNS = ((f"{ASKED} and not alone", "4"), (f"{ASKED} and alone", "0"))
"""Marks, and how many processes run these tests."""
NO_TESTS = 5
UNSET = (
    "ROSLINGS_WALKS",
    "ROSLINGS_SLOW_UNTIL",
    "ROSLINGS_TESTS_UNTIL",
    "ROSLINGS_MUTANTS_UNTIL",
    "PYTHONDONTWRITEBYTECODE",
)
"""What would let a test find made what it makes, leave it out, or read no bytecode."""


class NoRecord(Exception):
    """A test file did not show what it needs."""


@dataclass(frozen=True)
class Recorder:
    """Of one clone."""

    root: Path

    def files(self) -> list[str]:
        """Each with tests that the gate may leave out, and the lessons.

        To find them, pytest compiles all tests: after that, whoever opens a source reads its text.
        """
        words = ["--collect-only", "-q", "-n", "0", "-m", ASKED, "tests", "packages"]
        done = self._pytest(words, capture_output=True)
        if done.returncode:
            raise NoRecord(f"the tests cannot be collected:\n{done.stdout}{done.stderr}")
        found = {line.split("::")[0] for line in done.stdout.splitlines() if "::" in line}
        lessons = (file.relative_to(self.root).as_posix() for file in self.root.glob(LESSONS))
        return [*sorted(found), *sorted(lessons)]

    def compile_all(self) -> None:
        """So that modules are imported from their bytecode, whoever asks first."""
        places = (each for each in ("packages", "tests", "graders", "site", "days", ".ci"))
        words = [sys.executable, "-m", "compileall", "-q", *places]
        subprocess.run(words, cwd=self.root, env=environment(), check=False, capture_output=True)

    def record(self, test: str) -> Record:
        """Run one, and see what it opens. Raises NoRecord and CannotWatch."""
        tree = Tree(self.root)
        with TemporaryDirectory() as folder:
            costs = Path(folder, "costs")
            with Watch(self.root, tuple(tree.watched)) as watch:
                self._run(test, costs)
            skipped = skipped_in(costs)
        opened = watch.opened()
        self._insist_on_stillness(opened, tree)
        needs = {need: tree.digest(need) for need in tree.needs(test, opened)}
        return Record(test, made_with(), skipped, needs)

    def _run(self, test: str, costs: Path) -> None:
        for words in words_for(test):
            done = self._pytest([*words, f"--costs={costs}", test], capture_output=True)
            if done.returncode not in (0, NO_TESTS):
                raise NoRecord(f"it fails:\n{_end(done.stdout + done.stderr)}")

    def _insist_on_stillness(self, opened: Opened, tree: Tree) -> None:
        if changed := opened.changed & tree.names:
            raise NoRecord(f"files of the clone were changed meanwhile: {few(changed)}")

    def _pytest(
        self, words: Sequence[str], *, capture_output: bool
    ) -> subprocess.CompletedProcess[str]:
        unused = [f"-pno:{name}" for name in plugins_without_use(words)]
        command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", *unused, *words]
        return subprocess.run(
            command,
            cwd=self.root,
            env=environment(),
            capture_output=capture_output,
            text=True,
            check=False,
        )


def environment() -> dict[str, str]:
    """Of pytest: nothing is taken from another run."""
    return {key: value for key, value in os.environ.items() if key not in UNSET}


def words_for(test: str) -> Iterator[list[str]]:
    """The runs of pytest that together are what the gate asks of a test file."""
    if test.endswith(".ipynb"):
        yield ["--nbval-lax", "-n", "0"]
    else:
        yield from (["-m", marks, "-n", processes] for marks, processes in RUNS)


def skipped_in(costs: Path) -> dict[str, str]:
    """Test to what the machine lacks. Raises NoRecord where all were skipped, or some for time."""
    lines = costs.read_text("utf-8").splitlines() if costs.exists() else []
    tests = [json.loads(line) for line in lines]
    skipped = {each["test"]: each["lack"] for each in tests if each["outcome"] == "skipped"}
    lacks = set(skipped.values())
    if not any(each["outcome"] == "passed" for each in tests):
        why = f": no {', '.join(sorted(lacks))}" if lacks else ""
        raise NoRecord(f"none of its slow tests ran{why}")
    if late := [lack for lack in lacks if lack not in TABLE or TABLE[lack].kind == "time"]:
        raise NoRecord(f"some were skipped: no {', '.join(sorted(late))}")
    return skipped


def _end(said: str) -> str:
    return "\n".join(said.splitlines()[-30:])


@dataclass(frozen=True)
class Made:
    """What came of one test file."""

    file: str
    seconds: float
    record: Record | None
    why_not: str = ""


def made_by(recorder: Recorder, tests: Iterable[str]) -> Iterator[Made]:
    """The record of each, as soon as it is there."""
    recorder.compile_all()
    for test in tests:
        began = time.monotonic()
        try:
            record, why_not = recorder.record(test), ""
        except NoRecord as error:
            record, why_not = None, str(error)
        yield Made(test, time.monotonic() - began, record, why_not)
