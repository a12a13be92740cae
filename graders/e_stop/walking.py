"""Lets things happen around a guard in an order, and watches it after each: a walk."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from itertools import groupby
from random import Random

from graders.e_stop.act import (
    HOLDS_S,
    SHOWS_WITHIN_S,
    STEADY_S,
    DrawnCommands,
    Roads,
    Watched,
    beside,
    button_plan,
    motors_plan,
    operator_plan,
    watching,
)
from graders.e_stop.contract import StopContract
from graders.e_stop.orders import DRIVING, STEPS, GuardModel, Happens
from graders.e_stop.record import EStopSeen, MoveSeen, WalkSeen
from graders.e_stop.steps import BEGUN, part_of, takes_s
from roslings.arena import Companion
from roslings.course import NodeContract
from roslings.experiment import Scene
from roslings.walks import drawn_walk, states_on

FIRST, SECOND = "button", "second_button"
BEGINS = {Happens.JOIN: FIRST, Happens.SECOND_JOINS: SECOND}
ENDS = {Happens.LEAVE: FIRST, Happens.SECOND_LEAVES: SECOND}
SAYS = {Happens.PRESS: True, Happens.RELEASE: False}


@dataclass
class Walk:
    """One guard, and those around it, while one thing after the other happens."""

    scene: Scene
    number: int
    roads: Roads
    stops: Mapping[str, StopContract]
    operator: Companion
    guard: Watched
    stack: ExitStack
    buttons: dict[str, Companion] = field(default_factory=dict)

    def begin(self) -> bool:
        """A button that is released, and commands: whether the guard drives."""
        self._join(FIRST)
        self.buttons[FIRST].tell(say={"data": False})
        return self.guard.drives(part_of(self.number, BEGUN), "when the stop is released")

    def follow(self, events: Sequence[Happens]) -> None:
        """All events, as long as the guard drives when it should."""
        seen = WalkSeen(events=[event.value for event in events])
        self.guard.seen.walks.append(seen)
        before = DRIVING
        for step, (event, state) in enumerate(zip(events, states_on(before, events), strict=True)):
            seen.taken = step + 1
            if not self._take(part_of(self.number, step + 1), event, before, state):
                return
            before = state

    def _take(self, part: str, event: Happens, before: GuardModel, state: GuardModel) -> bool:
        """Let it happen, and watch. Whether it makes sense to go on."""
        if event in BEGINS:
            self._join(BEGINS[event])
        late_s = takes_s(event, self.stops)
        if state.drives:
            self._happen(event, before)
            return self.guard.drives(part, event.value, SHOWS_WITHIN_S, late_s + STEADY_S)
        self.guard.stands(
            part,
            event.value,
            lambda: self._happen(event, before),
            late_s,
            holds_s=HOLDS_S + (0.0 if before.drives else self._settles_s(event)),
        )
        return True

    def _settles_s(self, event: Happens) -> float:
        """How long it takes until the guard may know of what does not change what it must do.

        A sign of life comes once in the lease.
        """
        lease_s = self.roads.alive.lease_s or 0.0
        return lease_s if event is Happens.THAW else takes_s(event, self.stops)

    def _happen(self, event: Happens, before: GuardModel) -> None:
        if event in BEGINS:
            self.buttons[BEGINS[event]].tell(say={"data": True})
        elif event in ENDS:
            self.buttons.pop(ENDS[event]).leave()
        elif event in SAYS:
            able = FIRST if before.there and not before.hangs else SECOND
            self.buttons[able].tell(say={"data": SAYS[event]})
        else:
            self._others[event]()

    @property
    def _others(self) -> dict[Happens, Callable[[], object]]:
        return {
            Happens.SILENCE: lambda: self.operator.tell(drive=None),
            Happens.COMMAND: self.guard.command_anew,
            Happens.FREEZE: lambda: self.buttons[FIRST].freeze(),
            Happens.THAW: lambda: self.buttons[FIRST].thaw(),
        }

    def _join(self, name: str) -> None:
        """A button's program that has said nothing yet."""
        button = self.stack.enter_context(beside(self.scene, name, button_plan(self.roads)))
        self.guard.hears(button)
        self.buttons[name] = button


@contextmanager
def walked(
    scene: Scene,
    node: NodeContract,
    roads: Roads,
    stops: Mapping[str, StopContract],
    number: int = 0,
) -> Iterator[Walk]:
    """A guard of its own that drives, for one walk.

    >>> with walked(scene, GUARD, ROADS, STOPS) as walk:
    ...     walk.follow(ALWAYS[0])
    """
    plans = operator_plan(roads), motors_plan(roads)
    with (
        beside(scene, "operator", *plans) as operator,
        scene.run(node),
        watching(scene, operator, operator, DrawnCommands(scene, roads.commands)) as guard,
        ExitStack() as stack,
    ):
        yield Walk(scene, number, roads, stops, operator, guard, stack)


def walk_along(
    scene: Scene,
    node: NodeContract,
    roads: Roads,
    stops: Mapping[str, StopContract],
    *walks: Sequence[Happens],
) -> None:
    """Each of these walks with a guard of its own, one after the other; kept thin."""
    for number, events in enumerate(walks):
        with walked(scene, node, roads, stops, number) as walk:
            if walk.begin():
                walk.follow(events)
    thin_out(scene.seen.recording(EStopSeen))


def with_drawn(known: Sequence[Happens], seed: int, count: int) -> list[list[Happens]]:
    """A walk that ends where it began, and so many that nobody knows before.

    The first of them goes on where `known` ends, with the same guard.
    """
    random = Random(seed)
    drawn = [drawn_walk(DRIVING, random, STEPS) for _ in range(count)]
    first, *others = drawn or [[]]
    return [[*known, *first], *others]


# --- kept thin ---------------------------------------------------------------------------------


def thin_out(seen: EStopSeen) -> None:
    """Of equal messages in a row, keep the first and the last of each step.

    What the motors were told when, and the longest pause between two commands of a step, can be
    told from that as before.
    """
    steps = seen.stretches
    begins, ends = [each.began_ns for each in steps], [each.until_ns for each in steps]

    def step_of(at_ns: int) -> tuple[int, int]:
        return sum(each < at_ns for each in begins), sum(each < at_ns for each in ends)

    def kind_of(move: MoveSeen) -> tuple[tuple[int, int], dict[str, float]]:
        return step_of(move.at_ns), move.fields

    runs = [list(run) for _, run in groupby(seen.moves, kind_of)]
    seen.moves = [move for run in runs for move in ([run[0], run[-1]] if len(run) > 1 else run)]
    pauses = (longest_pause([*step]) for _, step in groupby(seen.sent_ns, step_of))
    seen.sent_ns = [at_ns for pause in pauses for at_ns in pause]


def longest_pause(sent_ns: Sequence[int]) -> list[int]:
    """The two between which it lies; who is alone stays."""
    if len(sent_ns) < 2:
        return list(sent_ns)
    at = max(range(1, len(sent_ns)), key=lambda n: sent_ns[n] - sent_ns[n - 1])
    return [sent_ns[at - 1], sent_ns[at]]
