"""A rover that runs beside the cells of a notebook; where a cell ends with it, its map is shown."""

from __future__ import annotations

import threading
from abc import ABC, abstractmethod
from contextlib import AbstractContextManager, ExitStack
from typing import Any, Generic, Protocol, TypeVar

from roslings_rover.models.differential_drive import Pose
from roslings_rover.rover.moving_map import moving_map
from roslings_rover.rover.one_rover import rover_of_cell
from roslings_rover.rover.rover import Rover, RoverMoment
from roslings_rover.rover.text_map import DrawnWalls


class Turned(Protocol):
    """Something that runs as long as it is given turns."""

    def turn(self) -> None:
        """Do the next thing that is due."""
        ...


T = TypeVar("T", bound=Turned)
Live = TypeVar("Live", bound="LiveMap[Any]")


class LiveMap(ABC, Generic[T]):
    """Runs in a thread. Also a context manager, which stops it at its end."""

    def __init__(self, name: str, opening: AbstractContextManager[T]) -> None:
        """`opening` gives what turns. Raises RoverThere, and what `opening` raises."""
        self._stopping = threading.Event()
        with ExitStack() as stack:
            stack.enter_context(rover_of_cell())
            self._turned = stack.enter_context(opening)
            self._thread = threading.Thread(target=self._run, name=name, daemon=True)
            self._thread.start()
            self._running = stack.pop_all()

    def __enter__(self: Live) -> Live:
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    @property
    @abstractmethod
    def _rover(self) -> Rover:
        """What moves."""

    @property
    def _drawn_walls(self) -> DrawnWalls | None:
        """What somebody has drawn of the room; None where nobody draws."""
        return None

    @property
    def pose(self) -> Pose:
        """Where it is now."""
        return self._rover.pose

    @property
    def trail(self) -> list[RoverMoment]:
        """Where it has been, and when; the last moment is now."""
        rover = self._rover
        return [*rover.trail, RoverMoment(rover.time_s, rover.pose)]

    def map(self, moves: bool = True) -> str:
        """The map as an SVG file, in which the drive until now is seen once more if it `moves`."""
        rover, walls = self._rover, self._drawn_walls
        return moving_map(rover.world, self.trail, rover.body.radius_m, moves=moves, drawn=walls)

    def stop(self) -> None:
        """End it. The map stays."""
        self._stopping.set()
        self._thread.join()
        self._running.close()

    def _repr_svg_(self) -> str:
        """Jupyter shows what a cell ends with through this."""
        return self.map()

    def _run(self) -> None:
        while not self._stopping.is_set():
            self._turned.turn()
