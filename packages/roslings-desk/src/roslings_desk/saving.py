"""Saves as a bag what the desk has heard in the last seconds, and the robot's way as a GIF."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from ros2_on_pip.problem import CommandProblem
from ros2_on_pip.rosbag2.errors import BagError
from ros2_on_pip.rosbag2.metadata import Topic
from ros2_on_pip.rosbag2.writing import BagWriter, BagWriterOptions
from roslings_desk.hub import Message, SharedSubscription
from roslings_desk.map_gif import can_draw, gif_of
from roslings_desk.odometry import ODOM, ODOMETRY, pose_in
from roslings_desk.room_heard import world_heard
from roslings_rover.models.world import World
from roslings_rover.rover.rover import RoverMoment

LAST_S = 20.0
NAME = "desk_%Y-%m-%d_%H-%M-%S"
HERE = Path.cwd()
"""The folder in which the desk was started; it may be gone later."""


class NoMessagesToSave(CommandProblem):
    """There is nothing to save."""

    def __init__(self) -> None:
        super().__init__(
            f"No message has come in the last {LAST_S:g} s on a topic that an open tab shows."
            " Open a tab that shows it, wait, and press again."
        )


class CannotSaveBag(CommandProblem):
    """The bag cannot be written."""

    def __init__(self, error: Exception) -> None:
        super().__init__(f"The bag cannot be written: {error}")


@dataclass(frozen=True)
class Saved:
    """A bag, and what is in it."""

    folder: Path
    counts: dict[str, int]
    """Messages of each topic."""
    cut_s: dict[str, float]
    """Topics that came so fast that only their last seconds were kept."""
    map_words: str = ""
    """Where the GIF is, or why there is none; nothing where no robot was heard."""

    @property
    def words(self) -> str:
        """Where it is, what is in it, and how it is shown again."""
        topics = ", ".join(f"{name}: {count}" for name, count in self.counts.items())
        cut = "".join(f" Of {name} only the last {s:.1f} s." for name, s in self.cut_s.items())
        return f"Saved in {self.folder}. Messages: {topics}.{cut}{self.map_words}"


def save(heard: Sequence[SharedSubscription], place: Path) -> Saved:
    """Write a new bag in the folder `place`. Raises NoMessagesToSave, CannotSaveBag."""
    now_s, now_ns = time.monotonic(), time.time_ns()
    begin_s = now_s - LAST_S
    kept = {each: [m for m in each.after(0) if m.came_s >= begin_s] for each in heard}
    kept = {each: messages for each, messages in kept.items() if messages}
    if not kept:
        raise NoMessagesToSave
    folder = _new(place)
    try:
        _write(folder, kept, now_ns - round(now_s * 1e9))
    except BagError as error:
        raise CannotSaveBag(error) from error
    words = _save_map(folder, kept, world_heard(heard))
    cut_s = {
        each.topic: now_s - messages[0].came_s
        for each, messages in kept.items()
        if messages[0].number > 1 and messages[0] is each.after(0)[0]
    }
    counts = {each.topic: len(messages) for each, messages in kept.items()}
    return Saved(folder, counts, cut_s, words)


def _save_map(folder: Path, kept: dict[SharedSubscription, list[Message]], world: World) -> str:
    """Beside the bag, where the robot said where it was. Raises CannotSaveBag."""
    heard = next((each for each in kept if (each.topic, each.type_name) == (ODOM, ODOMETRY)), None)
    places = [(m.came_s, pose_in(heard.read(m))) for m in kept[heard]] if heard else []
    way = [RoverMoment(came_s, pose) for came_s, pose in places if pose]
    if not way:
        return ""
    if not can_draw():
        return " No GIF of the map: matplotlib is not installed here."
    file = folder.with_name(f"{folder.name}.gif")
    try:
        file.write_bytes(gif_of(way, world))
    except OSError as error:
        raise CannotSaveBag(error) from error
    return f" The map: {file}"


def _new(place: Path) -> Path:
    """A name that is not there yet: two may be saved in one second."""
    name = datetime.now().strftime(NAME)
    tried = (place / (f"{name}_{number}" if number else name) for number in range(1000))
    return next(each for each in tried if not each.exists())


def _write(folder: Path, kept: dict[SharedSubscription, list[Message]], zero_ns: int) -> None:
    """All messages in the order in which they came. Raises BagError."""
    writer = BagWriter(folder, BagWriterOptions())
    try:
        for heard in kept:
            writer.add_topic(Topic(heard.topic, heard.type_name))
        said = [(m.came_s, heard.topic, m.content) for heard, ms in kept.items() for m in ms]
        for came_s, topic, content in sorted(said, key=lambda each: each[0]):
            writer.write(topic, zero_ns + round(came_s * 1e9), content)
    finally:
        writer.close()
