"""A node that tells what a launch made of it, and ends; `stay` lets it stay, `die` fails.

Its line on standard error: `told {"node": ..., "topic": ..., "parameters": ..., ...}`.
"""

from __future__ import annotations

import json
import os
import sys
from contextlib import suppress
from typing import Any

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.utilities import remove_ros_args

OURS = ("use_sim_time", "start_type_description_service")
"""Every node has these."""


def told(node: Node, words: list[str]) -> dict[str, Any]:
    """What it is called, what it would publish on, and what it was given."""
    given = {
        name: list(one.value) if hasattr(one.value, "tolist") else one.value
        for name, one in node.get_parameters_by_prefix("").items()
        if name not in OURS or (name == "use_sim_time" and one.value)
    }
    said = {
        "node": node.get_fully_qualified_name(),
        "topic": node.resolve_topic_name("topic"),
        "parameters": dict(sorted(given.items())),
        "words": words,
        "mood": os.environ.get("MOOD"),
    }
    return {key: value for key, value in said.items() if value}


def main() -> None:
    """Tell, and end or stay."""
    rclpy.init(args=sys.argv)
    node = Node("teller", automatically_declare_parameters_from_overrides=True)
    words = remove_ros_args(sys.argv)[1:]
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        print("told " + json.dumps(told(node, words)), file=sys.stderr, flush=True)
        print("printed", flush=True)
        if "stay" in words:
            rclpy.spin(node)
    rclpy.try_shutdown()
    sys.exit(3 if "die" in words else 0)


if __name__ == "__main__":
    main()
