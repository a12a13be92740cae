"""`ros2 bag record`: write down what is said on topics."""

from __future__ import annotations

import argparse
import signal
import time
from datetime import datetime
from pathlib import Path
from typing import Any

from ros2_on_pip import stopping
from ros2_on_pip.bag.keys import SPACE, KeySource, pressed
from ros2_on_pip.bag.problem import WrongBagOptions, told
from ros2_on_pip.bag.speech import tell
from ros2_on_pip.discovery import DirectNode
from ros2_on_pip.interfaces import UnknownInterface, class_of
from ros2_on_pip.names import checked_topic, is_hidden
from ros2_on_pip.problem import CommandProblem, did_you_mean
from ros2_on_pip.rosbag2.choosing import TopicFilter
from ros2_on_pip.rosbag2.errors import BagError, BagThere
from ros2_on_pip.rosbag2.metadata import Topic
from ros2_on_pip.rosbag2.quality import kept, overrides, requested_qos
from ros2_on_pip.rosbag2.writing import BagWriter, BagWriterOptions
from ros2_on_pip.words import OK

STORAGE = "rosbag2_storage"
AT_ONCE = 500
"""After so many messages of a topic the others, keys and Ctrl-C get their turn."""

POSITIONAL = (
    'Positional "topics" argument deprecated. Please use optional "--topics" argument instead.'
)
HIDDEN = "Hidden topics are not recorded. Enable them with --include-hidden-topics"


class NothingToRecord(CommandProblem):
    """Neither topics nor `-a`."""

    exit_code = 2

    def __init__(self) -> None:
        super().__init__(
            "Must specify topics to record: ros2 bag record --topics /chatter, or all of them:"
            " ros2 bag record -a"
        )


def record(options: argparse.Namespace) -> int:
    """`ros2 bag record --topics TOPIC...`; ends with Ctrl-C."""
    wanted = WantedTopics.of(options)
    folder = Path(options.output or datetime.now().strftime("rosbag2_%Y_%m_%d-%H_%M_%S"))
    with told():
        profiles, plan = overrides(options.qos_profile_overrides_path), plan_of(options)
        plan.require_sense()
        if folder.exists():
            raise BagThere(folder)
    # A message that is half written must not be torn: Ctrl-C is looked for between two.
    stopping.listen_softly(signal.SIGTERM)
    name = options.node_name
    with (
        DirectNode(name, options.use_sim_time) as direct_node,
        told(),
        Bag(folder, plan, name) as bag,
        pressed(not options.disable_keyboard_controls) as keyboard,
    ):
        _record(BagRecorder(direct_node, bag, wanted, options, profiles), keyboard)
    tell(name, "Recording stopped")
    return OK


def _record(recorder: BagRecorder, keyboard: KeySource | None) -> None:
    try:
        recorder.run(keyboard)
    except KeyboardInterrupt:
        tell(recorder.name, "Pausing recording.")


def plan_of(options: argparse.Namespace) -> BagWriterOptions:
    """How the bag is written. Raises WrongBagOptions."""
    if options.compression_format and options.compression_mode == "none":
        raise WrongBagOptions(
            "Invalid choice: Cannot specify compression format without a compression mode."
            " Add --compression-mode file"
        )
    if options.compression_mode != "none" and not options.compression_format:
        raise WrongBagOptions("a compression mode needs --compression-format zstd")
    pairs = (pair.partition("=") for pair in options.custom_data)
    return BagWriterOptions(
        storage=options.storage,
        compression=options.compression_mode,
        max_size=options.max_bag_size,
        max_duration_s=options.max_bag_duration,
        custom={key: value for key, _, value in pairs},
    )


class WantedTopics:
    """Which topics are to be recorded."""

    def __init__(self, choice: TopicFilter, options: argparse.Namespace) -> None:
        self._choice = choice
        self.names = frozenset(choice.names)
        self._hidden: bool = options.include_hidden_topics
        self._unpublished: bool = options.include_unpublished_topics
        self._leaves: bool = not options.ignore_leaf_topics
        self._told_hidden = False

    @classmethod
    def of(cls, options: argparse.Namespace) -> WantedTopics:
        """What the options say. Raises NothingToRecord, WrongBagOptions, BagProblem."""
        every = options.all or options.all_topics
        names = [checked_topic(name) for name in [*options.topics, *options.topics_option]]
        if not (every or names or options.topic_types or options.regex):
            raise NothingToRecord
        _require_many(options, every or options.topic_types or options.regex)
        if options.topics:
            tell(options.node_name, POSITIONAL, "WARN")
        chosen = (
            {} if every else {"names": names, "types": options.topic_types, "regex": options.regex}
        )
        with told():
            choice = TopicFilter(
                without=[checked_topic(name) for name in options.exclude_topics],
                without_types=options.exclude_topic_types,
                without_regex=options.exclude_regex,
                **chosen,
            )
        return cls(choice, options)

    def takes(self, direct_node: DirectNode, topic: str, types: list[str]) -> bool:
        """Whether this topic is one of them."""
        if not self._choice.takes(topic, types[0]):
            return False
        if is_hidden(topic) and not self._hidden:
            self._tell_hidden(topic)
            return False
        published = self._unpublished or direct_node.publishers(topic)
        return bool(published and (self._leaves or direct_node.subscriptions(topic)))

    def _tell_hidden(self, topic: str) -> None:
        if topic in self.names and not self._told_hidden:
            self._told_hidden = True
            tell("rosbag2_transport", HIDDEN, "WARN")


