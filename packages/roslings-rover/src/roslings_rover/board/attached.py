"""A real board on this computer's serial port, seen as a `Chip`.

Whoever asks for it puts it behind a `Board`: the node then opens the pseudo-terminal as always,
and every byte passes through here. So the same experiments can be made with the real thing.
"""

from __future__ import annotations

import errno
import termios
import time
from pathlib import Path
from types import TracebackType

import serial

from roslings_rover.chip import (
    BAUD,
    LINE_EVERY_MS,
    STOPS_AFTER_MS,
    Applied,
    Counts,
    Truth,
)
from roslings_rover.errors import DeviceTrouble
from roslings_rover.models.board_lines import BadLine, DriveCommand, LineReader, Speeds
from roslings_rover.models.differential_drive import moved
from roslings_rover.rover import Body, Pose, Wheels

SPEAKS_WITHIN_S = 8.0
"""A Mega starts anew when its port is opened, and waits up to 2 s for a new sketch."""

LISTEN_S = 0.05
MOST_AT_ONCE = 4096
MRAD_PER_RAD = 1000
MS_PER_S = 1000


class CannotOpen(DeviceTrouble):
    """The port of the real board cannot be used; the text says why, and what to do."""

    def __init__(self, port: Path, because: str, mend: str) -> None:
        super().__init__(f"The port {port} cannot be opened: {because}. {mend}")


class LabHasNoBoard(DeviceTrouble):
    """A port was given for a lab that uses none."""

    def __init__(self, lab: str) -> None:
        super().__init__(f"The lab {lab!r} has no board. Check it without --port.")


class SilentBoard(DeviceTrouble):
    """Something is on the port, and it does not speak as the course's sketch does."""

    def __init__(self, port: Path) -> None:
        super().__init__(
            f"No good line came from {port} within {SPEAKS_WITHIN_S:g} s. Put the course's sketch"
            " on the board (it lies in the lab's folder 'firmware'), and check the port's name."
        )


class BoardGone(DeviceTrouble):
    """The port vanished while it was used."""

    def __init__(self, port: Path) -> None:
        super().__init__(f"The board on {port} is gone. Put its cable back, and check again.")


