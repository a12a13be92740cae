"""Looks at the running graph for the doctor: prints pairs that cannot exchange messages.

Run as a program by the Python that has ROS; nothing of ours is imported. Each line printed is a
JSON object: {"topic", "publisher", "subscription", "why"}, and a last one: {"topics": COUNT}.
"""

import json
import sys
import time
from collections.abc import Iterator

import rclpy
from rclpy.node import Node
from rclpy.qos import (
    QoSCompatibility,
    qos_check_compatible,
)

OWN = "doctor_observer"


def clashes(node: Node, topic: str) -> Iterator[dict[str, str]]:
    """Yield each publisher and subscription of `topic` whose settings cannot match."""
    hearers = node.get_subscriptions_info_by_topic(topic)
    for speaker in node.get_publishers_info_by_topic(topic):
        for hearer in hearers:
            verdict, why = qos_check_compatible(speaker.qos_profile, hearer.qos_profile)
            if verdict == QoSCompatibility.ERROR:
                yield {
                    "topic": topic,
                    "publisher": speaker.node_name,
                    "subscription": hearer.node_name,
                    "why": why,
                }


def main(seconds: float) -> None:
    """Look for `seconds`, so that discovery can finish, then print what was seen."""
    rclpy.init(args=[])
    node = Node(OWN, enable_rosout=False, start_parameter_services=False)
    time.sleep(seconds)
    topics = [name for name, _ in node.get_topic_names_and_types()]
    for topic in topics:
        for clash in clashes(node, topic):
            print(json.dumps(clash), flush=True)
    print(json.dumps({"topics": len(topics)}), flush=True)
    rclpy.try_shutdown()


if __name__ == "__main__":
    main(float(sys.argv[1]))
