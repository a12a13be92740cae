"""Ten faults that a rover may have: each makes one topic wrong, and a number proves it."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from statistics import median

from roslings_rover.models.drives.chance import Chance
from roslings_rover.models.drives.recording import (
    NS,
    DrivePlan,
    RecordedMessage,
    TopicPlan,
    of_topic,
)
from roslings_rover.models.drives.sheet import (
    BATTERY,
    BUMPER,
    CMD_VEL,
    IMU,
    LIGHT,
    ODOM,
    RANGE,
    TEMPERATURE,
    WHEEL_SPEEDS,
    TopicSheet,
)

SENSORS = (IMU, RANGE, BATTERY, TEMPERATURE, LIGHT)
UNITS = {
    RANGE: 100.0,
    BATTERY: 1000.0,
    IMU: 180 / math.pi,
    TEMPERATURE: 1000.0,
    LIGHT: 0.001,
}
"""Topic to what its value is multiplied by: centimetres, millivolts, degrees a second, thousandths
of a degree, kilolux."""

LARGEST = "the largest value of the topic, without its sign"

Plant = Callable[[DrivePlan, TopicPlan, Chance], DrivePlan]
Measure = Callable[[Sequence[RecordedMessage], TopicPlan, DrivePlan], float]
"""From all messages, the topic and the drive to the number that proves the fault."""


@dataclass(frozen=True)
class RoverFault:
    """One way in which a rover can be sick."""

    name: str
    about: str
    number: str
    """What is to be measured, with its unit."""
    topics: tuple[TopicSheet, ...]
    """It can be planted in each of them."""
    plant: Plant
    measure: Measure
    signed: bool = False
    """Whether the sign of the number counts."""


def _with(drive: DrivePlan, topic: TopicPlan, **words: object) -> DrivePlan:
    changed = replace(topic, **words)  # type: ignore[arg-type]
    return replace(drive, topics=tuple(changed if each is topic else each for each in drive.topics))


# --- what makes a topic wrong ------------------------------------------------------------------


def _unit(drive: DrivePlan, topic: TopicPlan, chance: Chance) -> DrivePlan:
    return _with(drive, topic, factor=UNITS[topic.sheet])


def _best_effort(drive: DrivePlan, topic: TopicPlan, chance: Chance) -> DrivePlan:
    return _with(drive, topic, reliable=False, rate_hz=topic.rate_hz * chance.between(0.92, 1.08))


def _stale(drive: DrivePlan, topic: TopicPlan, chance: Chance) -> DrivePlan:
    return _with(drive, topic, still_from_s=drive.seconds * chance.between(0.15, 0.7))


def _dead(drive: DrivePlan, topic: TopicPlan, chance: Chance) -> DrivePlan:
    return _with(drive, topic, ends_s=drive.seconds * chance.between(0.3, 0.8))


def _frame(drive: DrivePlan, topic: TopicPlan, chance: Chance) -> DrivePlan:
    own = topic.sheet.frame
    others = [f"/{own}", own.replace("_link", ""), f"{own}_0", "map"]
    frame = chance.pick([each for each in others if each != own])
    from_s = drive.seconds * chance.between(0.2, 0.75)
    return _with(drive, topic, other_frame=frame, other_frame_from_s=from_s)


def _drift(drive: DrivePlan, topic: TopicPlan, chance: Chance) -> DrivePlan:
    slow = 1 - chance.between(0.03, 0.12)
    return replace(drive, left=slow) if chance.pick((True, False)) else replace(drive, right=slow)


def _clock(drive: DrivePlan, topic: TopicPlan, chance: Chance) -> DrivePlan:
    return _with(drive, topic, ahead_s=chance.pick((-1, 1)) * chance.between(2, 90))


def _namespace(drive: DrivePlan, topic: TopicPlan, chance: Chance) -> DrivePlan:
    space = chance.pick(("/rover", "/robot1", "/left", "/sim"))
    rate_hz = topic.rate_hz * chance.between(0.92, 1.08)
    return _with(drive, topic, name=f"{space}{topic.name}", rate_hz=rate_hz)


def _flood(drive: DrivePlan, topic: TopicPlan, chance: Chance) -> DrivePlan:
    return _with(drive, topic, rate_hz=topic.rate_hz * chance.between(6, 14))


def _default(drive: DrivePlan, topic: TopicPlan, chance: Chance) -> DrivePlan:
    faster = chance.between(1.25, 2.0)
    pieces = (
        replace(piece, motion=replace(piece.motion, forward_m_s=piece.motion.forward_m_s * faster))
        for piece in drive.pieces
    )
    return replace(drive, pieces=tuple(pieces))


# --- what proves it ----------------------------------------------------------------------------


def _largest(said: Sequence[RecordedMessage], topic: TopicPlan, drive: DrivePlan) -> float:
    return max(abs(each.values[0]) for each in of_topic(said, topic.name))


def _count(said: Sequence[RecordedMessage], topic: TopicPlan, drive: DrivePlan) -> float:
    return len(of_topic(said, topic.name))


def _age_s(said: Sequence[RecordedMessage], topic: TopicPlan, drive: DrivePlan) -> float:
    last = of_topic(said, topic.name)[-1]
    return (last.time_ns - last.stamp_ns) / NS


def _lived_s(said: Sequence[RecordedMessage], topic: TopicPlan, drive: DrivePlan) -> float:
    return (of_topic(said, topic.name)[-1].time_ns - said[0].time_ns) / NS


def _wrong_frames(said: Sequence[RecordedMessage], topic: TopicPlan, drive: DrivePlan) -> float:
    return sum(each.frame != topic.sheet.frame for each in of_topic(said, topic.name))


def _slower(said: Sequence[RecordedMessage], topic: TopicPlan, drive: DrivePlan) -> float:
    return 100 * (1 - min(drive.left, drive.right))


def _ahead_s(said: Sequence[RecordedMessage], topic: TopicPlan, drive: DrivePlan) -> float:
    return median((each.stamp_ns - each.time_ns) / NS for each in of_topic(said, topic.name))


def _rate_hz(said: Sequence[RecordedMessage], topic: TopicPlan, drive: DrivePlan) -> float:
    times = [each.time_ns for each in of_topic(said, topic.name)]
    return (len(times) - 1) * NS / (times[-1] - times[0])


FAULTS = {
    fault.name: fault
    for fault in (
        RoverFault(
            "wrong_unit",
            "the value has another unit than in the table above",
            LARGEST,
            SENSORS,
            _unit,
            _largest,
        ),
        RoverFault(
            "qos_mismatch",
            "the quality of service that is offered is not enough for who hears it",
            "how many messages were never heard",
            (ODOM, BATTERY, TEMPERATURE, LIGHT, BUMPER),
            _best_effort,
            _count,
        ),
        RoverFault(
            "stale_stamps",
            "the stamp stands still while new messages come",
            "how old the last message was, in seconds",
            SENSORS,
            _stale,
            _age_s,
        ),
        RoverFault(
            "dead_node",
            "a node died, and its topic ends",
            "the seconds from the start of the bag to its last message",
            (*SENSORS, BUMPER),
            _dead,
            _lived_s,
        ),
        RoverFault(
            "wrong_frame",
            "from some message on, the `frame_id` is another one",
            "how many messages have the wrong one",
            (ODOM, *SENSORS),
            _frame,
            _wrong_frames,
        ),
        RoverFault(
            "drifting_wheel",
            "on a straight way one wheel turns slower than the other",
            "by how many per cent of the faster wheel",
            (WHEEL_SPEEDS,),
            _drift,
            _slower,
        ),
        RoverFault(
            "wrong_clock",
            "all stamps are off by the same time",
            "by how many seconds they are ahead; with a minus: behind",
            SENSORS,
            _clock,
            _ahead_s,
            signed=True,
        ),
        RoverFault(
            "wrong_namespace",
            "the topic has a namespace that nobody listens to",
            "how many messages went there",
            (*SENSORS, BUMPER),
            _namespace,
            _count,
        ),
        RoverFault(
            "flood",
            "messages come far too often",
            "how many come in a second",
            (RANGE, BATTERY, TEMPERATURE, LIGHT, BUMPER),
            _flood,
            _rate_hz,
        ),
        RoverFault(
            "lost_parameter",
            "the parameter never arrived, and the node took its default",
            LARGEST,
            (CMD_VEL,),
            _default,
            _largest,
        ),
    )
}
"""Name to fault, in the order in which the task tells them."""
