"""Quality of service on the page: what those got who came late."""

from __future__ import annotations

from collections.abc import Iterator

from ros2_on_pip.language import Text, said
from ros2_on_pip.markup import Markup, tag
from roslings.capabilities.qos.record import JoinSeen, QosSeen
from roslings.evidence import Evidence
from roslings.report.html.timeline_svg import table

HEAD = (Text("page.late.after", "came late, after"), Text("page.late.got", "got"))


def sections(evidence: Evidence) -> Iterator[Markup]:
    """All late joiners."""
    joins = [join for seen in evidence.experiments.values() for join in seen.part(QosSeen).joins]
    if joins:
        rows = [_joined(join) for join in joins]
        title = tag("h2", said("page.late", "Late joiners"))
        yield tag("section", title, table(said("page.late.table", "late joiners"), HEAD, rows))


def _joined(join: JoinSeen) -> tuple[str, str]:
    then = said("page.late.then", ", then ")
    heard = then.join(str(each).lower() for each in join.heard)
    return join.after, heard or said("page.late.nothing", "nothing")
