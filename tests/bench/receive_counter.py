"""A rate by the times of receiving, with a queue of five messages: `receive_counter FILE`."""

from __future__ import annotations

import signal
import sys
import time
from pathlib import Path

import rclpy
from std_msgs.msg import String

heard_s: list[float] = []


def finish(*_: object) -> None:
    """Write the rate, and end."""
    span_s = heard_s[-1] - heard_s[0] if len(heard_s) > 1 else 0.0
    Path(sys.argv[1]).write_text(str((len(heard_s) - 1) / span_s) if span_s else "nan")
    sys.exit()


rclpy.init(signal_handler_options=rclpy.signals.SignalHandlerOptions.NO)
signal.signal(signal.SIGTERM, finish)
node = rclpy.create_node("_counter")
node.create_subscription(String, "/chatter", lambda _: heard_s.append(time.monotonic()), 5)
while True:
    rclpy.spin_once(node, timeout_sec=0.1)