class AttachedBoard:
    """A board with the course's sketch, on a serial port of this computer.

    What is true of it is known by its own lines alone. The wheels' speeds come from its encoders,
    the pose from these speeds, the PWM from the commands that it accepted. A context manager.
    Raises CannotOpen, SilentBoard at its begin, BoardGone later.
    """

    def __init__(self, port: Path, body: Body = Body()) -> None:  # noqa: B008 - cannot change
        self._name, self._body = port, body
        self._from_host, self._from_board = LineReader(), LineReader()
        self._asked: dict[int, DriveCommand] = {}
        self._applied: list[Applied] = []
        self._pwm = (0, 0)
        self._now_s = self._accepted_s = 0.0
        self._last: Speeds | None = None
        self._pose = Pose()
        self._counts = Counts()

    def __enter__(self) -> AttachedBoard:
        self._port = _opened(self._name)
        try:
            self._wait_for_a_line()
        except BaseException:
            self._port.close()
            raise
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._port.close()

    @property
    def truth(self) -> Truth:
        """How things stand, as far as the board tells; the pose is (0, 0, 0) at the begin."""
        wheels = _wheels(self._last)
        return Truth(self._now_s, *self._pwm, wheels.left_rad_s, wheels.right_rad_s, self._pose)

    @property
    def counts(self) -> Counts:
        """What the board told last."""
        return self._counts

    @property
    def applied(self) -> list[Applied]:
        """Every change of the motors' PWM: by a command that was accepted, or by none for long."""
        return self._applied

    def receive(self, incoming: bytes) -> None:
        """Bytes from the host. Raises BoardGone."""
        for body in self._from_host.feed(incoming):
            self._note_command(body)
        try:
            self._port.write(incoming)
        except (OSError, serial.SerialException) as error:
            raise BoardGone(self._name) from error

    def step(self, dt_s: float) -> bytes:
        """Note that time passed; returns what the board sent meanwhile. Raises BoardGone."""
        self._now_s += dt_s
        told = self._read()
        for body in self._from_board.feed(told):
            self._note(body)
        if any(self._pwm) and self._now_s - self._accepted_s > STOPS_AFTER_MS / MS_PER_S:
            self._drive(0, 0)
        return told

    def _read(self) -> bytes:
        try:
            return bytes(self._port.read(MOST_AT_ONCE))
        except (OSError, serial.SerialException) as error:
            raise BoardGone(self._name) from error

    def _wait_for_a_line(self) -> None:
        until_s = time.monotonic() + SPEAKS_WITHIN_S
        while not self._from_board.feed(self._read()):
            if time.monotonic() > until_s:
                raise SilentBoard(self._name)
            time.sleep(LISTEN_S)

    def _note_command(self, body: str) -> None:
        try:
            drive = DriveCommand.read(body)
        except BadLine:
            return  # the board refuses it too
        self._asked[drive.seq] = drive

    def _note(self, body: str) -> None:
        kind, _, rest = body.partition(",")
        if kind == "A" and (drive := self._asked.pop(int(rest), None)):
            self._accepted_s = self._now_s
            self._drive(drive.left_pwm, drive.right_pwm)
        elif kind == "W":
            self._move(Speeds.read(body))
        elif kind == "S":
            self._counts = Counts(*map(int, rest.split(",")[1:]))

    def _drive(self, left_pwm: int, right_pwm: int) -> None:
        if (left_pwm, right_pwm) != self._pwm:
            self._pwm = (left_pwm, right_pwm)
            self._applied.append(Applied(self._now_s, left_pwm, right_pwm))

    def _move(self, now: Speeds) -> None:
        """The pose after the time since the line before, at the speeds measured in it."""
        before_ms = self._last.ms if self._last else now.ms - LINE_EVERY_MS
        motion = self._body.motion_of(_wheels(now))
        self._pose = moved(self._pose, motion, (now.ms - before_ms) / MS_PER_S)
        self._last = now


def try_port(port: Path) -> None:
    """Say now what would go wrong later. Raises CannotOpen, SilentBoard."""
    with AttachedBoard(port):
        pass


def _wheels(speeds: Speeds | None) -> Wheels:
    if speeds is None:
        return Wheels()
    return Wheels(speeds.left_mrad_s / MRAD_PER_RAD, speeds.right_mrad_s / MRAD_PER_RAD)


def _opened(port: Path) -> serial.Serial:
    try:
        return serial.Serial(str(port), BAUD, timeout=0, exclusive=True)
    except (OSError, serial.SerialException) as error:
        raise CannotOpen(port, *_because(error)) from error


def _number_of(error: OSError) -> int | None:
    """The kernel's number of an error; pyserial keeps that of `tcgetattr` in the cause alone."""
    cause = error.__context__
    return cause.args[0] if isinstance(cause, termios.error) else error.errno


def _because(error: OSError) -> tuple[str, str]:
    """Why a port does not open, and what to do; pyserial's own words do not tell apart."""
    number = _number_of(error)
    if number == errno.ENOENT:
        return (
            "it is not there",
            "Put the cable in, and list the ports: ls /dev/ttyACM* /dev/ttyUSB*",
        )
    if number in (errno.EACCES, errno.EPERM):
        return "you have no permission", (
            "Join the group of serial ports: sudo usermod -aG dialout $USER. Then log out and in."
        )
    if number in (errno.EBUSY, errno.EAGAIN):
        return (
            "another program has it open",
            "Close the serial monitor, or the node, and try again.",
        )
    if number in (errno.ENOTTY, errno.EINVAL):
        return "it is no serial port", "Give the name of a port, for example /dev/ttyACM0."
    return str(error), "Give the name of a port, for example /dev/ttyACM0."
