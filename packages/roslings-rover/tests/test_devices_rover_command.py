"""`./roslings rover`, and real `ros2` commands in other processes that drive it and look at it."""

from __future__ import annotations

import io
import math
import os
import re
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from program import Program, environment, run, running
from rich.text import Text
from rosbags.highlevel import AnyReader

from ros2_on_pip.domain_lease import leased_domain
from roslings_rover.remembered import has_reached_a_ball, remember_the_ball
from roslings_rover.rover import Ball, Box, Circle, Motion, Pose, Rover, World
from roslings_rover.rover.displays import Lines, Terminal
from roslings_rover.rover.driven import LEAVES_M, DrivenRover
from roslings_rover.rover.frames import FrameOptions
from roslings_rover.rover.map_display import shown_until
from roslings_rover.rover.node import RoverNode
from roslings_rover.rover.text_map import ASCII, UNICODE, text_map
from roslings_rover.rover.words import about_tf, below, beside, position
from skips import imported

FORWARD = "{linear: {x: 0.5}}"
PUB = ["ros2", "topic", "pub", "--once", "/cmd_vel", "geometry_msgs/msg/Twist"]


@pytest.fixture
def terminal(tmp_path: Path) -> Iterator[dict[str, str]]:
    """The environment of a terminal on a domain of its own."""
    with leased_domain() as domain:
        yield environment(domain, tmp_path)


@pytest.fixture
def rover(terminal: dict[str, str], tmp_path: Path) -> Iterator[Program]:
    """A rover that runs and prints lines."""
    with running(["rover", "--view", "lines", "--save", "map.png"], terminal, tmp_path) as program:
        program.wait_for("standing")
        yield program


def test_one_command_makes_it_move_and_it_stops_by_itself(
    rover: Program, terminal: dict[str, str], tmp_path: Path
) -> None:
    """The newcomer's first success: the command that the screen shows, typed as it stands there."""
    shown = rover.wait_for(r"^ros2 topic pub")
    assert FORWARD in shown
    done = run([*PUB, FORWARD], terminal, tmp_path)
    assert done.returncode == 0, done.stderr
    line = rover.wait_for(r"x 0\.[3-9].* standing")
    assert re.search(r"x 0\.\d+ m, y 0\.00 m, heading 0 degrees", line)
    assert rover.interrupt() == 0
    assert re.search(r"It went 0\.\d+ m", "\n".join(rover.lines))
    assert (tmp_path / "map.png").stat().st_size > 5000
    assert not (tmp_path / ".ros").exists()


@pytest.mark.slow
def test_its_topics_have_the_usual_names_and_types(
    rover: Program, terminal: dict[str, str], tmp_path: Path
) -> None:
    """What `ros2 topic list -t` and `ros2 topic echo` say of it."""
    listed = run(["ros2", "topic", "list", "-t"], terminal, tmp_path).stdout
    assert "/cmd_vel [geometry_msgs/msg/Twist]" in listed
    assert "/odom [nav_msgs/msg/Odometry]" in listed
    assert "/scan [sensor_msgs/msg/LaserScan]" in listed
    odom = run(["ros2", "topic", "echo", "--once", "/odom"], terminal, tmp_path).stdout
    assert "frame_id: odom" in odom and "child_frame_id: base_link" in odom
    scan = run(["ros2", "topic", "echo", "--once", "/scan"], terminal, tmp_path).stdout
    assert "range_max: 6.0" in scan and "frame_id: laser" in scan
    field = ["ros2", "topic", "echo", "--once", "/camera/image_raw", "--field"]
    assert "1920" in run([*field, "step"], terminal, tmp_path).stdout
    header = run([*field, "header.frame_id"], terminal, tmp_path).stdout
    assert "camera_optical" in header


@pytest.mark.slow
def test_by_itself_it_publishes_tf(terminal: dict[str, str], tmp_path: Path) -> None:
    """20 times a second, beside /odom, and from one to the other."""
    imported("tf2_msgs")
    with running(["rover", "--view", "lines"], terminal, tmp_path) as rover:
        rover.wait_for("says /odom, /scan, /tf")
        rover.wait_for("standing")
        listed = run(["ros2", "topic", "list", "-t"], terminal, tmp_path).stdout
        assert "/tf [tf2_msgs/msg/TFMessage]" in listed
        assert "/tf_static [tf2_msgs/msg/TFMessage]" in listed
        words = ["ros2", "topic", "echo", "--once", "/tf"]
        moved = run(words, terminal, tmp_path).stdout
        assert "frame_id: odom" in moved and "child_frame_id: base_link" in moved
        bag = ["ros2", "bag", "record", "--topics", "/tf", "/odom"]
        with running([*bag, "-o", "drive"], terminal, tmp_path) as recorder:
            recorder.wait_for("All requested topics are subscribed")
            run(["ros2", "topic", "echo", "--once", "/tf"], terminal, tmp_path)
            assert recorder.interrupt() == 0
    with AnyReader([tmp_path / "drive"]) as reader:
        counts = {c.topic: c.msgcount for c in reader.connections}
        first = next(iter(reader.messages()))
        assert reader.deserialize(first[2], first[0].msgtype)
    assert abs(counts["/tf"] - counts["/odom"]) <= 2 and counts["/tf"] > 2


