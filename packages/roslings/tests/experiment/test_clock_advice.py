"""A student is told of the clock what was measured of the node, and nothing else."""

from __future__ import annotations

import lzma
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import pytest
from recorded_evidence import recorded
from watching import HERE, watched

from kills_of_old import LABS, read_kills
from roslings.course import all_labs
from roslings.evidence import (
    Endpoint,
    Evidence,
    ExperimentSeen,
    GraphSeen,
    LogLine,
    MessageSeen,
    ProcessSeen,
    Qos,
    Tick,
    TopicSeen,
    read_json,
)
from roslings.experiment.clock_advice import advice_on_clocks, note_who_ignores_the_clock

TESTS = Path(__file__).parents[1]
SOLUTIONS = sorted((TESTS / "evidence/schema1").glob("*/solution.json.xz"))
NS = 10**9
TOPIC = "/chatter"
DOES_NOT_FOLLOW = "does not follow simulated time"
PUBLISHES = "publishes on /clock"
ENDED = "ended by itself in simulated time"
TRACE = (
    "Traceback (most recent call last):",
    '  File "talker.py", line 12, in __init__',
    "ValueError: Subtraction leads to negative time.",
)


@dataclass(frozen=True)
class Ran:
    """What happened in the two runs: the first in simulated time, the second on the wall."""

    hz: float = 2.0
    """On the wall."""
    ticks: int = 105
    step_s: float = 0.1
    tick_s: float = 0.003
    """Of real time, for one step."""
    each_s: float | None = None
    """Real seconds from message to message in the first run; None where none came."""
    reason: str = "it ran at no more than 1.6 times real time"
    crashed: tuple[bool, bool] = (False, False)
    machine_fault: str | None = None
    clock_publisher: bool = False
    pause_s: float = 0.0
    """For so long the node ran on after the last step."""


def runs(ran: Ran) -> list[ExperimentSeen]:
    """The evidence of it."""
    length_s = ran.ticks * ran.tick_s + ran.pause_s
    count = int(length_s / ran.each_s) + 1 if ran.each_s else 0
    first = _run("sim", ran, [n * (ran.each_s or 0) for n in range(count)], ran.crashed[0])
    first.not_believed = ran.reason
    first.ticks = [
        Tick(
            sim_ns=1_700_000_000 * NS + round(n * ran.step_s * NS),
            wall_ns=0,
            at_ns=round(n * ran.tick_s * NS),
            kept_up=True,
        )
        for n in range(ran.ticks)
    ]
    second = _run("wall", ran, [n / ran.hz for n in range(11)], ran.crashed[1])
    second.machine_fault = ran.machine_fault
    return [first, second]


def _run(
    clock: Literal["sim", "wall"], ran: Ran, times_s: list[float], crashed: bool
) -> ExperimentSeen:
    ends = [_publisher(TOPIC), *([_publisher("/clock")] if ran.clock_publisher else [])]
    messages = [
        MessageSeen(source_ns=at, sequence=n, arrival_ns=at, size=9)
        for n, at in enumerate(round(time_s * NS) for time_s in times_s)
    ]
    process = ProcessSeen(
        executable="talker",
        started_ns=0,
        asked_to_end_ns=None if crashed else 20 * NS,
        ended_ns=20 * NS,
        status=1 if crashed else 0,
        ended_by_itself=crashed,
    )
    seen = ExperimentSeen(
        name="talking",
        clock=clock,
        graph=GraphSeen(nodes=["/talker"], endpoints=ends),
        topics={TOPIC: TopicSeen(name=TOPIC, type="String", messages=messages)},
        processes={"talker": process},
    )
    return seen


def _publisher(topic: str) -> Endpoint:
    return Endpoint(
        kind="publisher", node="/talker", topic=topic, type="String", qos=Qos(), gid=topic
    )


SLEEPS = Ran(each_s=0.5, tick_s=0.05)
"""Ten seconds of its clock in five real ones, and two messages in each real one."""
SLOW = Ran(each_s=0.4, tick_s=0.08)
"""A timer on a slow computer: two messages in each second of its clock."""

