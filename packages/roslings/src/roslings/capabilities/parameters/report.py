"""Parameters on the page: those that were set, and what became of them; those of a launch."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ros2_on_pip.language import Text, said
from ros2_on_pip.markup import Markup, tag
from roslings.capabilities.parameters.record import (
    GIVEN_BY_ROS,
    ParameterSet,
    ParametersRead,
    ParametersSeen,
    ParameterTrial,
)
from roslings.evidence import Evidence, ExperimentSeen
from roslings.report.html.timeline_svg import fields_text, in_experiment, table

MOST_ROWS = 60
SET = (
    Text("page.parameters.node", "node"),
    Text("page.parameters.name", "parameter"),
    Text("page.parameters.set_to", "set to"),
    Text("page.parameters.became", "what became of it"),
)
READ = (Text("page.parameters.node", "node"), Text("page.parameters.its", "its parameters"))


def sections(evidence: Evidence) -> Iterator[Markup]:
    """For each experiment that set a parameter while the node ran, or read them all."""
    experiments = evidence.experiments.values()
    figures = [figure for seen in experiments for figure in _figures(seen)]
    if figures:
        yield tag(
            "section", tag("h2", said("page.parameters.set", "Parameters that were set")), *figures
        )
    read = [_read_figure(seen) for seen in experiments if seen.part(ParametersSeen).read]
    if read:
        title = said("page.parameters.launched", "Parameters after the launch")
        yield tag("section", tag("h2", title), *read)


def _figures(seen: ExperimentSeen) -> Iterator[Markup]:
    part = seen.part(ParametersSeen)
    rows = [_row(each) for each in part.sets] + [_trial_row(tried) for tried in part.trials]
    if rows:
        name = said("page.parameters.set_table", "parameters that were set")
        tables = table(name, SET, rows[:MOST_ROWS])
        yield tag("figure", tag("h3", in_experiment(seen.name)), tables)


def _row(each: ParameterSet) -> tuple[str, ...]:
    return each.node, each.name, fields_text(each.value), _outcome(each)


def _trial_row(tried: ParameterTrial) -> tuple[str, ...]:
    """Several at once stand in one row."""
    names = ", ".join(tried.asked)
    values = ", ".join(fields_text(value) for value in tried.asked.values())
    if tried.together:
        values = said("page.parameters.at_once", "{values} (at once)", values=values)
    return tried.node, names, values, _outcome(tried)


def _outcome(each: ParameterSet | ParameterTrial) -> str:
    if each.answered_ns is None:
        return said("page.parameters.no_answer", "no answer")
    if each.accepted:
        return said("page.parameters.taken", "taken")
    reason = f": {fields_text(each.reason)}" if each.reason else ""
    return said("page.parameters.refused", "refused{reason}", reason=reason)


def _read_figure(seen: ExperimentSeen) -> Markup:
    rows = [_read_row(read) for read in seen.part(ParametersSeen).read[:MOST_ROWS]]
    name = said("page.parameters.table", "parameters of a launch")
    return tag("figure", tag("h3", in_experiment(seen.name)), table(name, READ, rows))


def _read_row(read: ParametersRead) -> tuple[str, str]:
    return read.node, ", ".join(_pairs(read.values))


def _pairs(values: Mapping[str, object]) -> Iterator[str]:
    """Without those that ROS gives to every node."""
    own = (name for name in values if name not in GIVEN_BY_ROS)
    return (f"{name} {fields_text(values[name])}" for name in own)
