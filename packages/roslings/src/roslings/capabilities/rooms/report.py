"""Rooms on the page: where the rover went in each, where it bumped, and by which clock."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2_on_pip.language import Text, said
from ros2_on_pip.markup import Markup, tag
from roslings.capabilities.rooms.reasons import InRealTime
from roslings.capabilities.rooms.record import FloorSeen, RoomDriveSeen, RoomsSeen, RoomTick
from roslings.capabilities.rooms.seen import covered_m, way_m
from roslings.evidence import Evidence, ExperimentSeen
from roslings.report.html.timeline_svg import in_experiment, table

WIDEST, HIGHEST, MARGIN = 480.0, 360.0, 6.0
BUMP = 5.0
MOST_POINTS = 400
HEAD = (
    Text("page.rooms.room", "room"),
    Text("page.rooms.way", "way"),
    Text("page.rooms.ground", "new ground"),
    Text("page.rooms.bumps", "bumps"),
    Text("page.rooms.clock", "clock"),
)


def sections(evidence: Evidence) -> Iterator[Markup]:
    """For each experiment with rooms: a table, and a picture of each."""
    figures = [_figure(each) for each in evidence.experiments.values() if _drives(each)]
    if figures:
        words = (
            "A ring is where the rover starts, a dot is where it ends, a cross is a bump. What"
            " moves in a room is not drawn."
        )
        note = tag("p", said("page.rooms.about", words), class_="about")
        yield tag("section", tag("h2", said("page.rooms", "Rooms")), note, *figures)


def _drives(seen: ExperimentSeen) -> list[RoomDriveSeen]:
    return seen.part(RoomsSeen).drives


def _figure(seen: ExperimentSeen) -> Markup:
    floors = {floor.seed: floor for floor in seen.part(RoomsSeen).floors}
    pictures = [
        room_picture(floors[drive.seed], drive) for drive in _drives(seen) if drive.seed in floors
    ]
    rows = [_row(drive) for drive in _drives(seen)]
    heading = tag("h3", in_experiment(seen.name))
    head = table(said("page.rooms.table", "drives through rooms"), HEAD, rows)
    return tag("figure", heading, head, *pictures)


def _row(drive: RoomDriveSeen) -> tuple[str, ...]:
    thread = drive.sleepers[0].thread if drive.sleepers else ""
    lockstep = said("page.rooms.lockstep", "in lockstep")
    clock = str(InRealTime(drive.why_wall, thread)) if drive.why_wall else lockstep
    return (
        str(drive.seed),
        f"{way_m(drive):.1f} m",
        f"{covered_m(drive):.1f} m",
        str(len(drive.bumps)),
        clock,
    )


def room_picture(floor: FloorSeen, drive: RoomDriveSeen) -> Markup:
    """The room from above, x to the right and y up, and the way that the rover went."""
    paper = _Paper(floor)
    words = said(
        "page.rooms.picture",
        "Room {room}: the rover went {way_m:.1f} m, and bumped {bumps} times.",
        room=drive.seed,
        way_m=way_m(drive),
        bumps=len(drive.bumps),
    )
    parts = (*paper.things(), *paper.way(drive), *paper.bumps(drive))
    return tag(
        "svg",
        *parts,
        role="img",
        aria_label=words,
        viewBox=f"0 0 {paper.width:.0f} {paper.height:.0f}",
        width=paper.width,
        height=paper.height,
        class_="way",
    )


class _Paper:
    """Where a place of the room stands on the paper."""

    def __init__(self, floor: FloorSeen) -> None:
        self._floor = floor
        self._west, self._south, east, north = floor.inside
        wide_m, high_m = east - self._west, north - self._south
        self._scale = min((WIDEST - 2 * MARGIN) / wide_m, (HIGHEST - 2 * MARGIN) / high_m)
        self.width = wide_m * self._scale + 2 * MARGIN
        self.height = high_m * self._scale + 2 * MARGIN

    def _at(self, x_m: float, y_m: float) -> tuple[float, float]:
        x = MARGIN + (x_m - self._west) * self._scale
        return x, self.height - MARGIN - (y_m - self._south) * self._scale

    def things(self) -> Iterator[Markup]:
        """The walls, and all that stands."""
        yield self._outline(self._floor.inside)
        yield from map(self._outline, self._floor.boxes)
        for x_m, y_m, radius_m in self._floor.circles:
            x, y = self._at(x_m, y_m)
            radius = radius_m * self._scale
            yield tag("ellipse", cx=x, cy=y, rx=radius, ry=radius, class_="grid", fill="none")

    def _outline(self, box: tuple[float, float, float, float]) -> Markup:
        (left, bottom), (right, top) = self._at(*box[:2]), self._at(*box[2:])
        path = f"M{left:.1f} {bottom:.1f}H{right:.1f}V{top:.1f}H{left:.1f}Z"
        return tag("path", d=path, class_="grid", fill="none")

    def way(self, drive: RoomDriveSeen) -> Iterator[Markup]:
        """A ring, a line, a dot."""
        points = [self._at(tick.x_m, tick.y_m) for tick in _thinned(drive)]
        if not points:
            return
        yield tag("path", d="M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points), class_="true")
        for (x, y), kind in ((points[0], "true start"), (points[-1], "true end")):
            yield tag("ellipse", cx=x, cy=y, rx=BUMP, ry=BUMP, class_=kind)

    def bumps(self, drive: RoomDriveSeen) -> Iterator[Markup]:
        """A cross each."""
        for bump in drive.bumps:
            x, y = self._at(bump.x_m, bump.y_m)
            path = (
                f"M{x - BUMP:.1f} {y - BUMP:.1f}L{x + BUMP:.1f} {y + BUMP:.1f}"
                f"M{x - BUMP:.1f} {y + BUMP:.1f}L{x + BUMP:.1f} {y - BUMP:.1f}"
            )
            yield tag("path", d=path, class_="told")


def _thinned(drive: RoomDriveSeen) -> Sequence[RoomTick]:
    every = -(-len(drive.ticks) // MOST_POINTS) or 1
    return [*drive.ticks[:-1:every], *drive.ticks[-1:]]
