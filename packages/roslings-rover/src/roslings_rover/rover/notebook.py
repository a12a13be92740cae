"""The rover in a notebook: a node that runs beside the cells, and its map as a picture.

from roslings_rover.rover.notebook import start
rover = start()     # one cell: the node runs from now on
rover               # another cell: the map as it is now
rover.stop()        # the last cell
"""

from __future__ import annotations

import os
import threading
from contextlib import ExitStack

from roslings_rover.models.differential_drive import Pose
from roslings_rover.rover.in_room import Bump, RoomRover
from roslings_rover.rover.made import rover_in
from roslings_rover.rover.moving_map import moving_map
from roslings_rover.rover.one_rover import rover_of_cell
from roslings_rover.rover.room_node import node_for
from roslings_rover.rover.rover import Moment, Rover


class LiveRover:
    """A rover whose node runs in a thread. Also a context manager, which stops it at its end."""

    def __init__(self, rover: Rover, tf: bool = False) -> None:
        self._rover, self._tf = rover, tf
        self._alone = ExitStack()
        self._alone.enter_context(rover_of_cell())
        self._stopping = threading.Event()
        self._ready = threading.Event()
        self._thread = threading.Thread(target=self._run, name="rover", daemon=True)
        self._thread.start()
        self._ready.wait()

    def __enter__(self) -> LiveRover:
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    @property
    def pose(self) -> Pose:
        """Where it is now."""
        return self._rover.pose

    @property
    def bumps(self) -> list[Bump]:
        """When and where it ran into something; counted in a room from a seed alone."""
        return list(self._rover.bumps) if isinstance(self._rover, RoomRover) else []

    def stop(self) -> None:
        """End the node. The map stays."""
        self._stopping.set()
        self._thread.join()
        self._alone.close()

    @property
    def trail(self) -> list[Moment]:
        """Where it has been, and when; the last moment is now."""
        rover = self._rover
        return [*rover.trail, Moment(rover.time_s, rover.pose)]

    def map(self, moves: bool = True) -> str:
        """The map as an SVG file, in which the drive until now is seen once more if it `moves`."""
        rover = self._rover
        return moving_map(rover.world, self.trail, rover.body.radius_m, moves=moves)

    def _repr_svg_(self) -> str:
        """Jupyter shows what a cell ends with through this."""
        return self.map()

    def _run(self) -> None:
        try:
            with node_for(self._rover, tf=self._tf) as node:
                self._ready.set()
                while not self._stopping.is_set():
                    node.turn()
        finally:
            self._ready.set()


def start(seed: int = 0, tf: bool = False, room: int | None = None) -> LiveRover:
    """Start a rover; with `tf` it publishes /tf, where tf2_msgs is installed.

    `room` is the seed of a room that it is in; `seed` is that of its sensors' noise. Without a word
    about the range, only this computer hears it. Raises NoSeed and
    RoverThere.
    """
    os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    return LiveRover(rover_in(room, seed), tf)
