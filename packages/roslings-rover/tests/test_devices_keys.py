"""Driving by keys: the rover's own terminal, and the program of this name in every guide."""

from __future__ import annotations

import os
import pty
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from program import environment, run, running

from ros2_on_pip.domain_lease import leased_domain
from ros2_on_pip.keyboard import HELP, Hands, NoKeys, Steering, keys_of

TELEOP = ["ros2", "run", "teleop_twist_keyboard", "teleop_twist_keyboard"]


@pytest.fixture
def terminal(tmp_path: Path) -> Iterator[dict[str, str]]:
    """The environment of a terminal on a domain of its own."""
    with leased_domain() as domain:
        yield environment(domain, tmp_path)


@pytest.fixture
def keyboard() -> Iterator[tuple[int, int]]:
    """The end on which a person types, and the one that a program reads."""
    typed, read = pty.openpty()
    yield typed, read
    os.close(typed)
    os.close(read)


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        ("i", (0.5, 0.0)),
        (",", (-0.5, 0.0)),
        ("j", (0.0, 1.0)),
        ("l", (0.0, -1.0)),
        ("u", (0.5, 1.0)),
        ("o", (0.5, -1.0)),
        ("m", (-0.5, -1.0)),
        (".", (-0.5, 1.0)),
        ("ik", (0.0, 0.0)),
        ("i?", (0.0, 0.0)),
        ("qi", (0.55, 0.0)),
        ("zi", (0.45, 0.0)),
        ("wi", (0.55, 0.0)),
        ("xu", (0.45, 1.0)),
        ("eu", (0.5, 1.1)),
        ("cj", (0.0, 0.9)),
        ("iq", (0.55, 0.0)),
    ],
)
def test_each_key_has_its_meaning(keys: str, told: tuple[float, float]) -> None:
    """Metres a second ahead, and radians a second to the left."""
    hands = Hands()
    for key in keys:
        hands = hands.press(key)
    steering = hands.steering
    assert (steering.forward_m_s, steering.turn_rad_s) == pytest.approx(told)


def test_the_help_is_no_wider_than_a_terminal() -> None:
    """And names every way."""
    assert max(map(len, HELP.splitlines())) <= 80
    assert all(f" {key} " in f" {HELP} " for key in "uiojkl")


@pytest.mark.parametrize(
    ("typed", "key"),
    [
        (b"i", "i"),
        (b"iiiiii", "i"),
        (b"\x1b[A", "\x1b[A"),
        (b"\x1b[D\x1b[D", "\x1b[D"),
        ("ü".encode(), "ü"),
    ],
)
def test_of_a_key_that_is_held_the_newest_counts(
    typed: bytes, key: str, keyboard: tuple[int, int]
) -> None:
    """An arrow sends three letters."""
    with os.fdopen(os.dup(keyboard[1])) as end, keys_of(end) as keys:
        assert keys.next(0.0) == ""
        os.write(keyboard[0], typed)
        assert keys.next(5.0) == key
    assert Hands().press("\x1b[A").steering == Steering(0.5, 0.0)


def test_without_a_terminal_nothing_is_read(tmp_path: Path) -> None:
    """A pipe, a file."""
    with (
        (tmp_path / "file").open("w+") as file,
        pytest.raises(NoKeys, match="terminal"),
        keys_of(file),
    ):
        pass


def test_the_rover_follows_the_keys_of_its_terminal(
    terminal: dict[str, str], keyboard: tuple[int, int], tmp_path: Path
) -> None:
    """Ahead, and it stands again; the graph shows who says it."""
    with running(["rover", "--keys", "--view", "lines"], terminal, tmp_path, keyboard[1]) as rover:
        rover.wait_for("Keys: arrow up drives")
        rover.wait_for("standing")
        os.write(keyboard[0], b"i")
        rover.wait_for(r"x 0\.[3-9].* standing")
        told = run(["ros2", "topic", "info", "-v", "/cmd_vel"], terminal, tmp_path).stdout
        assert "Node name: keyboard" in told
        assert rover.interrupt() == 0


def test_the_rover_needs_a_terminal_for_keys(terminal: dict[str, str], tmp_path: Path) -> None:
    """It says so, and does not begin."""
    ran = run(["rover", "--keys"], terminal, tmp_path)
    assert ran.returncode == 2
    assert "--keys: keys are read from a terminal" in ran.stderr


def test_the_guides_program_drives_the_rover(
    terminal: dict[str, str], keyboard: tuple[int, int], tmp_path: Path
) -> None:
    """By its usual name and parameters; at its end it tells the robot to stand."""
    slow = [*TELEOP, "--ros-args", "-p", "speed:=0.3"]
    with running(["rover", "--view", "lines"], terminal, tmp_path) as rover:
        rover.wait_for("standing")
        with running(slow, terminal, tmp_path, keyboard[1]) as teleop:
            teleop.wait_for("Ctrl-C ends it")
            os.write(keyboard[0], b"i")
            rover.wait_for("moving")
            assert teleop.interrupt() == 0
            assert "ahead  0.30 m/s" in "\n".join(teleop.lines)
            assert teleop.lines[-1].rpartition("\r")[2].startswith("ahead  0.00 m/s")


def test_the_guides_program_needs_a_terminal(terminal: dict[str, str], tmp_path: Path) -> None:
    """In a pipe it says what to do."""
    ran = run(TELEOP, terminal, tmp_path)
    assert ran.returncode == 2
    assert "keys are read from a terminal" in ran.stderr


def test_a_robot_that_wants_stamps_gets_them(
    terminal: dict[str, str], keyboard: tuple[int, int], tmp_path: Path
) -> None:
    """`stamped` makes the messages TwistStamped, with the frame that was given."""
    stamped = [*TELEOP, "--ros-args", "-p", "stamped:=true", "-p", "frame_id:=base_link"]
    echo = ["ros2", "topic", "echo", "--once", "/cmd_vel", "geometry_msgs/msg/TwistStamped"]
    with (
        running(stamped, terminal, tmp_path, keyboard[1]) as teleop,
        running(echo, terminal, tmp_path) as heard,
    ):
        teleop.wait_for("Ctrl-C ends it")
        while not any("frame_id" in line for line in heard.lines) and heard.process.poll() is None:
            os.write(keyboard[0], b"i")  # until the two have found each other
            time.sleep(0.2)
        assert "frame_id: base_link" in heard.wait_for("frame_id")
        assert teleop.interrupt() == 0
