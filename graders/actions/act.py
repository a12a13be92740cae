"""Experiments with a server of goals: give them, cancel them, and watch its robot."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field

from graders.actions.floor import STANDS_WITHIN_S, Robot
from graders.actions.record import stopped_after_s
from ros2_on_pip.near_names import nearest
from roslings.arena import Process
from roslings.capabilities.actions.act import await_action
from roslings.capabilities.actions.contract import RESTLESS, ActionContract
from roslings.capabilities.actions.goals import Goal, GoalGiver
from roslings.capabilities.actions.record import (
    HEARS,
    ActionEnd,
    ActionsSeen,
    GoalLimits,
    answer_to,
    cancelled_after_s,
)
from roslings.capabilities.robot.record import RobotSeen
from roslings.course import NodeContract
from roslings.experiment.on_the_wall import FIRST_MESSAGE_WITHIN_S
from roslings.experiment.own_time import OwnTime
from roslings.experiment.scene import Scene
from roslings.experiment.timing import accounting

ANSWER_WITHIN_S = 5.0
HEARS_WITHIN_S = 6.0
"""A node that answers no question for so long of its own time is blocked."""

ENDS_WITHIN_S = 45.0
"""A goal that is under way, and whose robot moves, may take so long."""

RESTS_S = 8.0
"""A robot that has not moved for so long will not get there."""

IDLE_S = 4.0
"""Nor will one that was told nothing at all for so long."""

STRAYS_S = 12.0
"""Nor will one that has not come nearer for so long: a slow one turns about in less."""

MOVED_M = 0.03
MOVED_RAD = 0.1
CANCELS_WITHIN_S = 5.0
"""No end for so long after a request to cancel is none; a late one is told as late."""

REFUSED_S = 0.5
"""A goal whose cancel was refused may still be about to end by itself; it is not awaited longer."""

CALM_S = 0.7
"""So long a robot is watched after it stands: it must not be told to drive on."""

RESTLESS_AFTER_S = 1.0
"""So soon it can be seen."""


@dataclass
class Director:
    """Gives goals to the action of one running node, as clients do, and watches its robot."""

    scene: Scene
    process: Process
    node: NodeContract
    action: ActionContract
    robot: Robot
    _silent: bool = field(default=False, init=False)
    _first_s: float = field(default=math.inf, init=False)
    """When the first goal was given."""

    def __post_init__(self) -> None:
        """Waits until the node's action is there, and the node has heard where the robot is.

        A goal that comes before is rightly refused: on a busy computer, it may.
        """
        self.scene.seen.recording(ActionsSeen).limits = GoalLimits(
            answer_within_s=ANSWER_WITHIN_S,
            hears_within_s=HEARS_WITHIN_S,
            idle_s=IDLE_S,
            cancels_within_s=CANCELS_WITHIN_S,
        )
        await_action(self.scene)
        if self._turned():
            self._await_news()
            self._turned()

    def _await_news(self) -> None:
        """Wait until the robot has told once more where it is.

        A node of several threads may answer while the thread that is to hear the robot still waits
        for a processor.
        """
        told = self.robot.told
        if told:
            self.scene.until(lambda: self.robot.told > told, FIRST_MESSAGE_WITHIN_S)

    @contextmanager
    def giving(self) -> Iterator[GoalGiver | None]:
        """A client that is matched with the server; None where there is none to give goals to.

        >>> with director.giving() as giver:
        ...     there = giver is not None
        """
        end = self._end()
        if end is None or self._silent:
            yield None
            return
        with GoalGiver(self.scene.probe, end.action, end.type) as giver:
            matched = self.scene.until(lambda: giver.ready, FIRST_MESSAGE_WITHIN_S)
            yield giver if matched else None

    def drive(self, part: str, goal: Mapping[str, float]) -> None:
        """Give a goal, wait for its end, and watch until the robot stands."""
        with self.giving() as giver:
            if given := self._give(giver, part, goal):
                self._look_whether_it_hears()
                self._await_end(given)
                self._watch_rest(given)

    def cancel(self, part: str, goal: Mapping[str, float], after_m: float) -> None:
        """Give a goal, cancel it when the robot has gone so far, and watch until it stands.

        The turn is waited for before the goal is given: who waits for it on the way arrives.
        """
        with self.giving() as giver, self.scene.timed():
            given = self._give(giver, part, goal)
            if given and self._look_whether_it_hears():
                on_its_way = self._await_way(given, after_m)
                with accounting(self.scene, part):
                    self._cancel(given)
                    self._watch_rest(given)
                self._note_lateness(given)
                self._silent = not (on_its_way and given.ended)

    def give_and_cancel(self, part: str, goal: Mapping[str, float]) -> None:
        """Give a goal, and see whether it is accepted; if it is, it is cancelled at once."""
        with self.giving() as giver:
            if given := self._give(giver, part, goal):
                self._cancel(given)

    def give_and_cancel_each(self, parts: Sequence[str], goal: Mapping[str, float]) -> None:
        """The same goal for each part, one after the other, until one of them does not end."""
        with self.giving() as giver:
            for part in parts:
                given = self._give(giver, part, goal)
                if given is None:
                    break
                self._cancel(given)
                self._silent = self._silent or not given.ended

    def disturb(
        self, part: str, goal: Mapping[str, float], other: Mapping[str, float], after_m: float
    ) -> None:
        """Give a goal, and another one on the way; watch what becomes of the first."""
        with self.giving() as giver:
            given = self._give(giver, part, goal)
            if given and self._look_whether_it_hears():
                on_its_way = self._await_way(given, after_m)
                second = self._give(giver, f"{part}: another", other)
                if on_its_way:
                    self._await_end(given)
                if second and not second.ended:
                    self._cancel(second)

    # --- the parts ------------------------------------------------------------------------

    def _give(self, giver: GoalGiver | None, part: str, goal: Mapping[str, float]) -> Goal | None:
        """The goal, where it was accepted."""
        if giver is None or self._silent:
            return None
        self._first_s = min(self._first_s, time.monotonic())
        given = giver.give(dict(goal), part)
        with accounting(self.scene, answer_to(part)):
            accepted = given.await_answer(ANSWER_WITHIN_S, lambda: self.process.alive)
        if given.seen.answered_ns is None:
            self._silent = True
            self._look_whether_it_hears()
        return given if accepted else None

    def _note_lateness(self, given: Goal) -> None:
        """A late end that this computer may have made late is no reason to judge."""
        limit_s, seen = self.action.cancels_within_s, self.scene.seen
        drive = seen.part(RobotSeen).drive
        took_s = [cancelled_after_s(given.seen), drive and stopped_after_s(given.seen, drive)]
        late_s = max([each - limit_s for each in took_s if each and limit_s], default=0.0)
        held_s = seen.stall_s + given.seen.cpu_wait_s
        if 0.0 < late_s <= held_s:
            seen.machine_fault = (
                f"a goal was cancelled {late_s:.2f} s late, and this computer held your node or the"
                f" check up for {held_s:.2f} s"
            )

    def _look_whether_it_hears(self) -> bool:
        """Does the node run its other callbacks meanwhile? Where it does not: nothing more."""
        near = nearest(self.node.node, self.scene.seen.graph.nodes)
        if near is None or not self.process.alive:
            return False
        stuck = self.scene.seen.stuck
        if near.found not in stuck and not self._turned() and self.process.alive:
            stuck.append(near.found)
        self._silent = self._silent or bool(stuck)
        return not stuck

    def _turned(self) -> bool:
        """Wait until the node has run the callbacks of all that came: it is complete, and spins.

        The graph shows an action server before its constructor has ended, and long before it has
        heard where the robot is.
        """
        near = nearest(self.node.node, self.scene.seen.graph.nodes)
        if near is None or not self.process.alive:
            return True
        with accounting(self.scene, HEARS):
            return self.scene.turned(near.found, HEARS_WITHIN_S)

    def _await_end(self, given: Goal) -> None:
        """Wait for the goal's end, as long as the robot moves and the node hears."""
        if self.scene.seen.stuck:
            return
        rest = Rest(self.robot, given.seen.goal, OwnTime(self.scene.arena))

        def over() -> bool:
            return given.ended or rest.is_over() or self._restless(given)

        with accounting(self.scene, given.seen.part):
            self.scene.until(over, ENDS_WITHIN_S)
        self._silent = not given.ended

    def _await_way(self, given: Goal, way_m: float) -> bool:
        """Wait until the robot has gone so far, or clearly does not go; whether it has."""
        begin = self.robot.pose
        rest = Rest(self.robot, given.seen.goal, OwnTime(self.scene.arena))

        def there() -> bool:
            return self.robot.distance_to(begin.x_m, begin.y_m) >= way_m

        def over() -> bool:
            return there() or given.ended or rest.is_over() or self._restless(given)

        self.scene.until(over, ENDS_WITHIN_S)
        return there()

    def _restless(self, given: Goal) -> bool:
        """Its loop has no pause: it takes all processors that it can get, and tells nothing new."""
        limit = self.action.feedback
        passed_s = time.monotonic() - self._first_s
        if limit is None or passed_s < RESTLESS_AFTER_S:
            return False
        told = self.scene.probe.count(given.seen.feedback_topic)
        return told > RESTLESS * limit.high_hz * passed_s

    def _cancel(self, given: Goal) -> None:
        """Ask for it, and wait for the goal's end; not for long where the node says no."""
        own = OwnTime(self.scene.arena)
        given.cancel()
        self.scene.until(lambda: given.ended or given.cancel_refused, CANCELS_WITHIN_S)
        if given.cancel_refused:
            self.scene.until(lambda: given.ended, REFUSED_S)
        given.seen.cpu_wait_s = own.waited_in_turn_s()

    def _watch_rest(self, given: Goal) -> None:
        """Watch until the robot stands, and a little longer."""
        self.scene.until(lambda: self.robot.stands, STANDS_WITHIN_S)
        calm_s = time.monotonic() + CALM_S
        self.scene.until(lambda: time.monotonic() > calm_s, 2 * CALM_S)
        given.seen.watched_until_ns = time.monotonic_ns()

    def _end(self) -> ActionEnd | None:
        """The action to use: the nearest by name among those of the right type."""
        ends = [e for e in self.scene.seen.part(ActionsSeen).ends if e.kind == "server"]
        right = [e for e in ends if e.type == self.action.type]
        near = nearest(self.action.action, (e.action for e in right))
        return next((e for e in right if near and e.action == near.found), None)


