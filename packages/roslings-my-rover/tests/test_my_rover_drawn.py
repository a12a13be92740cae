"""The room as a student's node draws it: what is a map, how it looks, and who says the frames."""

from __future__ import annotations

import math
import os
import shutil
import signal
from collections import Counter, defaultdict
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from carried import Carried, carried, pid_of, put
from nav_msgs.msg import OccupancyGrid
from test_my_rover_wins import carries, workspace

from roslings.course import lab
from roslings_my_rover.drawn_room import DrawnRoom, NotDrawable, drawn_room
from roslings_my_rover.parts import MAPPER
from roslings_my_rover.robot import MyRover
from roslings_rover.models.differential_drive import Pose
from roslings_rover.models.rooms import room_of
from roslings_rover.models.world import World, default_world
from roslings_rover.rover.displays import RoverMapWindow
from roslings_rover.rover.in_room import RoomRover
from roslings_rover.rover.map_display import without_gaps
from roslings_rover.rover.moving_map import moving_map
from roslings_rover.rover.rover import Rover, RoverMoment
from roslings_rover.rover.text_map import ASCII, UNICODE, cells, letters_for
from skips import skip_without

__all__ = ["workspace"]
CELL_M = 0.05


def grid_of(rows: list[str], cell_m: float = CELL_M) -> OccupancyGrid:
    """A map whose first row is the one in the north: `#` a wall, `.` free, blank unknown."""
    grid = OccupancyGrid()
    grid.header.frame_id = "odom"
    grid.info.resolution, grid.info.height, grid.info.width = cell_m, len(rows), len(rows[0])
    grid.data = [{"#": 100, ".": 0, " ": -1}[letter] for row in reversed(rows) for letter in row]
    return grid


def lines_of(rows: list[str], columns: int = 80, lines: int = 17) -> list[str]:
    """How these are shown."""
    return [*drawn_room(grid_of(rows)).lines(columns, lines, UNICODE)]


# --- what is a map -------------------------------------------------------------------------------


def test_a_map_has_its_walls_where_its_cells_are() -> None:
    """The first cell is in the south-west, and its corner is the origin."""
    grid = grid_of(["..#", "#.."])
    grid.info.origin.position.x, grid.info.origin.position.y = 1.0, -2.0
    room = drawn_room(grid)
    assert room.counts == "2 cells of walls and 4 free ones"
    places = zip(room.walls_m.x_m, room.walls_m.y_m, strict=True)
    assert [(round(x, 3), round(y, 3)) for x, y in places] == [(1.025, -1.975), (1.125, -1.925)]


@pytest.mark.parametrize("spoilt", ["data", "resolution", "negative", "origin"])
def test_what_is_no_map_is_refused(spoilt: str) -> None:
    """A program may say anything; the reason fits in a line."""
    grid = grid_of(["..#", "#.."])
    if spoilt == "data":
        grid.data = [0] * 5
    elif spoilt == "origin":
        grid.info.origin.position.y = math.nan
    else:
        grid.info.resolution = 0.0 if spoilt == "resolution" else -0.05
    with pytest.raises(NotDrawable) as told:
        drawn_room(grid)
    assert len(str(told.value)) <= 80
    with pytest.raises(NotDrawable):
        drawn_room(OccupancyGrid())


# --- how it looks --------------------------------------------------------------------------------


def test_a_small_room_is_drawn_cell_by_cell() -> None:
    """Half a letter a cell, as a letter is twice as high as wide; what is unknown is left out."""
    assert lines_of(["      ", " ###  ", " #.#  ", " ###  ", "      "]) == ["█▀█", "▀▀▀"]
    assert lines_of(["..", "..", "#."]) == ["··", "▀·"]


def test_nothing_known_is_nothing_drawn() -> None:
    """Before the first scan."""
    assert lines_of(["   ", "   "]) == []


@pytest.mark.parametrize("size", [(240, 240), (20, 400), (400, 20), (1, 1), (81, 37)])
def test_each_room_finds_room(size: tuple[int, int]) -> None:
    """At most 80 columns and as many lines as there are; no line of a wall has a hole."""
    high, wide = size
    rows = ["#" * wide, *["#" + "." * (wide - 2) + "#"[: wide - 1]] * (high - 2), "#" * wide][:high]
    lines = lines_of(rows)
    assert len(lines) <= 17 and max(map(len, lines)) <= 80, lines
    assert all(line[0] in "█▀" and line[-1] in "█▀" for line in lines), lines
    assert set(lines[0]) <= set("█▀")


