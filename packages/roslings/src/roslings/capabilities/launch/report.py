"""A launch on the page: what was typed, which programs ran, and which came back."""

from __future__ import annotations

from collections.abc import Iterator

from ros2_on_pip.language import Text, said
from ros2_on_pip.markup import Markup, tag
from roslings.capabilities.launch.record import LABEL, LaunchSeen
from roslings.evidence import Evidence, ExperimentSeen
from roslings.report.html.timeline_svg import table

HEAD = (
    Text("page.launch.program", "program"),
    Text("page.launch.often", "ran so often"),
    Text("page.launch.killed", "when it was killed"),
)


def sections(evidence: Evidence) -> Iterator[Markup]:
    """For each experiment that launched something."""
    figures = [
        _figure(seen) for seen in evidence.experiments.values() if seen.part(LaunchSeen).running
    ]
    if figures:
        yield tag("section", tag("h2", said("page.launch", "What was launched")), *figures)


def _figure(seen: ExperimentSeen) -> Markup:
    launch = seen.part(LaunchSeen)
    command = seen.processes[LABEL].executable if LABEL in seen.processes else seen.name
    rows = [(name, str(n), _returns(launch, name)) for name, n in sorted(launch.running.items())]
    name = said("page.launch.table", "programs of a launch")
    return tag("figure", tag("h3", command), table(name, HEAD, rows))


def _returns(launch: LaunchSeen, program: str) -> str:
    """What became of those that were killed; empty where none was."""
    return "; ".join(
        _return_of(each.node, each.back_after_s)
        for each in launch.killed
        if each.executable == program
    )


def _return_of(node: str, back_s: float | None) -> str:
    if back_s is None:
        return said("page.launch.gone", "{node} did not come back", node=node)
    answered = "{node} answered again after {back_s:.1f} s"
    return said("page.launch.back", answered, node=node, back_s=back_s)
