"""What the commands of a learner take."""

from __future__ import annotations

import argparse
from pathlib import Path

from roslings.cli.options import (
    hidden_option,
    package_options,
    path_option,
    soak_option,
    trust_option,
    verdict_options,
)


def check_options(word: argparse.ArgumentParser) -> None:
    """What `check` takes."""
    package_options(word)
    word.add_argument(
        "--solution", action="store_true", help="check the course's own solution instead"
    )
    verdict_options(word)
    hidden_option(word)
    word.add_argument(
        "--evidence", metavar="DIR", type=Path,
        help="save all that was seen in the new folder DIR, to judge it again (regrade)",
    )  # fmt: skip
    trust_option(word)
    word.add_argument(
        "--as-stranger", action="store_true",
        help="hold somebody else's package as grade does, or refuse it where nothing can",
    )  # fmt: skip
    soak_option(word, "0; as grade does where a platform's file is written")
    word.add_argument(
        "--clock", choices=("auto", "sim", "wall"), default="auto",
        help="simulated time where it can be believed (auto), always (sim), or never (wall)",
    )  # fmt: skip
    word.add_argument(
        "--seed", metavar="N", type=int, help="repeat the random choices of a verdict"
    )
    word.add_argument(
        "--port", metavar="DEVICE", type=Path,
        help="use the real board on this serial port, for example /dev/ttyACM0",
    )  # fmt: skip
    word.add_argument(
        "--timings", action="store_true", help="show where the seconds of the check went"
    )
    word.add_argument(
        "--hint", metavar="STEP", type=int, choices=(1, 2, 3), nargs="?", const=1,
        help="a hint for what your last check found: 1 where, 2 which idea, 3 other code",
    )  # fmt: skip


def drill_options(word: argparse.ArgumentParser) -> None:
    """What `drill` takes."""
    word.add_argument(
        "drill", metavar="NAME", nargs="?",
        help="the drill to check (default: show the next one, and put its file in place)",
    )  # fmt: skip
    word.add_argument("--day", metavar="DAY", help="the next one of this day, for example 3")
    word.add_argument("--list", action="store_true", help="all drills, and which are done")
    word.add_argument(
        "--hint", metavar="STEP", type=int, choices=(1, 2, 3), nargs="?", const=1,
        help="a hint for it: 1 where, 2 which idea, 3 other code",
    )  # fmt: skip
    word.add_argument(
        "--solution", action="store_true", help="check the course's own solution instead"
    )


def watch_options(word: argparse.ArgumentParser) -> None:
    """What `watch` takes."""
    word.add_argument("lab", metavar="LAB|DRILL", nargs="?", help="default: today's")
    path_option(word)
    word.add_argument(
        "--plain", action="store_true", help="no keys, no new screen: lines only, as for a pipe"
    )
    word.set_defaults(
        solution=False, json=None, html=None, evidence=None, only=None, seed=None, hint=None,
        clock="auto", port=None, hidden=None, trust=False, as_stranger=False, timings=False,
        all=False, soak=None,
    )  # fmt: skip


def pack_options(word: argparse.ArgumentParser) -> None:
    """What `pack` takes."""
    package_options(word)
    word.add_argument("--out", metavar="FILE", type=Path, help="the zip (default: LAB.zip here)")
    soak_option(word, "as where it is graded; 0 skips it")


def graph_options(word: argparse.ArgumentParser) -> None:
    """What `graph` takes."""
    word.add_argument(
        "--for", metavar="LAB", dest="lab", help="save the picture that LAB wants in your package"
    )
    word.add_argument(
        "path", metavar="PATH", type=Path, nargs="?", help="with --for: your package, as for check"
    )
    word.add_argument(
        "--tf", action="store_true", help="publish /tf too; its type is compiled once, by g++"
    )
    word.add_argument("--save", metavar="FILE.png", type=Path, help="save a picture of it")
    word.add_argument("--force", action="store_true", help="replace FILE.png if it is there")
    word.add_argument("--all", action="store_true", help="also /rosout and other parts of ROS")


def jupyter_options(word: argparse.ArgumentParser) -> None:
    """What `lab` takes."""
    word.add_argument(
        "day", metavar="DAY", nargs="?", help="for example: 3, or 03-topics (default: today's)"
    )
    word.add_argument("--no-browser", action="store_true", help="print the address, open nothing")
    word.add_argument("--port", metavar="N", type=int, help="default: 8888, or the next free one")
    word.add_argument(
        "--ip",
        metavar="ADDRESS",
        help="who may open it; 0.0.0.0 in a container (default: this computer)",
    )


def rover_options(word: argparse.ArgumentParser) -> None:
    """What `rover` takes."""
    word.add_argument(
        "--view", choices=("auto", "window", "terminal", "lines"), default="auto",
        help="where the map is shown (default: a window where there is a screen)",
    )  # fmt: skip
    word.add_argument(
        "--keys", action="store_true", help="drive it by the keys of this terminal: i, j, k, l"
    )
    word.add_argument(
        "--listen", action="store_true",
        help="show the sentences that your nodes say, and keep the limit of /motor_state; it"
        " is one more subscription on each of these topics",
    )  # fmt: skip
    word.add_argument(
        "--tf", action="store_true", help="publish /tf too; its type is compiled once, by g++"
    )
    word.add_argument("--save", metavar="FILE.png", type=Path, help="save the map at the end")
    word.add_argument("--seed", metavar="N", type=int, default=0, help="for the sensors' noise")
    word.add_argument(
        "--sick", action="store_true",
        help="run nothing, and write the bag of a sick rover: with five faults that follow from"
        " --name",
    )  # fmt: skip
    word.add_argument("--name", metavar="NAME", help="of --sick: the name that you hand in under")
    word.add_argument(
        "--to", metavar="FOLDER", type=Path, help="of --sick: a new folder (default: ~/sick_rover)"
    )


def board_options(word: argparse.ArgumentParser) -> None:
    """What `board` takes."""
    word.add_argument("--port", metavar="FILE", type=Path, help="default: /tmp/ttyROVER")
    word.add_argument(
        "--sketch",
        metavar="FILE.ino",
        type=Path,
        help="run this sketch, in an emulated Mega",
    )


def camera_options(word: argparse.ArgumentParser) -> None:
    """What `camera` takes."""
    word.add_argument("--device", metavar="PATH", type=Path, help="default: /tmp/rover_camera")
    word.add_argument(
        "--hue", type=int, default=5, metavar="0..179", help="the ball's colour, as OpenCV counts"
    )
    word.add_argument(
        "--noise", type=float, default=4.0, metavar="LEVELS", help="of each value, of 255"
    )
