"""Drives on the page: how far points were from walls, and the map that was drawn."""

from __future__ import annotations

from collections.abc import Iterator

from graders.frames.record import FramesDriveSeen, FramesSeen
from ros2_on_pip.language import Text, said
from ros2_on_pip.markup import Markup, tag
from roslings.evidence import Evidence
from roslings.report.html.timeline_svg import table

HEAD = (
    Text("page.frames.part", "the rover"),
    Text("page.frames.scans", "scans"),
    Text("page.frames.answered", "with points"),
    Text("page.frames.off", "off the walls, in the mean"),
)
PARTS = {
    "before": Text("page.frames.before", "before the first odometry"),
    "standing": Text("page.frames.standing", "stands"),
    "moving": Text("page.frames.moving", "drives and turns"),
    "after": Text("page.frames.after", "after the last odometry"),
}

SMALL = "line-height: 1; font-size: 6px"
"""A cell is about as wide as it is high."""


def sections(evidence: Evidence) -> Iterator[Markup]:
    """For each drive that a node was told of."""
    seen = [each.part(FramesSeen) for each in evidence.experiments.values()]
    drives = [(each.drive, each.shown) for each in seen if each.drive]
    if drives:
        title = said("page.frames", "Drives that the node was told of")
        yield tag("section", tag("h2", title), *(_figure(*each) for each in drives))


def _figure(drive: FramesDriveSeen, shown: str) -> Markup:
    title = said(
        "page.frames.room",
        "room {seed}, the laser at {x} m, {y} m, turned by {yaw} rad",
        seed=str(drive.seed),
        x=f"{drive.laser_x_m:g}",
        y=f"{drive.laser_y_m:g}",
        yaw=f"{drive.laser_yaw_rad:g}",
    )
    rows = [_row(drive, part, str(text)) for part, text in PARTS.items()]
    parts = [tag("h3", title), table(title, HEAD, rows)]
    if shown:
        caption = said("page.frames.map", "the middle of the map: # wall, . free, blank unknown")
        parts += [tag("figcaption", caption), tag("pre", shown, style=SMALL)]
    return tag("figure", *parts)


def _row(drive: FramesDriveSeen, part: str, name: str) -> tuple[str, str, str, str]:
    scans = [scan for scan in drive.scans if scan.part == part]
    off_m = [walls.off_m for walls in drive.walls if walls.part == part and walls.points]
    mean = f"{sum(off_m) / len(off_m):.3f} m" if off_m else "-"
    return name, str(len(scans)), str(sum(scan.answers > 0 for scan in scans)), mean
