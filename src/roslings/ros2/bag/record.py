"""`ros2 bag record`: write down what is said on topics."""

from __future__ import annotations

import argparse
import signal
import time
from datetime import datetime
from pathlib import Path
from types import TracebackType
from typing import Any, Literal

from roslings.probe.definition import definition_of
from roslings.ros2 import stopping
from roslings.ros2.bag.quality import kept
from roslings.ros2.bag.speech import tell
from roslings.ros2.discovery import Eye
from roslings.ros2.interfaces import UnknownInterface, class_of
from roslings.ros2.names import checked_topic, is_hidden
from roslings.ros2.problem import Problem, did_you_mean
from roslings.ros2.qos import matching
from roslings.ros2.words import OK

RECORDER, STORAGE = "rosbag2_recorder", "rosbag2_storage"
LOOK_EVERY_S = 0.2
VERSION: Literal[9] = 9
ENDINGS = {"mcap": ".mcap", "sqlite3": ".db3"}


class NothingToRecord(Problem):
    """Neither topics nor `-a`."""

    exit_code = 2

    def __init__(self) -> None:
        super().__init__(
            "Must specify topics to record: ros2 bag record /chatter, or all of them:"
            " ros2 bag record -a"
        )


class BagThere(Problem):
    """A folder of that name exists; nothing is overwritten."""

    def __init__(self, folder: Path) -> None:
        super().__init__(
            f"[ERROR] [ros2bag]: Output folder '{folder}' already exists."
            " Choose another one with -o"
        )


class CannotRecord(Problem):
    """The bag cannot be written."""

    def __init__(self, folder: Path, fault: Exception) -> None:
        super().__init__(f"[ERROR] [ros2bag]: cannot write the bag '{folder}': {fault}")


def record(options: argparse.Namespace) -> int:
    """`ros2 bag record TOPIC...`; ends with Ctrl-C."""
    topics = [checked_topic(name) for name in [*options.topics, *(options.topics_option or [])]]
    if not topics and not options.all:
        raise NothingToRecord
    folder = Path(options.output or datetime.now().strftime("rosbag2_%Y_%m_%d-%H_%M_%S"))
    if folder.exists():
        raise BagThere(folder)
    stopping.listen(signal.SIGTERM)
    with Eye() as eye, Recorder(eye, folder, options) as recorder:
        try:
            recorder.run(topics)
        except KeyboardInterrupt:
            tell(RECORDER, "Pausing recording.")
    tell(RECORDER, "Recording stopped")
    return OK


class Recorder:
    """Writes every message into a bag. Leaving the `with` block completes the bag."""

    def __init__(self, eye: Eye, folder: Path, options: argparse.Namespace) -> None:
        self._eye = eye
        self._folder = folder
        self._options = options
        self._heard: set[str] = set()
        self._refused: set[str] = set()
        self._fault: OSError | None = None

    def __enter__(self) -> Recorder:
        from rosbags.rosbag2 import StoragePlugin, Writer

        plugin = StoragePlugin[self._options.storage.upper()]
        self._writer = Writer(self._folder, version=VERSION, storage_plugin=plugin)
        try:
            self._writer.open()
        except OSError as fault:
            raise CannotRecord(self._folder, fault) from fault
        file = self._folder / f"{self._folder.name}{ENDINGS[self._options.storage]}"
        tell(STORAGE, f"Opened database '{file}' for READ_WRITE.")
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        # A second Ctrl-C must not tear the bag: its index is written now.
        before = signal.signal(signal.SIGINT, signal.SIG_IGN)
        try:
            self._writer.close()
        finally:
            signal.signal(signal.SIGINT, before)

    def run(self, topics: list[str]) -> None:
        """Record `topics`, or all of them, until somebody stops it. Raises CannotRecord."""
        tell(RECORDER, "Listening for topics...")
        self._eye.settle()
        self._look(topics)
        self._say_near(topics)
        tell(RECORDER, "Recording...")
        complete = False
        while True:
            self._eye.until(lambda: self._fault, LOOK_EVERY_S)
            if self._fault:
                raise CannotRecord(self._folder, self._fault)
            self._look(topics)
            if topics and not complete and self._heard >= set(topics):
                complete = True
                tell(RECORDER, "All requested topics are subscribed. Stopping discovery...")

    def _look(self, wanted: list[str]) -> None:
        """Subscribe to each wanted topic that has come up since."""
        there = self._eye.topics()
        for topic in wanted or [name for name in there if not is_hidden(name)]:
            if topic in there and topic not in self._heard | self._refused:
                self._subscribe(topic, there[topic])

    def _subscribe(self, topic: str, types: list[str]) -> None:
        try:
            cls = class_of(types[0], "msg")
        except UnknownInterface as problem:
            self._refused.add(topic)
            tell(RECORDER, f"Topic '{topic}' is left out. {problem}", "WARN")
            return
        definition = definition_of(types[0])
        publishers = self._eye.publishers(topic)
        connection = self._writer.add_connection(
            topic, types[0], msgdef=definition.text, rihs01=definition.hash,
            offered_qos_profiles=[kept(info.qos_profile) for info in publishers],
        )  # fmt: skip
        self._eye.node.create_subscription(
            cls, topic, self._keeper(connection), matching(self._options, publishers), raw=True
        )
        self._heard.add(topic)
        tell(RECORDER, f"Subscribed to topic '{topic}'")

    def _keeper(self, connection: Any) -> Any:
        """What takes the messages of one topic."""

        def keep(raw: bytes, info: Any) -> None:
            try:
                self._writer.write(connection, info["received_timestamp"] or time.time_ns(), raw)
            except OSError as fault:  # the disk is full
                self._fault = fault

        return keep

    def _say_near(self, topics: list[str]) -> None:
        there = [name for name in self._eye.topics() if not is_hidden(name)]
        for topic in topics:
            if topic not in there:
                near = did_you_mean(topic, there)
                tell(RECORDER, f"No node has the topic '{topic}' yet.{near}", "WARN")
