"""The site's page on frames: the node that it shows, beside a robot that drives, and its errors."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator
from typing import Any

import pytest
import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time
from sensor_msgs.msg import LaserScan

from ros2_on_pip.domain_lease import leased_domain
from ros2_on_pip.stand_ins._frames import errors
from skips import needs
from sources import ROOT

PAGE = (ROOT / "site/pages/reference/tf-and-scan.md").read_text("utf-8")
IN_A_NODE = PAGE.partition("## In a node")[2].partition("\n## ")[0]
LASER_HEIGHT_M = 0.15
MANY = 300
"""Turns of the robot; only a test that fails takes them all."""
TURN_NS, STEP_NS, SCAN_NS = 100_000_000, 50_000_000, 25_000_000

NODE = """
{imports}

class Looker(Node):
    def __init__(self, found, **options):
        super().__init__("looker", **options)
        self.found = found
        self.create_subscription(LaserScan, "scan", self.look, 10)
{made}

{look}
        self.found.append(found)
"""


def looker(found: list[Any], context: Any) -> Any:
    """The page's node; it appends what it has found."""
    made, look = re.findall(r"```python\n(.*?)```", IN_A_NODE, re.DOTALL)
    imports, _, made = made.partition("\n\n")
    text = NODE.format(
        imports=imports,
        made=textwrap.indent(made, " " * 8),
        look=textwrap.indent(look.rstrip(), " " * 4),
    )
    names: dict[str, Any] = {"Node": Node, "LaserScan": LaserScan}
    exec(text, names)
    return names["Looker"](found, context=context)


@pytest.fixture
def context() -> Iterator[Any]:
    """On a domain of its own."""
    with leased_domain() as domain:
        made = rclpy.Context()
        rclpy.init(context=made, domain_id=domain)
        yield made
        made.try_shutdown()


@needs("module tf2_msgs")
def test_the_node_of_the_page_finds_each_scan(context: Any) -> None:
    """Also where the step for a scan's time comes after the scan, as it does from a robot."""
    import tf2_ros

    found: list[Any] = []
    node, robot = looker(found, context), rclpy.create_node("robot", context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    executor.add_node(robot)
    broadcaster = tf2_ros.TransformBroadcaster(robot)
    mounted = TransformStamped(child_frame_id="laser")
    mounted.header.frame_id, mounted.transform.rotation.w = "base_link", 1.0
    mounted.transform.translation.z = LASER_HEIGHT_M
    fixed = tf2_ros.StaticTransformBroadcaster(robot)
    fixed.sendTransform(mounted)
    scans = robot.create_publisher(LaserScan, "scan", 10)
    for turn in range(MANY):
        if len(found) >= 3:
            break
        drive(broadcaster, scans, 10**18 + turn * TURN_NS)
        for _ in range(4):
            executor.spin_once(timeout_sec=0.01)
    assert len(found) >= 3, "nothing was found"
    for each in found:  # between two steps
        assert each.header.stamp.nanosec % TURN_NS == SCAN_NS
        assert each.header.frame_id == "odom"
        assert each.transform.translation.z == LASER_HEIGHT_M


def drive(broadcaster: Any, scans: Any, now_ns: int) -> None:
    """Two steps, as often as the rover says them, and a scan between their times."""
    for at_ns in (now_ns, now_ns + STEP_NS):
        moved = TransformStamped(child_frame_id="base_link")
        moved.header.frame_id, moved.header.stamp = "odom", Time(nanoseconds=at_ns).to_msg()
        broadcaster.sendTransform(moved)
    scan = LaserScan()
    scan.header.frame_id = "laser"
    scan.header.stamp = Time(nanoseconds=now_ns + SCAN_NS).to_msg()
    scans.publish(scan)


def test_its_errors_are_those_of_a_look_up() -> None:
    """Each row of its table has words of a text."""
    rows = re.findall(r"^\| `(.*?)` \| ", IN_A_NODE, re.MULTILINE)
    texts = [
        text for name, text in vars(errors).items() if name.isupper() and isinstance(text, str)
    ]
    known = [text.format_map(Shown()) for text in texts]
    assert len(rows) == 4
    for row in rows:
        words = row.strip(". ")
        assert any(words in text for text in known), row


class Shown(dict[str, str]):
    """The page's example where a text has a gap."""

    def __missing__(self, key: str) -> str:
        return {"frame": "map", "argument": "lookupTransform argument target_frame"}.get(key, "")
