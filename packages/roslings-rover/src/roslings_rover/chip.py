"""What every board can do, whatever it is made of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from roslings_rover.rover import Pose

BAUD = 115_200
LINE_EVERY_MS = 20
REPORT_EVERY_MS = 1000
STOPS_AFTER_MS = 500
TICKS_PER_TURN = 1440
"""Both edges of both channels of a quadrature encoder with 360 marks on the wheel's axle."""


@dataclass(frozen=True)
class Counts:
    """What the board counted since its start."""

    accepted: int = 0
    rejected: int = 0
    stops: int = 0
    """How often it stopped running motors because no command came."""


@dataclass(frozen=True)
class Applied:
    """A PWM that reached the motors, and when."""

    time_s: float
    left_pwm: int
    right_pwm: int


@dataclass(frozen=True)
class Truth:
    """What is so, whatever the line says of it."""

    time_s: float
    left_pwm: int
    right_pwm: int
    left_rad_s: float
    right_rad_s: float
    pose: Pose


class Chip(Protocol):
    """A board without its cable: bytes go in, time goes on, bytes come out."""

    @property
    def truth(self) -> Truth:
        """How things stand."""
        ...

    @property
    def applied(self) -> list[Applied]:
        """Every change of the motors' PWM since the start."""
        ...

    def receive(self, incoming: bytes) -> None:
        """Bytes from the host; the board reads them in its next step."""
        ...

    def step(self, dt_s: float) -> bytes:
        """Let time go on; returns what the board sent meanwhile."""
        ...
