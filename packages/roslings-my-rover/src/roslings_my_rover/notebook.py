"""Your rover in a notebook: it runs beside the cells, and its map is a picture.

from roslings_my_rover.notebook import start
rover = start()     # builds and starts your parts; the rover runs from now on
rover               # another cell: the map as it is now
rover.stop()        # the last cell
"""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator
from contextlib import contextmanager

from roslings_my_rover.assembled import Assembled, RoverOptions, assembled, started
from roslings_my_rover.chosen import ChosenParts, NoPart, chosen
from roslings_rover.rover.live_map import LiveMap
from roslings_rover.rover.rover import Rover
from roslings_rover.rover.text_map import DrawnWalls


class LiveMyRover(LiveMap[Assembled]):
    """A rover of parts: its node, and their programs."""

    def __init__(self, choice: ChosenParts, wish: RoverOptions) -> None:
        super().__init__("my rover", _running(choice, wish))

    @property
    def _rover(self) -> Rover:
        return self._turned.node.rover

    @property
    def _drawn_walls(self) -> DrawnWalls | None:
        return self._turned.node.drawn_walls

    @property
    def parts(self) -> list[str]:
        """A line each: `voice`, `pace     60 of 100`, `no eyes yet: day 7`."""
        return [*self._turned.node.about_parts]

    @property
    def says(self) -> str:
        """What it says over its head; empty where it says nothing."""
        sentence = self._turned.node.sentence
        return sentence.text if sentence else ""

    @property
    def news(self) -> str:
        """What has just happened to a part; empty where all is well."""
        return self._turned.node.notice


@contextmanager
def _running(choice: ChosenParts, wish: RoverOptions) -> Iterator[Assembled]:
    """Built, with all programs started; what cannot be built is printed."""
    with assembled(choice, wish, print, print) as made, started(made):
        yield made


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
    return LiveMyRover(choice, RoverOptions(follows=follow, seed=seed))
