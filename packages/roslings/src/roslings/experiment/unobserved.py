"""An experiment without a probe: nothing of ours joins the domain, so nobody can behave for it.

What the nodes did there is read from what the student's own listener writes. Where the kernel shows
them, the packets between the two are read as well. It is made only where the result is for others:
a student's own check needs no such proof.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from roslings.arena import LONGEST_WAIT_S, Arena, Process
from roslings.course import NodeContract, TopicContract
from roslings.evidence import ExperimentSeen
from roslings.experiment.on_the_wall import FIRST_MESSAGE_WITHIN_S, LONGEST_PERIODS
from roslings.experiment.packets import Tap
from roslings.experiment.start import PLAIN
from roslings.seen.log_rates import hz_of, is_often, written_ns

MOST_LINES = 10
"""After so many that are too slow their pace is known."""
INTERRUPT_SLACK_S = 1.0


class Unobserved:
    """Nodes that run among themselves."""

    def __init__(
        self, arena: Arena, seen: ExperimentSeen, ends_within_s: float, tap: Tap | None = None
    ) -> None:
        self.seen = seen
        self._arena, self._tap = arena, tap
        self._ends_within_s = ends_within_s

    @contextmanager
    def run(self, node: NodeContract, remaps: Sequence[str] = ()) -> Iterator[Process]:
        """Start a node; press Ctrl-C when the block ends.

        >>> with scene.run(TALKER), scene.run(LISTENER) as listener:
        ...     scene.read_along(listener, LISTENER, CHATTER)
        """
        with self._arena.run(node.executable, PLAIN.arguments(remaps)) as process:
            self.seen.processes[node.executable] = process.seen
            yield process
            process.interrupt(self._ends_within_s + INTERRUPT_SLACK_S)

    def read_along(self, process: Process, node: NodeContract, contract: TopicContract) -> None:
        """Wait until the listener `node` has written as often as the card's rate, or could have."""
        rate = contract.rate
        assert rate, f"the card gives {contract.topic} no rate"

        def told_ns() -> list[list[int]]:
            sent = [self._tap.sent_ns(contract.topic)] if self._tap else []
            return [written_ns(process.lines(), node), *sent]

        def enough(told: list[list[int]]) -> bool:
            return all(is_often(hz_of(each_ns), rate) for each_ns in told)

        def settled() -> bool:
            return enough(told_ns())

        def known() -> bool:
            told = told_ns()
            return enough(told) or any(len(each_ns) >= MOST_LINES for each_ns in told)

        within_s = FIRST_MESSAGE_WITHIN_S + LONGEST_PERIODS / rate.hz
        process.wait_until(known, within_s)
        waited_s = min(self._arena.waited_s(), LONGEST_WAIT_S)
        if not settled() and waited_s * rate.hz > 1 and not process.wait_until(settled, waited_s):
            self.seen.machine_fault = (
                f"your nodes were ready to run and waited {waited_s:.1f} s for a free processor"
            )
        if self._tap:
            self.seen.sent_ns[contract.topic] = self._tap.sent_ns(contract.topic)
            if (lost := self._tap.lost()) and not settled():
                self.seen.machine_fault = f"{lost} packets of your nodes could not be read in time"
