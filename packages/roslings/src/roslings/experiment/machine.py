"""The machine and the versions that do the measuring."""

from __future__ import annotations

import os
import platform

import roslings
from roslings.arena import Wall
from roslings.evidence import HeldBy, MachineSeen


def look_at_machine(wall: Wall, held_by: HeldBy | None = None) -> MachineSeen:
    """What an appeal needs to know to measure again in the same way."""
    return MachineSeen(
        roslings=roslings.__version__,
        ros_distro=os.environ.get("ROS_DISTRO", "jazzy"),
        rmw=os.environ.get("RMW_IMPLEMENTATION", ""),
        python=platform.python_version(),
        platform=f"{platform.system()} {platform.release()} {platform.machine()}",
        isolation=wall,
        wall=held_by,
    )
