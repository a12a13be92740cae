"""`./roslings rover --room SEED`: what it says and shows, and real `ros2` commands beside it."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from program import Program, environment, run, running

from ros2_on_pip.domain_lease import leased_domain
from roslings_rover.models.differential_drive import Motion
from roslings_rover.models.rooms import SEEDS, MovingWorld, SeededRoom, moving_in, room_of
from roslings_rover.models.world import Box, Circle, World
from roslings_rover.rover.displays import RoverMapWindow
from roslings_rover.rover.in_room import RoomRover
from roslings_rover.rover.made import rover_in
from roslings_rover.rover.moving_map import moving_map
from roslings_rover.rover.picture import MOVING, save
from roslings_rover.rover.room_markers import markers_of_moving, markers_of_room, world_in
from roslings_rover.rover.room_node import RoomNode, node_for
from roslings_rover.rover.rover import Rover, RoverMoment
from roslings_rover.rover.text_map import ASCII, UNICODE, text_map
from roslings_rover.rover.words import below, beside

SEED = 3
"""Corridors; two things move."""
AHEAD = [
    "ros2",
    "topic",
    "pub",
    "-r",
    "5",
    "/cmd_vel",
    "geometry_msgs/msg/Twist",
    "{linear: {x: 0.5}}",
]


@pytest.fixture
def terminal(tmp_path: Path) -> Iterator[dict[str, str]]:
    """The environment of a terminal on a domain of its own."""
    with leased_domain() as domain:
        yield environment(domain, tmp_path)


@pytest.fixture
def rover(terminal: dict[str, str], tmp_path: Path) -> Iterator[Program]:
    """A rover in a room."""
    words = ["rover", "--room", str(SEED), "--view", "lines", "--save", "map.png"]
    with running(words, terminal, tmp_path) as program:
        program.wait_for("standing")
        yield program


@pytest.mark.parametrize("seed", ["abc", "-1", str(SEEDS), "1.5"])
def test_what_is_no_room_is_said_with_the_next_step(
    terminal: dict[str, str], tmp_path: Path, seed: str
) -> None:
    """Wrong use, never a traceback."""
    done = run(["rover", f"--room={seed}"], terminal, tmp_path)
    assert done.returncode == 2
    assert f"'{seed}' names no room" in done.stderr and "for example 17" in done.stderr
    assert "Traceback" not in done.stderr


def test_it_bumps_and_says_so(rover: Program, terminal: dict[str, str], tmp_path: Path) -> None:
    """Driven against the wall by a command that does not end; the map is saved all the same."""
    rover.wait_for(f"^Room {SEED}: corridors; 2 things move in it")
    rover.wait_for(r"says /odom, /scan, (/tf, )?/room, /room/moving")
    with running(AHEAD, terminal, tmp_path) as pushing:
        rover.wait_for(r"^Bump 1: the rover ran into something\. It stands for 1 s")
        pushing.interrupt()
    assert rover.interrupt() == 0
    assert "Bumps: 1." in rover.lines
    assert (tmp_path / "map.png").stat().st_size > 5000


@pytest.mark.slow
def test_the_room_is_told_to_whoever_comes_later(
    rover: Program, terminal: dict[str, str], tmp_path: Path
) -> None:
    """By types that rviz2 draws; what moves is told again and again."""
    listed = run(["ros2", "topic", "list", "-t"], terminal, tmp_path).stdout
    for topic in ("/room", "/room/moving"):
        assert f"{topic} [visualization_msgs/msg/MarkerArray]" in listed
    echo = ["ros2", "topic", "echo", "--once"]
    said = run([*echo, "/room"], terminal, tmp_path).stdout
    things = len(room_of(SEED).world.obstacles)
    assert said.count("ns: floor") == 1 and said.count("ns: things") == things
    assert "frame_id: odom" in said
    moving = run([*echo, "/room/moving"], terminal, tmp_path).stdout
    assert moving.count("ns: things") == len(room_of(SEED).tracks)


@pytest.mark.slow
def test_the_bare_rover_has_no_topic_more(terminal: dict[str, str], tmp_path: Path) -> None:
    """Without --room all is as before."""
    with running(["rover", "--view", "lines"], terminal, tmp_path) as bare:
        bare.wait_for("standing")
        listed = run(["ros2", "topic", "list"], terminal, tmp_path).stdout.split()
        assert not [topic for topic in listed if topic.startswith("/room")]
        bare.interrupt()
    assert not [line for line in bare.lines if "bump" in line.lower() or "Room" in line]


@pytest.mark.slow
def test_a_notebook_drives_in_a_room(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Its map is that of the room, and it counts bumps."""
    from roslings_rover.rover.notebook import start

    with leased_domain() as domain:
        monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
        monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        with start(room=SEED) as rover:
            assert rover.map().count('class="obstacle"') == len(room_of(SEED).world.obstacles)
            assert rover.bumps == []


