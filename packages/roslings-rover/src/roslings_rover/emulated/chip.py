"""The emulated board as a `Chip`: a process that lets simulated time pass when it is asked to."""

from __future__ import annotations

import struct
import subprocess
from types import TracebackType
from typing import IO

from roslings_rover.chip import TICKS_PER_TURN, Applied, Truth
from roslings_rover.emulated.build import BuiltSketch
from roslings_rover.errors import DeviceTrouble
from roslings_rover.models.differential_drive import moved
from roslings_rover.rover import Body, Pose, Wheels

US_PER_S = 1_000_000
STATE = struct.Struct("<QddddhhII")
CHANGE = struct.Struct("<Qhh")
LONGEST_STEP_US = 5000
"""The pose is put together from short pieces, each a part of a circle."""


class EmulatorEnded(DeviceTrouble):
    """The process that runs the sketch is gone."""

    def __init__(self, status: int | None) -> None:
        super().__init__(f"The emulated board ended (status {status}). Start it again.")


class EmulatedMega:
    """The sketch on an ATmega2560, in a rover on an endless empty floor.

    A context manager, which starts and ends the process. Raises EmulatorEnded where it is gone.
    """

    def __init__(self, built: BuiltSketch, body: Body = Body()) -> None:  # noqa: B008 - cannot change
        self._built, self._body = built, body
        self._pose = Pose()
        self._angles = (0.0, 0.0)
        self._state: tuple[float, ...] = (0, 0.0, 0.0, 0.0, 0.0, 0, 0)
        self._unread = b""
        self._rest_us = 0.0
        self._applied: list[Applied] = []

    def __enter__(self) -> EmulatedMega:
        body = self._body
        figures = (body.fastest_wheel_rad_s, body.motor_lag_s, TICKS_PER_TURN)
        self._process = subprocess.Popen(
            [str(self._built.runner), str(self._built.sketch), *map(str, figures)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        with self._process:
            self._process.kill()

    @property
    def truth(self) -> Truth:
        """How things stand."""
        time_us, _, _, left, right, left_pwm, right_pwm = self._state
        return Truth(time_us / US_PER_S, int(left_pwm), int(right_pwm), left, right, self._pose)

    @property
    def applied(self) -> list[Applied]:
        """Every change of the motors' PWM that lasted for 0.1 ms."""
        return self._applied

    def receive(self, incoming: bytes) -> None:
        """Bytes from the host; they reach the UART at 115200 baud."""
        self._unread += incoming

    def step(self, dt_s: float) -> bytes:
        """Let simulated time pass; returns what UART0 sent. Raises EmulatorEnded."""
        whole_us = self._rest_us + dt_s * US_PER_S
        left_us = int(whole_us)
        self._rest_us = whole_us - left_us
        sent = b""
        while left_us > 0:
            span_us = min(left_us, LONGEST_STEP_US)
            sent += self._pass(span_us)
            left_us -= span_us
        return sent

    def _pass(self, span_us: int) -> bytes:
        stdin, stdout = self._pipes()
        try:
            stdin.write(struct.pack("<II", span_us, len(self._unread)) + self._unread)
            stdin.flush()
        except BrokenPipeError as error:
            raise EmulatorEnded(self._process.poll()) from error
        self._unread = b""
        *state, sent, changes = STATE.unpack(self._take(stdout, STATE.size))
        self._state = tuple(state)
        said = self._take(stdout, sent)
        for time_us, left, right in CHANGE.iter_unpack(self._take(stdout, CHANGE.size * changes)):
            self._applied.append(Applied(time_us / US_PER_S, left, right))
        self._move()
        return said

    def _move(self) -> None:
        """The pose after the wheels have turned from the angles before to those of now."""
        before, self._angles = self._angles, (self._state[1], self._state[2])
        turned = Wheels(self._angles[0] - before[0], self._angles[1] - before[1])
        self._pose = moved(self._pose, self._body.motion_of(turned), 1.0)

    def _take(self, stdout: IO[bytes], count: int) -> bytes:
        taken = stdout.read(count)
        if len(taken) < count:
            raise EmulatorEnded(self._process.poll())
        return taken

    def _pipes(self) -> tuple[IO[bytes], IO[bytes]]:
        stdin, stdout = self._process.stdin, self._process.stdout
        assert stdin is not None and stdout is not None
        return stdin, stdout
