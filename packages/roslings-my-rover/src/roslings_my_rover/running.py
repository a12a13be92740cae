"""Run my rover: its parts are built and started, its map is shown, until Ctrl-C."""

from __future__ import annotations

import shutil
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager

from roslings.report.progress import ProgressLine
from roslings_my_rover.assembled import Assembled, RoverOptions, assembled, started
from roslings_my_rover.chosen import ChosenParts
from roslings_my_rover.drive_bag import kept, require_place
from roslings_my_rover.hands import TOLD, hands
from roslings_my_rover.parts import MAPPER
from roslings_rover.rover.displays import opened
from roslings_rover.rover.driven import DrivenRover
from roslings_rover.rover.map_display import Display, View, shown_until
from roslings_rover.rover.one_rover import rover_of_terminal
from roslings_rover.rover.rover import Rover
from roslings_rover.rover.text_map import letters_for
from roslings_rover.rover.words import at_its_end
from roslings_rover.stop_signal import listening

MOST_COLUMNS = 80
LINES_AROUND = 7
"""What else is said at the end, and the next prompt."""
LEAST_LINES = 12


def run(
    choice: ChosenParts,
    view: View,
    keys: bool,
    follows: bool,
    seed: int = 0,
    keeps_bag: bool = False,
    room: int | None = None,
    tf: bool = True,
) -> Rover:
    """Run it until Ctrl-C; returns the rover as it then is. With `keeps_bag`, see `drive_bag`.

    `room` is the seed of a room that it is in. There a part may drive by itself, unless somebody
    has the keys.

    Raises RoverInCell, NotOurBag, NoPart where there is nothing to carry, NoTerminal, NoWindow, and
    what a board, a camera or a build raises.
    """
    if keeps_bag:
        require_place()
    wish = RoverOptions(follows, keeps_bag, seed, keys, room, TOLD, tf)
    with ExitStack() as stack:
        stack.enter_context(rover_of_terminal())
        made = stack.enter_context(_told(choice, wish))
        look = stack.enter_context(hands(keys, made.shown.tell, made.pull, made.follow))
        asked = stack.enter_context(listening())
        with started(made), opened(view, made.node) as display:
            _go_on(made, display, asked, look)
        print("", *at_its_end(made.node, "Your"), sep="\n")
        for ended in made.crew.ended:
            print(ended.line)
        if made.crew.bag:
            print(kept(made.crew.bag))
        for line in _drawn(made):
            print(line)
        return made.node.rover


@contextmanager
def _told(choice: ChosenParts, wish: RoverOptions) -> Iterator[Assembled]:
    """It is built while a line says so; what cannot be built is said below."""
    left_out = list[str]()
    with ExitStack() as stack:
        try:
            with ProgressLine() as progress:
                parts = assembled(choice, wish, progress.step, left_out.append)
                made = stack.enter_context(parts)
        finally:
            for line in left_out:
                print(line, flush=True)
        yield made


def _drawn(made: Assembled) -> Iterator[str]:
    """The room as the part has drawn it, below what is said of it; nothing without the part."""
    node = made.node
    if not any(each.chosen.part is MAPPER for each in made.crew.built):
        return
    if node.drawn is None:
        yield "Your mapper has drawn nothing."
        yield node.no_map or "It has said nothing on /map."
        return
    yield f"Your mapper has drawn {node.drawn.counts}:"
    columns, lines = shutil.get_terminal_size()
    size = min(columns, MOST_COLUMNS), max(lines - LINES_AROUND, LEAST_LINES)
    yield from node.drawn.lines(*size, letters_for(sys.stdout.encoding))


def _go_on(
    made: Assembled,
    display: Display[DrivenRover],
    asked: threading.Event,
    look: Callable[[], None],
) -> None:
    def turn() -> None:
        look()
        made.turn()

    shown_until(asked, display, made.node, turn)