# --- words and maps ------------------------------------------------------------------------------


def bumped(seed: int) -> RoomNode:
    """Its rover has just driven against something."""
    rover = RoomRover(room_of(seed))
    while not rover.bumps:
        rover.drive(Motion(0.5))
        rover.step(0.05)
    return RoomNode(rover)


@pytest.mark.parametrize("seed", [0, 1, SEED, SEEDS - 1])
def test_all_words_fit_on_the_screen(seed: int) -> None:
    """Also of the largest seed: 32 columns beside the map, 80 below it, and 80 for a line."""
    node = bumped(seed)
    assert max(map(len, beside(node))) <= 32
    assert beside(node)[0] == f"Room {seed}"
    assert "bumps         1" in beside(node)
    told = below(node)
    assert len(told) == 2 and max(map(len, told)) <= 80 and told[0].startswith("Bump 1:")
    assert len(node.about_place) <= 80


def test_a_bump_is_no_news_for_ever() -> None:
    """After some seconds the screen says again what to do; the count stays."""
    node = bumped(0)
    node.rover.drive(Motion(-0.3))
    node.rover.step(5.0)
    assert not below(node)[0].startswith("Bump") and "bumps         1" in beside(node)


def test_which_node_it_is_depends_on_the_rover() -> None:
    """The bare one is no RoomNode, and the course's own room has no seed."""
    assert type(node_for(rover_in(None))).__name__ == "DrivenRover"
    assert isinstance(node_for(rover_in(SEED, seed=4)), RoomNode)
    assert beside(node_for(Rover()))[0] == "The rover"


@pytest.mark.parametrize("seed", range(30))
@pytest.mark.parametrize("size", [(46, 21), (28, 16), (90, 40)])
def test_each_thing_is_on_the_letter_map(seed: int, size: tuple[int, int]) -> None:
    """No wall is so thin that it falls between two letters; what moves has letters of its own."""
    room = room_of(seed)
    empty = text_map(RoomRover(_only(room)), *size, ASCII)
    assert not set("#@") & set("".join(empty))
    for shape in room.world.obstacles:
        assert "#" in "".join(text_map(RoomRover(_only(room, shape)), *size, ASCII)), shape
    whole = "".join(text_map(RoomRover(room), *size, UNICODE))
    assert whole.count("◆") >= 1


def _only(room: SeededRoom, *shapes: Circle | Box) -> SeededRoom:
    return SeededRoom(room.seed, room.kind, World(room.world.room, shapes), ())


def test_the_map_of_a_page_shows_what_moves() -> None:
    """Where it is now, and in the legend; in the course's own room nothing is added."""
    rover = RoomRover(room_of(SEED))
    rover.step(20.0)
    drawn = moving_map(rover.world, [RoverMoment(0.0, rover.pose)], 0.12)
    things = moving_in(rover.world)
    assert things != moving_in(room_of(SEED).at_first)
    assert drawn.count('fill="#c2571a"') == len(things) + 1 and ">moves<" in drawn
    assert ">moves<" not in moving_map(Rover().world, [RoverMoment(0.0, rover.pose)], 0.12)


