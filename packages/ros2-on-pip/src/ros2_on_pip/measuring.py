"""`ros2 topic hz`, `bw` and `delay`: how often messages come, how large and how old they are."""

from __future__ import annotations

import argparse
import statistics
import time
from collections import deque
from collections.abc import Callable, Collection
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from ros2_on_pip.discovery import DirectNode
from ros2_on_pip.interfaces import class_of, name_of
from ros2_on_pip.listening import awaited_type, filter_in, known_type, subscribe, topic_in
from ros2_on_pip.problem import CommandProblem
from ros2_on_pip.qos import matching

if TYPE_CHECKING:
    from ros2_on_pip.rates import Rate

EVERY_S = 1.0
DEPTH = 1000
"""Enough for a second at 1 kHz: a burst is no loss."""


@dataclass(frozen=True)
class Arrival:
    """One message: the three things that `ros2_on_pip.rates` measures from, and its size."""

    source_ns: int | None
    sequence: int | None
    arrival_ns: int
    size: int


class MessageWindow:
    """The newest messages."""

    def __init__(self, most: int) -> None:
        self.arrivals: deque[Arrival] = deque(maxlen=most)
        self.new = 0

    def hear(self, raw: bytes, info: Any) -> None:
        """Keep one message's stamps and size."""
        self.keep(
            Arrival(
                source_ns=info["source_timestamp"] or None,
                sequence=info["publication_sequence_number"],
                arrival_ns=time.monotonic_ns(),
                size=len(raw),
            )
        )

    def keep(self, arrival: Arrival) -> None:
        """One more message; where its time lies before the last one's, the clock began anew."""
        if self.arrivals and arrival.arrival_ns < self.arrivals[-1].arrival_ns:
            self.arrivals.clear()
        self.arrivals.append(arrival)
        self.new += 1

    def something_new(self) -> bool:
        """Whether a message came since the last time that this was asked."""
        came, self.new = self.new > 0, 0
        return came


class SimWindow(MessageWindow):
    """The newest messages, by the time of /clock; before that has begun, none count."""

    def __init__(self, most: int, direct_node: DirectNode) -> None:
        super().__init__(most)
        self._clock = direct_node.node.get_clock()

    def hear(self, raw: bytes, info: Any) -> None:
        """Keep when one message came."""
        if now_ns := self._clock.now().nanoseconds:
            number = info["publication_sequence_number"]
            self.keep(Arrival(None, number, now_ns, len(raw)))


def hz(options: argparse.Namespace) -> int:
    """`ros2 topic hz TOPIC`."""
    passes = filter_in(options)
    with DirectNode.asked_by(options) as direct_node:
        by_sim = options.use_sim_time and not options.wall_time
        most = options.window + 1
        window = SimWindow(most, direct_node) if by_sim else MessageWindow(most)
        topic, cls = _opened(direct_node, options)
        _subscribe(direct_node, topic, options, filtered(window.hear, cls, passes, options))
        from ros2_on_pip.rates import (
            measure_rate,  # takes a moment, and the first messages need one
        )

        while True:
            direct_node.until(lambda: False, EVERY_S)
            if window.something_new():
                arrivals = list(window.arrivals)
                rate = measure_rate(arrivals) or few_rate(arrivals)
                if rate:
                    print("\n".join(hz_lines(rate, _unknown_losses(direct_node, topic, options))))


def filtered(
    hear: Callable[[bytes, Any], None],
    cls: Any,
    passes: Callable[[Any], bool],
    options: argparse.Namespace,
) -> Callable[[bytes, Any], None]:
    """`hear` for the messages that pass `--filter`; only for that are they read."""
    if not options.filter:
        return hear

    def choose(raw: bytes, info: Any) -> None:
        from rclpy.serialization import deserialize_message

        if passes(deserialize_message(raw, cls)):
            hear(raw, {**info, "publication_sequence_number": None})  # gaps are no losses here

    return choose


def few_rate(arrivals: list[Arrival]) -> Rate | None:
    """The rate of the first messages, or of so few as a small `--window` leaves."""
    from ros2_on_pip.rates import FEWEST_INTERVALS, Rate

    if not 1 < len(arrivals) <= FEWEST_INTERVALS:
        return None
    stamped = all(arrival.source_ns for arrival in arrivals)
    times_ns = [(a.source_ns if stamped else None) or a.arrival_ns for a in arrivals]
    periods_s = tuple((after - before) / 1e9 for before, after in pairwise(times_ns))
    mean_s = statistics.fmean(periods_s)
    numbers = [arrival.sequence for arrival in arrivals if arrival.sequence is not None]
    lost = numbers[-1] - numbers[0] - len(periods_s) if len(numbers) == len(arrivals) else 0
    return Rate(1 / mean_s, 0.0, periods_s, lost, stamped) if mean_s > 0 else None


