"""Experiments with bags: give a program one that nobody could know before, and see what it says."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from graders.black_box.contract import BagReaderContract
from graders.black_box.record import (
    BagGiven,
    BagsSeen,
    DriveHeld,
    PauseHeld,
    TopicHeld,
)
from roslings.arena import Process
from roslings.experiment.own_time import PATIENCE_S, OwnTime
from roslings.experiment.scene import Scene
from roslings_rover.models.drives import held
from roslings_rover.models.drives.recording import of_topic
from roslings_rover.models.drives.unknown import RecordedDrive, unknown_drive, without
from roslings_rover.rover.black_box import write_drive

READS_WITHIN_S = 30.0
"""Of its own time: a bag of some seconds is read in one."""
ENDS_WITHIN_S = 2.0
SEEDS = 10**9
Write = Callable[[Path], None]


class Giver:
    """Makes bags where the program can see them, and gives them to it, one by one."""

    def __init__(self, scene: Scene, reader: BagReaderContract) -> None:
        self._scene, self._reader = scene, reader

    def drive(self) -> RecordedDrive:
        """One that nobody knows, with gaps on both sides of the card's limit."""
        seed = int(self._scene.between(0, 1) * SEEDS)
        return unknown_drive(seed, self._reader.odometry, self._reader.gap_periods)

    def give(
        self, label: str, drive: RecordedDrive, storage: str = "", split_s: float = 0.0
    ) -> None:
        """A bag with this drive; the first storage of the card where none is named."""
        path = self._place(label)
        write_drive(drive, path, storage or self._reader.storages[0], split_s)
        self._run(BagGiven(label=label, path=str(path), holds=holding(drive, self._reader)))

    def give_still(self, label: str) -> None:
        """A bag in which nobody tells of the drive."""
        path = self._place(label)
        write_drive(without(self.drive(), self._reader.odometry), path, self._reader.storages[0])
        self._run(BagGiven(label=label, path=str(path), holds=None))

    def give_none(self, label: str) -> None:
        """The path of a bag that is not there."""
        self._run(BagGiven(label=label, path=str(self._place(label)), holds=None))

    def give_empty(self, label: str) -> None:
        """The path of a folder that is no bag."""
        path = self._place(label)
        path.mkdir()
        self._run(BagGiven(label=label, path=str(path), holds=None))

    def _place(self, label: str) -> Path:
        """A name that nobody can know; the program sees all that lies there."""
        return self._scene.arena.devices / f"{label}_{self._scene.sentence().split()[-1]}"

    def _run(self, bag: BagGiven) -> None:
        scene, executable = self._scene, self._reader.executable
        scene.seen.recording(BagsSeen).given.append(bag)
        with scene.arena.run(executable, [bag.path]) as process:
            scene.seen.processes[bag.label] = process.seen
            if not self._ends(process):
                process.interrupt(ENDS_WITHIN_S)

    def _ends(self, process: Process) -> bool:
        """Wait for this one: those that read other bags have ended before."""
        own = OwnTime(self._scene.arena)
        self._scene.probe.until(
            lambda: not process.alive or own.is_past(READS_WITHIN_S), READS_WITHIN_S + PATIENCE_S
        )
        return not process.alive


def holding(drive: RecordedDrive, reader: BagReaderContract) -> DriveHeld:
    """The truth about a drive.

    >>> holding(giver.drive(), READER)
    """
    odometry = of_topic(drive.said, reader.odometry)
    names = [topic.name for topic in drive.topics]
    return DriveHeld(
        duration_s=held.duration_s(drive.said),
        distance_m=held.distance_m(odometry),
        top_speed_m_s=held.top_speed_m_s(odometry),
        topics=[_topic(drive, name) for name in names],
        pauses=[
            PauseHeld(topic=p.topic, seconds=p.seconds, start_s=p.start_s, periods=p.periods)
            for name in names
            for p in held.pauses_of(name, drive.said)
        ],
    )


def _topic(drive: RecordedDrive, name: str) -> TopicHeld:
    times = [each.time_ns for each in of_topic(drive.said, name)]
    usual_s = held.usual_period_s(times)
    return TopicHeld(name=name, count=len(times), rate_hz=1 / usual_s if usual_s else 0.0)
