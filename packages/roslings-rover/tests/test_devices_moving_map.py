"""The map that drives: what it draws, how it moves, and who sees it stand."""

from __future__ import annotations

import math
import re
from itertools import pairwise
from xml.etree import ElementTree

import pytest

from roslings_rover.models.differential_drive import Body, Motion, Pose
from roslings_rover.models.world import default_world
from roslings_rover.rover.moving_map import (
    LONGEST_S,
    MOST_FRAMES,
    moving_map,
    place_under,
    shown_s,
)
from roslings_rover.rover.rover import Rover, RoverMoment

RADIUS_M = Body().radius_m


def driven(*parts: tuple[float, float, float]) -> list[RoverMoment]:
    """The trail of a rover that drives each part: m/s, rad/s, seconds."""
    rover = Rover()
    for forward_m_s, turn_rad_s, seconds in parts:
        rover.drive(Motion(forward_m_s, turn_rad_s))
        for _ in range(round(seconds / 0.02)):
            rover.step(0.02)
    return [*rover.trail, RoverMoment(rover.time_s, rover.pose)]


def svg_of(trail: list[RoverMoment], **how: bool) -> str:
    """The map of a trail in the course's room."""
    return moving_map(default_world(), trail, RADIUS_M, **how)


def frames_of(svg: str, name: str) -> list[tuple[float, str]]:
    """Percent and rule of each key frame."""
    rules = re.search(rf"@keyframes {name}\{{(.*?\}})\}}", svg)
    assert rules
    return [(float(at), rule) for at, rule in re.findall(r"([\d.]+)%\{(.*?)\}", rules[1])]


def test_it_is_a_drawing_with_the_whole_room() -> None:
    """Well formed; a wall, two boxes, two bins, and a ball in its colour."""
    svg = svg_of(driven((0.3, 0.0, 2.0)))
    drawing = ElementTree.fromstring(svg)
    kinds = [each.get("class") for each in drawing.iter()]
    assert kinds.count("wall") == 1 and kinds.count("obstacle") == 4
    assert {"path", "start", "rover", "ball"} <= set(drawing.itertext())
    assert "<script" not in svg and "http" not in svg.replace("http://www.w3.org/2000/svg", "")


def test_the_way_begins_and_ends_where_the_rover_did() -> None:
    """First and last frame, and what stands there without motion."""
    trail = driven((0.4, 0.3, 5.0), (0.0, 1.5, 2.0), (0.5, -0.4, 4.0))
    svg, last = svg_of(trail), trail[-1].pose
    frames, way = frames_of(svg, "drive"), frames_of(svg, "way")
    assert frames[0][0] == way[0][0] == 0 and frames[-1][0] == way[-1][0] == 100
    assert way[0][1].endswith(":1.0000") and way[-1][1].endswith(":0.0000")
    x_px, y_px = 44 + (last.x_m + 2.3) * 50, 34 + (7.3 - last.y_m) * 50
    placed = re.search(r'class="rover" transform="translate\((\S+) (\S+)\)', svg)
    assert placed and [float(each) for each in placed.groups()] == pytest.approx(
        [x_px, y_px], abs=0.06
    )
    moved = re.search(r"translate\(([\d.]+)px,([\d.]+)px\)", frames[-1][1])
    assert moved
    assert [float(each) for each in moved.groups()] == [float(each) for each in placed.groups()]


def test_a_turn_on_the_spot_is_seen_and_never_jumps_round() -> None:
    """Past pi the heading goes on: the rover does not spin back."""
    svg = svg_of(driven((0.0, 2.0, 5.0)))
    angles = [float(rule.rpartition("rotate(")[2][:-4]) for _, rule in frames_of(svg, "drive")]
    assert angles[-1] < -360
    assert all(later <= earlier + 0.1 for earlier, later in pairwise(angles))


def test_a_long_drive_is_short_to_watch_and_small() -> None:
    """At most five seconds, at most so many frames, below 50 kB."""
    trail = driven(*[(0.4, 0.5, 10.0), (0.4, -0.5, 10.0)] * 10)
    svg = svg_of(trail)
    assert shown_s(trail) == LONGEST_S and len(frames_of(svg, "drive")) <= MOST_FRAMES
    assert len(svg) < 50_000


def test_a_rest_is_cut_short() -> None:
    """Ten seconds of standing are not watched."""
    trail = driven((0.3, 0.0, 2.0), (0.0, 0.0, 10.0), (0.3, 0.0, 1.0))
    assert 2.5 < shown_s(trail) < 4.5


def test_who_never_moved_just_stands() -> None:
    """No animation at all; and without a moment there is no map."""
    svg = svg_of([RoverMoment(at_s, Pose(1.0, 1.0, math.pi / 2)) for at_s in (0.0, 0.3)])
    assert "@keyframes" not in svg and 'class="rover" transform="translate(209.0 349.0)' in svg
    with pytest.raises(ValueError, match="one moment"):
        svg_of([])


def test_places_are_marked_where_asked() -> None:
    """A dot for each, as a list of odometry has them."""
    trail = [RoverMoment(0.1 * i, Pose(0.2 * i, 0.1 * i)) for i in range(9)]
    assert svg_of(trail, dots=True).count('r="2.4"') == 9
    assert 'r="2.4"' not in svg_of(trail)


def test_without_motion_it_stands_at_the_end() -> None:
    """The same drawing, and no animation."""
    trail = driven((0.3, 0.2, 3.0))
    moving, still = svg_of(trail), svg_of(trail, moves=False)
    assert "animation:" not in still.replace("animation:none", "") and "@keyframes" not in still
    assert moving.partition("</style>")[2] == still.partition("</style>")[2]


def test_a_point_of_the_picture_is_a_place_in_the_room() -> None:
    """Where the way ends, the rover is."""
    trail = driven((0.4, 0.5, 3.0))
    svg = svg_of(trail, moves=False)
    wide, high = map(float, re.search(r'viewBox="0 0 (\S+) (\S+)"', svg).groups())
    right, down = map(float, re.findall(r"([\d.]+)[, ]([\d.]+)", way_of(svg))[-1])
    x_m, y_m = place_under(default_world(), right / wide, down / high)
    assert math.dist((x_m, y_m), (trail[-1].pose.x_m, trail[-1].pose.y_m)) < 0.01


def way_of(svg: str) -> str:
    """The points of the line that was driven."""
    drawn = ElementTree.fromstring(svg)
    (line,) = (each for each in drawn.iter() if each.tag.endswith("polyline"))
    return line.get("points") or ""
