"""Demands on actions: who performs them, and what a client of them does."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ros2_on_pip.near_names import nearest
from roslings.capabilities.actions import faults
from roslings.capabilities.actions.contract import ActionContract
from roslings.capabilities.actions.reasons import NoGoal
from roslings.capabilities.actions.record import ActionEnd, ActionsSeen
from roslings.capabilities.services import demands as services
from roslings.capabilities.services.demands import end_by_itself, require_code, require_no_crash
from roslings.course import NodeContract, OutcomeContract
from roslings.course.files import written
from roslings.evidence import ExperimentSeen
from roslings.judge.demands import insist_on_at_most, most_similar
from roslings.judge.faults import NotLogged
from roslings.judge.faults.moments import When
from roslings.judge.faults.writing import PlaceInCode
from roslings.judge.values import same
from roslings.judge.views import Demand, ExperimentView
from roslings.judge.words import how_it_went

# --- who performs what -------------------------------------------------------------------------


def perform(action: ActionContract) -> Demand[ExperimentView]:
    """A node performs it under its very name."""

    def demand(experiment: ExperimentView) -> None:
        end = _server(experiment, action)
        if end is None:
            clients = (each.action for each in _ends(experiment, "client"))
            raise faults.NoAction(action.action, action.action in clients)
        near = nearest(action.action, [end.action])
        if near and not near.exact:
            raise faults.WrongAction(near)

    return demand


def perform_its_type(action: ActionContract) -> Demand[ExperimentView]:
    """The action has the card's type. Of one that is missing no type was seen."""

    def demand(experiment: ExperimentView) -> None:
        end = _server(experiment, action)
        if end is None:
            raise NoGoal("no_type", action.action)
        if end.type != action.type:
            raise faults.WrongActionType(end.action, action.type, end.type)

    return demand


def _ends(experiment: ExperimentView, kind: str) -> list[ActionEnd]:
    return [end for end in experiment.seen.part(ActionsSeen).ends if end.kind == kind]


def _server(experiment: ExperimentView, action: ActionContract) -> ActionEnd | None:
    """The server that is meant: the very name, else the nearest one, the right type first."""
    servers = _ends(experiment, "server")
    exact = [end for end in servers if end.action == action.action]
    pool = exact or [end for end in servers if end.type == action.type] or servers
    near = nearest(action.action, (end.action for end in pool))
    return next((end for end in pool if near and end.action == near.found), None)


# --- clients -----------------------------------------------------------------------------------


def send_goal(
    node: NodeContract, action: ActionContract, goal: Mapping[str, float]
) -> Demand[ExperimentView]:
    """The client sends its goal to the server, as its parameters say."""

    def demand(experiment: ExperimentView) -> None:
        process = experiment.process(node)
        if not experiment.seen.part(ActionsSeen).orders:
            require_no_crash(process, "sends", action.action)
            near = nearest(action.action, (e.action for e in _ends(experiment, "client")))
            if near and not near.exact:
                raise faults.SendsElsewhere(near)
            raise faults.SentNoGoal(
                node.executable, action.action, how_it_went(process.seen), log=process.last_lines(6)
            )
        found = experiment.seen.part(ActionsSeen).orders[0].goal
        for name, wanted in goal.items():
            if not same(sent := float(found[name]), wanted):
                raise faults.SentAnotherGoal(node.executable, name, f"{wanted:g}", f"{sent:g}")
        if len(experiment.seen.part(ActionsSeen).orders) > 1:
            raise faults.GoalSentAgain(
                node.executable, action.action, len(experiment.seen.part(ActionsSeen).orders)
            )

    return demand


def show_each(node: NodeContract, texts: Sequence[str]) -> Demand[ExperimentView]:
    """The client writes the card's line for each feedback; one may be lost on the way."""
    template = written(node.log, node.node)

    def demand(experiment: ExperimentView) -> None:
        process = experiment.process(node)
        lines = {text: template.format(text=text) for text in texts}
        missing = [
            text
            for text, line in lines.items()
            if not any(line in found for found in process.texts)
        ]
        if len(missing) > 1:
            line = lines[missing[0]]
            raise NotLogged(
                node.executable,
                line,
                most_similar(line, process.texts),
                when=When("feedback_is", missing[0]),
                place=PlaceInCode("feedback"),
            )
        for line in lines.values():
            insist_on_at_most(process, [line], 1)

    return demand


def end_so(node: NodeContract, outcome: OutcomeContract, text: str = "") -> Demand[ExperimentView]:
    """The client ends by itself, writes the card's line, and its exit code tells how it went."""

    def demand(experiment: ExperimentView) -> None:
        process = experiment.process(node)
        line, case = outcome.log.format(text=text), outcome.when.removeprefix("when ")
        when = When("card", case)
        experiment.must(end_by_itself(node, None, when, _answered))
        require_no_crash(process, "writes", line, when)
        if not any(line in found for found in process.texts):
            raise NotLogged(
                node.executable,
                line,
                most_similar(line, process.texts),
                when=when,
                place=PlaceInCode("case", case),
            )
        insist_on_at_most(process, [line], 1)
        require_code(process, outcome.exit_code, when)

    return demand


def _answered(seen: ExperimentSeen) -> bool:
    """A goal of the client came to the grader's server, which answers at once."""
    return bool(seen.part(ActionsSeen).orders)


def give_up(node: NodeContract) -> Demand[ExperimentView]:
    """Without a server the client ends in time, says why, and its exit code says so, too."""
    return services.give_up(node, wait="wait_for_server")
