"""What an experiment stands on: an arena, a probe, and how things are waited for."""

from __future__ import annotations

import random
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path

from roslings.arena import LONGEST_WAIT_S, Arena, Process
from roslings.evidence import ExperimentSeen, GradingSpan, Part
from roslings.experiment.own_time import PATIENCE_S, OwnTime
from roslings.experiment.presence import GRACE_S, Absences, CallbackTurn, Presence
from roslings.experiment.turns import Turns
from roslings.probe import Probe
from roslings.seen.timeline import noted

BELIEVES_AFTER_S = 3.0
"""Of a node's own time: then what another experiment has missed is not waited for here either."""


class Stage:
    """An arena where nodes run, a probe that watches them, and how things are waited for."""

    def __init__(
        self,
        arena: Arena,
        probe: Probe,
        seed: int,
        ends_within_s: float,
        port: Path | None = None,
        turns: Turns | None = None,
        timeline: list[GradingSpan] | None = None,
        absences: Absences | None = None,
    ) -> None:
        """The clock is the one that `probe.seen` names; `port` leads to a real board.

        `turns` are those that it takes with the experiments beside it. `absences` are what one of
        them has waited for in vain. What it does is noted in `timeline`.
        """
        self.port = port
        self._turns = turns or Turns()
        self._timeline = [] if timeline is None else timeline
        self._over: Counter[str] = Counter()
        """Nodes of blocks that are over: the fullest graph is kept, and they are still in it."""
        self._simulated = probe.seen.clock == "sim"
        self._presence = Presence(probe, arena, absences or Absences(), self._simulated)
        self._arena = arena
        self._probe = probe
        self.seed = seed
        """Of all that nobody can know before."""
        self.ends_within_s = ends_within_s
        """After Ctrl-C."""
        self.outlives_s = 0.0
        """Nodes run for at least so long: so long one ran that ended by itself in another run."""
        self._random = random.Random(seed)
        arena.on_change = probe.notify
        probe.seen.patience_s = PATIENCE_S

    @property
    def seen(self) -> ExperimentSeen:
        """What was seen so far."""
        return self._probe.seen

    @property
    def arena(self) -> Arena:
        """Where the processes run, for those that are no executable of the package."""
        return self._arena

    @property
    def probe(self) -> Probe:
        """The node that watches and speaks, for what this class has no word for."""
        return self._probe

    def busy(self) -> AbstractContextManager[None]:
        """A stretch in which something of ours takes a processor: no times are judged meanwhile.

        >>> with scene.busy():
        ...     picture = draw_a_large_picture()
        """
        return self._turns.busy()

    def timed(self) -> AbstractContextManager[None]:
        """A stretch in which times are judged: no node of another experiment starts meanwhile.

        >>> with scene.timed():
        ...     asker.ask_in_a_row(SET_MAX_SPEED, SET_MAX_SPEED.answers, 100)
        """
        return self._turns.timed()

    def _noted(self, part: Part) -> AbstractContextManager[None]:
        return noted(self._timeline, part, self.seen.name)

    def until(self, condition: Callable[[], bool], within_s: float) -> bool:
        """Wait for the condition, as long as every process lives. Whether it holds.

        >>> scene.until(lambda: scene.heard(CHATTER) >= 10, 8.0)
        """
        with self._timed_watching():
            return self._until_alive(condition, within_s)

    def turned(self, node: str, within_s: float) -> bool:
        """Wait until a node has run the callbacks of all that came; `within_s` of its own time."""
        turn = CallbackTurn(self._probe, node)
        return self.until_own(turn.is_over, within_s)

    def until_own(self, condition: Callable[[], bool], within_s: float) -> bool:
        """As `until`; what the processes wait for a processor comes on top, to a bound.

        >>> scene.until_own(lambda: not process.alive, 3.0)
        """
        own = OwnTime(self._arena)
        self.until(lambda: condition() or own.is_past(within_s), within_s + LONGEST_WAIT_S)
        return condition()

    def until_back(self, condition: Callable[[], bool], what: str, within_s: float) -> bool:
        """As `until_own`, for what was away: not for long where others have missed `what`, too.

        For a while even then: on a busy computer another experiment may have given up too early.

        >>> scene.until_back(lambda: scene.heard(IMAGE) > before, says(IMAGE), 10.0)
        """
        own = OwnTime(self._arena)

        def given_up() -> bool:
            return self.is_missed(what) and own.is_past(BELIEVES_AFTER_S)

        self.until_own(lambda: condition() or given_up(), within_s)
        return condition()

    def _until_alive(self, condition: Callable[[], bool], within_s: float) -> bool:
        """Wait for the condition, as long as every process lives."""
        self._probe.until(lambda: condition() or not self._arena.all_alive(), within_s)
        return condition()

    def appears(self, condition: Callable[[], bool], what: str, grace_s: float = GRACE_S) -> bool:
        """Wait for what a node makes when it begins; whether it is there.

        When all nodes are complete, it is waited for during `grace_s` of their own time, and in no
        later experiment: `what` is its name.

        >>> scene.appears(lambda: len(scene.seen.graph.nodes) == 2, "both nodes")
        """
        with self._timed_watching():
            return self._until_there(condition, what, grace_s)

    def is_missed(self, what: str) -> bool:
        """Some experiment of this grading has waited for it in vain.

        >>> scene.is_missed(publishes(CHATTER))
        """
        return self._presence.is_known(what)

    def _until_there(
        self, condition: Callable[[], bool], what: str, grace_s: float = GRACE_S
    ) -> bool:
        """Wait for the condition, as long as every process lives and it is not in vain."""
        self._until_alive(
            lambda: condition() or self._presence.in_vain(what, grace_s), LONGEST_WAIT_S * 2
        )
        there = condition()
        self._presence.note(what, there)
        return there

    def is_written(self, process: Process, text: str) -> bool:
        """The text stands in the terminal or in /rosout.

        >>> scene.until(lambda: scene.is_written(process, "ready"), 5.0)
        """
        lines = [*process.lines(), *(line for log in self.seen.rosout.values() for line in log)]
        return any(text in line.text for line in lines)

    @contextmanager
    def _timed_watching(self) -> Iterator[None]:
        began_s = time.monotonic()
        with self._noted("watching"):
            yield
        self.seen.watching_s += time.monotonic() - began_s
