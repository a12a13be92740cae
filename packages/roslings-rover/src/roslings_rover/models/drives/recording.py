"""A drive, message by message, as somebody who recorded everything has it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from roslings_rover.models.differential_drive import Body, Motion, Pose, Wheels, moved
from roslings_rover.models.drives.chance import Chance
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

NS = 10**9
JITTER = 0.03
"""A timer is so much of its period too early or too late."""
LEAST_DELAY_S, MOST_DELAY_S = 0.001, 0.003
"""From the stamp to the bag."""
STEP_S = 0.01
"""Of the reckoning of the way."""
WHEEL_NOISE = 0.004
"""As a part of the speed."""


@dataclass(frozen=True, slots=True)
class RecordedMessage:
    """One message of a bag. The first of `values` is the value of its topic."""

    time_ns: int
    """When it was recorded."""
    topic: str
    stamp_ns: int
    frame: str
    values: tuple[float, ...]


@dataclass(frozen=True)
class TopicPlan:
    """How one topic is said in this drive; a fault changes one of these words."""

    sheet: TopicSheet
    name: str
    rate_hz: float
    reliable: bool
    ends_s: float = math.inf
    still_from_s: float = math.inf
    """From then on each stamp is that of then."""
    ahead_s: float = 0.0
    """So much are the stamps ahead of the truth."""
    other_frame: str = ""
    other_frame_from_s: float = math.inf
    factor: float = 1.0
    """Its value is told in another unit: so many of it are one of the right unit."""
    pauses: Mapping[int, float] = field(default_factory=dict)
    """Number of a message to the usual periods that pass before it comes."""

    @classmethod
    def healthy(cls, sheet: TopicSheet) -> TopicPlan:
        """As the sheet says."""
        return cls(sheet, sheet.name, sheet.rate_hz, sheet.offers_reliable)


@dataclass(frozen=True)
class Piece:
    """One stretch of the drive."""

    motion: Motion
    seconds: float


@dataclass(frozen=True)
class DrivePlan:
    """All that decides what a bag holds."""

    seed: str
    start_ns: int
    pieces: tuple[Piece, ...]
    topics: tuple[TopicPlan, ...]
    begin: Pose = field(default_factory=Pose)
    left: float = 1.0
    right: float = 1.0
    """Parts of the speed that each wheel should have."""

    @property
    def seconds(self) -> float:
        """From the first piece to the end of the last one."""
        return sum(piece.seconds for piece in self.pieces)

    def piece_at(self, time_s: float) -> Piece:
        """The one that is driven then; the last one where all is over."""
        for piece in self.pieces:
            if time_s < piece.seconds:
                return piece
            time_s -= piece.seconds
        return self.pieces[-1]


def recorded(plan: DrivePlan) -> list[RecordedMessage]:
    """All messages of the drive, in the order in which they were recorded."""
    surroundings = _Surroundings(plan)
    said = [each for topic in plan.topics for each in _said(plan, topic, surroundings)]
    return sorted(said, key=lambda each: (each.time_ns, each.topic))


def _said(plan: DrivePlan, topic: TopicPlan, around: _Surroundings) -> Iterator[RecordedMessage]:
    chance = Chance(f"{plan.seed} {topic.sheet.name}")
    for time_s in _times(plan, topic, chance):
        values = around.values(topic.sheet, time_s, chance)
        told = (values[0] * topic.factor, *values[1:])
        frame = topic.other_frame if time_s >= topic.other_frame_from_s else topic.sheet.frame
        stamp_s = min(time_s, topic.still_from_s) + topic.ahead_s
        delay_s = chance.between(LEAST_DELAY_S, MOST_DELAY_S)
        yield RecordedMessage(
            plan.start_ns + round((time_s + delay_s) * NS),
            topic.name,
            plan.start_ns + round(stamp_s * NS),
            frame,
            told,
        )


def _times(plan: DrivePlan, topic: TopicPlan, chance: Chance) -> Iterator[float]:
    """When its messages are made, in seconds after the start."""
    period_s = 1 / topic.rate_hz
    due_s, number = chance.between(0, period_s), 0
    while due_s < min(plan.seconds, topic.ends_s):
        yield due_s + chance.around(0, JITTER * period_s / 2)
        number += 1
        due_s += period_s * topic.pauses.get(number, 1.0)


def wheels_of(plan: DrivePlan, time_s: float, body: Body) -> Wheels:
    """How fast the wheels of this drive turn."""
    wanted = body.wheels_for(plan.piece_at(time_s).motion)
    return Wheels(wanted.left_rad_s * plan.left, wanted.right_rad_s * plan.right)


def ways(plan: DrivePlan) -> Iterator[Pose]:
    """Where the rover is, from its begin, each `STEP_S`."""
    body, pose = Body(), plan.begin
    for step in range(int(plan.seconds / STEP_S) + 1):
        yield pose
        pose = moved(pose, body.motion_of(wheels_of(plan, step * STEP_S, body)), STEP_S)


class _Surroundings:
    """The rover and its room at any time of a drive."""

    def __init__(self, plan: DrivePlan) -> None:
        self._plan, self._body = plan, Body()
        chance = Chance(f"{plan.seed} surroundings")
        self._poses = list(ways(plan))
        self._warmth = chance.between(22, 27), chance.between(6, 14)
        self._volts = chance.between(7.6, 8.3), chance.between(0.2, 0.9)
        self._lux = chance.between(250, 400), chance.between(60, 140), chance.between(7, 15)
        self._wall = chance.between(1.2, 1.6), chance.between(0.5, 0.9), chance.between(6, 12)
        self._bumps = [chance.between(0, plan.seconds) for _ in range(4)]

    def values(self, sheet: TopicSheet, time_s: float, chance: Chance) -> tuple[float, ...]:
        """What a message of this topic says."""
        return _VALUES[sheet](self, time_s, chance)

    def cmd_vel(self, time_s: float, chance: Chance) -> tuple[float, ...]:
        """Forward in m/s, turn in rad/s."""
        motion = self._plan.piece_at(time_s).motion
        return motion.forward_m_s, motion.turn_rad_s

    def wheels(self, time_s: float, chance: Chance) -> tuple[float, ...]:
        """Left and right in rad/s, as an encoder tells them."""
        wheels = self._wheels(time_s)
        noisy = (
            speed * chance.around(1, WHEEL_NOISE)
            for speed in (wheels.left_rad_s, wheels.right_rad_s)
        )
        return tuple(noisy)

    def odometry(self, time_s: float, chance: Chance) -> tuple[float, ...]:
        """Forward in m/s, turn in rad/s, x and y in metres, heading in rad."""
        pose = self._poses[min(int(time_s / STEP_S), len(self._poses) - 1)]
        motion = self._body.motion_of(self._wheels(time_s))
        return motion.forward_m_s, motion.turn_rad_s, pose.x_m, pose.y_m, pose.heading_rad

    def imu(self, time_s: float, chance: Chance) -> tuple[float, ...]:
        """Turn in rad/s."""
        turn = self._body.motion_of(self._wheels(time_s)).turn_rad_s
        return (turn + chance.around(0, 0.01),)

    def distance(self, time_s: float, chance: Chance) -> tuple[float, ...]:
        """To the wall, in metres."""
        middle, swing, period_s = self._wall
        return (_wave(middle, swing, period_s, time_s) + chance.around(0, 0.01),)

    def battery(self, time_s: float, chance: Chance) -> tuple[float, ...]:
        """Volts, and which part of it is left."""
        full, lost = self._volts
        volts = full - lost * time_s / self._plan.seconds + chance.around(0, 0.01)
        return volts, (volts - 6.0) / 2.4

    def warmth(self, time_s: float, chance: Chance) -> tuple[float, ...]:
        """Of the motor, in degrees Celsius."""
        cold, rise = self._warmth
        return (cold + rise * time_s / self._plan.seconds + chance.around(0, 0.1),)

    def lux(self, time_s: float, chance: Chance) -> tuple[float, ...]:
        """How light it is."""
        return (_wave(*self._lux, time_s) + chance.around(0, 5),)

    def bumper(self, time_s: float, chance: Chance) -> tuple[float, ...]:
        """1 while it touches something."""
        return (float(any(0 <= time_s - bump < 0.5 for bump in self._bumps)),)

    def _wheels(self, time_s: float) -> Wheels:
        return wheels_of(self._plan, time_s, self._body)


_VALUES = {
    CMD_VEL: _Surroundings.cmd_vel,
    WHEEL_SPEEDS: _Surroundings.wheels,
    ODOM: _Surroundings.odometry,
    IMU: _Surroundings.imu,
    RANGE: _Surroundings.distance,
    BATTERY: _Surroundings.battery,
    TEMPERATURE: _Surroundings.warmth,
    LIGHT: _Surroundings.lux,
    BUMPER: _Surroundings.bumper,
}


def _wave(middle: float, swing: float, period_s: float, time_s: float) -> float:
    return middle + swing * math.sin(2 * math.pi * time_s / period_s)


def of_topic(said: Sequence[RecordedMessage], name: str) -> list[RecordedMessage]:
    """The messages of one topic."""
    return [each for each in said if each.topic == name]
