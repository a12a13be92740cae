"""A launch that started its nodes, one that did not, and one that cannot be read here."""

from __future__ import annotations

import pytest

from ros2_on_pip.words import NOT_READ_HERE
from roslings.capabilities.launch.demands import start_all
from roslings.capabilities.launch.faults import LaunchFailed, LaunchMissesNode
from roslings.capabilities.launch.record import LABEL
from roslings.evidence import ExperimentSeen, GraphSeen, LogLine, ProcessSeen
from roslings.judge import ExperimentView, Inconclusive


def launched(status: int | None, *nodes: str, said: str = "") -> ExperimentView:
    """A launch of two nodes."""
    process = ProcessSeen(
        executable=f"{LABEL} rover two.launch.xml",
        started_ns=0,
        status=status,
        ended_by_itself=status is not None,
        lines=[LogLine(arrival_ns=1, text=said, source="terminal")],
    )
    seen = ExperimentSeen(
        name="launch",
        clock="wall",
        processes={LABEL: process},
        graph=GraphSeen(nodes=[*nodes], endpoints=[]),
    )
    return ExperimentView(seen)


def test_all_must_be_there() -> None:
    """One of two is missing; or the launch ended."""
    both = start_all(["/eye", "/ear"])
    launched(None, "/eye", "/ear").must(both)
    with pytest.raises(LaunchMissesNode):
        launched(None, "/eye").must(both)
    with pytest.raises(LaunchFailed):
        launched(1).must(both)


def test_what_cannot_be_read_here_is_no_fault() -> None:
    """It says what, and what to do."""
    said = "[ERROR] [launch]: two.launch.xml, line 3: 'timer' is right, and needs the full ros2."
    with pytest.raises(Inconclusive, match=r"line 3: 'timer'.*show it to your instructor"):
        launched(NOT_READ_HERE, said=said).must(start_all(["/eye"]))
