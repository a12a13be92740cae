"""`./roslings rover --listen` beside the nodes that students write; and a rover that does not."""

from __future__ import annotations

import math
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest
from program import environment, run, running

from ros2_on_pip.domain_lease import leased_domain
from roslings.course import lab
from roslings_rover.models.differential_drive import Pose
from roslings_rover.rover import Motion, Rover
from roslings_rover.rover.text_map import ASCII, cells
from sources import python_path

pytestmark = pytest.mark.slow

LISTENING = ["rover", "--view", "lines", "--listen"]
SPEED = ["ros2", "topic", "echo", "/odom", "--field", "twist.twist.linear.x"]


@pytest.fixture
def terminal(tmp_path: Path) -> Iterator[dict[str, str]]:
    """The environment of a terminal on a domain of its own."""
    with leased_domain() as domain:
        yield environment(domain, tmp_path)


@contextmanager
def solution(name: str, module: str, terminal: dict[str, str]) -> Iterator[None]:
    """The node of a lab's solution, while the block runs."""
    start = f"import sys; from {lab(name).card.package}.{module} import main; sys.exit(main())"
    own = terminal | {
        "PYTHONPATH": f"{lab(name).solution}{os.pathsep}{python_path()}",
        "PYTHONDONTWRITEBYTECODE": "1",  # nothing is left beside the solution
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }
    process = subprocess.Popen(
        [sys.executable, "-c", start],
        env=own,
        start_new_session=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        yield
    finally:
        process.send_signal(signal.SIGINT)
        process.wait()


@pytest.mark.parametrize(
    ("name", "module", "says"),
    [
        ("nodes", "minimal_publisher", r'"Robot status count: \d+" \(/robot_status\)'),
        ("topics", "talker", r'"Hello robotics \d+" \(/chatter\)'),
    ],
)
def test_a_students_sentence_appears(
    name: str, module: str, says: str, terminal: dict[str, str], tmp_path: Path
) -> None:
    """And goes away with its node: the topic is not held open."""
    with running(LISTENING, terminal, tmp_path) as rover:
        with solution(name, module, terminal):
            told = rover.wait_for(says)
        topic = told.rpartition("(")[2].rstrip(")")
        while topic in run(["ros2", "topic", "list"], terminal, tmp_path).stdout.split():
            assert rover.process.poll() is None
        assert rover.interrupt() == 0


def test_a_motor_controller_slows_it(terminal: dict[str, str], tmp_path: Path) -> None:
    """`/set_max_speed` is called; the rover drives at 0.3 in place of 0.5 m/s, then as it was."""
    call = ["ros2", "service", "call", "/set_max_speed", "std_srvs/srv/SetBool"]
    drive = ["ros2", "topic", "pub", "-r", "10", "/cmd_vel", "geometry_msgs/msg/Twist"]
    with (
        running([*drive, "{linear: {x: 0.5}, angular: {z: 0.8}}"], terminal, tmp_path),
        running(LISTENING, terminal, tmp_path) as rover,
        ExitStack() as later,
    ):
        rover.wait_for("is ready")
        speed = later.enter_context(running(SPEED, terminal, tmp_path))
        speed.wait_for(r"^0\.(49|50)")
        with solution("services", "motor_controller", terminal):
            assert run([*call, "{data: true}"], terminal, tmp_path).returncode == 0
            speed.wait_for(r"^0\.30")
        seen = len(speed.lines)
        while not any(re.match(r"0\.(49|50)", line) for line in speed.lines[seen:]):
            assert speed.process.poll() is None


def counts(terminal: dict[str, str], folder: Path, topic: str) -> str:
    """What `ros2 topic info` says of a topic."""
    return run(["ros2", "topic", "info", topic], terminal, folder).stdout


def test_what_others_count_is_as_without_it(terminal: dict[str, str], tmp_path: Path) -> None:
    """A rover that was not asked to listen is on no topic of the student's."""
    with (
        solution("topics", "talker", terminal),
        running(["rover", "--view", "lines"], terminal, tmp_path) as rover,
    ):
        rover.wait_for("standing")
        assert "Subscription count: 0" in counts(terminal, tmp_path, "/chatter")


def test_who_listens_is_hidden_and_counted_once(terminal: dict[str, str], tmp_path: Path) -> None:
    """Lists of nodes and pictures of the graph are as before; its help says what is not."""
    told = run(["rover", "--help"], terminal, tmp_path).stdout
    assert "one more subscription" in " ".join(told.split())
    with solution("topics", "talker", terminal):
        with running(["rover", "--view", "lines"], terminal, tmp_path) as rover:
            rover.wait_for("standing")
            before = run(["graph"], terminal, tmp_path).stdout
            nodes = run(["ros2", "node", "list"], terminal, tmp_path).stdout
        with running(LISTENING, terminal, tmp_path) as rover:
            rover.wait_for("Hello robotics")
            assert run(["graph"], terminal, tmp_path).stdout == before
            assert run(["ros2", "node", "list"], terminal, tmp_path).stdout == nodes
            assert "Subscription count: 1" in counts(terminal, tmp_path, "/chatter")


@pytest.mark.parametrize("y_m", [0.0, 2.45])
@pytest.mark.parametrize("x_m", [-1.9, 0.0, 2.9])
def test_the_words_stand_at_the_rover_and_fit(x_m: float, y_m: float) -> None:
    """In the next line, whole, and inside the walls; over it where there is room."""
    rover = Rover(pose=Pose(x_m, y_m))
    drawn = cells(rover, 60, 24, ASCII, '"Hello"')
    (row,) = (i for i, line in enumerate(drawn) if any(cell.kind == "rover" for cell in line))
    (said,) = (i for i, line in enumerate(drawn) if any(cell.kind == "said" for cell in line))
    assert abs(row - said) == 1
    assert "".join(cell.letter for cell in drawn[said] if cell.kind == "said") == '"Hello"'
    assert drawn[said][0].kind == drawn[said][-1].kind == "wall"


def test_a_limit_slows_at_once_and_keeps_the_curve() -> None:
    """Ahead and turn alike; without it, it drives as it was told."""
    rover = Rover()
    rover.drive(Motion(0.5, 1.0))
    rover.limit(0.25)
    rover.step(2.0)
    assert (rover.motion.forward_m_s, rover.motion.turn_rad_s) == pytest.approx((0.25, 0.5))
    rover.limit(math.inf)
    rover.step(2.0)
    assert (rover.motion.forward_m_s, rover.motion.turn_rad_s) == pytest.approx((0.5, 1.0))
    rover.drive(Motion(0.0, 1.0))
    rover.limit(0.25)
    rover.step(2.0)
    assert rover.motion.turn_rad_s == pytest.approx(1.0)
