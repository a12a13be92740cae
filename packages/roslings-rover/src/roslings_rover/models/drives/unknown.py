"""Drives that nobody can know before: healthy ones, with gaps, and more topics than the rover's."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from roslings_rover.models.differential_drive import Motion, Pose
from roslings_rover.models.drives.chance import Chance
from roslings_rover.models.drives.recording import (
    NS,
    DrivePlan,
    Piece,
    RecordedMessage,
    TopicPlan,
    recorded,
    ways,
)
from roslings_rover.models.drives.sheet import BATTERY, IMU, LIGHT, ODOM, RANGE, SHEET, TopicSheet
from roslings_rover.models.drives.sick_rover import START_S

EDGE = 0.5
"""So far from the limit, in usual periods, lie a pause that is no gap and a gap."""
RATES_HZ = (4.0, 5.0, 8.0, 10.0, 12.5, 16.0, 20.0, 25.0, 30.0, 40.0, 50.0)
STRANGE_TYPE = "warehouse_lift/msg/Lift"
"""A type that no computer has."""


@dataclass(frozen=True)
class Held:
    """A topic of a bag."""

    name: str
    type: str
    reliable: bool = True
    kept: bool = False
    """Its last message is kept for who comes late (transient local)."""


@dataclass(frozen=True)
class RecordedDrive:
    """All that is written into a bag."""

    topics: tuple[Held, ...]
    said: tuple[RecordedMessage, ...]


def as_drive(plan: DrivePlan, said: tuple[RecordedMessage, ...]) -> RecordedDrive:
    """A drive with the topics of its plan."""
    topics = (Held(each.name, each.sheet.type, each.reliable) for each in plan.topics)
    return RecordedDrive(tuple(topics), said)


def unknown_drive(seed: int, odometry: str, gap_periods: float) -> RecordedDrive:
    """A drive with gaps, one of them only just long enough, and with a pause that is none.

    Its stamps are some tenths of a second old: who takes them for the time of the bag is off.
    """
    chance = Chance(f"unknown drive {seed}")
    start_ns = (START_S - int(chance.between(0, 10_000_000))) * NS + int(chance.between(0, NS))
    pieces = tuple(_pieces(chance))
    plan = DrivePlan(f"{seed}", start_ns, pieces, (), Pose(0.0, 0.0, chance.around(0, 3)))
    plan = replace(plan, begin=_across_both_axes(plan))
    plan = replace(plan, topics=tuple(_topics(chance, odometry, plan.seconds, gap_periods)))
    return _with_others(as_drive(plan, tuple(recorded(plan))), chance)


def _across_both_axes(plan: DrivePlan) -> Pose:
    """A begin from which the way has places on both sides of each axis."""
    poses = list(ways(plan))
    xs, ys = [pose.x_m for pose in poses], [pose.y_m for pose in poses]
    middle_x_m, middle_y_m = (min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2
    return replace(plan.begin, x_m=-middle_x_m, y_m=-middle_y_m)


def without(drive: RecordedDrive, topic: str) -> RecordedDrive:
    """The same with no message of this topic; the bag still names it."""
    return replace(drive, said=tuple(each for each in drive.said if each.topic != topic))


def _pieces(chance: Chance) -> Iterator[Piece]:
    """Backward once, and then faster than ever forward."""
    backward = int(chance.between(1, 4))
    for number in range(5):
        speed = chance.between(0.1, 0.4)
        if number == backward:
            speed = -chance.between(0.45, 0.55)
        turn = chance.pick((-1, 1)) * chance.between(0.3, 1.0)
        yield Piece(Motion(speed), chance.between(0.8, 1.8))
        yield Piece(Motion(speed, turn), chance.between(0.6, 1.4))


def _topics(chance: Chance, odometry: str, seconds: float, limit: float) -> Iterator[TopicPlan]:
    own = f"/deck_{int(chance.between(100, 1000))}"
    names = {ODOM: odometry, LIGHT: f"{own}/light"}
    pauses: Mapping[TopicSheet, Mapping[float, float]] = {
        IMU: {0.25: limit - EDGE, 0.6: limit + EDGE},
        RANGE: {0.3: limit + EDGE, 0.5: chance.between(6, 9), 0.7: limit - EDGE},
        BATTERY: {0.5: limit + EDGE},
    }
    rates = dict(zip(SHEET, chance.shuffled(RATES_HZ), strict=False))
    for sheet in SHEET:
        rate_hz = 20.0 if sheet is ODOM else rates[sheet]
        planned: Mapping[int, float] = {
            int(part * seconds * rate_hz): periods
            for part, periods in pauses.get(sheet, {}).items()
        }
        if sheet is ODOM:
            planned = _pauses_of_odometry(chance, seconds * rate_hz)
        yield replace(
            TopicPlan.healthy(sheet),
            name=names.get(sheet, sheet.name),
            rate_hz=rate_hz,
            pauses=planned,
            ahead_s=-chance.between(0.2, 0.5),
        )


def _pauses_of_odometry(chance: Chance, periods: float) -> dict[int, float]:
    """In the middle, after the first message and before the last one.

    So the first way and the last way are long: who leaves out one of them is far off.
    """
    first, middle, last = chance.between(12, 16), chance.between(12, 20), chance.between(12, 16)
    the_last = int(periods - first - middle - last) + 2
    return {1: first, int(0.4 * periods): middle, the_last: last, the_last + 1: periods}


def _with_others(drive: RecordedDrive, chance: Chance) -> RecordedDrive:
    """And a topic said once, one never said, one of a strange type, and another one's odometry."""
    first, last = drive.said[0].time_ns, drive.said[-1].time_ns
    others = (
        Held("/robot_description", "std_msgs/msg/String", kept=True),
        Held("/goal_pose", "geometry_msgs/msg/PoseStamped"),
        Held("/lift/state", STRANGE_TYPE),
        Held("/other_rover/odom", ODOM.type),
    )
    once, _, strange, other = others
    said = [RecordedMessage(_within(chance, first, last), once.name, 0, "", (0.0,))]
    said += _steadily(strange.name, first, last, 0.21)
    said += _steadily(other.name, first, last, 0.11)
    every = sorted((*drive.said, *said), key=lambda each: (each.time_ns, each.topic))
    return RecordedDrive((*drive.topics, *others), tuple(every))


def _within(chance: Chance, first: int, last: int) -> int:
    return int(chance.between(first + (last - first) * 0.1, last - (last - first) * 0.1))


def _steadily(topic: str, first: int, last: int, period_s: float) -> Iterator[RecordedMessage]:
    """Another rover on a circle: fast, and far away."""
    step_ns = int(period_s * NS)
    for time_ns in range(first + step_ns, last, step_ns):
        turn = (time_ns - first) / NS
        values = (2.5, 1.0, 50 + 2.5 * math.cos(turn), 2.5 * math.sin(turn), turn)
        yield RecordedMessage(time_ns, topic, time_ns, "odom", values)
