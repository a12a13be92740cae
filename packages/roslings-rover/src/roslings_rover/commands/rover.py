"""`./roslings rover`: a small robot to drive by ROS, and its map."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from ros2_on_pip.errors import OK, WRONG_USE
from ros2_on_pip.typed_paths import shown


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument(
        "--view",
        choices=("auto", "window", "terminal", "lines"),
        default="auto",
        help="where the map is shown (default: a window where there is a screen)",
    )
    word.add_argument(
        "--keys", action="store_true", help="drive it by the keys of this terminal: i, j, k, l"
    )
    word.add_argument(
        "--listen",
        action="store_true",
        help="show the sentences that your nodes say, and keep the limit of /motor_state; it"
        " is one more subscription on each of these topics",
    )
    word.add_argument("--tf", action="store_true", help="publish /tf too")
    word.add_argument(
        "--room",
        metavar="SEED",
        type=typed_seed,
        help="drive in a room that you have not seen: each whole number is another one; bumps are"
        " counted",
    )
    word.add_argument("--save", metavar="FILE.png", type=Path, help="save the map at the end")
    word.add_argument("--seed", metavar="N", type=int, default=0, help="for the sensors' noise")
    word.add_argument(
        "--sick",
        action="store_true",
        help="run nothing, and write the bag of a sick rover: with five faults that follow from"
        " --name",
    )
    word.add_argument("--name", metavar="NAME", help="of --sick: the name that you hand in under")
    word.add_argument(
        "--to", metavar="FOLDER", type=Path, help="of --sick: a new folder (default: ~/sick_rover)"
    )


def run(options: argparse.Namespace) -> int:
    """Run the rover and its map until Ctrl-C; or write the bag of a sick one."""
    if options.sick:
        return _sick_rover(options.name, options.to)
    if options.name or options.to:
        print("roslings: --name and --to belong to --sick.", file=sys.stderr)
        return WRONG_USE
    from ros2_on_pip.surroundings import check_middleware, domain_id, prepare
    from roslings_rover.rover.running import run as run_rover

    prepare()
    domain_id()
    check_middleware()
    run_rover(
        options.view,
        options.save,
        options.seed,
        options.keys,
        listens=options.listen,
        tf=options.tf,
        room=options.room,
    )
    return OK


def typed_seed(typed: str) -> int:
    """The seed of a room, as argparse reads it."""
    from roslings_rover.models.rooms import NoSeed, seed_of

    try:
        return seed_of(typed)
    except NoSeed as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def _sick_rover(name: str | None, folder: Path | None) -> int:
    """Raises CannotWriteBag, and NeedsName."""
    from roslings_rover.rover.sick import write_sick_rover

    place = (folder or Path("~/sick_rover")).expanduser().absolute()
    seconds = write_sick_rover(name or "", place)
    print(f"The sick rover of {name} drove for {seconds:.0f} s. Its bag: {shown(place)}")
    print(f"Look at it: ros2 bag info {shown(place)}")
    return OK
