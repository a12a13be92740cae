"""`./roslings my-rover`: one robot of all the parts that you have built."""

from __future__ import annotations

import argparse
import sys

from ros2_on_pip.errors import OK, WRONG_USE
from roslings_rover.commands.rover import typed_seed


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument(
        "day", metavar="DAY", type=int, nargs="?", help="only the parts up to this day, as 5"
    )
    word.add_argument(
        "--parts", action="store_true", help="say which parts there are, and start nothing"
    )
    word.add_argument(
        "--borrow",
        metavar="DAY",
        type=int,
        action="append",
        default=[],
        help="for a day that you skipped: the course's part; may be given again",
    )
    word.add_argument(
        "--src",
        action="store_true",
        help="your packages as they lie in the workspace today, not those of your best check",
    )
    word.add_argument(
        "--keys",
        action="store_true",
        help="drive it by the keys of this terminal; Space is the stop of day 10, p pulls the"
        " cable of day 6",
    )
    word.add_argument(
        "--follow", action="store_true", help="follow the ball, by what day 7 says on /ball"
    )
    word.add_argument(
        "--room",
        metavar="SEED",
        type=typed_seed,
        help="in a room that it has not seen, as `rover --room`: your part of day 11 drives it"
        " there, as long as nobody has the keys",
    )
    word.add_argument(
        "--race",
        action="store_true",
        help="a race of two rovers in one room, /red and /blue, started by your launch file of"
        " day 8",
    )
    word.add_argument(
        "--bag",
        action="store_true",
        help="keep a bag of this drive, for your program of day 9: ~/roslings_ws/my_rover_bag",
    )
    word.add_argument(
        "--launch",
        action="store_true",
        help="print the launch file that starts these parts, wired as in the rover",
    )
    word.add_argument(
        "--view",
        choices=("auto", "window", "terminal", "lines"),
        default="auto",
        help="where the map is shown (default: a window where there is a screen)",
    )
    word.add_argument(
        "--no-tf", dest="tf", action="store_false", help="do not publish /tf and /tf_static"
    )
    word.add_argument("--seed", metavar="N", type=int, default=0, help="for the sensors' noise")


def run(options: argparse.Namespace) -> int:
    """Run the rover of the student's parts until Ctrl-C; or say which there are."""
    from roslings_my_rover.chosen import NoPart, chosen, told

    alone = (options.keys, options.follow, options.bag, options.launch, options.room is not None)
    if options.race and any(alone):
        print(
            "roslings: --race goes with DAY, --borrow, --src, --view and --seed alone.",
            file=sys.stderr,
        )
        return WRONG_USE
    last_day = None if options.race else options.day
    choice = chosen(last_day, options.borrow, options.src)
    if options.parts:
        print("\n".join(told(choice)))
        return OK
    if not choice.there and not options.race:
        raise NoPart
    if options.launch:
        from roslings_my_rover.launch_file import launch_file

        print(launch_file(choice))
        return OK
    from ros2_on_pip.surroundings import check_middleware, domain_id, prepare
    from roslings_my_rover.running import run as run_rover

    prepare()
    domain_id()
    check_middleware()
    if options.race:
        from roslings_my_rover.race_running import run as run_race

        run_race(choice, options.view, options.seed)
        return OK
    run_rover(
        choice,
        options.view,
        options.keys,
        options.follow,
        options.seed,
        options.bag,
        room=options.room,
        tf=options.tf,
    )
    return OK
