"""Quality of service on the page: what those got who came late."""

from __future__ import annotations

from collections.abc import Iterator

from ros2_on_pip.markup import Markup, tag
from roslings.capabilities.qos.record import JoinSeen, QosSeen
from roslings.evidence import Evidence
from roslings.report.html.timeline_svg import table

HEAD = ("came late, after", "got")


def sections(evidence: Evidence) -> Iterator[Markup]:
    """All late joiners."""
    joins = [join for seen in evidence.experiments.values() for join in seen.part(QosSeen).joins]
    if joins:
        rows = [_joined(join) for join in joins]
        yield tag("section", tag("h2", "Late joiners"), table("late joiners", HEAD, rows))


def _joined(join: JoinSeen) -> tuple[str, str]:
    return join.after, ", then ".join(str(each).lower() for each in join.heard) or "nothing"