def test_plain_letters_do_it_where_there_are_no_others() -> None:
    """A terminal that knows no UTF-8."""
    assert letters_for("utf-8") is letters_for("UTF8") is UNICODE
    assert letters_for("ascii") is letters_for(None) is ASCII
    assert [*drawn_room(grid_of(["##", "#.", "..", ".."])).lines(80, 17, ASCII)] == ["##", ".."]


def true_map(world: World) -> DrawnRoom:
    """What a node would draw that has seen all of it, without an error."""
    side = np.arange(-6.0, 6.0, CELL_M) + CELL_M / 2
    gaps_m = np.array([[world.room_at(x, y) for x in side] for y in side])
    grid = OccupancyGrid()
    grid.header.frame_id = "odom"
    grid.info.resolution, grid.info.height, grid.info.width = CELL_M, len(side), len(side)
    grid.info.origin.position.x = grid.info.origin.position.y = -6.0
    grid.data = np.where(np.abs(gaps_m) < CELL_M, 100, 0).astype(np.int8).ravel().tolist()
    return drawn_room(grid)


def kinds_on(rover: Rover, drawn: DrawnRoom | None) -> Counter[str]:
    """What the letters of its map show."""
    shown = cells(rover, 46, 21, UNICODE, drawn=drawn.walls_m if drawn else None)
    return Counter(cell.kind for row in shown[1:-1] for cell in row[1:-1])


def test_walls_that_are_drawn_lie_over_those_that_stand_there() -> None:
    """Of a right map hardly a letter is on the floor, and it leaves hardly a wall grey."""
    rover = RoomRover(room_of(35))
    stands, drawn = kinds_on(rover, None), kinds_on(rover, true_map(rover.world))
    assert drawn["wall"] < 0.1 * stands["wall"], (stands, drawn)
    assert drawn["drawn"] > stands["wall"]


def test_what_is_drawn_far_outside_is_not_shown() -> None:
    """A map that is wrong does not fill the edge of the screen."""
    grid = grid_of(["#####"] * 5)
    grid.info.origin.position.x = 30.0
    assert kinds_on(RoomRover(room_of(35)), drawn_room(grid))["drawn"] == 0


def test_a_notebook_shows_them_too() -> None:
    """On its map of the drive, with a word for them below."""
    rover = RoverMoment(0.0, Pose())
    world, room = default_world(), drawn_room(grid_of(["#.#"]))
    shown = ElementTree.fromstring(moving_map(world, [rover], 0.12, drawn=room.walls_m))
    drawn = [each for each in shown.iter() if each.get("class") == "drawn"]
    assert [each.attrib["d"].count("M") for each in drawn] == [2, 1]
    assert ">drawn<" not in moving_map(world, [rover], 0.12)


def test_a_window_shows_them_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """And draws itself anew when another map has come."""
    import matplotlib.pyplot as plt

    plt.switch_backend("agg")
    node = MyRover(Rover())
    with RoverMapWindow(node) as window:
        monkeypatch.setattr(window._figure.canvas, "flush_events", lambda: None)
        for rows in (["###"], ["#.#"]):
            node.drawn = drawn_room(grid_of(rows))
            window.show(node)
            (walls,) = (line for line in window._axes.lines if line.get_marker() == "s")
            assert len(walls.get_xdata()) == "".join(rows).count("#")
        node.drawn = None
        window.show(node)
        assert not [line for line in window._axes.lines if line.get_marker() == "s"]


def test_empty_lines_go_first_where_all_parts_find_no_room() -> None:
    """From below; what is told stays as long as it can."""
    words = ["Room 35", "", "x", "bumps", "", "voice", "", "Ctrl-C ends it"]
    assert without_gaps(words, 8) == words
    assert without_gaps(words, 6) == ["Room 35", "", "x", "bumps", "voice", "Ctrl-C ends it"]
    assert without_gaps(words, 4) == ["Room 35", "x", "bumps", "voice"]


# --- who says the frames -------------------------------------------------------------------------


def heard_steps(rover: Carried) -> list[Any]:
    """The messages of /tf, as they come."""
    from tf2_msgs.msg import TFMessage

    return rover.hear(TFMessage, "/tf")