@pytest.mark.slow
def test_told_so_it_publishes_no_tf(terminal: dict[str, str], tmp_path: Path) -> None:
    """And says nothing of it."""
    with running(["rover", "--view", "lines", "--no-tf"], terminal, tmp_path) as rover:
        rover.wait_for("standing")
        listed = run(["ros2", "topic", "list"], terminal, tmp_path).stdout.split()
        assert "/odom" in listed and not {"/tf", "/tf_static"} & set(listed)
        assert "/tf" not in "\n".join(rover.lines)


@pytest.mark.slow
def test_a_drift_is_on_odom_and_the_map_has_the_truth(
    terminal: dict[str, str], tmp_path: Path
) -> None:
    """By a fifth: what is told of it, on its screen, and at its end."""
    words = ["rover", "--view", "lines", "--drift", "20"]
    with running(words, terminal, tmp_path) as rover:
        assert "The map shows where the rover truly is" in rover.wait_for("/odom drifts by 20 %")
        rover.wait_for("standing")
        assert run([*PUB, FORWARD], terminal, tmp_path).returncode == 0
        true_m = metres(rover.wait_for(r"x 0\.[3-9].* standing"))
        field = ["--field", "pose.pose.position.x"]
        told = run(["ros2", "topic", "echo", "--once", "/odom", *field], terminal, tmp_path).stdout
        assert float(told.split()[0]) == pytest.approx(1.2 * true_m, abs=0.01)
        assert rover.interrupt() == 0
    believed = rover.wait_for("^By its odometry it is at")
    assert metres(believed) == pytest.approx(1.2 * true_m, abs=0.015)


def metres(line: str) -> float:
    """How far along x, in words of the rover."""
    found = re.search(r"x (-?\d+\.\d+) m", line)
    assert found, line
    return float(found[1])


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--drift", "a bit"], "the drift is a number from -50 to 50, not 'a bit'"),
        (["--drift", "nan"], "the drift is a number from -50 to 50, not 'nan'"),
        (["--drift", "51"], "the drift is a number from -50 to 50, not '51'"),
        (["--map-frame", "--no-tf"], "--map-frame is said on /tf. Leave out --no-tf."),
    ],
)
def test_what_makes_no_sense_is_refused(
    terminal: dict[str, str], tmp_path: Path, words: list[str], told: str
) -> None:
    """Before anything runs."""
    done = run(["rover", *words], terminal, tmp_path)
    assert done.returncode == 2 and told in " ".join(done.stderr.split())


@pytest.mark.parametrize(
    ("distro", "step"),
    [
        ("", "sudo apt install g++ then start it with --tf"),
        ("jazzy", "sudo apt install ros-jazzy-tf2-msgs"),
    ],
)
def test_where_tf_has_no_type_the_next_step_is_on_the_screen(
    monkeypatch: pytest.MonkeyPatch, distro: str, step: str
) -> None:
    """And only where somebody wants /tf; it fits beside the map."""
    monkeypatch.setenv("ROS_DISTRO", distro)
    told = about_tf(RoverNode(Rover()))
    assert step in " ".join(word.strip() for word in told)
    assert max(map(len, told)) <= 32
    assert about_tf(RoverNode(Rover(), frames=FrameOptions(published=False))) == ()


@pytest.mark.slow
def test_a_command_that_is_no_number_is_told_and_not_followed(
    rover: Program, terminal: dict[str, str], tmp_path: Path
) -> None:
    """And one that asks a wheeled robot to fly is told, too."""
    run([*PUB, "{linear: {x: .nan}}"], terminal, tmp_path)
    rover.wait_for("no finite number")
    run([*PUB, "{linear: {z: 1.0}}"], terminal, tmp_path)
    rover.wait_for(r"linear\.z does nothing")
    assert rover.process.poll() is None
    assert not [line for line in rover.lines if "moving" in line]


@pytest.mark.slow
def test_a_second_rover_is_told(rover: Program, terminal: dict[str, str], tmp_path: Path) -> None:
    """Two on one domain would both move."""
    with running(["rover", "--view", "lines"], terminal, tmp_path) as second:
        second.wait_for("second rover")
        rover.wait_for("second rover")


