"""`ros2 bag`: record what is said, play it again, look into a bag."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from ros2_on_pip.problem import CommandProblem
from ros2_on_pip.shared_options import also_hidden, complete_topics
from ros2_on_pip.words import Verbs, add, not_negative, positive, rate, seconds

ABSENT = {
    "burst": "ros2 bag play --start-paused BAG, and the right arrow for each message",
    "convert": "a Python program with rosbag2_py.SequentialReader and SequentialWriter",
    "list": "the storages are mcap and sqlite3, the compression is zstd",
}
"""Verb to what does the same here."""


class NoRosbags(CommandProblem):
    """The Python package that reads and writes bags is not installed."""

    def __init__(self) -> None:
        super().__init__(
            "ros2 bag needs the Python package rosbags, which is not installed here."
            " In this environment type: pip install rosbags"
        )


def declare(command: argparse.ArgumentParser) -> None:
    """The verbs."""
    verbs = Verbs(command, ABSENT)
    _declare_record(verbs("record", "Record ROS data to a bag", _from("record", "record")))
    _declare_play(verbs("play", "Play back ROS data from a bag", _from("play", "play")))
    info = verbs("info", "Print information about a bag to the screen", _from("info", "show_info"))
    _bag_path(info)
    info.add_argument("-t", "--topic-name", action="store_true", help="Only display topic names")
    info.add_argument(
        "-v",
        "--verbose",
        action="store_true",
        help="Display request/response information for services",
    )
    info.add_argument(
        "--sort", choices=("name", "type", "count"), default="name", help="The order of the topics"
    )
    reindex = verbs(
        "reindex", "Reconstruct metadata file for a bag", _from("reindex", "reindex_bag")
    )
    _bag_path(reindex)


def _declare_record(record: argparse.ArgumentParser) -> None:
    _declare_topics(record)
    _declare_bag(record)
    record.add_argument(
        "--qos-profile-overrides-path",
        type=Path,
        metavar="FILE",
        help="YAML file with the quality of service to subscribe with, for single topics",
    )
    record.add_argument(
        "--use-sim-time",
        action="store_true",
        help="Take the time of messages from /clock; until it is said, nothing is recorded",
    )
    record.add_argument(
        "--start-paused", action="store_true", help="Start the recorder in a paused state"
    )
    record.add_argument(
        "--node-name", default="rosbag2_recorder", help="Name of the node (%(default)s)"
    )
    _no_keyboard(record)


def _declare_topics(record: argparse.ArgumentParser) -> None:
    add(
        record,
        "topics",
        nargs="*",
        complete=complete_topics,
        help="Topics to record (old way; use --topics)",
    )
    add(
        record,
        "--topics",
        nargs="+",
        dest="topics_option",
        default=[],
        metavar="TOPIC",
        complete=complete_topics,
        help="Space-delimited list of topics to record",
    )
    _list(record, "--topic-types", "TYPE", "Space-delimited list of topic types to record")
    for names in (("-a", "--all"), ("--all-topics",)):
        record.add_argument(*names, action="store_true", help="Record all topics")
    record.add_argument(
        "-e", "--regex", default="", help="Record topics whose name holds this expression"
    )
    record.add_argument(
        "--exclude-regex",
        default="",
        metavar="REGEX",
        help="Leave out topics whose name holds this expression",
    )
    _list(record, "--exclude-topics", "TOPIC", "Space-delimited list of topics to leave out")
    _list(record, "--exclude-topic-types", "TYPE", "Space-delimited list of types to leave out")
    record.add_argument(
        "--include-unpublished-topics",
        action="store_true",
        help="Record topics which have no publisher too",
    )
    also_hidden(record, "topics")
    record.set_defaults(include_hidden_topics=False)
    record.add_argument(
        "--ignore-leaf-topics", action="store_true", help="Ignore topics without a subscription"
    )
    record.add_argument(
        "--no-discovery", action="store_true", help="Record only topics present at startup"
    )
    record.add_argument(
        "-p",
        "--polling-interval",
        type=positive,
        default=100,
        dest="polling_interval_ms",
        metavar="MS",
        help="Time in ms between two looks for new topics (%(default)s)",
    )


def _declare_bag(record: argparse.ArgumentParser) -> None:
    record.add_argument("-o", "--output", help="Destination of the bag to create, a folder")
    record.add_argument(
        "-s",
        "--storage",
        choices=("mcap", "sqlite3"),
        default="mcap",
        help="Storage format (default: mcap)",
    )
    record.add_argument(
        "-b",
        "--max-bag-size",
        type=not_negative,
        default=0,
        metavar="BYTES",
        help="Begin a new file after so many bytes (default: one file)",
    )
    record.add_argument(
        "-d",
        "--max-bag-duration",
        type=not_negative,
        default=0,
        metavar="S",
        help="Begin a new file after so many seconds (default: one file)",
    )
    record.add_argument(
        "--compression-mode",
        choices=("none", "file", "message"),
        default="none",
        help="Compress whole files, or each message",
    )
    record.add_argument(
        "--compression-format", choices=("zstd",), default="", help="How it is compressed"
    )
    record.add_argument(
        "--custom-data",
        nargs="*",
        default=[],
        metavar="KEY=VALUE",
        help="Words of your own that metadata.yaml keeps",
    )


def _declare_play(play: argparse.ArgumentParser) -> None:
    _bag_path(play)
    play.add_argument("-r", "--rate", type=rate, default=1.0, help="rate at which to play back")
    play.add_argument("-l", "--loop", action="store_true", help="play again and again")
    _list(play, "--topics", "TOPIC", "topics to replay")
    play.add_argument("-e", "--regex", default="", help="replay topics whose whole name fits")
    play.add_argument(
        "-x",
        "--exclude-regex",
        default="",
        metavar="REGEX",
        help="leave out topics whose whole name fits",
    )
    _list(play, "--exclude-topics", "TOPIC", "topics to leave out")
    play.add_argument(
        "-m", "--remap", nargs="+", default=[], metavar="OLD:=NEW", help="other names for topics"
    )
    play.add_argument(
        "--qos-profile-overrides-path",
        type=Path,
        metavar="FILE",
        help="YAML file with the quality of service to publish with, for single topics",
    )
    _declare_time(play)
    play.add_argument(
        "-p", "--start-paused", action="store_true", help="start paused; the space bar goes on"
    )
    _no_keyboard(play)


def _declare_time(play: argparse.ArgumentParser) -> None:
    play.add_argument(
        "--clock",
        type=rate,
        nargs="?",
        const=40.0,
        default=0.0,
        metavar="HZ",
        help="publish the bag's time on /clock, so many times a second (40)",
    )
    play.add_argument(
        "--start-offset",
        type=seconds,
        default=0.0,
        metavar="S",
        help="start this many seconds into the bag",
    )
    play.add_argument(
        "--playback-duration",
        type=float,
        default=-1.0,
        metavar="S",
        help="play this many seconds of the bag (default: all)",
    )
    play.add_argument(
        "-d", "--delay", type=seconds, default=0.0, metavar="S", help="sleep before play, in s"
    )
    play.add_argument(
        "--wait-for-all-acked",
        type=int,
        default=-1,
        metavar="MS",
        help="at the end, wait so many ms until each message has arrived (0: for ever)",
    )


def _list(parser: argparse.ArgumentParser, name: str, one: str, about: str) -> None:
    complete = complete_topics if one == "TOPIC" else None
    add(parser, name, nargs="+", default=[], metavar=one, complete=complete, help=about)


def _no_keyboard(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--disable-keyboard-controls", action="store_true", help="read no keys from the terminal"
    )


def _bag_path(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("bag_path", type=Path, help="Bag to open")
    parser.add_argument("-s", "--storage", help=argparse.SUPPRESS)  # it is read from the bag


def _from(module: str, function: str) -> Any:
    """A function that needs `rosbags`, imported when it is called."""

    def call(options: argparse.Namespace) -> int:
        from importlib import import_module
        from importlib.util import find_spec

        if find_spec("rosbags") is None:
            raise NoRosbags
        return int(getattr(import_module(f"ros2_on_pip.bag.{module}"), function)(options))

    return call