def _require_many(options: argparse.Namespace, many: Any) -> None:
    """Something is left out only where more is asked for than names."""
    for word in ("exclude_regex", "exclude_topics", "exclude_topic_types"):
        if getattr(options, word) and not many:
            raise WrongBagOptions(
                f"--{word.replace('_', '-')} argument requires either --all, --all-topics,"
                " --topic-types or --regex"
            )


class Bag:
    """The bag that is written. Leaving the `with` block completes it."""

    def __init__(self, folder: Path, plan: BagWriterOptions, speaker: str) -> None:
        self._folder, self._plan, self._speaker = folder, plan, speaker

    def __enter__(self) -> BagWriter:
        self._writer = BagWriter(self._folder, self._plan)
        tell(STORAGE, f"Opened database '{self._writer.file}' for READ_WRITE.")
        return self._writer

    def __exit__(self, *_: object) -> None:
        self._writer.close()


class BagRecorder:
    """Subscribes to what is wanted, also to what comes late, and writes what it hears."""

    def __init__(
        self,
        direct_node: DirectNode,
        writer: BagWriter,
        wanted: WantedTopics,
        options: argparse.Namespace,
        profiles: dict[str, Any],
    ) -> None:
        self.name: str = options.node_name
        self._direct_node, self._writer, self._wanted = direct_node, writer, wanted
        self._options, self._profiles = options, profiles
        self._paused: bool = options.start_paused
        self._asked: set[str] = set()
        self._refused: set[str] = set()
        self._fault: BagError | None = None

    def run(self, keyboard: KeySource | None = None) -> None:
        """Record until somebody stops it. Raises BagNotWritable."""
        if keyboard:
            tell(self.name, "Press SPACE for pausing/resuming")
        tell(self.name, "Listening for topics...")
        self._direct_node.settle()
        self._look()
        self._say_near()
        tell(self.name, "Waiting for recording (paused)" if self._paused else "Recording...")
        self._go_on(keyboard)

    def _go_on(self, keyboard: KeySource | None) -> None:
        every_s = self._options.polling_interval_ms / 1000
        complete = self._options.no_discovery
        look_s = time.monotonic() + every_s
        while True:
            self._direct_node.spin_to(time.monotonic() + min(every_s, 0.05))
            if self._fault:
                raise self._fault
            self._writer.keep_settled()
            if keyboard and keyboard.next(0.0) == SPACE:
                self._toggle()
            if not complete and time.monotonic() >= look_s:
                self._look()
                complete = self._has_all()
                look_s = time.monotonic() + every_s

    def _has_all(self) -> bool:
        """All topics that were named are there; nothing else was asked for."""
        options = self._options
        more = options.all or options.all_topics or options.regex or options.topic_types
        if more or not self._asked >= self._wanted.names:
            return False
        tell(self.name, "All requested topics are subscribed. Stopping discovery...")
        return True

    def _toggle(self) -> None:
        self._paused = not self._paused
        tell(self.name, "Pausing recording." if self._paused else "Resuming recording.")

    def _look(self) -> None:
        """Subscribe to each wanted topic that has come up since."""
        for topic, types in self._direct_node.topics().items():
            known = topic in self._asked or topic in self._refused
            if not known and self._wanted.takes(self._direct_node, topic, types):
                self._subscribe(topic, types[0])

    def _subscribe(self, topic: str, type_name: str) -> None:
        try:
            cls = class_of(type_name, "msg")
        except UnknownInterface as problem:
            self._refused.add(topic)
            tell(self.name, f"Topic '{topic}' is left out. {problem}", "WARN")
            return
        publishers = self._direct_node.publishers(topic)
        profile = self._profile(topic, publishers)
        offers = tuple(kept(info.qos_profile) for info in publishers)
        self._writer.add_topic(Topic(topic, type_name, qos=offers))
        self._listen(cls, topic, profile)
        self._asked.add(topic)
        tell(self.name, f"Subscribed to topic '{topic}'")

    def _profile(self, topic: str, publishers: list[Any]) -> Any:
        """What is asked for: the file's profile, or what all publishers can give."""
        if topic in self._profiles:
            tell(self.name, f"Overriding subscription profile for {topic}")
            return self._profiles[topic]
        profile, notes = requested_qos(topic, [info.qos_profile for info in publishers])
        for note in notes:
            tell("ROSBAG2_TRANSPORT", note, "WARN")
        return profile

    def _listen(self, cls: Any, topic: str, profile: Any) -> None:
        """Take the messages of one topic. What waits already is taken at once: to wake up for each
        costs more than to write it."""

        def keep(raw: bytes, info: Any) -> None:
            self._keep(topic, raw, info)
            for _ in range(AT_ONCE):
                if (taken := subscription.handle.take_message(cls, True)) is None:
                    return
                self._keep(topic, *taken)

        subscription = self._direct_node.node.create_subscription(
            cls, topic, keep, profile, raw=True
        )

    def _keep(self, topic: str, raw: bytes, info: Any) -> None:
        time_ns = self._time_ns(info)
        if self._paused or self._fault or not time_ns:
            return
        try:
            self._writer.write(topic, time_ns, raw)
        except BagError as fault:
            self._fault = fault

    def _time_ns(self, info: Any) -> int:
        """When a message came. In simulated time 0 until somebody has said what time it is."""
        if self._options.use_sim_time:
            return int(self._direct_node.node.get_clock().now().nanoseconds)
        return int(info["received_timestamp"] or time.time_ns())

    def _say_near(self) -> None:
        there = [name for name in self._direct_node.topics() if not is_hidden(name)]
        for topic in sorted(self._wanted.names - set(self._direct_node.topics())):
            near = did_you_mean(topic, there)
            tell(self.name, f"No node has the topic '{topic}' yet.{near}", "WARN")
