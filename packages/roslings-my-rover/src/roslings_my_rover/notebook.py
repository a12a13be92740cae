"""Your rover in a notebook: it runs beside the cells, and its map is a picture.

from roslings_my_rover.notebook import start
rover = start()     # builds and starts your parts; the rover runs from now on
rover               # another cell: the map as it is now
rover.stop()        # the last cell
"""

from __future__ import annotations

import os
import threading
from collections.abc import Collection
from contextlib import ExitStack

from roslings_my_rover.assembled import Assembled, Wish, assembled, started
from roslings_my_rover.chosen import Choice, NoPart, chosen
from roslings_rover.models.differential_drive import Pose
from roslings_rover.rover.moving_map import moving_map
from roslings_rover.rover.one_rover import rover_of_cell
from roslings_rover.rover.rover import Moment


class LiveMyRover:
    """A rover of parts that runs in a thread. Also a context manager, which stops it at its end."""

    def __init__(self, choice: Choice, wish: Wish) -> None:
        self._running, self._stopping = ExitStack(), threading.Event()
        with ExitStack() as stack:
            stack.enter_context(rover_of_cell())
            self._made: Assembled = stack.enter_context(assembled(choice, wish, print, print))
            stack.enter_context(started(self._made))
            self._thread = threading.Thread(target=self._run, name="my rover", daemon=True)
            self._thread.start()
            self._running = stack.pop_all()

    def __enter__(self) -> LiveMyRover:
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    @property
    def pose(self) -> Pose:
        """Where it is now."""
        return self._made.node.rover.pose

    @property
    def parts(self) -> list[str]:
        """A line each: `voice`, `pace     60 of 100`, `no eyes yet: day 7`."""
        return [*self._made.node.about_parts]

    @property
    def says(self) -> str:
        """What it says over its head; empty where it says nothing."""
        sentence = self._made.node.sentence
        return sentence.text if sentence else ""

    @property
    def news(self) -> str:
        """What has just happened to a part; empty where all is well."""
        return self._made.node.notice

    @property
    def trail(self) -> list[Moment]:
        """Where it has been, and when; the last moment is now."""
        rover = self._made.node.rover
        return [*rover.trail, Moment(rover.time_s, rover.pose)]

    def map(self, moves: bool = True) -> str:
        """The map as an SVG file, in which the drive until now is seen once more if it `moves`."""
        rover = self._made.node.rover
        return moving_map(rover.world, self.trail, rover.body.radius_m, moves=moves)

    def stop(self) -> None:
        """End the node and all parts. The map stays."""
        self._stopping.set()
        self._thread.join()
        self._running.close()

    def _repr_svg_(self) -> str:
        """Jupyter shows what a cell ends with through this."""
        return self.map()

    def _run(self) -> None:
        while not self._stopping.is_set():
            self._made.turn()


def start(
    day: int | None = None,
    *,
    borrow: Collection[int] = (),
    todays: bool = False,
    follow: bool = False,
    seed: int = 0,
) -> LiveMyRover:
    """Build and start the parts, those up to a `day`; returns when all programs are started.

    The options are those of `./roslings my-rover`. Without a word about the range, only this
    computer hears it. Raises NoPart, CannotBorrow, RoverThere, and what a build raises.
    """
    os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    choice = chosen(day, borrow, todays)
    if not choice.there:
        raise NoPart
    return LiveMyRover(choice, Wish(follows=follow, seed=seed))
