"""A board at a serial port, used by the grader: here the port is a pseudo-terminal's."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from roslings_rover.board import Board, DriveCommand, LineReader, Mega
from roslings_rover.board import attached as attached_module
from roslings_rover.board.attached import (
    AttachedBoard,
    BoardGone,
    CannotOpen,
    SilentBoard,
    try_port,
)
from roslings_rover.rover import Box, Rover, World

FLOOR = World(room=Box(-50, -50, 50, 50))
BOUND_S = 60.0


@pytest.fixture
def board() -> Iterator[Board]:
    """A board that lives in real time."""
    with Board(Mega(Rover(FLOOR))) as board, board.running():
        yield board


def pass_until(chip: AttachedBoard, holds: Callable[[], bool]) -> bytes:
    """Let time pass until something holds; returns what the board said."""
    said, before_s = b"", time.monotonic()
    until_s = before_s + BOUND_S
    while not holds():
        assert time.monotonic() < until_s, "it did not come to hold"
        time.sleep(0.005)
        now_s = time.monotonic()
        said += chip.step(now_s - before_s)
        before_s = now_s
    return said


def test_lines_pass_both_ways(board: Board) -> None:
    """The host hears the board's own lines; the board obeys the host."""
    with AttachedBoard(Path(board.name)) as chip:
        chip.receive(DriveCommand(7, 120, -120).line())
        said = pass_until(chip, lambda: bool(chip.applied))
        assert "A,7" in LineReader().feed(said)
        assert board.chip.applied[0].left_pwm == 120


def test_what_is_true_is_what_the_board_tells(board: Board) -> None:
    """PWM by what it accepted, speed and pose by its encoders; by itself it stops."""
    with AttachedBoard(Path(board.name)) as chip:
        chip.receive(DriveCommand(1, 150, 150).line())
        pass_until(chip, lambda: chip.truth.left_pwm == 150)
        pass_until(chip, lambda: chip.truth.left_rad_s > 1 and chip.truth.pose.x_m > 0.02)
        pass_until(chip, lambda: chip.truth.left_pwm == 0 == chip.truth.left_rad_s)
        assert [each.left_pwm for each in chip.applied] == [150, 0]
        assert chip.truth.pose.x_m == pytest.approx(board.chip.truth.pose.x_m, abs=0.02)


def test_a_command_that_the_board_refuses_is_not_applied(board: Board) -> None:
    """A wrong checksum, and then a good line that shows that time has passed."""
    with AttachedBoard(Path(board.name)) as chip:
        chip.receive(b"$M,1,99,99*0000\n" + DriveCommand(2, 50, 50).line())
        pass_until(chip, lambda: bool(chip.applied))
        assert chip.applied[0].left_pwm == 50
        pass_until(chip, lambda: chip.counts.rejected == 1)


def test_a_board_that_goes_says_so(board: Board) -> None:
    """Also in the middle."""
    with AttachedBoard(Path(board.name)) as chip:
        board.unplug()
        with pytest.raises(BoardGone, match="Put its cable back"):
            pass_until(chip, lambda: False)


def test_a_port_that_is_taken_is_said_to_be(board: Board) -> None:
    """By the student's own node, most of the time."""
    with AttachedBoard(Path(board.name)), pytest.raises(CannotOpen, match="another program"):
        try_port(Path(board.name))


def test_a_silent_port_is_no_board(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing came: another sketch, or another thing."""
    monkeypatch.setattr(attached_module, "SPEAKS_WITHIN_S", 0.2)
    ours, theirs = os.openpty()
    try:
        with pytest.raises(SilentBoard, match="sketch"):
            try_port(Path(os.ttyname(theirs)))
    finally:
        os.close(ours)
        os.close(theirs)


@pytest.mark.parametrize(
    ("port", "because"),
    [("/dev/there-is-none", "ls /dev/ttyACM"), ("/dev/null", "no serial port"), (".", "port")],
)
def test_what_is_no_port_is_told(port: str, because: str) -> None:
    """With what to do."""
    with pytest.raises(CannotOpen, match=because):
        try_port(Path(port))


NOBODY = 65534


@pytest.fixture
def closed_port(tmp_path: Path) -> Iterator[Path]:
    """Nobody may open it. Root may open everything, so this process is somebody else meanwhile."""
    port = tmp_path / "tty"
    port.touch(mode=0)
    if (before := os.geteuid()) == 0:
        os.seteuid(NOBODY)
    yield port
    os.seteuid(before)


def test_a_port_without_permission_names_the_group(closed_port: Path) -> None:
    """The beginner's first fault with a board."""
    with pytest.raises(CannotOpen, match="dialout"):
        try_port(closed_port)
