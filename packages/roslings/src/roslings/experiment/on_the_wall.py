"""Watching a rate in real time, beside a canary that tells whether this computer can keep one."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from ros2_on_pip.rates import LONGEST_STALL_S, MOST_UNEVEN, NS_PER_S, Rate, measure_rate
from roslings.arena import LONGEST_WAIT_S, Arena
from roslings.course import RateContract
from roslings.evidence import CanarySeen, Endpoint, ExperimentSeen
from roslings.experiment.turns import Turns
from roslings.probe import Probe, canary
from roslings.seen.rates import held_s, own_rate

FIRST_MESSAGE_WITHIN_S = 10.0
CANARY_WITHIN_S = 20.0
SHORTEST_PERIODS = 10
LONGEST_PERIODS = 40
CANARY_MISSES = 0.5
"""Part of the tolerance by which the canary may miss its rate before nothing is believed."""


@contextmanager
def singing(hz: float, domain_id: int) -> Iterator[None]:
    """A canary in this domain while the block runs."""
    command = [sys.executable, canary.__file__, str(hz)]
    environment = {**os.environ, "ROS_DOMAIN_ID": str(domain_id)}
    quiet = subprocess.DEVNULL
    with subprocess.Popen(
        command, env=environment, stdin=quiet, stdout=quiet, stderr=quiet
    ) as process:
        try:
            yield
        finally:
            process.kill()


@dataclass
class WallWatch:
    """The rate of one topic, until it is sure or the bound is met."""

    probe: Probe
    arena: Arena
    limit: RateContract
    publisher: Callable[[], Endpoint | None]
    until: Callable[[Callable[[], bool], float], bool]
    """Waits for a condition, as long as every process lives."""
    until_heard: Callable[[], bool]
    """Waits for the first message, as long as that is not in vain."""
    turns: Turns = field(default_factory=Turns)
    _began: list[dict[str, int]] = field(default_factory=list)
    _devices_began: dict[str, int] = field(default_factory=dict)
    _judged: int = -1
    _sure: bool = False

    def watch(self) -> None:
        """Watch, and write down what speaks against believing it."""
        seen = self.probe.seen
        with singing(self.limit.hz, self.arena.domain_id):
            self.probe.listen_to_canary(self.limit.hz)
            with self.turns.busy():
                self.until_heard()  # meanwhile the canary starts; beside silence nobody needs it
                if self._count():
                    self.until(self._canary_sings, CANARY_WITHIN_S)
            if self._count():
                with self.turns.timed():
                    self._watch_rate()
        if self.arena.all_alive() or self._canary_sings():
            rate_trouble = trouble(seen, self._rate(), self.limit) if self._count() else None
            seen.machine_fault = self._unheard() or rate_trouble

    def _unheard(self) -> str | None:
        """Silence is the node's own only where it would have been heard."""
        topic, waited_s = self._topic(), self.arena.waited_s()
        if not self._count() and waited_s > LONGEST_WAIT_S:
            return f"your node waited {waited_s:.0f} s for a free processor, so it is not judged"
        silent = topic and not self._count() and self.arena.all_alive()
        if not silent or self.probe.connected(topic):
            return None
        return (
            f"your publisher on {topic} is there, but in {FIRST_MESSAGE_WITHIN_S:g} s no"
            " connection to it came up"
        )

    def _watch_rate(self) -> None:
        self._began = [process.waits_ns() for process in self.arena.processes]
        self._devices_began = self.arena.devices_waits_ns()
        period_s = 1 / self.limit.hz
        self.until(lambda: False, SHORTEST_PERIODS * period_s)
        self.until(self._is_sure, (LONGEST_PERIODS - SHORTEST_PERIODS) * period_s)
        if not self._sure and self.arena.all_alive():
            self.probe.note_longest_watch(self._topic())
        self._note_waits()
        self.probe.seen.rate_until_ns = time.monotonic_ns()

    def _is_sure(self) -> bool:
        """Asked at every look; the sum is done when a message came."""
        if self._judged != (count := self._count()):
            self._judged = count
            self._note_waits()
            rate = self._rate()
            limits_hz = (self.limit.low_hz, self.limit.high_hz)
            self._sure = rate is not None and rate.settled(limits_hz)
        return self._sure

    def _note_waits(self) -> None:
        """How long each process waited for a processor since the watch began."""
        for process, before_ns in zip(self.arena.processes, self._began, strict=True):
            if now_ns := process.waits_ns():
                process.seen.cpu_wait_s = longest_wait_s(before_ns, now_ns)
        if now_ns := self.arena.devices_waits_ns():
            self.probe.seen.devices_wait_s = longest_wait_s(self._devices_began, now_ns)

    def _rate(self) -> Rate | None:
        return own_rate(measure_rate(self.probe.messages(self._topic())), self.probe.seen)

    def _topic(self) -> str:
        publisher = self.publisher()
        return publisher.topic if publisher else ""

    def _count(self) -> int:
        return self.probe.count(self._topic())

    def _canary_sings(self) -> bool:
        heard = self.probe.seen.canary
        return heard is not None and len(heard.messages) > 0


def longest_wait_s(before_ns: dict[str, int], now_ns: dict[str, int]) -> float:
    """Of all threads, the longest time that one was ready and no processor was free."""
    return max(now_ns[thread] - before_ns.get(thread, 0) for thread in now_ns) / NS_PER_S


def trouble(seen: ExperimentSeen, rate: Rate | None, limit: RateContract) -> str | None:
    """Why this computer, not the node, decides what was seen here; None where it does not."""
    if rate and rate.far_above(limit.high_hz):
        return None
    if seen.canary and not seen.canary.imitated and (missed := _missed(seen.canary, limit)):
        return missed
    limits_hz = (limit.low_hz, limit.high_hz)
    if seen.stall_s > LONGEST_STALL_S and not (rate and _within(rate, limits_hz)):
        return f"this computer stood still for {seen.stall_s:.1f} s while your nodes ran"
    if rate and rate.blurred(limits_hz):
        held = f"this computer held your node up for {rate.held_s:.1f} s"
        return f"{held}, so its own rate cannot be told"
    waited = f"your node was ready to run and waited {seen.cpu_wait_s:.1f} s for a free processor"
    if rate is None and seen.cpu_wait_s * limit.hz > 1:
        return f"{waited}, so its silence tells nothing"
    if rate and rate.made_uneven_by(wait_s := held_s(rate, seen)):
        held = f"this computer held your node up for {wait_s:.1f} s"
        return f"{held}, so nobody can tell whether its messages are even by themselves"
    return None


def _within(rate: Rate, limits_hz: tuple[float, float]) -> bool:
    return limits_hz[0] <= rate.hz <= limits_hz[1]


def _missed(canary: CanarySeen, limit: RateContract) -> str | None:
    rate = measure_rate([*canary.messages])  # it sings on meanwhile, heard by another thread
    if rate is None:
        return "a talker that is known to be good did not come up beside yours"
    off_hz = abs(rate.hz - canary.wanted_hz) - rate.uncertainty_hz
    if off_hz <= CANARY_MISSES * limit.within * limit.hz and rate.uneven_share() <= MOST_UNEVEN:
        return None
    return (
        f"a talker that is known to be good ran beside yours, and reached {rate.hz:.2f} Hz"
        f" of {canary.wanted_hz:g} Hz"
    )