def test_the_picture_of_a_room_is_drawn(tmp_path: Path) -> None:
    """With a colour for what moves."""
    from PIL import Image

    save(RoomRover(room_of(SEED)), tmp_path / "room.png")
    with Image.open(tmp_path / "room.png") as picture:
        colours = {colour for _, colour in picture.convert("RGB").getcolors(1 << 20) or []}
    assert (0xC2, 0x57, 0x1A) in colours


# --- the room in messages ------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(6))
def test_a_room_comes_back_from_its_messages(seed: int) -> None:
    """All shapes, at their places."""
    from builtin_interfaces.msg import Time

    world = room_of(seed).at_first
    told = world_in(markers_of_room(world, Time()), markers_of_moving(world.moving, Time()))
    assert told is not None
    assert _numbers(told) == pytest.approx(_numbers(world), abs=1e-9)
    assert world_in(markers_of_room(world, Time())) is not None


def _numbers(world: MovingWorld) -> list[float]:
    shapes = (world.room, *world.obstacles, *world.moving)
    return [value for shape in shapes for value in vars(shape).values()]


def _changed(change: Any) -> Any:
    from builtin_interfaces.msg import Time

    message = markers_of_room(room_of(SEED).world, Time())
    change(message.markers)
    return message


@pytest.mark.parametrize(
    "change",
    [
        lambda markers: markers.clear(),
        lambda markers: markers.append(markers[0]),
        lambda markers: setattr(markers[0].scale, "x", 0.0),
        lambda markers: setattr(markers[0].scale, "y", math.nan),
        lambda markers: setattr(markers[0].pose.position, "x", math.inf),
        lambda markers: setattr(markers[0].pose.position, "x", 1e9),
        lambda markers: setattr(markers[0], "type", 9),
    ],
)
def test_a_message_that_tells_no_room_is_none(change: Any) -> None:
    """Anybody may publish there: no floor, two, one of no size, one that is nowhere."""
    assert world_in(_changed(change)) is None


def test_a_thing_that_is_none_is_left_out() -> None:
    """And a million of them are not drawn."""
    whole = world_in(_changed(lambda markers: None))
    less = world_in(_changed(lambda markers: setattr(markers[1].scale, "x", -1.0)))
    assert whole is not None and less is not None
    assert len(less.obstacles) == len(whole.obstacles) - 1
    many = SimpleNamespace(markers=_changed(lambda markers: None).markers * 10_000)
    many.markers[1:1] = []
    world = world_in(many)
    assert world is None or len(world.obstacles) <= 1_000


def test_help_tells_of_rooms(terminal: dict[str, str], tmp_path: Path) -> None:
    """As `./roslings rover --help` shows it."""
    shown = run(["rover", "--help"], terminal, tmp_path).stdout
    assert re.search(r"--room SEED", shown) and "bumps" in shown


def test_the_window_moves_what_moves() -> None:
    """Each drawing takes the last one away; without news nothing is drawn."""
    import matplotlib.pyplot as plt

    plt.switch_backend("agg")  # the same window, which nobody sees
    node = RoomNode(RoomRover(room_of(SEED)))
    tracks = len(room_of(SEED).tracks)
    with RoverMapWindow(node) as window:
        seen = []
        for _ in range(3):
            window.show(node)
            seen.append(_discs_in(window))
            node.rover.step(8.0)
        assert [len(discs) for discs in seen] == [tracks] * 3
        assert seen[0] != seen[1] != seen[2]
        window.show(node)
        last = [*window._parts]
        window.show(node)
        assert window._parts == last


def _discs_in(window: RoverMapWindow) -> list[tuple[float, float]]:
    from matplotlib.colors import to_rgba
    from matplotlib.patches import Circle as Disc

    patches = [each for each in window._axes.patches if isinstance(each, Disc)]
    return [disc.center for disc in patches if disc.get_facecolor() == to_rgba(MOVING)]
