"""Run my rover: its parts are built and started, its map is shown, until Ctrl-C."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager

from roslings.report.progress import Progress
from roslings_my_rover.assembled import Assembled, Wish, assembled, started
from roslings_my_rover.chosen import Choice
from roslings_my_rover.drive_bag import kept, require_place
from roslings_my_rover.hands import TOLD, hands
from roslings_rover.asked import listening
from roslings_rover.rover.displays import Display, View, opened
from roslings_rover.rover.one_rover import rover_of_terminal
from roslings_rover.rover.rover import Rover
from roslings_rover.rover.words import position


def run(
    choice: Choice, view: View, keys: bool, follows: bool, seed: int = 0, keeps_bag: bool = False
) -> Rover:
    """Run it until Ctrl-C; returns the rover as it then is. With `keeps_bag`, see `drive_bag`.

    Raises RoverInCell, NotOurBag, NoPart where there is nothing to carry, NoTerminal, NoWindow, and
    what a board, a camera or a build raises.
    """
    if keeps_bag:
        require_place()
    wish = Wish(follows, keeps_bag, seed, keys, TOLD)
    with ExitStack() as stack:
        stack.enter_context(rover_of_terminal())
        made = stack.enter_context(_told(choice, wish))
        look = stack.enter_context(hands(keys, made.shown.tell, made.pull, made.follow))
        asked = stack.enter_context(listening())
        with started(made), opened(view, made.node) as display:
            _go_on(made, display, asked, look)
        print(f"\nYour rover is at {position(made.node)}.\nIt went {made.node.rover.way_m:.2f} m.")
        for ended in made.crew.ended:
            print(ended.line)
        if made.crew.bag:
            print(kept(made.crew.bag))
        return made.node.rover


@contextmanager
def _told(choice: Choice, wish: Wish) -> Iterator[Assembled]:
    """It is built while a line says so; what cannot be built is said below."""
    left_out = list[str]()
    with ExitStack() as stack:
        try:
            with Progress() as progress:
                parts = assembled(choice, wish, progress.step, left_out.append)
                made = stack.enter_context(parts)
        finally:
            for line in left_out:
                print(line, flush=True)
        yield made


def _go_on(
    made: Assembled, display: Display, asked: threading.Event, look: Callable[[], None]
) -> None:
    due_s = time.monotonic()
    while not (asked.is_set() or display.closed):
        look()
        made.turn()
        if time.monotonic() >= due_s:
            display.show(made.node)
            due_s = time.monotonic() + display.every_s