def hz_lines(rate: Rate, losses_unknown: str) -> list[str]:
    """The lines of the real tool, and one on losses, or why they are not known."""
    periods_s = rate.periods_s
    lost = f"{rate.lost} of {rate.lost + len(periods_s)} messages"
    return [
        f"average rate: {rate.hz:.3f}",
        f"\tmin: {min(periods_s):.3f}s max: {max(periods_s):.3f}s"
        f" std dev: {rate.jitter_s:.5f}s window: {len(periods_s)}",
        f"\tlost: {losses_unknown or lost}",
    ]


def _unknown_losses(direct_node: DirectNode, topic: str, options: argparse.Namespace) -> str:
    """Why a gap in the numbers would tell nothing; empty where it does."""
    publishers = len(direct_node.publishers(topic))
    if options.filter:
        return "not known, because --filter leaves messages out"
    return f"not known, because {publishers} nodes publish here" if publishers > 1 else ""


def bw(options: argparse.Namespace) -> int:
    """`ros2 topic bw TOPIC`."""
    with DirectNode.asked_by(options) as direct_node:
        window = MessageWindow(options.window)
        topic, _ = _opened(direct_node, options)
        _subscribe(direct_node, topic, options, window.hear)
        print(f"Subscribed to [{topic}]")
        while True:
            direct_node.until(lambda: False, EVERY_S)
            if len(window.arrivals) > 1:
                print("\n".join(bw_lines(list(window.arrivals), time.monotonic_ns())))


class NoHeader(CommandProblem):
    """Only a message with a header tells when it was made."""

    def __init__(self, topic: str, type_name: str) -> None:
        super().__init__(
            f"msg does not have header: the messages of '{topic}' are {type_name}, and have no"
            " stamp that tells how old they are. Use a type with a header, such as"
            " geometry_msgs/msg/TwistStamped"
        )


class Ages:
    """How old the newest messages were when they came, by a clock of ROS."""

    def __init__(self, most: int, clock: Any) -> None:
        self.delays_s: deque[float] = deque(maxlen=most)
        self.new = 0
        self._clock = clock

    def hear(self, message: Any) -> None:
        """Keep the age of one message; before /clock has begun it has none."""
        if now_ns := self._clock.now().nanoseconds:
            stamp = message.header.stamp
            self.delays_s.append((now_ns - stamp.nanosec) / 1e9 - stamp.sec)
            self.new += 1

    def lines(self) -> list[str]:
        """What to print now."""
        came, self.new = self.new > 0, 0
        if not self.delays_s:
            return []
        return delay_lines(self.delays_s) if came else ["no new messages"]


def delay(options: argparse.Namespace) -> int:
    """`ros2 topic delay TOPIC`."""
    with DirectNode.asked_by(options) as direct_node:
        topic, cls = _opened(direct_node, options)
        if "header" not in cls.get_fields_and_field_types():
            raise NoHeader(topic, name_of(cls))
        ages = Ages(options.window, direct_node.node.get_clock())
        _subscribe(direct_node, topic, options, ages.hear, raw=False)
        while True:
            direct_node.until(lambda: False, EVERY_S)
            print("".join(f"{line}\n" for line in ages.lines()), end="")


def delay_lines(delays_s: Collection[float]) -> list[str]:
    """The lines of the real tool."""
    return [
        f"average delay: {statistics.fmean(delays_s):.3f}",
        f"\tmin: {min(delays_s):.3f}s max: {max(delays_s):.3f}s"
        f" std dev: {statistics.pstdev(delays_s):.5f}s window: {len(delays_s)}",
    ]


def _opened(direct_node: DirectNode, options: argparse.Namespace) -> tuple[str, Any]:
    """The topic of `options` and its class, as soon as somebody has it."""
    topic = topic_in(options)
    direct_node.settle()
    return topic, class_of(awaited_type(direct_node, topic), "msg")


def _subscribe(
    direct_node: DirectNode,
    topic: str,
    options: argparse.Namespace,
    hear: Callable[..., None],
    raw: bool = True,
) -> None:
    options.qos_depth = options.qos_depth or DEPTH
    profile = matching(options, direct_node.publishers(topic))
    subscribe(direct_node, topic, known_type(direct_node, topic), profile, hear, raw=raw)


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
