"""Script: a talker that is known to be good; where it is late, the computer is to blame.

    python canary.py HZ

It runs beside the student's nodes, in their domain, as a process of its own like theirs. It imports
nothing of ours, for it must be there before a node that crashes soon has crashed.
"""

from __future__ import annotations

import sys
from pathlib import Path

NODE, TOPIC, TYPE = "_roslings_canary", "/_roslings_canary", "std_msgs/msg/Empty"


def main(hz: float) -> None:
    """Sing until the process is ended."""
    import rclpy
    from rclpy.node import Node
    from rclpy.parameter import Parameter
    from std_msgs.msg import Empty

    rclpy.init(args=["--ros-args", "--disable-external-lib-logs"])
    plain = [Parameter("start_type_description_service", value=False)]
    node = Node(
        NODE, enable_rosout=False, start_parameter_services=False, parameter_overrides=plain
    )
    publisher = node.create_publisher(Empty, TOPIC, 10)
    node.create_timer(1 / hz, lambda: publisher.publish(Empty()))
    rclpy.spin(node)


if __name__ == "__main__":
    sys.path[0] = str(Path(__file__).parents[1] / "arena")
    import kernel  # type: ignore[import-not-found]

    del sys.path[0]
    kernel.die_with_parent()
    main(float(sys.argv[1]))
