"""A listener for the doctor: prints HEARD when the expected word arrives, then ends.

Run as a program by the Python that has ROS; nothing of ours is imported.
"""

import select
import sys

import rclpy
from rclpy.node import Node
from std_msgs.msg import String

PERIOD_S = 0.1


def main(topic: str, word: str) -> None:
    """Wait for `word` on `topic` while the doctor holds the leash (the standard input)."""
    rclpy.init(args=[])
    node = Node("doctor_listener", enable_rosout=False, start_parameter_services=False)
    heard: list[str] = []
    node.create_subscription(String, topic, lambda message: heard.append(message.data), 10)
    while word not in heard and not select.select([sys.stdin], [], [], 0)[0]:
        rclpy.spin_once(node, timeout_sec=PERIOD_S)
    if word in heard:
        print("HEARD", flush=True)
    rclpy.try_shutdown()


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
