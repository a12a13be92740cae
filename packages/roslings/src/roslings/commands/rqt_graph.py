"""`rqt_graph`: the running graph in a window, or as a picture where there is no screen."""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ros2_on_pip.cli import STOPPED, explained
from ros2_on_pip.handover import hand_over
from ros2_on_pip.problem import CommandProblem
from ros2_on_pip.windows import window_of
from ros2_on_pip.words import OK, CommandParser

if TYPE_CHECKING:
    from ros2_on_pip.graph.seen import Graph

PICTURE = "rosgraph.png"
"""The name that the save button of the real rqt_graph offers."""

TITLE = "Node graph"
SCREENS = ("DISPLAY", "WAYLAND_DISPLAY")
INCHES_MOST = (16.0, 9.0)


class NoMatplotlib(CommandProblem):
    """The picture cannot be drawn."""

    def __init__(self) -> None:
        super().__init__(
            "rqt_graph draws with matplotlib, which is not installed here yet."
            " In the roslings folder type: ./roslings graph --save rosgraph.png"
        )


class CannotSaveGraph(CommandProblem):
    """The picture cannot be written there."""


def main(argv: Sequence[str]) -> int:
    """Run `rqt_graph argv...` and return its exit code."""
    hand_over("rqt_graph", "rqt_graph.main", argv)
    try:
        return explained(lambda: run(_parser().parse_args(argv)))
    except KeyboardInterrupt:
        return STOPPED


def _parser() -> CommandParser:
    parser = CommandParser(
        prog="rqt_graph", description="Shows which node talks to which, on what topic."
    )
    parser.add_argument("--save", metavar="FILE.png", type=Path, help="save a picture, no window")
    parser.add_argument("--all", action="store_true", help="also /rosout and other parts of ROS")
    return parser


def run(options: argparse.Namespace) -> int:
    """Look at the graph, then show or save it. Raises NoMatplotlib, CannotSaveGraph.

    Where another package opens a window of its own in place of rqt_graph's, that one is opened.
    """
    if options.save is None and (window := window_of("rqt_graph")):
        return window.open([])
    graph = seen_graph()
    if not graph.nodes:
        print("No node runs, so the picture is empty. Start a node first.", file=sys.stderr)
    if options.save is None and has_screen() and show(graph, options.all):
        return OK
    place = options.save or free_name(Path(PICTURE))
    draw(graph, place, options.all)
    print(f"The picture of the graph is in {place.resolve()}")
    return OK


def seen_graph() -> Graph:
    """The whole graph, without our own node."""
    from ros2_on_pip.discovery import DirectNode
    from ros2_on_pip.graph.seen import graph_seen_by

    with DirectNode() as direct_node:
        return graph_seen_by(direct_node.settle())


def has_screen() -> bool:
    """There is a display, and matplotlib can be expected to open a window on it."""
    return any(os.environ.get(name) for name in SCREENS)


def free_name(path: Path) -> Path:
    """`path`, or the first of `path_2`, `path_3`, ... that is free: no picture is lost."""
    names = [path, *(path.with_stem(f"{path.stem}_{n}") for n in range(2, 1000))]
    return next((name for name in names if not name.exists()), path)


def draw(graph: Graph, place: Path, everything: bool) -> None:
    """Write the picture. Raises NoMatplotlib, CannotSaveGraph."""
    from roslings.report.graph_picture import NotAPng, draw_graph
    from roslings.report.whole_file import CannotWriteFile

    try:
        draw_graph(graph, place, title=TITLE, show_hidden=everything, overwrite=True)
    except ModuleNotFoundError as fault:
        raise NoMatplotlib from fault
    except (NotAPng, CannotWriteFile, OSError) as fault:
        raise CannotSaveGraph(str(fault)) from fault


def show(graph: Graph, everything: bool) -> bool:
    """Show the picture in a window until it is closed; False where no window can be opened."""
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / PICTURE
        draw(graph, place, everything)
        return show_picture(place)


def show_picture(place: Path) -> bool:
    """A window with the picture; False where matplotlib has no window to offer."""
    try:
        import matplotlib.pyplot as plt
        from matplotlib import get_backend
        from matplotlib.backends.registry import BackendFilter, backend_registry

        picture = plt.imread(place)
        height, width = picture.shape[:2]
        scale = min(1.0, INCHES_MOST[0] * 100 / width, INCHES_MOST[1] * 100 / height)
        size = (width * scale / 100, height * scale / 100)
        figure = plt.figure(TITLE, figsize=size, dpi=100)
        axes = figure.add_axes((0, 0, 1, 1))
    except (ImportError, RuntimeError):  # no tkinter, no Qt, or a display that refuses
        return False
    windows: list[str] = backend_registry.list_builtin(BackendFilter.INTERACTIVE)  # type: ignore[no-untyped-call]
    if get_backend().lower() not in windows:
        return False
    axes.imshow(picture)
    axes.set_axis_off()
    plt.show()
    return True
