"""Who no longer says what a part says again and again: a program that hangs looks alive."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from roslings_my_rover.wiring import Steady

FIRST_WITHIN_S = 30.0
"""On a busy computer a program takes so long until its first message."""
AGAIN_WITHIN_S = 8.0
"""The slowest of them says something once a second; without a processor it waits for one."""
LOOKS_WITHIN_S = 1.0
"""Who looks later than this has not listened meanwhile, and blames nobody for it."""


@dataclass(frozen=True)
class Silent:
    """A program that is there, and says nothing."""

    program: str
    topic: str
    spoke: bool
    """Whether it ever did."""

    @property
    def line(self) -> str:
        """What the map says of it, at most 80 columns."""
        ever = "any more" if self.spoke else "yet"
        return f"{self.program} hangs? It says nothing on {self.topic} {ever}."


@dataclass
class Silence:
    """When each program was heard."""

    clock: Callable[[], float]
    """Seconds that only grow."""
    _steady: tuple[Steady, ...] = ()
    _late_s: dict[str, float] = field(default_factory=dict)
    """By topic: when its next message is late."""
    _spoke: set[str] = field(default_factory=set)
    _looked_s: float = 0.0

    def expect(self, steady: Sequence[Steady]) -> None:
        """Listen for these from now on; each may just have been started."""
        self._steady, self._spoke = tuple(steady), set()
        self._looked_s = self.clock()
        self._late_s = {each.topic: self._looked_s + FIRST_WITHIN_S for each in steady}

    def hear(self, topic: str) -> None:
        """Something came there."""
        self._spoke.add(topic)
        self._late_s[topic] = self.clock() + AGAIN_WITHIN_S

    def look(self, plugged: bool = True) -> tuple[Silent, ...]:
        """Who is silent now; what the board says is not missed while its cable is pulled."""
        now_s = self.clock()
        asleep_s = now_s - self._looked_s
        self._looked_s = now_s
        for each in self._steady:
            if asleep_s > LOOKS_WITHIN_S:
                self._late_s[each.topic] += asleep_s
            if each.by_cable and not plugged:
                self._late_s[each.topic] = now_s + AGAIN_WITHIN_S
        return tuple(
            Silent(each.program, each.topic, each.topic in self._spoke)
            for each in self._steady
            if now_s > self._late_s[each.topic]
        )
