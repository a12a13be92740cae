"""Demands on managed nodes: that a node is one, and that each transition leads where it should."""

from __future__ import annotations

from graders.valve import faults
from graders.valve.contract import LifecycleWords
from graders.valve.record import LifecycleSeen, StepSeen

from roslings.course import NodeContract
from roslings.judge import ExperimentView
from roslings.judge.demands import require_steady
from roslings.judge.faults import NothingToJudge
from roslings.judge.views import Demand


def be_managed(node: NodeContract) -> Demand[ExperimentView]:
    """The node answers who asks for a transition."""

    def demand(experiment: ExperimentView) -> None:
        if not any(step.accepted is not None for step in _steps(experiment)):
            require_steady(experiment.seen.stall_s)
            raise faults.NotManaged(node.node)

    return demand


def go_through(node: NodeContract) -> Demand[ExperimentView]:
    """After each transition the node is in the card's state."""

    def demand(experiment: ExperimentView) -> None:
        asked = node.of(LifecycleWords).lifecycle
        for wanted, seen in zip(asked, _steps(experiment), strict=False):
            if seen.state is None:
                raise NothingToJudge("it did not tell its state")
            if seen.state != wanted.state:
                raise faults.OtherState(wanted.transition, wanted.state, seen.state)

    return demand


def _steps(experiment: ExperimentView) -> list[StepSeen]:
    """Raises NothingToJudge where no transition was asked for."""
    steps = experiment.seen.part(LifecycleSeen).steps
    if not steps:
        raise NothingToJudge("there was no node to ask")
    return steps
