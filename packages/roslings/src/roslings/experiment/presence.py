"""When it is in vain to wait longer for what a node does not have.

A node that has answered is complete: its constructor is over, and its executor runs. What it has
not got then, only a timer or a thread of it can still make. That is waited for, and no more; what
was waited for once is not waited for again, neither here nor in another experiment.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from roslings.arena import Arena
from roslings.evidence import GraphSeen
from roslings.experiment.own_time import OwnTime
from roslings.probe import Probe
from roslings.probe.clock import Barrier

GRACE_S = 1.5
"""Of a complete node's own time: a timer of a second may still make something."""

LOST_FOR_S = 4.0
"""What was announced, and lost because nobody had a processor to take it, is announced again after
seconds: the middleware's heartbeat period is 3 s."""

LOSES = 8.0
"""So often the time that a node waited for a processor is waited for what may be lost."""

SIMULATED_GRACE_S = 0.3
"""Where the clock stands still, no timer makes anything."""

TURNS_WITHIN_S = 10.0
"""A node that answers nothing for so long of its own time is not waited for either."""


class Absences:
    """What the nodes of a package were found not to have: one for all experiments of a grading.

    What came in one experiment is not absent, whatever another one has found: on a busy computer a
    node may be given up too early.
    """

    def __init__(self) -> None:
        self._known = set[tuple[frozenset[str], str]]()
        self._came = set[tuple[frozenset[str], str]]()

    def add(self, executables: Iterable[str], what: str) -> None:
        """Nobody needs to wait for this again."""
        self._known.add((frozenset(executables), what))

    def came(self, executables: Iterable[str], what: str) -> None:
        """It was there."""
        self._came.add((frozenset(executables), what))

    def forget(self, executables: Iterable[str]) -> None:
        """What these were found not to have tells nothing: this computer was too busy to see it."""
        them = frozenset(executables)
        self._known = {each for each in self._known if not each[0] <= them}

    def holds(self, executables: Iterable[str], what: str) -> bool:
        """Some experiment has waited for this, as long as is worth it, and none has seen it."""
        return (frozenset(executables), what) in self._known - self._came


class CallbackTurn:
    """Whether a node has run the callbacks of all that came before; asked, never waited for."""

    def __init__(self, probe: Probe, node: str) -> None:
        self._barrier = Barrier(probe.node, [node])
        self._sent = self._over = False

    def is_over(self) -> bool:
        """It has answered; the question is sent as soon as it can be."""
        if not self._sent and self._barrier.ready:
            self._sent = True
            self._barrier.send()
        if self._sent and not self._over and self._barrier.is_passed:
            self._over = True
            self._barrier.close()
        return self._over


@dataclass
class Presence:
    """Looks at the nodes of one experiment: are they complete, and for how long?"""

    probe: Probe
    arena: Arena
    absences: Absences
    simulated: bool = False
    _turns: dict[str, CallbackTurn] = field(default_factory=dict)
    _size: tuple[int, int, int] = (-1, 0, 0)
    _complete: bool = False
    _since: OwnTime = field(init=False)

    def in_vain(self, what: str, grace_s: float = GRACE_S) -> bool:
        """Asked again and again while something is waited for: is it in vain?"""
        complete = self._look()
        if not complete:
            return self._since.is_past(TURNS_WITHIN_S)
        if self.simulated:
            return self._since.is_past(SIMULATED_GRACE_S)
        return self.is_known(what) or self._is_over(grace_s)

    def _is_over(self, grace_s: float) -> bool:
        """The grace, and what may be lost: nearly nothing on a free computer.

        The kernel is not asked before the grace alone is over: this is called at every look.
        """
        since = self._since
        return since.is_past(grace_s) and since.is_past(
            grace_s + min(LOST_FOR_S, LOSES * since.waited_s())
        )

    def is_known(self, what: str) -> bool:
        """It was waited for, here or in another experiment."""
        return self.absences.holds(self._executables, what)

    def note(self, what: str, came: bool) -> None:
        """It was waited for; whether it came. Of what did not, a stopped clock tells nothing."""
        if came:
            self.absences.came(self._executables, what)
        elif not self.simulated and self.arena.all_alive():
            self.absences.add(self._executables, what)

    def note_for_good(self, what: str) -> None:
        """It did not come, and simulated time did go by: that clock does tell something."""
        if self.arena.all_alive():
            self.absences.add(self._executables, what)

    @property
    def _executables(self) -> list[str]:
        return [process.seen.executable for process in self.arena.processes]

    def _look(self) -> bool:
        """Whether all nodes are complete; time begins again when one becomes so, or when one grows.

        A program that shows no node has had its time already.
        """
        graph = self.probe.seen.graph
        size, complete = _size_of(graph), self._all_turned(graph.nodes)
        if (size, complete) != (self._size, self._complete):
            self._size, self._complete, self._since = size, complete, OwnTime(self.arena)
        return complete

    def _all_turned(self, nodes: Sequence[str]) -> bool:
        return all([self._turn_of(node).is_over() for node in nodes])

    def _turn_of(self, node: str) -> CallbackTurn:
        if node not in self._turns:
            self._turns[node] = CallbackTurn(self.probe, node)
        return self._turns[node]


def _size_of(graph: GraphSeen) -> tuple[int, int, int]:
    return len(graph.nodes), len(graph.endpoints), len(graph.services)
