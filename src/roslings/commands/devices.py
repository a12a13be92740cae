"""The rover, its board and its camera, and the graph of what runs."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from roslings import course
from roslings.errors import FAILED, OK, WRONG_USE
from roslings.workspace.errors import from_here, shown
from roslings.workspace.student import package_of

if TYPE_CHECKING:
    from roslings.evidence import GraphSeen


def rover(options: argparse.Namespace) -> int:
    """Run the rover and its map until Ctrl-C; or write the bag of a sick one."""
    if options.sick:
        return _sick_rover(options.name, options.to)
    if options.name or options.to:
        print("roslings: --name and --to belong to --sick.", file=sys.stderr)
        return WRONG_USE
    from roslings.devices.rover.running import run
    from roslings.ros2.surroundings import check_middleware, domain_id, prepare

    prepare()
    domain_id()
    check_middleware()
    run(
        options.view, options.save, options.seed, options.keys,
        listens=options.listen, tf=options.tf,
    )  # fmt: skip
    return OK


def _sick_rover(name: str | None, folder: Path | None) -> int:
    """Raises CannotWriteBag, and NeedsName."""
    from roslings.devices.rover.sick import write_sick_rover

    place = (folder or Path("~/sick_rover")).expanduser().absolute()
    seconds = write_sick_rover(name or "", place)
    print(f"The sick rover of {name} drove for {seconds:.0f} s. Its bag: {shown(place)}")
    print(f"Look at it: ros2 bag info {shown(place)}")
    return OK


def board(options: argparse.Namespace) -> int:
    """Run the rover's board on a serial port until Ctrl-C."""
    from roslings.devices.board.live import run, usual_port

    run(options.port or usual_port(), options.sketch)
    return OK


def camera(options: argparse.Namespace) -> int:
    """Run the rover's camera until Ctrl-C."""
    from roslings.devices.camera.live import run, usual_path

    run(options.device or usual_path(), options.hue, options.noise)
    return OK


def graph(options: argparse.Namespace) -> int:
    """Show the running graph, or save a picture of it."""
    from roslings.report import graph_text
    from roslings.ros2.rqt_graph import seen_graph
    from roslings.ros2.surroundings import prepare

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
    lab = course.lab(options.lab)
    package = package_of(lab, options.path)
    if not lab.card.pictures:
        print(f"The lab {lab.name!r} wants no picture.")
    return [package / picture.path for picture in lab.card.pictures]


def _nothing_to_draw() -> int:
    print("\nNothing was saved: no node runs. Start your nodes, each in a terminal of its own,")
    print("then type the same command once more.")
    return FAILED


def _saved(seen: GraphSeen, file: Path, options: argparse.Namespace) -> bool:
    """Draw the picture; its folder is made where it is missing."""
    from roslings.report import draw_graph
    from roslings.report.graph_picture import NotAPng

    try:
        draw_graph(seen, file, show_hidden=options.all, overwrite=options.force)
    except NotAPng as error:
        print(f"roslings: {error}", file=sys.stderr)
        return False
    print(f"\nSaved {from_here(file)}")
    return True