class Rest:
    """Tells that a robot will not get to a point: it stands, or has not come nearer, for long.

    >>> rest = Rest(robot, goal)
    """

    def __init__(self, robot: Robot, goal: Mapping[str, float], own: OwnTime | None = None) -> None:
        """`own` is the time of the node that is to command the robot, from now on."""
        self._robot, self._goal, self._own = robot, goal, own
        self._nearest_m = math.inf
        self._moved_s = self._nearer_s = time.monotonic()
        self._pose, self._told = robot.pose, len(robot.seen.commands)

    def is_over(self) -> bool:
        """It has been so for long enough.

        >>> scene.until(lambda: rest.is_over(), 20.0)
        """
        now_s = time.monotonic()
        if self._own and len(self._robot.seen.commands) == self._told:
            return self._own.is_past(IDLE_S)
        if self._moves():
            self._pose, self._moved_s = self._robot.pose, now_s
        distance_m = self._robot.distance_to(self._goal["x"], self._goal["y"])
        if distance_m < self._nearest_m - MOVED_M:
            self._nearest_m, self._nearer_s = distance_m, now_s
        return now_s - self._moved_s > RESTS_S or now_s - self._nearer_s > STRAYS_S

    def _moves(self) -> bool:
        pose = self._robot.pose
        turned_rad = abs(math.remainder(pose.heading_rad - self._pose.heading_rad, math.tau))
        went_m = self._robot.distance_to(self._pose.x_m, self._pose.y_m)
        return went_m > MOVED_M or turned_rad > MOVED_RAD
