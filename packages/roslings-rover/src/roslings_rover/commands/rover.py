"""`./roslings rover`: a small robot to drive by ROS, and its map."""

from __future__ import annotations

import argparse
import sys
from contextlib import suppress
from pathlib import Path

from ros2_on_pip.errors import OK, WRONG_USE
from ros2_on_pip.typed_paths import shown

MOST_DRIFT_PERCENT = 50.0


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
    word.add_argument(
        "--tf",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="say on /tf and /tf_static where its frames are, which it does by itself where their"
        " type is there",
    )
    word.add_argument(
        "--drift",
        metavar="PERCENT",
        type=typed_drift,
        default=0.0,
        help="let /odom count each metre and each turn too long by so much, as a real robot does;"
        " the map shows where the rover truly is",
    )
    word.add_argument(
        "--map-frame",
        action="store_true",
        help="say on /tf where odom is in the frame map: the rover's place in map is the true one",
    )
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
    if options.map_frame and not options.tf:
        print("roslings: --map-frame is said on /tf. Leave out --no-tf.", file=sys.stderr)
        return WRONG_USE
    from ros2_on_pip.surroundings import check_middleware, domain_id, prepare
    from roslings_rover.rover.frames import FrameOptions
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
        room=options.room,
        frames=FrameOptions(options.tf, options.drift, options.map_frame),
    )
    return OK


def typed_seed(typed: str) -> int:
    """The seed of a room, as argparse reads it."""
    from roslings_rover.models.rooms import NoSeed, seed_of

    try:
        return seed_of(typed)
    except NoSeed as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def typed_drift(typed: str) -> float:
    """The drift of the odometry in per cent, as argparse reads it."""
    with suppress(ValueError):
        if abs(percent := float(typed)) <= MOST_DRIFT_PERCENT:
            return percent
    most = f"{MOST_DRIFT_PERCENT:g}"
    raise argparse.ArgumentTypeError(f"the drift is a number from -{most} to {most}, not {typed!r}")


def _sick_rover(name: str | None, folder: Path | None) -> int:
    """Raises CannotWriteBag, and NeedsName."""
    from roslings_rover.rover.sick import write_sick_rover

    place = (folder or Path("~/sick_rover")).expanduser().absolute()
    seconds = write_sick_rover(name or "", place)
    print(f"The sick rover of {name} drove for {seconds:.0f} s. Its bag: {shown(place)}")
    print(f"Look at it: ros2 bag info {shown(place)}")
    return OK
