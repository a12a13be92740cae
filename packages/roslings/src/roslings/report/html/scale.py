"""Axes: where a value stands on the paper, which numbers stand beside it, and in which unit."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from ros2_on_pip.language import said

MOST_DECIMALS = 4
LEAST_S = 1e-6
NICE = (1.0, 2.0, 5.0, 10.0)


@dataclass(frozen=True)
class Axis:
    """Values from 0 to `top`, on paper from `start` to `end`."""

    top: float
    start: float
    end: float

    def at(self, value: float) -> float:
        """Where `value` stands; what is beyond the top stands at the end."""
        return self.start + (self.end - self.start) * min(value / self.top, 1.0)

    def ticks(self, about: int) -> Iterator[float]:
        """Round values from 0 to the top, at most about `about` of them."""
        step = _nice_step(self.top / about)
        count = math.floor(self.top / step + 1e-9)
        return (number * step for number in range(count + 1))


def _nice_step(least: float) -> float:
    power = 10.0 ** math.floor(math.log10(least))
    return next(power * nice for nice in NICE if power * nice >= least * (1 - 1e-9))


@dataclass(frozen=True)
class Unit:
    """A unit of time."""

    name: str
    per_s: float

    def number(self, seconds: float) -> str:
        """The number alone, with four digits that count."""
        return f"{seconds * self.per_s:.4g}"

    def text(self, seconds: float) -> str:
        """The number with its unit, as far as four digits go."""
        value = seconds * self.per_s
        return f"{value:.{max(0, min(3, 4 - _digits(value)))}f} {self.name}"


def _digits(value: float) -> int:
    """Digits before the point."""
    return len(str(int(abs(value)))) if abs(value) >= 1 else 0


def time_text(seconds: float) -> str:
    """A time in the unit in which it is easy to read."""
    if seconds < LEAST_S:
        return said("page.least_time", "less than 1 µs")
    return unit_for(seconds).text(seconds)


def rate_text(hz: float, uncertainty_hz: float) -> str:
    """A rate to the second digit of what is not certain of it, at most four decimals."""
    least = max(uncertainty_hz, 10.0**-MOST_DECIMALS)
    decimals = min(MOST_DECIMALS, max(0, math.ceil(-math.log10(least)) + 1))
    rate, about = f"{hz:.{decimals}f}", f"{max(least, uncertainty_hz):.{decimals}f}"
    if uncertainty_hz < least:
        sure = "{rate} Hz, give or take less than {about} Hz"
        return said("page.rate.sure", sure, rate=rate, about=about)
    return said("page.rate.about", "{rate} Hz, give or take {about} Hz", rate=rate, about=about)


SECONDS, MILLISECONDS, MICROSECONDS = Unit("s", 1.0), Unit("ms", 1e3), Unit("µs", 1e6)


def unit_for(seconds: float) -> Unit:
    """The unit in which `seconds` is easy to read."""
    if seconds >= 1:
        return SECONDS
    return MILLISECONDS if seconds >= 1e-3 else MICROSECONDS
