"""Demands on a launch file."""

from __future__ import annotations

from collections.abc import Sequence

from roslings.capabilities.launch.faults import LaunchFailed, LaunchMissesNode
from roslings.capabilities.launch.record import LABEL
from roslings.exits import NOT_READ_HERE
from roslings.judge.faults import Inconclusive, NothingToJudge
from roslings.judge.views import Demand, ExperimentView, ProcessView
from roslings.judge.words import describe_end


def launch_of(experiment: ExperimentView) -> ProcessView:
    """The process of the launch. Raises NothingToJudge where there was none."""
    if LABEL not in experiment.seen.processes:
        raise NothingToJudge("nothing was launched")
    return experiment.labelled(LABEL)


def start_all(names: Sequence[str]) -> Demand[ExperimentView]:
    """The launch runs on, and these nodes are in the graph."""

    def demand(experiment: ExperimentView) -> None:
        process = launch_of(experiment)
        command, there = process.seen.executable, tuple(experiment.seen.graph.nodes)
        how, log = describe_end(process.seen), process.last_lines()
        if process.seen.status == NOT_READ_HERE:
            raise Inconclusive(_not_read(log))
        if process.seen.ended_by_itself and not there:
            raise LaunchFailed(command, how, log=log)
        for name in names:
            if name not in there:
                raise LaunchMissesNode(command, how, name, there, log=log)

    return demand


def _not_read(log: Sequence[str]) -> str:
    said = [line.rpartition("[launch]: ")[2] for line in log if "known here" in line]
    why = f" ({said[0]})" if said else ""
    return (
        f"only the full ROS can carry out this launch file{why};"
        " launch it there, or show it to your instructor"
    )
