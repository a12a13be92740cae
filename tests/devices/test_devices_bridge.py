"""The lab's own bridge beside both boards: ROS at one end, motors at the other."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from program import PATIENCE_S, environment, run

from ros2_on_pip.domain_lease import leased_domain
from roslings.course import root
from roslings_rover.board import Board, Chip, Mega
from roslings_rover.emulated import EmulatedMega, built
from roslings_rover.rover import Body, Motion, Rover
from skips import imported, needs

LAB = root() / "labs" / "serial-bridge"
SKETCH = LAB / "firmware" / "rover_mega" / "rover_mega.ino"
MOTION = Motion(0.2, 0.5)
TWIST = "{linear: {x: 0.2}, angular: {z: 0.5}}"
without_emulator = needs("emulated board")
imported("serial")


@pytest.fixture(params=["python", pytest.param("emulated", marks=without_emulator)])
def board(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Board]:
    """A board that lives in real time."""
    if request.param == "python":
        with living(Mega(Rover()), tmp_path) as lives:
            yield lives
    else:
        with EmulatedMega(built(SKETCH)) as chip, living(chip, tmp_path) as lives:
            yield lives


@contextmanager
def living(chip: Chip, folder: Path) -> Iterator[Board]:
    """A chip on a port, in real time."""
    with Board(chip, folder / "ttyTEST") as board, board.running():
        yield board


def wait_for(condition: Callable[[], object]) -> None:
    """Wait until something is so; only a test that fails waits for long."""
    until_s = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < until_s, "it did not come to that"
        time.sleep(0.01)


@contextmanager
def bridge(board: Board, surroundings: dict[str, str], folder: Path) -> Iterator[None]:
    """The solution's node on the board's port."""
    source = LAB / "solution" / "serial_bridge"
    words = ["-m", "serial_bridge.serial_bridge", "--ros-args", "-p", f"port:={board.name}"]
    own = {
        "PYTHONPATH": f"{source}:{surroundings['PYTHONPATH']}",
        "PYTHONDONTWRITEBYTECODE": "1",  # nothing is left beside the solution
    }
    node = subprocess.Popen(
        [sys.executable, *words],
        env=surroundings | own,
        cwd=folder,
        stdin=subprocess.DEVNULL,
    )
    try:
        yield
    finally:
        node.terminate()
        node.wait(PATIENCE_S)


def test_a_twist_reaches_the_motors_and_the_way_comes_back(board: Board, tmp_path: Path) -> None:
    """`ros2 topic pub` at one end, PWM at the other; then the node stops them itself."""
    wheels, full = Body().wheels_for(MOTION), 255 / Body().fastest_wheel_rad_s
    wanted = (round(wheels.left_rad_s * full), round(wheels.right_rad_s * full))
    with leased_domain() as domain:
        local = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
        surroundings = environment(domain, tmp_path) | local
        with bridge(board, surroundings, tmp_path):
            wait_for(lambda: board.heard)
            pub = ["ros2", "topic", "pub", "-t", "15", "-r", "10", "/cmd_vel"]
            run([*pub, "geometry_msgs/msg/Twist", TWIST], surroundings, tmp_path)
            wait_for(lambda: board.chip.truth.left_pwm == 0 and board.chip.truth.left_rad_s < 0.01)
            echo = ["ros2", "topic", "echo", "--once", "/odom", "--field", "pose.pose.position.x"]
            said = run(echo, surroundings, tmp_path).stdout
    assert wanted in [(a.left_pwm, a.right_pwm) for a in board.chip.applied]
    assert float(said.split()[0]) == pytest.approx(board.chip.truth.pose.x_m, abs=0.02)
    assert board.chip.truth.pose.x_m > 0.1
