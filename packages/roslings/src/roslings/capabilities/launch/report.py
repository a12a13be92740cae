"""A launch on the page: what was typed, which programs ran, and which came back."""

from __future__ import annotations

from collections.abc import Iterator

from ros2_on_pip.markup import Markup, tag
from roslings.capabilities.launch.record import LABEL, LaunchSeen
from roslings.evidence import Evidence, ExperimentSeen
from roslings.report.html.timeline_svg import table

HEAD = ("program", "ran so often", "when it was killed")


def sections(evidence: Evidence) -> Iterator[Markup]:
    """For each experiment that launched something."""
    figures = [
        _figure(seen) for seen in evidence.experiments.values() if seen.part(LaunchSeen).running
    ]
    if figures:
        yield tag("section", tag("h2", "What was launched"), *figures)


def _figure(seen: ExperimentSeen) -> Markup:
    launch = seen.part(LaunchSeen)
    command = seen.processes[LABEL].executable if LABEL in seen.processes else seen.name
    rows = [(name, str(n), _returns(launch, name)) for name, n in sorted(launch.running.items())]
    return tag("figure", tag("h3", command), table("programs of a launch", HEAD, rows))


def _returns(launch: LaunchSeen, program: str) -> str:
    """What became of those that were killed; empty where none was."""
    said = []
    for each in launch.killed:
        if each.executable == program:
            back_s = each.back_after_s
            how = "did not come back" if back_s is None else f"answered again after {back_s:.1f} s"
            said.append(f"{each.node} {how}")
    return "; ".join(said)
