"""The board in Python alone: it does what the sketch in `firmware` does, with the same lines."""

from __future__ import annotations

import math

from roslings_rover.chip import (
    LINE_EVERY_MS,
    REPORT_EVERY_MS,
    STOPS_AFTER_MS,
    TICKS_PER_TURN,
    Applied,
    Counts,
    Truth,
)
from roslings_rover.models.board_lines import (
    LARGEST_PWM,
    BadLine,
    DriveCommand,
    LineReader,
    Speeds,
    framed,
)
from roslings_rover.rover import Rover, Wheels

US_PER_S = 1_000_000
US_PER_MS = 1000
RAD_PER_TICK = 2 * math.pi / TICKS_PER_TURN


class Mega:
    """An Arduino Mega with two motors and two encoders, built into a rover."""

    def __init__(self, rover: Rover | None = None) -> None:
        self.rover = rover or Rover()
        self._reader = LineReader()
        self._now_us = 0
        self._rest_us = 0.0
        self._seq = 0
        self._ticks = (0, 0)
        self._pwm = (0, 0)
        self._commanded_us = 0
        self._accepted = self._misread = self._stops = 0
        self._applied: list[Applied] = []
        self._unread = b""

    @property
    def truth(self) -> Truth:
        """How things stand."""
        wheels = self.rover.wheels
        return Truth(
            self._now_us / US_PER_S,
            *self._pwm,
            wheels.left_rad_s,
            wheels.right_rad_s,
            self.rover.pose,
        )

    @property
    def counts(self) -> Counts:
        """What the board tells once a second."""
        return Counts(self._accepted, self._reader.rejected + self._misread, self._stops)

    @property
    def applied(self) -> list[Applied]:
        """Every change of the motors' PWM."""
        return self._applied

    def receive(self, incoming: bytes) -> None:
        """Bytes from the host."""
        self._unread += incoming

    def step(self, dt_s: float) -> bytes:
        """Let time go on; returns what was sent. Fractions of a microsecond are kept for later."""
        whole_us = self._rest_us + dt_s * US_PER_S
        until_us = self._now_us + int(whole_us)
        self._rest_us = whole_us - int(whole_us)
        sent = self._obey()
        while (due_us := self._next_due_us()) <= until_us:
            self._advance(due_us)
            sent += self._do_what_is_due()
        self._advance(until_us)
        return sent

    def _next_due_us(self) -> int:
        line_us = LINE_EVERY_MS * US_PER_MS
        dues = [(self._now_us // line_us + 1) * line_us]
        if any(self._pwm):
            dues.append(self._commanded_us + STOPS_AFTER_MS * US_PER_MS)
        return min(dues)

    def _advance(self, until_us: int) -> None:
        self.rover.step((until_us - self._now_us) / US_PER_S)
        self._now_us = until_us

    def _do_what_is_due(self) -> bytes:
        self._watch_over_motors()
        ms, fraction = divmod(self._now_us, US_PER_MS)
        sent = b""
        if not fraction and ms % LINE_EVERY_MS == 0:
            sent += self._speeds(ms).line()
        if not fraction and ms % REPORT_EVERY_MS == 0:
            sent += self._report(ms)
        return sent

    def _obey(self) -> bytes:
        answers = [self._follow(body) for body in self._reader.feed(self._unread)]
        self._unread = b""
        return b"".join(answers)

    def _follow(self, body: str) -> bytes:
        try:
            drive = DriveCommand.read(body)
        except BadLine:
            self._misread += 1
            return b""
        self._accepted += 1
        self._commanded_us = self._now_us
        self._drive(drive.left_pwm, drive.right_pwm)
        return framed(f"A,{drive.seq}")

    def _drive(self, left_pwm: int, right_pwm: int) -> None:
        if (left_pwm, right_pwm) == self._pwm:
            return
        self._pwm = (left_pwm, right_pwm)
        self._applied.append(Applied(self._now_us / US_PER_S, left_pwm, right_pwm))
        fastest = self.rover.body.fastest_wheel_rad_s
        self.rover.turn_wheels(
            Wheels(left_pwm / LARGEST_PWM * fastest, right_pwm / LARGEST_PWM * fastest)
        )

    def _watch_over_motors(self) -> None:
        late = self._now_us - self._commanded_us >= STOPS_AFTER_MS * US_PER_MS
        if late and any(self._pwm):
            self._stops += 1
            self._drive(0, 0)

    def _speeds(self, ms: int) -> Speeds:
        left, right = (math.floor(turned / RAD_PER_TICK) for turned in self.rover.turned_rad)
        before, self._ticks = self._ticks, (left, right)
        seq, self._seq = self._seq, self._seq + 1
        return Speeds(seq, ms, _mrad_s(left - before[0]), _mrad_s(right - before[1]))

    def _report(self, ms: int) -> bytes:
        counts = self.counts
        return framed(f"S,{ms},{counts.accepted},{counts.rejected},{counts.stops}")


def _mrad_s(ticks: int) -> int:
    """The speed of so many ticks in the time between two lines."""
    return round(ticks * RAD_PER_TICK * 1_000_000 / LINE_EVERY_MS)
