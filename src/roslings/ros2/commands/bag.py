"""`ros2 bag`: record what is said, play it again, look into a bag."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from roslings.ros2.problem import Problem
from roslings.ros2.qos import DEFAULT_DEPTH, add_qos_options
from roslings.ros2.shared_options import complete_topics
from roslings.ros2.words import Verbs, add, rate, seconds

ABSENT = ("burst", "convert", "list", "reindex")


class NoRosbags(Problem):
    """The Python package that reads and writes bags is not installed."""

    def __init__(self) -> None:
        super().__init__(
            "ros2 bag needs the Python package rosbags, which is not installed here."
            " In this environment type: pip install rosbags"
        )


def declare(command: argparse.ArgumentParser) -> None:
    """The verbs."""
    verbs = Verbs(command, ABSENT)
    _declare_record(verbs)
    play = verbs("play", "Play back ROS data from a bag", _from("play", "play"))
    _bag_path(play)
    play.add_argument("-r", "--rate", type=rate, default=1.0, help="rate at which to play back")
    play.add_argument("-l", "--loop", action="store_true", help="play again and again")
    play.add_argument("--topics", nargs="+", default=[], help="topics to replay")
    play.add_argument(
        "--start-offset", type=seconds, default=0.0, help="start this many seconds into the bag"
    )
    play.add_argument("-d", "--delay", type=seconds, default=0.0, help="sleep before play, in s")
    info = verbs("info", "Print information about a bag to the screen", _from("info", "show_info"))
    _bag_path(info)


def _declare_record(verbs: Verbs) -> None:
    record = verbs("record", "Record ROS data to a bag", _from("record", "record"))
    add(record, "topics", nargs="*", complete=complete_topics, help="List of topics to record")
    add(
        record, "--topics", nargs="+", dest="topics_option", complete=complete_topics,
        help="Space-delimited list of topics to record",
    )  # fmt: skip
    record.add_argument("-a", "--all", action="store_true", help="Record all topics")
    record.add_argument("-o", "--output", help="Destination of the bag to create, a folder")
    record.add_argument(
        "-s", "--storage", choices=("mcap", "sqlite3"), default="mcap",
        help="Storage format (default: mcap)",
    )  # fmt: skip
    add_qos_options(record, "subscribe")
    record.set_defaults(qos_depth=100 * DEFAULT_DEPTH)


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
        return int(getattr(import_module(f"roslings.ros2.bag.{module}"), function)(options))

    return call
