"""A traceback that our own Ctrl-C made is told of no program as its mistake, but where it ends."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from graders.black_box.contract import BagWords
from graders.black_box.demands import read_to_the_end
from graders.black_box.faults import ReadingNeverEnds
from graders.black_box.record import BagGiven, BagsSeen
from roslings.course import lab, written
from roslings.evidence import Ending, ExperimentSeen, LogLine, ProcessSeen
from roslings.judge import ExperimentView, exit_cleanly
from roslings.judge.demands import come_up
from roslings.judge.faults import DidNotComeUp, Fault, UncleanExit
from roslings.seen.exits import without_interrupt
from roslings_learn.drills.card import DrillCard
from roslings_learn.drills.judging import judged
from roslings_learn.drills.steps import PROGRAM, steps_of

ASKED_NS = 100
OURS = (
    "Traceback (most recent call last):",
    '  File "/w/lib/python3/site-packages/it/it.py", line 9, in main',
    "    time.sleep(1.0)",
    "KeyboardInterrupt",
)
CHAINED = (
    *OURS,
    "",
    "During handling of the above exception, another exception occurred:",
    "",
    *OURS[:-1],
    "rclpy._rclpy_pybind11.RCLError: failed to shutdown",
)
IGNORED = ("Exception ignored in: <function It.__del__ at 0x7f>", *OURS)
IN_A_LAUNCH = tuple(f"[it-1] {line}" for line in OURS)
CRASH = (*OURS[:-1], "ValueError: it is mine")
GOES_ON = ("I begin", "I work")


def process(before: tuple[str, ...], after: tuple[str, ...], asked: bool = True) -> ProcessSeen:
    """One that wrote these lines before and after we asked it to end, or ended by itself."""
    lines = [LogLine(arrival_ns=1, text=text, source="terminal") for text in before]
    lines += [LogLine(arrival_ns=ASKED_NS + 1, text=text, source="terminal") for text in after]
    return ProcessSeen(
        executable="it",
        started_ns=0,
        ended_ns=ASKED_NS + 9,
        status=1,
        lines=lines,
        asked_to_end_ns=ASKED_NS if asked else None,
        ended_by_itself=not asked,
        ending=Ending(signal="SIGINT", after_s=0.1, watched_s=0.1) if asked else None,
    )


def view(seen: ProcessSeen, label: str = "it", **part: Any) -> ExperimentView:
    """An experiment with this process."""
    return ExperimentView(
        ExperimentSeen(name="x", clock="wall", processes={label: seen}, parts=part)
    )


@pytest.mark.parametrize("after", [OURS, CHAINED, IGNORED, IN_A_LAUNCH])
def test_what_our_signal_made_is_left_out(after: tuple[str, ...]) -> None:
    """What stands before and behind it stays."""
    said = without_interrupt(process(GOES_ON, ("I end", *after, "I am gone")))
    assert [line.text for line in said if line.text] == [*GOES_ON, "I end", "I am gone"]


@pytest.mark.parametrize("asked", [True, False])
def test_a_mistake_of_its_own_is_told(asked: bool) -> None:
    """It came before we asked for the end, or nobody asked."""
    before = (*GOES_ON, *CRASH)
    seen = process(before if asked else (*GOES_ON, *CRASH), (), asked)
    assert [line.text for line in without_interrupt(seen)] == list(before)


def black_box(seen: ProcessSeen) -> ExperimentView:
    """A program with a bag."""
    given = BagGiven(label="drive", path="/b", holds=None)
    return view(seen, "drive", bags=BagsSeen(given=[given]))


def drill(seen: ProcessSeen) -> ExperimentView:
    """A program that is practised with."""
    return view(seen, PROGRAM)


CARD = lab("black-box").card
READER = written(CARD.of(BagWords).reads_bags, CARD.package)
RUNS_ON = DrillCard.model_validate(
    {
        "title": "It prints",
        "kind": "mend",
        "lesson": "days/01-install#a",
        "idea": "An idea.",
        "nodes": [{"node": "/it"}],
        "prints": ["done"],
        "starter": {"check": "prints", "fault": "NotPrinted", "names": "done"},
        "hints": ["a", "b", "c"],
    }
)


def prints(seen: ExperimentView) -> None:
    """The drill's own demand for a line."""
    (step,) = (each for each in steps_of(RUNS_ON) if each.name == "prints")
    step.demand(seen)


@pytest.mark.parametrize(
    ("demand", "made", "kind"),
    [
        (read_to_the_end(READER, "drive", "a bag"), black_box, ReadingNeverEnds),
        (lambda seen: come_up(seen.labelled("it")), view, DidNotComeUp),
        (prints, drill, Fault),
    ],
)
@pytest.mark.parametrize("after", [OURS, CHAINED, IGNORED])
def test_no_fault_tells_it(
    demand: Callable[[ExperimentView], None],
    made: Callable[[ProcessSeen], ExperimentView],
    kind: type[Fault],
    after: tuple[str, ...],
) -> None:
    """Neither in its lines nor in its words."""
    with pytest.raises(kind) as raised:
        demand(made(process(GOES_ON, after)))
    fault = raised.value
    assert fault.log == GOES_ON
    said = f"{fault.expected} {fault.measured} {fault.hint}"
    assert "Traceback" not in said and "Interrupt" not in said


def test_the_headline_of_a_drill_is_not_our_ctrl_c() -> None:
    """Python's own last word counts only where it is the program's."""
    steps = [each for each in steps_of(RUNS_ON) if each.name == "prints"]
    assert "Interrupt" not in judged("it", steps, drill(process(GOES_ON, OURS))).headline


def test_where_the_end_is_judged_it_is_told() -> None:
    """Who does not catch Ctrl-C reads where that was."""
    with pytest.raises(UncleanExit) as raised:
        exit_cleanly(view(process(GOES_ON, OURS)).labelled("it"))
    assert raised.value.log == (*GOES_ON, *OURS)
