"""Managed nodes on the page: each transition, and where it led."""

from __future__ import annotations

from collections.abc import Iterator

from graders.valve.record import LifecycleSeen

from ros2_on_pip.markup import Markup, tag
from roslings.evidence import Evidence, ExperimentSeen


def sections(evidence: Evidence) -> Iterator[Markup]:
    """A table for each experiment that asked for transitions."""
    tables = [
        _table(seen) for seen in evidence.experiments.values() if seen.part(LifecycleSeen).steps
    ]
    if tables:
        yield tag("section", tag("h2", "The states of the node"), *tables)


def _table(seen: ExperimentSeen) -> Markup:
    head = tag("tr", tag("th", "asked to"), tag("th", "state afterwards"))
    rows = [
        tag("tr", tag("td", step.transition), tag("td", step.state or "no answer"))
        for step in seen.part(LifecycleSeen).steps
    ]
    return tag("figure", tag("h3", f"in {seen.name}"), tag("table", head, *rows))
