"""The ROS graph as a picture: nodes as ellipses, topics as rectangles, arrows where messages go.

matplotlib is imported only when a picture is drawn.
"""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

from ros2_on_pip.graph.seen import Graph
from ros2_on_pip.graph.shape import shape_of
from ros2_on_pip.graph.words import describe_graph
from ros2_on_pip.safe_text import harmless
from roslings.report.whole_file import already_there, make_folder_of, write_whole

DPI = 150.0
MOST_PIXELS = 30_000.0


class NotAPng(Exception):
    """The file's name says that it is something else than a PNG."""

    def __init__(self, path: Path) -> None:
        self.path = path
        super().__init__(f"The picture is a PNG: give a name that ends in .png, not {path.name!r}.")


def draw_graph(
    graph: Graph,
    path: Path,
    *,
    title: str | None = None,
    show_hidden: bool = False,
    overwrite: bool = False,
) -> None:
    """Draw `graph` into the PNG `path`, with its description as metadata; make its folder.

    Raises FileExistsError without `overwrite`, NotAPng, CannotWriteFile; ModuleNotFoundError where
    matplotlib (the group `graph`) is not installed.
    """
    if path.suffix.lower() != ".png":
        raise NotAPng(path)
    if path.exists() and not overwrite:
        raise already_there(path)
    picture = _png(graph, title, show_hidden)
    make_folder_of(path)
    write_whole(path, picture, overwrite=overwrite)


def _png(graph: Graph, title: str | None, show_hidden: bool) -> bytes:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    from roslings.report.graph_sheet import GraphSheet

    sheet = GraphSheet(shape_of(graph, show_hidden=show_hidden), title)
    figure = Figure(
        figsize=(sheet.width / 72, sheet.height / 72),
        dpi=min(DPI, MOST_PIXELS * 72 / max(sheet.width, sheet.height)),
    )
    # Straight to Agg: no window, no global state, and no setting of the user's crops the sheet.
    canvas: Any = FigureCanvasAgg(figure)  # matplotlib has no types for it
    sheet.draw(figure)
    metadata = {
        "Title": harmless(title or "ROS graph"),
        "Description": describe_graph(graph, show_hidden=show_hidden),
        "Software": "roslings",
    }
    picture = io.BytesIO()
    canvas.print_png(picture, metadata=metadata)
    return picture.getvalue()