REMARKS: dict[str, tuple[Ran, list[str]]] = {
    "a thread speaks by real time": (SLEEPS, [DOES_NOT_FOLLOW]),
    "nothing came while much simulated time went by": (
        Ran(reason="no message came in 10 s of simulated time"),
        [DOES_NOT_FOLLOW],
    ),
    "it speaks while the clock stands still": (
        Ran(
            ticks=1, each_s=0.5, pause_s=3.0, reason="it did not handle a step of the clock in time"
        ),
        [DOES_NOT_FOLLOW],
    ),
    "the computer was slow, and the timer was right": (SLOW, []),
    "slower than real time, so both say the same": (
        replace(SLOW, each_s=0.52, tick_s=0.104, reason="it is slower than real time"),
        [],
    ),
    "the experiment belongs on the wall": (
        Ran(ticks=0, reason="it has no parameter services, which show that it keeps up"),
        [],
    ),
    "its clock never began": (Ran(ticks=0, reason="it does not listen to /clock"), []),
    "one step was late, and nothing more is known": (
        Ran(ticks=1, reason="it did not handle a step of the clock in time"),
        [],
    ),
    "it crashed in simulated time alone": (
        Ran(ticks=0, reason="it ended by itself there", crashed=(True, False)),
        [ENDED],
    ),
    "it crashed in both": (
        replace(SLEEPS, reason="it ended by itself there", crashed=(True, True)),
        [],
    ),
    "it crashed in real time": (replace(SLEEPS, crashed=(False, True)), []),
    "the run in real time tells nothing": (replace(SLEEPS, machine_fault="too busy"), []),
    "it sets the time itself": (
        Ran(ticks=0, reason="/talker publishes on /clock itself", clock_publisher=True),
        [PUBLISHES],
    ),
}


@pytest.mark.parametrize("name", REMARKS)
def test_each_reason_has_its_own_true_word_or_none(name: str) -> None:
    """A table: why a run in simulated time did not count, and what is said of it."""
    ran, expected = REMARKS[name]
    evidence = recorded(runs(ran))
    said = advice_on_clocks(evidence)
    assert len(said) == len(expected), said
    for words, sentence in zip(expected, said, strict=True):
        assert words in sentence
    note_who_ignores_the_clock(evidence)
    assert evidence.attempts[0].ignores_clock is (DOES_NOT_FOLLOW in expected)


def test_a_crash_is_told_in_the_programs_own_words() -> None:
    """What stood in its last traceback, once; and that real time is what counts."""
    seen = runs(REMARKS["it crashed in simulated time alone"][0])
    seen[0].processes["talker"].lines = [
        _line(text) for text in ("[INFO] [1.0] [talker]: hello", *TRACE)
    ]
    (said,) = advice_on_clocks(recorded([seen[0], *seen]))
    assert f"{ENDED} (use_sim_time): {TRACE[-1]} In real time it ran on" in said


def _line(text: str) -> LogLine:
    return LogLine(arrival_ns=0, text=text, source="terminal")


def of_every_lab() -> Iterator[tuple[str, Evidence]]:
    """The recorded evidence of every lab: its solution's, or packages with one thing wrong."""
    for file in SOLUTIONS:
        yield file.parent.name, read_json(lzma.decompress(file.read_bytes()))
    for name in LABS:
        for kill, evidence in read_kills(name):
            yield f"{name} {kill.diff}", evidence


def test_no_lab_hears_a_remark_that_its_code_does_not_deserve() -> None:
    """No code of them has a thread or sleeps by itself; where one line was changed so, it may."""
    heard, seen = set[str](), 0
    for package, evidence in of_every_lab():
        heard.add(evidence.lab)
        seen += sum(run.not_believed is not None for run in evidence.attempts)
        deserved = re.search(r"^\+.*sleep", package, re.MULTILINE)
        assert deserved or not any(DOES_NOT_FOLLOW in each for each in advice_on_clocks(evidence))
    labs = [each for each in all_labs() if each.name != "example"]
    in_both = {each.name for each in labs if 'clock="auto"' in each.grader.read_text("utf-8")}
    assert in_both <= heard
    assert len(heard) > len(in_both) > 3
    assert seen > 15, "runs that were not believed, whatever the reason"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("style", "told"),
    [("thread", True), ("spin_once_and_sleep", True), ("many_threads", False), ("timer", False)],
)
def test_real_nodes_hear_what_they_deserve(style: str, told: bool) -> None:
    """Where the run in simulated time counted, nothing is said; nor on a computer too busy."""
    seen = watched(HERE / "styles" / f"{style}.py")
    said = any(DOES_NOT_FOLLOW in each for each in advice_on_clocks(recorded(seen)))
    assert said is told or seen[-1].machine_fault
