"""The demand on a guard that was led through an order of events: each step as the model has it."""

from __future__ import annotations

from collections.abc import Mapping

from graders.e_stop import faults
from graders.e_stop.contract import StopContract
from graders.e_stop.demands import fields_told, judge_drive, moves_between
from graders.e_stop.orders import DRIVING, GuardModel, Happens
from graders.e_stop.reasons import NotWatched
from graders.e_stop.record import DriveSeen, EStopSeen, StopSeen, WalkSeen
from graders.e_stop.steps import BEGUN, part_of, takes_s
from ros2_on_pip.rates import NS_PER_S
from roslings.course import TopicContract
from roslings.judge.demands import require_its_time, require_steady
from roslings.judge.faults.moments import Awaited
from roslings.judge.views import Demand, ExperimentView
from roslings.walks import states_on

NOT_AS_WANTED = (faults.StandsStill, faults.OtherCommand, faults.Stutters)


def keep_all_reasons(
    topic: TopicContract, stops: Mapping[str, StopContract], deadline_s: float
) -> Demand[ExperimentView]:
    """After each event of each walk the motors are told what the card says.

    >>> walking.must(keep_all_reasons(CMD_VEL, STOPS, DEADLINE_S))
    """

    def demand(experiment: ExperimentView) -> None:
        walks = experiment.seen.part(EStopSeen).walks
        if not walks:
            raise NotWatched("not_driven")
        for number, walk in enumerate(walks):
            _WalkJudge(experiment, topic.topic, stops, deadline_s, number).judge(walk)

    return demand


class _WalkJudge:
    """One walk, step by step."""

    def __init__(
        self,
        experiment: ExperimentView,
        topic: str,
        stops: Mapping[str, StopContract],
        deadline_s: float,
        number: int,
    ) -> None:
        self._experiment, self._topic, self._number = experiment, topic, number
        self._stops, self._deadline_s = stops, deadline_s
        self._steps = {each.part: each for each in experiment.seen.part(EStopSeen).stretches}

    def judge(self, walk: WalkSeen) -> None:
        events = [Happens(name) for name in walk.events[: walk.taken]]
        if part_of(self._number, BEGUN) not in self._steps:
            raise NotWatched("not_driven")
        for step, state in enumerate(states_on(DRIVING, events), 1):
            seen = self._steps.get(part_of(self._number, step))
            if seen is None:
                raise NotWatched("not_so_far")
            self._judge_step(seen, events[:step], state)

    def _judge_step(
        self, seen: DriveSeen | StopSeen, events: list[Happens], state: GuardModel
    ) -> None:
        told = tuple(faults.HAPPENINGS[event.value] for event in events)
        if isinstance(seen, StopSeen):
            self._stands(seen, told, takes_s(events[-1], self._stops))
            return
        try:
            judge_drive(self._experiment, self._topic, seen, self._deadline_s)
        except NOT_AS_WANTED:
            moves = moves_between(self._experiment, seen.began_ns, seen.until_ns)
            other = next((each for each in reversed(moves) if each.fields != seen.command), None)
            found = fields_told(other.fields if other else {})
            raise faults.WrongInThisOrder(self._topic, told, True, found) from None

    def _stands(self, seen: StopSeen, told: tuple[faults.Happening, ...], within_s: float) -> None:
        moves = moves_between(self._experiment, seen.began_ns, seen.until_ns)
        if not moves:
            require_steady(self._experiment.seen.stall_s)
            raise faults.TellsTheMotorsNothing(
                self._topic, faults.After(faults.in_words(seen.cause))
            )
        driven = [move for move in moves if move.fields]
        last_ns = driven[-1].at_ns if driven else seen.began_ns
        late_s = (last_ns - seen.began_ns) / NS_PER_S - within_s
        if driven and late_s > 0:
            require_its_time(self._experiment.seen, seen.part, late_s, Awaited("stop"))
            found = fields_told(driven[-1].fields)
            raise faults.WrongInThisOrder(self._topic, told, False, found)