def speakers(rover: Carried, topic: str) -> set[str]:
    """The nodes that publish there."""
    return {each.node_name for each in rover.node.get_publishers_info_by_topic(topic)}


def one_voice_each(said: list[Any]) -> bool:
    """Each frame has one parent, and each step is said once for each time."""
    steps = [step for message in said for step in message.transforms]
    parents = defaultdict(set)
    for step in steps:
        parents[step.child_frame_id].add(step.header.frame_id)
    stamps = (each.header.stamp for each in steps)
    times = Counter(
        (step.child_frame_id, stamp.sec, stamp.nanosec)
        for step, stamp in zip(steps, stamps, strict=True)
    )
    return set(map(len, parents.values())) == {1} and set(times.values()) == {1}


@pytest.mark.slow
def test_one_node_says_the_frames_also_when_the_part_is_killed(workspace: Path) -> None:
    """First the part, then the rover, and never both; the screen says so."""
    skip_without("module tf2_msgs")
    carries(workspace, MAPPER)
    with carried(workspace) as rover:
        said = heard_steps(rover)
        assert rover.sees(lambda: len(said) > 20), rover.heard
        assert speakers(rover, "/tf") == speakers(rover, "/tf_static") == {"frames"}
        os.kill(pid_of(workspace, "frames"), signal.SIGKILL)
        rover.wait_for(r"^frames ended\.")
        rover.wait_for(r"^Now the rover itself says /tf and /tf_static\.$")
        before = len(said)
        assert rover.sees(lambda: len(said) > before + 40), rover.heard
        assert "rover" in speakers(rover, "/tf") & speakers(rover, "/tf_static")
        assert one_voice_each(said)
        assert "both say" not in rover.heard
        assert rover.interrupt() == 0
        assert "Your mapper has drawn" in rover.heard  # until it ended


@pytest.mark.slow
def test_without_tf_nobody_takes_the_place_of_the_part(workspace: Path) -> None:
    """The part says them as always; when it has ended, the rover keeps to --no-tf."""
    skip_without("module tf2_msgs")
    carries(workspace, MAPPER)
    with carried(workspace, "--no-tf") as rover:
        said = heard_steps(rover)
        assert rover.sees(lambda: len(said) > 20), rover.heard
        os.kill(pid_of(workspace, "frames"), signal.SIGINT)
        rover.wait_for(r"^Nobody says /tf now: you typed --no-tf\.$")
        assert rover.sees(lambda: not speakers(rover, "/tf")), speakers(rover, "/tf")


@pytest.mark.slow
@pytest.mark.parametrize("there", [True, False], ids=["starter", "absent"])
def test_without_a_part_that_runs_the_rover_says_its_frames(workspace: Path, there: bool) -> None:
    """Where its lab has only begun, too: what is missing is named."""
    skip_without("module tf2_msgs")
    carries(workspace)
    if there:
        shutil.copytree(lab(MAPPER.lab).starter, workspace / "src" / "frames")
    with carried(workspace) as rover:
        said = heard_steps(rover)
        assert rover.sees(lambda: len(said) > 20), rover.heard
        assert speakers(rover, "/tf") == {"rover"} and one_voice_each(said)
        assert ("mapper is left out: " in rover.heard) == there
        rover.interrupt()
        assert "Your mapper" not in rover.heard


@pytest.mark.slow
@pytest.mark.parametrize("part", [True, False], ids=["with-the-part", "without"])
def test_a_second_node_of_that_name_is_told(workspace: Path, part: bool) -> None:
    """As one runs it in another terminal; with what to do."""
    skip_without("module tf2_msgs")
    carries(workspace, *([MAPPER] if part else []))
    with carried(workspace) as rover:
        second = rover.another_node("frames")
        rover.wait_for(
            r"^Two nodes /frames say /tf: .* End the other one\.$"
            if part
            else r"^/frames and the rover both say /tf\. Start the rover with --no-tf\.$"
        )
        second.destroy_node()


@pytest.mark.slow
def test_what_cannot_be_drawn_is_told_at_the_end(workspace: Path) -> None:
    """A node that says nothing on /map: the drive ends as always."""
    carries(workspace)
    put(workspace, MAPPER, "map_never_published")
    with carried(workspace) as rover:
        assert rover.drive(0.3, until_it=lambda: rover.pose[3])
        assert rover.interrupt() == 0
        assert "Your mapper has drawn nothing.\nIt has said nothing on /map." in rover.heard
