"""The rover in a notebook: a node that runs beside the cells, and its map as a picture.

from roslings_rover.rover.notebook import start
rover = start()     # one cell: the node runs from now on
rover               # another cell: the map as it is now
rover.stop()        # the last cell
"""

from __future__ import annotations

import os

from roslings_rover.models.differential_drive import Pose
from roslings_rover.rover.frames import FrameOptions
from roslings_rover.rover.in_room import Bump, RoomRover
from roslings_rover.rover.live_map import LiveMap
from roslings_rover.rover.made import rover_in
from roslings_rover.rover.node import RoverNode
from roslings_rover.rover.room_node import node_for
from roslings_rover.rover.rover import Rover


class LiveRover(LiveMap[RoverNode]):
    """The course's rover, and its node."""

    def __init__(self, rover: Rover, frames: FrameOptions) -> None:
        super().__init__("rover", node_for(rover, frames))

    @property
    def _rover(self) -> Rover:
        return self._turned.rover

    @property
    def odom_pose(self) -> Pose:
        """Where /odom says that it is; `pose` is the truth."""
        return self._turned.odometer.pose

    @property
    def publishes_tf(self) -> bool:
        """It says its frames on /tf and /tf_static."""
        return self._turned.publishes_tf

    @property
    def bumps(self) -> list[Bump]:
        """When and where it ran into something; counted in a room from a seed alone."""
        return list(self._rover.bumps) if isinstance(self._rover, RoomRover) else []


def start(
    seed: int = 0,
    tf: bool = True,
    room: int | None = None,
    drift_percent: float = 0.0,
    map_frame: bool = False,
) -> LiveRover:
    """Start a rover; with `tf` it publishes /tf and /tf_static, where tf2_msgs is installed.

    `room` is the seed of a room that it is in; `seed` is that of its sensors' noise. By
    `drift_percent` /odom counts too much; `map_frame` says on /tf what puts it right. Without a
    word about the range, only this computer hears it. Raises NoSeed and RoverThere.
    """
    os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    return LiveRover(rover_in(room, seed), FrameOptions(tf, drift_percent, map_frame))
