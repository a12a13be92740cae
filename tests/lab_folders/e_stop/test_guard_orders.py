"""A guard in any order of events: the model, mistakes that it tells from, and what is told."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graders.e_stop import faults
from graders.e_stop.contract import StopContract
from graders.e_stop.orders import ALWAYS, DRIVING, STEPS, GuardModel, Happens
from graders.e_stop.reasons import NotWatched
from graders.e_stop.record import DriveSeen, EStopSeen, MoveSeen, StopSeen, WalkSeen
from graders.e_stop.steps import part_of, takes_s
from graders.e_stop.walked import keep_all_reasons
from graders.e_stop.walking import longest_pause, thin_out, with_drawn
from roslings.course import TopicContract
from roslings.evidence import ExperimentSeen, HeldUpSeen
from roslings.judge import ExperimentView, Inconclusive
from roslings.walks import first_difference, states_on

S = 10**9
PERIOD_NS = S // 20
MOTORS = TopicContract(topic="/cmd_vel", type="geometry_msgs/msg/Twist")
STOPS = {
    word: StopContract(when=word, says=word, within_s=within_s)
    for word, within_s in {"pressed": 0.3, "silent": 0.8, "lost": 2.6}.items()
}
DEADLINE_S = 0.4


# --- mistakes that students make, as models ----------------------------------------------------


class LastReasonOnly(GuardModel):
    """One variable for all reasons: whatever ends lets the rover go."""

    def after(self, event: Happens) -> GuardModel:
        """A release, a command, or a button that is back ends everything."""
        ends = {Happens.RELEASE, Happens.COMMAND, Happens.THAW}
        now = super().after(event)
        return replace(now, pressed=False, silent=False, hangs=False) if event in ends else now


class ReleaseEndsSilence(GuardModel):
    """A release lets it drive on by a command that is long over."""

    def after(self, event: Happens) -> GuardModel:
        """Two variables are changed by one event."""
        now = super().after(event)
        return replace(now, silent=False) if event is Happens.RELEASE else now


class CommandEndsPress(GuardModel):
    """A command after a silence lets it drive, though the stop is pressed."""

    def after(self, event: Happens) -> GuardModel:
        """Only if commands had been away."""
        now = super().after(event)
        ends = event is Happens.COMMAND and self.silent
        return replace(now, pressed=False) if ends else now


class ForgetsThePress(GuardModel):
    """The button hangs and runs on: what it said before is forgotten."""

    def after(self, event: Happens) -> GuardModel:
        """As if it had been released."""
        now = super().after(event)
        return replace(now, pressed=False) if event is Happens.THAW else now


class ForgetsTheSilence(GuardModel):
    """The button is back, and the last command counts again."""

    def after(self, event: Happens) -> GuardModel:
        """As if a command had come."""
        now = super().after(event)
        return replace(now, silent=False) if event is Happens.THAW else now


class OneGoneIsAllGone(GuardModel):
    """One of two buttons ends, and none counts as alive."""

    def after(self, event: Happens) -> GuardModel:
        """The first one is not looked at."""
        now = super().after(event)
        return replace(now, there=False) if event is Happens.SECOND_LEAVES else now


MISTAKES = (
    LastReasonOnly,
    ReleaseEndsSilence,
    CommandEndsPress,
    ForgetsThePress,
    ForgetsTheSilence,
    OneGoneIsAllGone,
)


def mistaken(kind: type[GuardModel]) -> GuardModel:
    """One that drives, as the right one does at the beginning."""
    return kind(**vars(DRIVING))


@pytest.mark.parametrize("kind", MISTAKES)
def test_each_mistake_shows_in_a_walk_that_each_check_makes(kind: type[GuardModel]) -> None:
    """So its verdict does not hang on what is drawn."""
    shown = [first_difference(DRIVING, mistaken(kind), walk, lambda m: m.drives) for walk in ALWAYS]
    assert any(shown)


@pytest.mark.parametrize("kind", MISTAKES)
def test_each_mistake_shows_in_some_walk_that_is_drawn(kind: type[GuardModel]) -> None:
    """A hundred of them are more than enough."""
    shown = [
        first_difference(DRIVING, mistaken(kind), walk, lambda m: m.drives)
        for walk in with_drawn([], 1, 100)
    ]
    assert any(shown)


@pytest.mark.parametrize("walk", ALWAYS)
def test_the_walks_of_each_check_are_possible_and_short(walk: tuple[Happens, ...]) -> None:
    """And at some step the rover drives again: a guard that always stands is found."""
    assert len(walk) <= STEPS
    drives = [state.drives for state in states_on(DRIVING, walk)]
    assert not all(drives)
    assert any(drives)


def test_each_event_has_its_words() -> None:
    """And nothing has words that never happens."""
    assert {event.value for event in Happens} == set(faults.HAPPENINGS)


def test_two_reasons_hold_at_once_and_either_ends_first() -> None:
    """Each pair of the three reasons, in the walks of each check."""
    ended = set[tuple[str, str]]()
    for walk in ALWAYS:
        for before, now in pairwise([DRIVING, *states_on(DRIVING, walk)]):
            gone, left = reasons(before) - reasons(now), reasons(now)
            ended |= {(one, other) for one in gone for other in left}
    assert {("pressed", "silent"), ("silent", "pressed")} <= ended
    assert {("lost", "pressed"), ("lost", "silent")} <= ended


def reasons(model: GuardModel) -> set[str]:
    """Those that hold."""
    return {word for word in STOPS if getattr(model, word)}


def test_what_is_drawn_goes_on_where_a_known_walk_ends() -> None:
    """With one guard; others have their own. Where none is drawn, the known one is left."""
    known = ALWAYS[0]
    assert [*states_on(DRIVING, known)][-1] == DRIVING
    first, second = with_drawn(known, 7, 2)
    assert (tuple(first[: len(known)]), len(first)) == (known, len(known) + STEPS)
    assert len(second) == STEPS
    for walk in (first, second):
        assert [*states_on(DRIVING, walk)]
    assert with_drawn(known, 7, 0) == [[*known]]


# --- what a guard would have done --------------------------------------------------------------


def played(events: list[Happens], guard: GuardModel, late_s: float = 0.1) -> EStopSeen:
    """What is seen of a guard that does as its model says, `late_s` after each event."""
    seen = EStopSeen(walks=[WalkSeen(events=[each.value for each in events], taken=len(events))])
    now_ns, command = S, {"linear.x": 0.5}
    _play(seen, 0, now_ns, (guard.drives, guard.drives), True, command, 1.0, late_s)
    now_ns += S
    for step, (event, right) in enumerate(
        zip(events, states_on(DRIVING, events), strict=True), start=1
    ):
        before, guard = guard, guard.after(event)
        lasts_s = takes_s(event, STOPS) + 3.0
        drives = (before.drives, guard.drives)
        _play(seen, step, now_ns, drives, right.drives, command, lasts_s, late_s)
        now_ns += round(lasts_s * S)
    return seen


def _play(
    seen: EStopSeen,
    step: int,
    began_ns: int,
    drives: tuple[bool, bool],
    must_drive: bool,
    command: dict[str, float],
    lasts_s: float,
    late_s: float,
) -> None:
    until_ns = began_ns + round(lasts_s * S)
    times = {"part": part_of(0, step), "began_ns": began_ns, "until_ns": until_ns}
    if must_drive:
        seen.drives.append(DriveSeen(after="x", command=command, **times))
    else:
        seen.stops.append(StopSeen(reason="", cause="x", **times))
    for n in range(1, round(lasts_s * 20) + 1):
        at_ns = began_ns + n * PERIOD_NS
        moves = drives[at_ns - began_ns > late_s * S]
        seen.moves.append(MoveSeen(at_ns=at_ns, fields=command if moves else {}))
        seen.sent_ns.append(at_ns - 1000)


def judged(seen: EStopSeen, **fields: object) -> None:
    """Hold it against the card."""
    whole = ExperimentSeen(name="x", clock="wall", parts={"e_stop": seen}, **fields)
    keep_all_reasons(MOTORS, STOPS, DEADLINE_S)(ExperimentView(whole))


@settings(deadline=None)
@given(seed=st.integers(0, 2**32))
def test_a_guard_that_does_as_the_card_says_passes_in_each_order(seed: int) -> None:
    """Late by as much as the card allows to a press."""
    (events,) = with_drawn([], seed, 1)
    judged(played(events, DRIVING, late_s=0.0))


@settings(deadline=None)
@given(seed=st.integers(0, 2**32))
def test_thinned_out_it_is_judged_as_before(seed: int) -> None:
    """Right guards and mistaken ones; and most of it is gone."""
    random = Random(seed)
    (events,) = with_drawn([], seed, 1)
    seen = played(events, mistaken(random.choice([GuardModel, *MISTAKES])), late_s=0.0)
    whole, count = outcome(seen), len(seen.moves)
    thin_out(seen)
    assert outcome(seen) == whole
    assert len(seen.moves) <= 4 * (STEPS + 1) < count


def outcome(seen: EStopSeen) -> str:
    """Passed, or what is told."""
    try:
        judged(seen)
    except faults.WrongInThisOrder as fault:
        return f"{fault.expected}: {fault.measured}"
    return "passed"


def test_what_is_told_is_the_way_to_the_first_mistake() -> None:
    """The events until then, in their order, what the card says, and what came."""
    with pytest.raises(faults.WrongInThisOrder) as told:
        judged(played(list(ALWAYS[0]), mistaken(ReleaseEndsSilence)))
    assert told.value.expected == (
        "one after the other: a press, no more commands, a release. Then /cmd_vel says zero"
    )
    assert told.value.measured == "it says: linear.x: 0.5"


def test_who_stands_where_it_should_drive_is_told_so() -> None:
    """One of two buttons has gone."""
    with pytest.raises(faults.WrongInThisOrder) as told:
        judged(played(list(ALWAYS[2]), mistaken(OneGoneIsAllGone)))
    assert told.value.expected.endswith("ends. Then /cmd_vel says what the operator wants")
    assert told.value.measured == "it says: zero"


def test_a_busy_computer_is_not_held_against_the_guard() -> None:
    """Where it waited for a processor for as long as it was late."""
    seen = played(list(ALWAYS[0]), DRIVING, late_s=0.5)
    with pytest.raises(faults.WrongInThisOrder):
        judged(seen)
    held = {part_of(0, 1): HeldUpSeen(cpu_wait_s=0.4, stall_s=0.0)}
    with pytest.raises(Inconclusive):
        judged(seen, held_up=held)


def test_what_was_not_walked_is_not_judged() -> None:
    """No walk at all, or none that has begun."""
    for seen in (EStopSeen(), EStopSeen(walks=[WalkSeen(events=["press"])])):
        with pytest.raises(NotWatched):
            judged(seen)


def test_the_longest_pause_stays() -> None:
    """Between its two commands; who is alone stays, too."""
    assert longest_pause([1, 2, 9, 10]) == [2, 9]
    assert longest_pause([5]) == [5]
    assert longest_pause([]) == []
