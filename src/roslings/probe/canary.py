"""Script: a talker that is known to be good; where it is late, the computer is to blame.

    python -m roslings.probe.canary HZ

It runs beside the student's nodes, in their domain, as a process of its own like theirs.
"""

from __future__ import annotations

import sys

from roslings.evidence import Endpoint, Qos

NODE, TOPIC, TYPE = "_roslings_canary", "/_roslings_canary", "std_msgs/msg/Empty"


def endpoint() -> Endpoint:
    """Where the canary is heard."""
    return Endpoint(
        kind="publisher", node=f"/{NODE}", topic=TOPIC, type=TYPE, qos=Qos(), gid="canary"
    )


def main(hz: float) -> None:
    """Sing until the process is ended."""
    import rclpy
    from rclpy.node import Node
    from std_msgs.msg import Empty

    rclpy.init(args=["--ros-args", "--disable-external-lib-logs"])
    node = Node(NODE, enable_rosout=False, start_parameter_services=False)
    publisher = node.create_publisher(Empty, TOPIC, 10)
    node.create_timer(1 / hz, lambda: publisher.publish(Empty()))
    rclpy.spin(node)


if __name__ == "__main__":
    from roslings.arena import kernel

    kernel.die_with_parent()
    main(float(sys.argv[1]))
