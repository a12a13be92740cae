"""Parameters on the page: those that were set, and what became of them."""

from __future__ import annotations

from collections.abc import Iterator

from roslings.capabilities.parameters.record import ParameterSet, ParametersSeen
from roslings.evidence import Evidence, ExperimentSeen
from roslings.report.html.markup import Markup, tag
from roslings.report.html.timeline_svg import fields_text, table

MOST_ROWS = 60
SET = ("node", "parameter", "set to", "what became of it")


def sections(evidence: Evidence) -> Iterator[Markup]:
    """For each experiment that set a parameter while the node ran."""
    figures = [_figure(seen) for seen in evidence.experiments.values()
               if seen.part(ParametersSeen).sets]  # fmt: skip
    if figures:
        yield tag("section", tag("h2", "Parameters that were set"), *figures)


def _figure(seen: ExperimentSeen) -> Markup:
    sets = seen.part(ParametersSeen).sets[:MOST_ROWS]
    rows = [(said.node, said.name, fields_text(said.value), _outcome(said)) for said in sets]
    return tag("figure", tag("h3", f"in {seen.name}"), table("parameters that were set", SET, rows))


def _outcome(said: ParameterSet) -> str:
    if said.answered_ns is None:
        return "no answer"
    reason = f": {fields_text(said.reason)}" if said.reason else ""
    return "taken" if said.accepted else f"refused{reason}"
