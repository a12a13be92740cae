"""A grader's own program beside the nodes: what it sees, and that it does as it is told."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from roslings.arena import Companion, Isolation
from roslings.arena.companion import BEGIN, Surroundings
from roslings.arena.environment import base_environment
from roslings.course import root

LONG_S, LOOKS_AGAIN_S = 30.0, 0.02
PROGRAM = """
import json, os, sys

plan = json.loads(sys.argv[1])
seen = [place for place in plan["looks_for"] if os.path.exists(place)]
try:
    print(json.dumps({"ready": True, "sees": seen}), flush=True)
    for line in sys.stdin:
        print(json.dumps({"heard": json.loads(line)}), flush=True)
except KeyboardInterrupt:
    print(json.dumps({"left": True}), flush=True)
"""


class Beside:
    """A companion, and whoever waits for what it tells."""

    def __init__(self, folder: Path, around: Surroundings, looks_for: list[Path]) -> None:
        self._changed = threading.Condition()
        program = folder / "program.py"
        program.write_text(PROGRAM)
        plan = {"looks_for": [str(each) for each in (program, *looks_for)]}
        self.it = Companion(program, plan, around, self._notify)

    def _notify(self) -> None:
        with self._changed:
            self._changed.notify_all()

    def until(self, condition: Callable[[], bool]) -> bool:
        """Wait until it holds; of what the kernel does with a process nobody tells us."""
        ends_s = time.monotonic() + LONG_S
        with self._changed:
            while not condition() and time.monotonic() < ends_s:
                self._changed.wait(LOOKS_AGAIN_S)
            return condition()


@pytest.fixture(params=["sandbox", "none"])
def around(request: pytest.FixtureRequest, tmp_path: Path) -> Surroundings:
    """With a sandbox, and without one."""
    home = tmp_path / "home"
    home.mkdir()
    environment = base_environment(home)
    if request.param == "none":
        return Surroundings(environment)
    isolation: Isolation = request.getfixturevalue("isolation")
    assert isolation.sandbox
    shown = isolation.sandbox.showing(tmp_path / "graders/lab/program.py", BEGIN)
    return Surroundings(environment, replace(shown, home=home))


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """As of a lab: other files lie beside the program."""
    made = tmp_path / "graders/lab"
    made.mkdir(parents=True)
    (made / "demands.py").write_text("ANSWER = 42\n")
    (made.parent / "grade_lab.py").write_text("ANSWER = 42\n")
    return made


@pytest.fixture
def beside(folder: Path, around: Surroundings) -> Iterator[Beside]:
    """A companion that has told that it is there."""
    looks_for = [folder / "demands.py", folder.parent / "grade_lab.py", root() / "labs"]
    made = Beside(folder, around, looks_for)
    with made.it:
        assert made.until(lambda: made.it.ready)
        yield made


def test_in_a_sandbox_it_sees_of_the_course_its_own_file_alone(
    beside: Beside, folder: Path, around: Surroundings
) -> None:
    """Nothing else of its lab's folder, no grader, no lab."""
    (told,) = beside.it.told("sees")
    own = [str(folder / "program.py")]
    assert (told["sees"] == own) is (around.sandbox is not None)
    assert told["sees"][:1] == own


def test_it_hears_and_answers(beside: Beside) -> None:
    """Line by line."""
    beside.it.tell(drive=1.5)
    assert beside.until(lambda: bool(beside.it.told("heard")))
    assert beside.it.told("heard") == [{"heard": {"drive": 1.5}}]


def test_it_freezes_and_goes_on(beside: Beside) -> None:
    """While it is frozen nothing of it runs: the kernel says that it is stopped."""
    beside.it.freeze()
    assert beside.until(lambda: state_of(beside.it) == "T")
    beside.it.tell(drive=1.5)
    beside.it.thaw()
    assert beside.until(lambda: bool(beside.it.told("heard")))
    assert state_of(beside.it) != "T"


def test_it_leaves_in_order_when_it_is_asked(beside: Beside) -> None:
    """It is told so by Ctrl-C, and has its last word."""
    beside.it.leave()
    assert beside.until(lambda: bool(beside.it.told("left")))
    assert not Path(f"/proc/{beside.it.pid}").exists()


def test_a_frozen_one_can_be_killed(beside: Beside) -> None:
    """At once, and it tells nobody."""
    beside.it.freeze()
    beside.it.kill()
    assert not Path(f"/proc/{beside.it.pid}").exists()
    beside.it.tell(drive=1.5)  # there is nobody to be told
    assert not beside.it.told("heard") and not beside.it.told("left")


def state_of(companion: Companion) -> str:
    """The kernel's letter."""
    stat = Path(f"/proc/{companion.pid}/stat").read_text()
    return stat.rpartition(")")[2].split()[0]


def test_it_is_told_apart_from_what_stands_around_it(beside: Beside) -> None:
    """Signals go to the program, and to nothing between it and us."""
    command = Path(f"/proc/{beside.it.pid}/cmdline").read_bytes().split(b"\0")
    assert os.fsdecode(command[1]).endswith("companion_begin.py")
