"""The soak: all nodes of a lab run among themselves in real time, as long as the card promises.

It goes on beside the experiments, and nothing of ours joins its domain: what it costs is what the
nodes cost. A node that dies after 20 s is found by nothing else.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from time import monotonic

from roslings.arena import Arena, ArenaPlace, Installed, Process, opened
from roslings.capability import Plain, capabilities
from roslings.course import Card, NodeContract
from roslings.evidence import SoakSeen
from roslings.experiment.start import PLAIN, Start
from roslings.experiment.turns import Turns

SOAKING = "Your nodes run on for a while, to see that they stay"
"""The step that the command is told when nothing but the soak goes on."""
LOOK_EVERY_S = 0.5
LOOKS_AT_REST, LOOK_AGAIN_S, RESTS_WITHIN_S = 3, 0.1, 5.0
KEPT_LINES = 40


@dataclass(frozen=True)
class Soak:
    """What is left to run, where, and how long."""

    card: Card
    installed: Installed
    place: ArenaPlace
    turns: Turns
    for_s: float
    over: threading.Event = field(default_factory=threading.Event)

    def run(self) -> SoakSeen:
        """Start all nodes that stay, let them run, and press Ctrl-C."""
        seen = SoakSeen(for_s=self.for_s)
        with opened(self.installed, self.place) as arena, ExitStack() as running:
            staying = [node for node in self.card.nodes if node.stays]
            starts = [beside(node, self.card, arena, running) for node in staying]
            with self.turns.busy():
                processes = [
                    running.enter_context(arena.run(node.executable, start.arguments()))
                    for node, start in zip(staying, starts, strict=True)
                ]
                for process in processes:
                    self._let_rest(process)
            self._wait(processes)
        for process in processes:
            process.seen.lines = process.seen.lines[-KEPT_LINES:]
            seen.processes[process.seen.executable] = process.seen
        return seen

    def _let_rest(self, process: Process) -> None:
        """Until its start is over, as far as it ever is: that takes a processor."""
        end_s, looks = monotonic() + RESTS_WITHIN_S, 0
        while looks < LOOKS_AT_REST and process.alive and monotonic() < end_s:
            looks = looks + 1 if process.asleep() else 0
            process.wait_ended(LOOK_AGAIN_S)

    def _wait(self, processes: list[Process]) -> None:
        """Until the time is over, or nobody runs any more."""
        end_s = monotonic() + self.for_s
        while any(process.alive for process in processes) and monotonic() < end_s:
            if self.over.wait(min(LOOK_EVERY_S, max(0.0, end_s - monotonic()))):
                return


@contextmanager
def soaking(soak: Soak | None) -> Iterator[Future[SoakSeen] | None]:
    """A soak in a thread of its own while the block runs; called off where the block fails."""
    if soak is None:
        yield None
        return
    pool = ThreadPoolExecutor(1, thread_name_prefix="soak")
    try:
        yield pool.submit(soak.run)
    except BaseException:
        soak.over.set()
        raise
    finally:
        pool.shutdown(wait=True)


def beside(node: NodeContract, card: Card, arena: Arena, running: ExitStack) -> Start:
    """How a node is started: with the devices that it needs, which end when `running` does."""
    parameters: dict[str, Plain] = {}
    for each in capabilities():
        parameters |= each.companions_of(node, card, arena, running)
    return Start(parameters=parameters) if parameters else PLAIN
