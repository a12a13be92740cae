"""`ros2 topic hz` and `bw`: how often messages come, how large they are, how many are lost."""

from __future__ import annotations

import argparse
import time
from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from roslings.ros2.eye import Eye
from roslings.ros2.listening import awaited_type, subscribe, topic_in

if TYPE_CHECKING:
    from roslings.rates import Rate

EVERY_S = 1.0
DEPTH = 1000
"""Enough for a second at 1 kHz: a burst is no loss."""


@dataclass(frozen=True)
class Arrival:
    """One message: the three things that `roslings.rates` measures from, and its size."""

    source_ns: int | None
    sequence: int | None
    arrival_ns: int
    size: int


class Window:
    """The newest messages."""

    def __init__(self, most: int) -> None:
        self.arrivals: deque[Arrival] = deque(maxlen=most)
        self.new = 0

    def hear(self, raw: bytes, info: Any) -> None:
        """Keep one message's stamps and size."""
        self.arrivals.append(
            Arrival(
                source_ns=info["source_timestamp"] or None,
                sequence=info["publication_sequence_number"],
                arrival_ns=time.monotonic_ns(),
                size=len(raw),
            )
        )
        self.new += 1

    def something_new(self) -> bool:
        """Whether a message came since the last time that this was asked."""
        came, self.new = self.new > 0, 0
        return came


def hz(options: argparse.Namespace) -> int:
    """`ros2 topic hz TOPIC`."""
    with Eye() as eye:
        topic, window = _opened(eye, options, options.window + 1)
        from roslings.rates import measure_rate  # takes a moment, and the first messages need one

        while True:
            eye.until(lambda: False, EVERY_S)
            if window.something_new() and (rate := measure_rate(list(window.arrivals))):  # type: ignore[arg-type]  # only the stamps are read
                print("\n".join(hz_lines(rate, len(eye.publishers(topic)))))


def hz_lines(rate: Rate, publishers: int) -> list[str]:
    """The lines of the real tool, and one on losses."""
    periods_s = rate.periods_s
    return [
        f"average rate: {rate.hz:.3f}",
        f"\tmin: {min(periods_s):.3f}s max: {max(periods_s):.3f}s"
        f" std dev: {rate.jitter_s:.5f}s window: {len(periods_s)}",
        f"\tlost: {_losses(rate, publishers)}",
    ]


def _losses(rate: Rate, publishers: int) -> str:
    if publishers > 1:
        return f"not known, because {publishers} nodes publish here"
    return f"{rate.lost} of {rate.lost + len(rate.periods_s)} messages"


def bw(options: argparse.Namespace) -> int:
    """`ros2 topic bw TOPIC`."""
    with Eye() as eye:
        topic, window = _opened(eye, options, options.window)
        print(f"Subscribed to [{topic}]")
        while True:
            eye.until(lambda: False, EVERY_S)
            if len(window.arrivals) > 1:
                print("\n".join(bw_lines(list(window.arrivals), time.monotonic_ns())))


def _opened(eye: Eye, options: argparse.Namespace, most: int) -> tuple[str, Window]:
    """Subscribe to the topic of `options`, and keep the newest `most` messages."""
    topic = topic_in(options)
    eye.settle()
    window = Window(most)
    options.qos_depth = options.qos_depth or DEPTH
    subscribe(eye, topic, awaited_type(eye, topic), options, window.hear, raw=True)
    return topic, window


def bw_lines(arrivals: list[Arrival], now_ns: int) -> list[str]:
    """The lines of the real tool: bytes a second since the oldest message, and sizes."""
    sizes = [arrival.size for arrival in arrivals]
    per_s = sum(sizes) / ((now_ns - arrivals[0].arrival_ns) / 1e9)
    unit = unit_of(per_s)
    return [
        f"{unit(per_s)}/s from {len(sizes)} messages",
        f"\tMessage size mean: {unit(sum(sizes) / len(sizes))}"
        f" min: {unit(min(sizes))} max: {unit(max(sizes))}",
    ]


def unit_of(per_s: float) -> Any:
    """How to write bytes beside a bandwidth of `per_s`."""
    if per_s < 1e3:
        return lambda size: f"{size:.0f} B"
    if per_s < 1e6:
        return lambda size: f"{size / 1e3:.2f} KB"
    return lambda size: f"{size / 1e6:.2f} MB"
