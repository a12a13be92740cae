"""A board that runs until Ctrl-C, for a student whose bridge needs something to talk to."""

from __future__ import annotations

import fcntl
import math
import os
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from roslings_rover.board.mega import Mega
from roslings_rover.board.on_pty import Board
from roslings_rover.board.wire import Wire
from roslings_rover.chip import BAUD, Chip
from roslings_rover.errors import DeviceTrouble
from roslings_rover.rover import Rover
from roslings_rover.stop_signal import listening
from roslings_rover.usual_place import told_of, usual_place

TELL_EVERY_S = 1.0
NAME = "ttyROVER"
PARAMETER = "port"


class BoardNameTaken(DeviceTrouble):
    """Another board runs under this name."""

    def __init__(self, name: Path) -> None:
        super().__init__(
            f"A board runs already on {name}. End it with Ctrl-C there, or give another --port."
        )


class NoPlaceForPort(DeviceTrouble):
    """The port's name cannot be made."""

    def __init__(self, name: Path, because: str) -> None:
        super().__init__(f"The port {name} cannot be made: {because}. Give another --port.")


def usual_port() -> Path:
    """Where the board is when nobody says where. Raises NoOwnPlace."""
    return usual_place(NAME, "--port")


def run(asked_for: Path | None, sketch: Path | None = None) -> None:
    """Run a board until Ctrl-C, on that port or on the usual one.

    With `sketch`, the real one, emulated.

    Raises BoardNameTaken, NoPlaceForPort, NoOwnPlace, CannotBuild.
    """
    name = asked_for or usual_port()
    with ExitStack() as stack:
        stack.enter_context(_alone_on(name))
        chip = _chip(stack, sketch)
        board = stack.enter_context(Board(chip, name, Wire(BAUD)))
        stack.enter_context(board.running())
        asked = stack.enter_context(listening())
        print(f"The board is on {name}")
        if not asked_for and (words := told_of(name, NAME, PARAMETER)):
            print(words)
        print("It tells its wheel speeds 50 times a second. Ctrl-C ends it.", flush=True)
        told = ""
        while not asked.wait(TELL_EVERY_S) and board.trouble is None:
            if (news := describe(chip)) != told:
                print(news, flush=True)
                told = news
        print()
        if board.trouble:
            raise board.trouble


def describe(chip: Chip) -> str:
    """What the motors get and where the rover is; at most 80 columns."""
    truth = chip.truth
    pose = truth.pose
    return (
        f"PWM {truth.left_pwm:4d} {truth.right_pwm:4d}"
        f"   wheels {truth.left_rad_s:6.2f} {truth.right_rad_s:6.2f} rad/s"
        f"   x {pose.x_m:5.2f} y {pose.y_m:5.2f} m {math.degrees(pose.heading_rad):5.0f} degrees"
    )


def _chip(stack: ExitStack, sketch: Path | None) -> Chip:
    if sketch is None:
        return Mega(Rover())
    from roslings_rover.emulated import EmulatedMega, built

    return stack.enter_context(EmulatedMega(built(sketch)))


@contextmanager
def _alone_on(name: Path) -> Iterator[None]:
    """The name is ours while the block runs; a board that was killed leaves it free."""
    if name.exists() and not name.is_symlink():
        raise NoPlaceForPort(name, "a file of this name is there")
    with ExitStack() as held:
        _lock(name, held)
        yield


def _lock(name: Path, held: ExitStack) -> None:
    """Take a lock that ends with `held`, or with this process."""
    try:
        lock = os.open(f"{name}.lock", os.O_CREAT | os.O_WRONLY, 0o600)
        held.callback(os.close, lock)
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise BoardNameTaken(name) from None
    except OSError as error:
        raise NoPlaceForPort(name, error.strerror or str(error)) from error
