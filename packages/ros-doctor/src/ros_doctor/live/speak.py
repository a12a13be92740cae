"""A talker for the doctor: says one word on one topic until its standard input closes.

Run as a program by the Python that has ROS; nothing of ours is imported.
The standard input is the leash: when the doctor ends, even by force, the pipe closes.
"""

import select
import sys

import rclpy
from rclpy.node import Node
from std_msgs.msg import String

PERIOD_S = 0.05


def main(topic: str, word: str) -> None:
    """Publish `word` on `topic` 20 times a second while the doctor holds the leash."""
    rclpy.init(args=[])
    node = Node("doctor_talker", enable_rosout=False, start_parameter_services=False)
    publisher = node.create_publisher(String, topic, 10)
    while not select.select([sys.stdin], [], [], PERIOD_S)[0]:
        publisher.publish(String(data=word))
    rclpy.try_shutdown()


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
