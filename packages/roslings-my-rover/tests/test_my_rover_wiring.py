"""The wiring of every rover that there can be: each set of parts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from itertools import combinations

import pytest

from roslings.capabilities.parameters.contract import ParameterWords
from roslings.course import lab
from roslings_my_rover.parts import (
    CABLE,
    EYES,
    GUARD,
    LIMITER,
    MAPPER,
    PARTS,
    PILOT,
    SONAR,
    RoverPart,
)
from roslings_my_rover.robot import SAYS_FRAMES
from roslings_my_rover.wiring import (
    CHECKED,
    DRAWN_MAP,
    ENTRANCE,
    LIMITED,
    MOTORS,
    Wiring,
    new_mark,
    wired,
)
from roslings_rover.models.differential_drive import Pose
from roslings_rover.rover.frames import LASER_ON_BODY, TF, TF_STATIC

SETS = [frozenset(some) for n in range(len(PARTS) + 1) for some in combinations(PARTS, n)]
LINKS = {ENTRANCE, LIMITED, CHECKED, MOTORS}
MARK = "_1a2b3c"
OF_CARDS = {
    (LIMITER, "speed_limiter"): ("cmd_vel_in", "cmd_vel"),
    (GUARD, "guard"): ("cmd_vel_raw", "cmd_vel"),
    (CABLE, "serial_bridge"): ("cmd_vel", None),
}
"""What each stage hears and says by its card."""


def stages(parts: frozenset[RoverPart], mark: str = "") -> Iterator[tuple[str, str | None]]:
    """From which link to which each stage leads; None: to the wheels."""
    wiring = wired(parts, "port", "device", mark)
    for (part, program), (hears, says) in OF_CARDS.items():
        if part in parts:
            names = dict(wiring.programs[program].remaps)
            yield _absolute(names.get(hears, hears)), _absolute(names.get(says, says))
    if wiring.relay:
        names = dict(wiring.relay.remaps)
        yield names["commands"], names["checked"]
    if wiring.robot.hears:
        yield wiring.robot.hears, None


def _absolute(name: str | None) -> str | None:
    return name if name is None or name.startswith("/") else f"/{name}"


@pytest.mark.parametrize("size", range(len(PARTS) + 1))
def test_each_command_has_one_way_to_the_wheels(size: int) -> None:
    """From /cmd_vel, through each stage that is there, once; each link has one publisher."""
    for parts in (each for each in SETS if len(each) == size):
        found = list(stages(parts))
        heard = Counter(hears for hears, _ in found)
        said = Counter(says for _, says in found if says)
        assert set(heard) <= LINKS and max(heard.values()) == 1, parts
        assert max(said.values(), default=1) == 1 and ENTRANCE not in said, parts
        way, leads = [ENTRANCE], dict(found)
        while (link := leads[way[-1]]) is not None:
            way.append(link)
        assert len(way) == len(found), f"{parts}: {found}"


@pytest.mark.parametrize("size", range(len(PARTS) + 1))
def test_a_rover_that_runs_has_links_that_nobody_knows(size: int) -> None:
    """But for the entrance: the same way to the wheels, under names with the rover's mark."""
    for parts in (each for each in SETS if len(each) == size):
        known, marked = list(stages(parts)), list(stages(parts, MARK))
        assert marked == [tuple(map(_marked, each)) for each in known], parts
        links = {link for stage in known for link in stage if link} - {ENTRANCE}
        assert {*wired(parts, mark=MARK).robot.links} == {(link, link + MARK) for link in links}


def _marked(link: str | None) -> str | None:
    return link if link in (None, ENTRANCE) else f"{link}{MARK}"


def test_each_rover_has_a_mark_of_its_own() -> None:
    """That makes a name of ROS, and that nobody can guess."""
    marks = {new_mark() for _ in range(100)}
    assert len(marks) == 100 and all(mark[1:].isalnum() and mark[0] == "_" for mark in marks)


def test_what_is_said_steadily_is_promised_by_a_card() -> None:
    """A program that keeps to its card is never called silent."""
    told = {
        "distance_subscriber": "one message for each distance",
        "serial_bridge": "where the rover is",
        "frames": "for each message on /odom",
    }
    for each in wired(PARTS, mark=MARK).robot.steady:
        part = next(part for part in PARTS if each.program in part.programs)
        says = {said.topic: said for said in lab(part.lab).card.node(each.program).publishes}
        said = says["/cmd_vel" if each.topic == MOTORS else each.topic]
        assert said.type == each.kind
        assert said.rate or told[each.program] in said.about, each


def test_what_a_part_does_the_robot_does_not() -> None:
    """Odometry, frames, pictures and the time of the wheels have one source each."""
    for parts in SETS:
        robot = wired(parts).robot
        assert robot.says_odom == (CABLE not in parts) == bool(robot.hears)
        assert robot.believes == (CABLE in parts)
        assert robot.shows_pictures == (EYES not in parts)
        assert robot.says_echo == (SONAR in parts)
        assert robot.says_frames == (MAPPER not in parts) != robot.hears_map


def test_the_names_are_those_of_the_cards() -> None:
    """A card that is changed for a new term changes the rover, or this test."""
    for (part, program), (hears, says) in OF_CARDS.items():
        node = lab(part.lab).card.node(program)
        assert f"/{hears}" in {each.topic for each in node.subscribes}
        assert says is None or f"/{says}" in {each.topic for each in node.publishes}
    for part in PARTS:
        programs = {node.executable for node in lab(part.lab).card.nodes}
        assert set(part.programs) <= programs, part
    assert lab(SONAR.lab).card.node("distance_sensor").subscribes[0].topic == "/sonar_echo"
    assert lab(PILOT.lab).card.node("drive_server").publishes[0].topic == ENTRANCE
    assert lab(CABLE.lab).card.node("serial_bridge").of(ParameterWords).parameter("port")
    assert lab(EYES.lab).card.node("camera").of(ParameterWords).parameter("device")
    said = {each.topic for each in lab(MAPPER.lab).card.node("frames").publishes}
    assert {DRAWN_MAP, TF, TF_STATIC} <= said and MAPPER.programs == (SAYS_FRAMES,)


def test_the_mapper_is_told_where_the_laser_of_this_rover_sits() -> None:
    """By the parameters of its card, each a double; as the rover's own frames say it."""
    node = lab(MAPPER.lab).card.node("frames").of(ParameterWords)
    told = dict(wired([MAPPER]).programs["frames"].parameters)
    assert told.keys() == {each.name for each in node.parameters}
    assert all(
        "." in value and node.parameter(name).type == "double" for name, value in told.items()
    )
    place = Pose(*(float(told[f"laser_{name}"]) for name in ("x", "y", "yaw")))
    assert place == LASER_ON_BODY


def test_who_says_frames_rests_with_a_pulled_cable() -> None:
    """Without odometry there is no step to say: then nobody is blamed."""
    for parts in ((MAPPER,), (MAPPER, CABLE)):
        (frames,) = (each for each in wired(parts).robot.steady if each.topic == TF)
        assert frames.by_cable == (CABLE in parts)


def test_an_argument_is_written_as_ros_takes_it() -> None:
    """Without anything to say, nothing is said."""
    wiring: Wiring = wired({CABLE, LIMITER}, port="/run/a port")
    assert wiring.programs["serial_bridge"].arguments == [
        "--ros-args",
        "-r",
        "cmd_vel:=/rover/limited",
        "-p",
        "port:=/run/a port",
    ]
    assert wiring.programs["beacon"].arguments == []
    assert wiring.relay is None