@pytest.mark.parametrize(
    ("words", "changes", "says"),
    [
        (["--save", "no/such/map.png"], {}, "there is no folder no/such"),
        (["--save", "map.txt"], {}, "must end in .png"),
        (["--view", "window"], {}, "--view terminal"),
        ([], {"ROS_DOMAIN_ID": "abc"}, "whole number"),
    ],
)
def test_what_it_cannot_do_is_said_with_the_next_step(
    terminal: dict[str, str], tmp_path: Path, words: list[str], changes: dict[str, str], says: str
) -> None:
    """Wrong use, never a traceback."""
    done = run(["rover", *words], terminal | changes, tmp_path)
    assert done.returncode == 2
    assert says in done.stderr
    assert "Traceback" not in done.stderr


# --- the map -----------------------------------------------------------------------------------


def test_the_map_fits_and_keeps_its_shape() -> None:
    """Framed, at most as large as asked; the plain letters are ASCII."""
    for letters in (UNICODE, ASCII):
        drawn = text_map(Rover(), 46, 21, letters)
        assert len(drawn) <= 21
        assert {len(line) for line in drawn} == {len(drawn[0])}
        assert len(drawn[0]) <= 46
    assert "".join(text_map(Rover(), 46, 21, ASCII)).isascii()


def test_the_map_shows_what_there_is() -> None:
    """North is above, the arrow points where the rover looks, the path is dotted."""
    world = World(Box(0, 0, 10, 10), (Circle(8, 8, 1),), (Ball(1, 9),))
    rover = Rover(world)
    rover.pose = rover.path[0] = rover.pose.__class__(2.0, 2.0, 0.0)
    rover.drive(Motion(0.5, 0.0))
    rover.step(6.0)
    drawn = text_map(rover, 42, 22, ASCII)
    rows = {letter: [i for i, line in enumerate(drawn) if letter in line[1:-1]] for letter in "o#>"}
    assert max(rows["o"]) < max(rows["#"]) < min(rows[">"])
    assert drawn[rows[">"][0]].index(">") > 15
    rover.drive(Motion(0.0, 1.57))
    rover.step(1.1)
    assert "^" in "".join(text_map(rover, 42, 22, ASCII))


@pytest.mark.parametrize("turn", range(0, 360, 30))
@pytest.mark.parametrize("size", [(46, 21), (26, 15), (146, 47)])
def test_the_arrow_never_covers_a_ball(turn: int, size: tuple[int, int]) -> None:
    """The rover touches it from any side: both are on the map, side by side."""
    rover = Rover()
    (ball,) = rover.world.balls
    far_m = ball.radius_m + rover.body.radius_m
    angle = math.radians(turn)
    rover.pose = Pose(ball.x_m + far_m * math.cos(angle), ball.y_m + far_m * math.sin(angle), 0.0)
    drawn = "\n".join(text_map(rover, *size, ASCII))
    assert drawn.count("o") == 1 and drawn.count(">") == 1
    (rover_line,) = (n for n, line in enumerate(drawn.splitlines()) if ">" in line)
    (ball_line,) = (n for n, line in enumerate(drawn.splitlines()) if "o" in line)
    assert abs(rover_line - ball_line) <= 2


def test_a_ball_in_the_corner_stays_in_sight() -> None:
    """There is no letter beyond the wall: the arrow takes the one on the other side."""
    world = World(Box(0, 0, 10, 10), (), (Ball(9.99, 0.01),))
    rover = Rover(world, Pose(9.995, 0.005, 0.0))
    drawn = "".join(text_map(rover, 42, 22, ASCII))
    assert drawn.count("o") == 1 and drawn.count(">") == 1


def test_nothing_is_minus_nothing() -> None:
    """A rover that stands a hair south of the middle is at 0.00, and looks east at 0 degrees."""
    rover = Rover(pose=Pose(-0.001, -0.004, -0.001))
    shown = "\n".join([*beside(DrivenRover(rover)), position(DrivenRover(rover))])
    assert "-0" not in shown and "heading       0 degrees" in shown
    rover.pose = Pose(-0.25, -1.0, math.radians(-90))
    assert position(RoverNode(rover)).startswith("x -0.25 m, y -1.00 m, heading -90 degrees")


def test_a_pipe_is_told_what_is_news() -> None:
    """A line when the rover has moved, and none as long as it stands."""
    node, out = DrivenRover(Rover()), io.StringIO()
    lines = Lines(node, out)
    lines.show(node)
    begun = out.getvalue()
    assert position(node) in begun
    lines.show(node)
    assert out.getvalue() == begun
    node.rover.pose = Pose(0.5, 0.0, 0.0)
    lines.show(node)
    assert out.getvalue().removeprefix(begun).splitlines() == [position(node)]


