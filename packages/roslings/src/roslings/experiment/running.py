"""An experiment runs nodes: they start, come up, rest and end."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager, ExitStack, contextmanager
from dataclasses import dataclass

from roslings.arena import LONGEST_WAIT_S, Process
from roslings.course import NodeContract
from roslings.experiment.own_time import OwnTime
from roslings.experiment.stage import Stage
from roslings.experiment.start import PLAIN, Start

COMES_UP_WITHIN_S = 20.0
INTERRUPT_SLACK_S = 1.0
SPINS_WITHIN_S = 3.0
RESTS_WITHIN_S = 1.0
LOOKS_AT_REST = 3
LOOK_AGAIN_S = 0.005


@dataclass(frozen=True)
class Run:
    """A node that is to run, and how it is started."""

    node: NodeContract
    remaps: Sequence[str] = ()
    start: Start = PLAIN


class Running(Stage):
    """Runs nodes while a block lasts."""

    @contextmanager
    def run(
        self, node: NodeContract, remaps: Sequence[str] = (), start: Start = PLAIN
    ) -> Iterator[Process]:
        """Start a node, wait until it is in the graph; press Ctrl-C when the block ends."""
        with self.run_all(Run(node, remaps, start)) as (process,):
            yield process

    @contextmanager
    def run_all(self, *runs: Run) -> Iterator[list[Process]]:
        """Start several nodes at once, as `run` does one; press Ctrl-C in all when the block ends.

        >>> with scene.run_all(Run(TALKER), Run(LISTENER)):
        ...     scene.joined(CHATTER)
        """
        known = self._present()
        with ExitStack() as running:
            with self._turns.busy(), self._noted("starting"):
                processes = [running.enter_context(self._started(each)) for each in runs]
                self._wait_up(processes, known)
            up_s = time.monotonic()
            since_up = OwnTime(self._arena) if self.outlives_s else None
            yield processes
            self._outlive(since_up)
            own = self._present() - known
            with self._noted("ending"):
                self._let_begin(processes, own, up_s)
                self._probe.look_now()  # the graph has all of them now
                for process in processes:
                    self._let_rest(process)
                self._end(processes)
        self._over += own

    @contextmanager
    def _started(self, run: Run) -> Iterator[Process]:
        words = run.start.arguments(run.remaps, simulated=self._simulated)
        with self._arena.run(run.node.executable, words) as process:
            process.seen.given = [*run.start.parameters]
            self.seen.processes[run.start.label(run.node)] = process.seen
            yield process

    def _present(self) -> Counter[str]:
        """The nodes that are there, as far as they are known."""
        return Counter(self.seen.graph.nodes) - self._over

    def _wait_up(self, processes: Sequence[Process], known: Counter[str]) -> None:
        """Until there is a node for each process that lives."""

        def up() -> bool:
            living = sum(process.alive for process in processes)
            return (self._present() - known).total() >= living

        self._probe.until(up, COMES_UP_WITHIN_S)

    def _outlive(self, since_up: OwnTime | None) -> None:
        """Let them run for as long, of their own time, as one that ended in another run."""
        if since_up:
            within_s = self.outlives_s + LONGEST_WAIT_S
            self._until_alive(lambda: since_up.is_past(self.outlives_s), within_s)

    @contextmanager
    def starting(self) -> Iterator[None]:
        """A stretch in which nodes start by another way than `run`: a launch file, say.

        >>> with scene.starting():
        ...     scene.until(lambda: process.alive, 5.0)
        """
        with self._turns.busy(), self._noted("starting"):
            yield

    def ending(self) -> AbstractContextManager[None]:
        """A stretch in which what was started so is asked to end, and waited for.

        >>> with scene.ending():
        ...     process.interrupt(scene.ends_within_s)
        """
        return self._noted("ending")

    def _let_begin(self, processes: Sequence[Process], nodes: Counter[str], up_s: float) -> None:
        """Wait until its nodes spin, as far as they ever do: no node ends well while it is made.

        A node is in the graph before its constructor has ended.
        """
        for node in nodes:
            left_s = up_s + SPINS_WITHIN_S - time.monotonic()
            if left_s > 0 and all(process.alive for process in processes):
                self._probe.turned(node, left_s)

    def _let_rest(self, process: Process) -> None:
        """Wait until it waits, as a node mostly does when somebody presses Ctrl-C.

        In the middle of a callback Python can hear Ctrl-C before rclpy does. Then a second
        shutdown() is the first, and one mistake in fifty is not seen on a busy computer.
        """
        end_s, looks = time.monotonic() + RESTS_WITHIN_S, 0
        while looks < LOOKS_AT_REST and process.alive and time.monotonic() < end_s:
            looks = looks + 1 if process.asleep() else 0
            process.wait_ended(LOOK_AGAIN_S)

    def _end(self, processes: Sequence[Process]) -> None:
        within_s = self.ends_within_s + INTERRUPT_SLACK_S
        with ThreadPoolExecutor(len(processes)) as fingers:
            list(fingers.map(lambda process: process.interrupt(within_s), processes))
