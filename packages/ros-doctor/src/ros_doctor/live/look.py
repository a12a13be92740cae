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
NAMELESS = "_NODE_NAME_UNKNOWN_"  # what rcl says until discovery has brought the name
STEP_S = 0.05
SETTLING_S = 0.3  # endpoints come a little after their nodes


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


def main(expected: int, seconds: float) -> None:
    """Look until `expected` nodes are seen, at most `seconds`; print what was seen."""
    rclpy.init(args=[])
    node = Node(OWN, enable_rosout=False, start_parameter_services=False)
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline and not complete(node, expected):
        time.sleep(STEP_S)
    time.sleep(SETTLING_S)
    topics = [name for name, _ in node.get_topic_names_and_types()]
    for topic in topics:
        for clash in clashes(node, topic):
            print(json.dumps(clash), flush=True)
    print(json.dumps({"topics": len(topics)}), flush=True)
    rclpy.try_shutdown()


def complete(node: Node, expected: int) -> bool:
    """Tell whether every expected node is there, and the name of every endpoint is known."""
    if len([name for name in node.get_node_names() if name != OWN]) < expected:
        return False
    ends = [
        end
        for topic, _ in node.get_topic_names_and_types()
        for look in (node.get_publishers_info_by_topic, node.get_subscriptions_info_by_topic)
        for end in look(topic)
    ]
    return all(end.node_name != NAMELESS for end in ends)


if __name__ == "__main__":
    main(int(sys.argv[1]), float(sys.argv[2]))