class Closed:
    """A display that somebody closes after some pictures."""

    every_s = 0.0

    def __init__(self, after: int) -> None:
        self._left, self.shown = after, list[int]()

    @property
    def closed(self) -> bool:
        """No more pictures are wanted."""
        return not self._left

    def show(self, node: list[int]) -> None:
        """What there is now."""
        self._left -= 1
        self.shown.append(len(node))


@pytest.mark.parametrize(("asked_after", "closed_after"), [(3, 9), (9, 3)])
def test_it_ends_when_it_is_asked_to_or_closed(asked_after: int, closed_after: int) -> None:
    """Each turn is shown, the last one too; after that there is none."""
    turns, asked, display = list[int](), threading.Event(), Closed(closed_after)

    def turn() -> None:
        turns.append(1)
        if len(turns) == asked_after:
            asked.set()

    shown_until(asked, display, turns, turn)
    assert display.shown == [1, 2, 3]


def test_a_touch_counts_until_the_rover_has_left() -> None:
    """The word stays when nobody pushes any more; it goes with the rover."""
    rover = Rover()
    (ball,) = rover.world.balls
    rover.pose = Pose(ball.x_m - 0.5, ball.y_m, 0.0)
    node = DrivenRover(rover, commands=1)
    for motion in (Motion(0.5, 0.0), Motion()):
        for _ in range(100):
            rover.drive(motion)
            rover.step(0.02)
            node.look_for_balls()
        assert below(node)[0] == "The rover touches the red ball. Well done!"
    rover.pose = Pose(ball.x_m - 1.1 * (ball.radius_m + rover.body.radius_m + LEAVES_M), 0.6, 0.0)
    node.look_for_balls()
    assert "Well done" not in "".join(below(node))


def test_a_ball_that_was_only_passed_is_not_reached() -> None:
    """Near is not touched."""
    rover = Rover()
    (ball,) = rover.world.balls
    rover.pose = Pose(ball.x_m, ball.y_m - 0.25, 0.0)
    node = DrivenRover(rover)
    node.look_for_balls()
    assert node.reached is None


def test_nobody_is_told_to_drive_while_somebody_drives() -> None:
    """By keys here, or by a program elsewhere, also before its first message."""
    assert below(DrivenRover(Rover()))[0].startswith("Make it move")
    for driven in ({"by_keys": True}, {"driver": "/turtle"}):
        told = "".join(below(DrivenRover(Rover(), **driven)))
        assert "Make it move" not in told and "ros2 topic pub" not in told
        assert all(len(line) <= 80 for line in below(DrivenRover(Rover(), **driven)))


def test_that_the_ball_was_reached_is_kept(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """In the workspace, which may not be there yet."""
    monkeypatch.setenv("ROSLINGS_WS", str(tmp_path / "new" / "ws"))
    assert not has_reached_a_ball()
    remember_the_ball()
    remember_the_ball()
    assert has_reached_a_ball()


def test_who_cannot_keep_it_is_told_and_goes_on(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """A file stands where the workspace should be."""
    from roslings_rover.rover.running import _remember

    (tmp_path / "ws").touch()
    monkeypatch.setenv("ROSLINGS_WS", str(tmp_path / "ws"))
    told = _remember()
    assert "cannot be written down: Not a directory" in told and len(told) <= 80
    assert not has_reached_a_ball()


@pytest.mark.slow
def test_a_notebook_sees_the_map_and_ends_the_node(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """A drawing for the cell, and no thread left."""
    from roslings_rover.rover.notebook import start

    with leased_domain() as domain:
        monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
        monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        with start() as rover:
            assert rover.map().startswith("<svg ") and rover.map() == rover._repr_svg_()
            assert rover.pose.x_m == 0.0
    assert "rover" not in [thread.name for thread in threading.enumerate()]
    assert os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] == "LOCALHOST"


@pytest.mark.parametrize(("columns", "lines"), [(60, 22), (80, 24), (200, 60)])
def test_a_small_terminal_cuts_nothing_off(
    monkeypatch: pytest.MonkeyPatch, columns: int, lines: int
) -> None:
    """Parts that need more lines than the map, and a long notice: all within the terminal."""
    monkeypatch.setenv("COLUMNS", str(columns))
    monkeypatch.setenv("LINES", str(lines))
    parts = tuple(f"no part {number} yet: day {number}" for number in range(8))
    notice = "a part ended. It said: " + " ".join(["burnt"] * 9)
    terminal = Terminal()
    terminal.show(DrivenRover(Rover(), about_parts=parts, notice=notice))
    shown = terminal._live.get_renderable()
    assert isinstance(shown, Text)
    rows = shown.plain.splitlines()
    assert len(rows) <= lines and max(len(row.rstrip()) for row in rows) <= columns
    assert all(any(part in row for row in rows) for part in parts)
    assert notice in " ".join(rows[-3:])
