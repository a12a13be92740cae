"""The live graph below a cell."""

from __future__ import annotations

from roslings_learn.notebook.picture import NotebookPicture, show, svg_picture
from roslings_learn.notebook.place import settle_in


def show_graph() -> None:
    """Show which node talks to which, on what topic, as it is at this moment.

    Every node of this ROS domain is there, also those of your terminals.
    """
    show(graph_picture())


def graph_picture() -> NotebookPicture:
    """The picture that `show_graph` shows."""
    settle_in()
    from ros2_on_pip.discovery import DirectNode
    from ros2_on_pip.graph.drawing import graph_svg
    from ros2_on_pip.graph.seen import graph_seen_by
    from ros2_on_pip.graph.words import describe_graph

    with DirectNode() as direct_node:
        seen = graph_seen_by(direct_node.settle())
    return svg_picture(graph_svg(seen), describe_graph(seen))
