"""The course's environment has the messages that apt's Jazzy brings."""

from __future__ import annotations

import importlib

import pytest

COMMON_INTERFACES = (
    "actionlib_msgs",
    "diagnostic_msgs",
    "geometry_msgs",
    "nav_msgs",
    "sensor_msgs",
    "shape_msgs",
    "std_msgs",
    "std_srvs",
    "stereo_msgs",
    "trajectory_msgs",
    "visualization_msgs",
)


@pytest.mark.parametrize("package", COMMON_INTERFACES)
def test_each_of_the_common_interfaces_is_there(package: str) -> None:
    """What apt's ros-jazzy-common-interfaces brings, the wheels bring, too."""
    kind = "srv" if package == "std_srvs" else "msg"
    assert importlib.import_module(f"{package}.{kind}")
