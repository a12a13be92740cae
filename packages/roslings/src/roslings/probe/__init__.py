"""Watch a ROS graph and speak to it. Knows messages and nodes; knows no points, no processes.

`rclpy` is imported here, and only when a probe is opened.
"""

from roslings.probe.probe import Probe

__all__ = ["Probe"]
