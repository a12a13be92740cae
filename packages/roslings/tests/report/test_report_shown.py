"""Pictures on the page: those that were kept, and the ways of a drive."""

from __future__ import annotations

import math
import re
from typing import Any

import pytest
from pydantic import ValidationError
from written_evidence import evidence
from written_verdicts import too_slow

from roslings.capabilities.camera.record import PictureKept
from roslings.capabilities.robot.record import WaySeen
from roslings.capabilities.robot.report import MOST_POINTS, describe, way_picture, ways_of
from roslings.evidence import ExperimentSeen, MessageSeen, TopicSeen
from roslings.report.html import html_of
from seen_with import seen_with

# One red pixel.
PNG = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC"
ODOMETRY = "nav_msgs/msg/Odometry"


def odometry(points: list[tuple[Any, Any]]) -> TopicSeen:
    """What a node told of its place."""
    messages = [
        MessageSeen(
            source_ns=None,
            sequence=None,
            arrival_ns=n,
            size=1,
            content={"pose": {"pose": {"position": {"x": x, "y": y, "z": 0.0}}}},
        )
        for n, (x, y) in enumerate(points)
    ]
    return TopicSeen(name="/odom", type=ODOMETRY, messages=messages)


def driven(points: list[tuple[Any, Any]], told: list[tuple[Any, Any]]) -> ExperimentSeen:
    """A drive."""
    way = [WaySeen(name="where it really was", points_m=points)] if points else []
    topics = {"/odom": odometry(told)}
    return seen_with(name="driving", clock="wall", ways=way, topics=topics)


def page(*experiments: ExperimentSeen) -> str:
    """The whole page."""
    return html_of(too_slow(), evidence(*experiments), [])


def test_a_picture_stands_in_the_page_itself_with_its_words() -> None:
    """The browser may draw what the page carries, and fetch nothing."""
    kept = PictureKept(title="A ball", caption='A "ball" <b>', png=PNG, width=1, height=1)
    text = page(seen_with(name="looking", clock="wall", pictures=[kept]))
    assert f'src="data:image/png;base64,{PNG}"' in text
    assert 'alt="A &quot;ball&quot; &lt;b&gt;"' in text
    assert "<figcaption>A &quot;ball&quot; &lt;b&gt;</figcaption>" in text
    assert "img-src data:" in text
    assert "://" not in re.sub(r"base64,[^\"]*", "", text)


@pytest.mark.parametrize("png", ["", 'x" onerror="alert(1)', "//evil/x.png ", "a\nb"])
def test_evidence_with_another_thing_in_the_place_of_a_picture_is_refused(png: str) -> None:
    """It comes from a file that anybody can write."""
    with pytest.raises(ValidationError):
        PictureKept(title="", caption="", png=png, width=1, height=1)


def test_a_drive_is_drawn_beside_what_was_told() -> None:
    """With a text that says the same as the picture."""
    seen = driven([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)], [(0.0, 0.0), (1.0, 0.0), (1.0, 0.5)])
    ways = ways_of(seen)
    assert [way.name for way in ways] == ["where it really was", "/odom"]
    words = describe(ways)
    assert "Where it really was: 2.00 m long, ends at x 1.00 m, y 1.00 m." in words
    assert "What /odom told: 1.50 m long" in words
    assert "0.50 m apart" in words
    text = page(seen)
    assert text.count('class="way"') == 1
    assert words in text


def test_up_on_the_floor_is_up_on_the_paper() -> None:
    """And both directions have one scale."""
    ways = [WaySeen(name="a", points_m=[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0)])]
    path = re.search(r'd="M([^"]+)"', way_picture(ways))
    assert path
    (x0, y0), (x1, y1), (x2, y2) = (
        tuple(map(float, point.split())) for point in path[1].split("L")
    )
    assert x1 > x0 and y1 == y0 and x2 == x1 and y2 < y1
    assert (x1 - x0) == pytest.approx(2 * (y1 - y2), abs=0.3)


def test_what_is_no_number_is_left_out_and_long_ways_are_thinned() -> None:
    """The last point stays."""
    told = [(n / 1000, math.nan if n == 5 else 0.0) for n in range(3000)]
    seen = driven([(0.0, 0.0), (3.0, 0.0)], [*told, ("Infinity", 0.0), (None, 1.0)])
    way = ways_of(seen)[1]
    assert len(way.points_m) <= MOST_POINTS + 1
    assert way.points_m[-1] == (2.999, 0.0)
    assert all(math.isfinite(value) for point in way.points_m for value in point)


def test_odometry_alone_is_not_drawn() -> None:
    """Without the truth beside it, it shows nothing."""
    assert ways_of(driven([], [(0.0, 0.0), (1.0, 0.0)])) == []
    assert 'class="way"' not in page(driven([], [(0.0, 0.0)]))


def test_a_robot_that_stands_is_drawn_as_well() -> None:
    """One point, or many in one place."""
    assert "<svg" in way_picture(ways_of(driven([(1.0, 1.0)], [(1.0, 1.0), (1.0, 1.0)])))
