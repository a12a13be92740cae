"""`./roslings graph`: show the running graph, or save a picture of it."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from ros2_on_pip.errors import FAILED, OK, WRONG_USE
from ros2_on_pip.typed_paths import from_here
from roslings.workspace.student import package_of

if TYPE_CHECKING:
    from ros2_on_pip.graph.seen import Graph


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument(
        "--for", metavar="LAB", dest="lab", help="save the picture that LAB wants in your package"
    )
    word.add_argument(
        "path", metavar="PATH", type=Path, nargs="?", help="with --for: your package, as for check"
    )
    word.add_argument("--tf", action="store_true", help="publish /tf too")
    word.add_argument("--save", metavar="FILE.png", type=Path, help="save a picture of it")
    word.add_argument("--force", action="store_true", help="replace FILE.png if it is there")
    word.add_argument("--all", action="store_true", help="also /rosout and other parts of ROS")


def run(options: argparse.Namespace) -> int:
    """Show the running graph, or save a picture of it."""
    from ros2_on_pip.graph.words import graph_text
    from ros2_on_pip.surroundings import prepare
    from roslings.commands.rqt_graph import seen_graph

    files = _pictures_wanted(options)
    there = [file for file in files if file.exists() and not options.force]
    if there:
        taken = f"roslings: {from_here(there[0])} is there already. Nothing was changed."
        print(taken, file=sys.stderr)
        print("To replace it, add --force.", file=sys.stderr)
        return WRONG_USE
    prepare()
    seen = seen_graph()  # complete: a fixed wait misses nodes, by luck, that run all the time
    print(graph_text(seen, show_hidden=options.all))
    if not seen.nodes and options.lab:
        return _nothing_to_draw()
    for file in files:
        if not _saved(seen, file, options):
            return WRONG_USE
    return OK if seen.nodes else FAILED


def _pictures_wanted(options: argparse.Namespace) -> list[Path]:
    """The file that was named, or those that a lab's card wants in the package."""
    if not options.lab:
        return [options.save] if options.save else []
    from roslings.workspace.own_card import own_lab

    lab = own_lab(options.lab)
    package = package_of(lab, options.path)
    if not lab.card.pictures:
        print(f"The lab {lab.name!r} wants no picture.")
    return [package / picture.path for picture in lab.card.pictures]


def _nothing_to_draw() -> int:
    print("\nNothing was saved: no node runs. Start your nodes, each in a terminal of its own,")
    print("then type the same command once more.")
    return FAILED


def _saved(seen: Graph, file: Path, options: argparse.Namespace) -> bool:
    """Draw the picture; its folder is made where it is missing."""
    from roslings.report.graph_picture import NotAPng, draw_graph

    try:
        draw_graph(seen, file, show_hidden=options.all, overwrite=options.force)
    except NotAPng as error:
        print(f"roslings: {error}", file=sys.stderr)
        return False
    print(f"\nSaved {from_here(file)}")
    return True
