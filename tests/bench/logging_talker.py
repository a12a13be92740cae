"""A talker that writes down when it spoke, by its own monotonic clock: `talker HZ FILE`."""

from __future__ import annotations

import sys
import time
from pathlib import Path

import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String

sent_ns: list[int] = []
rclpy.init()
node = rclpy.create_node("talker")
voice = node.create_publisher(String, "chatter", 1000)


def talk() -> None:
    """One message."""
    sent_ns.append(time.monotonic_ns())
    voice.publish(String(data=f"Hello {len(sent_ns)}"))


node.create_timer(1 / float(sys.argv[1]), talk)
try:
    rclpy.spin(node)
except (KeyboardInterrupt, ExternalShutdownException):
    pass
finally:
    Path(sys.argv[2]).write_text("\n".join(map(str, sent_ns)))
    rclpy.try_shutdown()
