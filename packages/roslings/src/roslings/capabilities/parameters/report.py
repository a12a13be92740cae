"""Parameters on the page: those that were set, and what became of them; those of a launch."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ros2_on_pip.markup import Markup, tag
from roslings.capabilities.parameters.record import (
    GIVEN_BY_ROS,
    ParameterSet,
    ParametersRead,
    ParametersSeen,
    ParameterTrial,
)
from roslings.evidence import Evidence, ExperimentSeen
from roslings.report.html.timeline_svg import fields_text, table

MOST_ROWS = 60
SET = ("node", "parameter", "set to", "what became of it")
READ = ("node", "its parameters")


def sections(evidence: Evidence) -> Iterator[Markup]:
    """For each experiment that set a parameter while the node ran, or read them all."""
    experiments = evidence.experiments.values()
    figures = [figure for seen in experiments for figure in _figures(seen)]
    if figures:
        yield tag("section", tag("h2", "Parameters that were set"), *figures)
    read = [_read_figure(seen) for seen in experiments if seen.part(ParametersSeen).read]
    if read:
        yield tag("section", tag("h2", "Parameters after the launch"), *read)


def _figures(seen: ExperimentSeen) -> Iterator[Markup]:
    part = seen.part(ParametersSeen)
    rows = [_row(said) for said in part.sets] + [_trial_row(tried) for tried in part.trials]
    if rows:
        tables = table("parameters that were set", SET, rows[:MOST_ROWS])
        yield tag("figure", tag("h3", f"in {seen.name}"), tables)


def _row(said: ParameterSet) -> tuple[str, ...]:
    return said.node, said.name, fields_text(said.value), _outcome(said)


def _trial_row(tried: ParameterTrial) -> tuple[str, ...]:
    """Several at once stand in one row."""
    names = ", ".join(tried.asked)
    values = ", ".join(fields_text(value) for value in tried.asked.values())
    return tried.node, names, f"{values} (at once)" if tried.together else values, _outcome(tried)


def _outcome(said: ParameterSet | ParameterTrial) -> str:
    if said.answered_ns is None:
        return "no answer"
    reason = f": {fields_text(said.reason)}" if said.reason else ""
    return "taken" if said.accepted else f"refused{reason}"


def _read_figure(seen: ExperimentSeen) -> Markup:
    rows = [_read_row(read) for read in seen.part(ParametersSeen).read[:MOST_ROWS]]
    return tag("figure", tag("h3", f"in {seen.name}"), table("parameters of a launch", READ, rows))


def _read_row(read: ParametersRead) -> tuple[str, str]:
    return read.node, ", ".join(_pairs(read.values))


def _pairs(values: Mapping[str, object]) -> Iterator[str]:
    """Without those that ROS gives to every node."""
    own = (name for name in values if name not in GIVEN_BY_ROS)
    return (f"{name} {fields_text(values[name])}" for name in own)
