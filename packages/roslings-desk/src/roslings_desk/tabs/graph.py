"""Graph: which node talks to which, on what topic, as it is now: as a picture and in words."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace

from nicegui import ui

from ros2_on_pip.graph.drawing import shape_svg
from ros2_on_pip.graph.seen import GraphNow, graph_seen_by, misfits
from ros2_on_pip.graph.shape import GraphShape, NodeShape, shape_of
from ros2_on_pip.graph.words import counts_of, sentences_of, types_of
from roslings_desk.controls import CheckField, Notice, PageText, StatusLine, TextField, button, part
from roslings_desk.tab import OpenTab

LOOK_EVERY_S = 0.5
LOOKING_SHARE = 0.1
"""At most this part of the time is spent on looks and drawings, however large the graph is."""
MOST_DRAWN = 120
"""Nodes and topics of one picture; of more nobody reads the names."""
MOST_MISFITS = 20


class GraphTab:
    """The running graph, drawn anew where it has changed."""

    title, every_s = "Graph", 0.25

    def __init__(self) -> None:
        self._look_s = 0.0
        self._drawn: object = None
        self._shape = GraphShape((), ())

    def show(self, open_tab: OpenTab) -> None:
        """What to leave out, the picture, the words."""
        self._hub = open_tab.hub
        with part("div", "row"):
            self._wanted = TextField("Only around names with", type="search")
            self._hidden = CheckField("Also /rosout and other parts of ROS")
            button("Say the graph", self._say)
        for control in (self._wanted, self._hidden):
            control.on_change(self._look_soon)
        self._count = PageText("p", "", "count")
        self._spoken = StatusLine()
        self._trouble = Notice()
        with part("div", "scroll sheet", role="region", tabindex=0, aria_label="The picture"):
            self._picture = ui.html("", sanitize=False)
        PageText("h3", "In words")
        self._words = part(
            "div", "scroll", role="region", tabindex=0, aria_label="Nodes and topics"
        )

    def _look_soon(self) -> None:
        self._look_s = 0.0

    def _say(self) -> None:
        self._spoken.say(sentences_of(self._shape))

    def refresh(self) -> None:
        """Look again; where it takes long, less often."""
        began_s = time.monotonic()
        if began_s < self._look_s:
            return
        self._take(graph_seen_by(self._hub.desk_node))
        took_s = time.monotonic() - began_s
        self._look_s = began_s + max(LOOK_EVERY_S, took_s / LOOKING_SHARE)

    def _take(self, graph: GraphNow) -> None:
        whole = shape_of(graph, show_hidden=bool(self._hidden.value))
        shape = around(whole, self._wanted.value.strip().lower())
        said = tuple(misfits(graph))
        if (shape, said) != self._drawn:
            self._drawn, self._shape = (shape, said), shape
            self._trouble.say(_shown(said))
            self._draw(whole, shape)

    def _draw(self, whole: GraphShape, shape: GraphShape) -> None:
        of_all = "" if shape == whole else f" of {counts_of(whole)}"
        size = len(shape.nodes) + len(shape.topics)
        self._count.say(f"{counts_of(shape)}{of_all}{_not_drawn(size)}")
        self._picture.set_content(shape_svg(shape) if 0 < size <= MOST_DRAWN else "")
        self._words.clear()
        with self._words:
            _tell(shape)


def _shown(said: tuple[str, ...]) -> str:
    """The first ones, and what to do."""
    if not said:
        return ""
    more = [f"And {len(said) - MOST_MISFITS} more."] if len(said) > MOST_MISFITS else []
    mend = "Give both the same type and the same QoS profile, in their code."
    return "\n".join([*said[:MOST_MISFITS], *more, mend])


def _not_drawn(size: int) -> str:
    if not size:
        return ". Start a node in a terminal, and it is here."
    if size > MOST_DRAWN:
        return f": too many to draw. Type a part of a name, so that {MOST_DRAWN} or fewer are left."
    return ""


def around(shape: GraphShape, wanted: str) -> GraphShape:
    """The nodes and topics whose names hold `wanted`, and those right beside them."""
    if not wanted:
        return shape
    named = {node.name for node in shape.nodes if wanted in node.name.lower()}
    topics = tuple(
        topic
        for topic in shape.topics
        if wanted in topic.name.lower() or named & {*topic.publishers, *topic.subscribers}
    )
    beside = {name for topic in topics for name in (*topic.publishers, *topic.subscribers)}
    nodes = tuple(node for node in shape.nodes if node.name in named | beside)
    return replace(shape, nodes=nodes, topics=topics)


def _tell(shape: GraphShape) -> None:
    """A list: each node with its topics, and who is at their other end."""
    with part("ul", "tree"):
        for node in shape.nodes:
            with part("li"):
                again = f" ({node.count} nodes of this name)" if node.count > 1 else ""
                PageText("strong", node.name + again)
                with part("ul"):
                    for line in _lines_of(node, shape):
                        PageText("li", line)


def _lines_of(node: NodeShape, shape: GraphShape) -> Iterator[str]:
    if node in shape.alone:
        yield "it has no topic here"
    for topic in shape.topics:
        if node.name in topic.publishers:
            heard = ", ".join(topic.subscribers) or "nobody"
            yield f"publishes {topic.name}, {types_of(topic)}; it is heard by {heard}"
        if node.name in topic.subscribers:
            said = ", ".join(topic.publishers) or "nobody"
            yield f"subscribes to {topic.name}, {types_of(topic)}; it is published by {said}"
