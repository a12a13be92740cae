"""The ROS graph in words: lines for a terminal, and sentences for who cannot see the picture."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2_on_pip.graph.seen import Graph
from ros2_on_pip.graph.shape import GraphShape, NodeShape, TopicShape, shape_of
from ros2_on_pip.safe_text import filled, harmless, wrapped

WIDTH = 80
NOTHING = "Nothing runs: no node was seen."
NEXT = "Start a node in another terminal, then look again."


def graph_text(graph: Graph, *, show_hidden: bool = False) -> str:
    """The graph in lines of at most 80 columns, ASCII where the names are; ends without newline."""
    shape = shape_of(graph, show_hidden=show_hidden)
    if not shape.nodes:
        return f"{NOTHING}\n{NEXT}"
    lines = [counts_of(shape), "", *_node_lines(shape), *_topic_lines(shape)]
    if shape.hidden:
        lines += ["", *_listed("Not shown: ", shape.hidden)]
    return "\n".join(lines)


def describe_graph(graph: Graph, *, show_hidden: bool = False) -> str:
    """The graph in sentences: the text alternative of its picture."""
    return sentences_of(shape_of(graph, show_hidden=show_hidden))


def sentences_of(shape: GraphShape) -> str:
    """What is left of a graph, in sentences."""
    if not shape.nodes:
        return NOTHING
    return harmless(" ".join(_sentences(shape)))


def counts_of(shape: GraphShape) -> str:
    """How many nodes and topics there are."""
    nodes = sum(node.count for node in shape.nodes)
    return f"{_number(nodes, 'node')}, {_number(len(shape.topics), 'topic')}"


def _number(count: int, what: str) -> str:
    return f"{count} {what}" if count == 1 else f"{count} {what}s"


def _node_lines(shape: GraphShape) -> Iterator[str]:
    yield "Nodes"
    for node in shape.nodes:
        yield from _indented(_node_words(node), 2)


def _node_words(node: NodeShape) -> str:
    again = f"   ({node.count} nodes of this name run)" if node.count > 1 else ""
    return node.name + again


def _topic_lines(shape: GraphShape) -> Iterator[str]:
    if shape.topics:
        yield from ("", "Topics")
    for topic in shape.topics:
        yield from _indented(f"{topic.name}   {types_of(topic)}", 2)
        yield from _listed("    from  ", topic.publishers or ("nobody publishes here",))
        yield from _listed("    to    ", topic.subscribers or ("nobody listens here",))


def types_of(topic: TopicShape) -> str:
    """The type of a topic, or that it has several."""
    if len(topic.types) > 1:
        return f"{len(topic.types)} types that do not match: {', '.join(topic.types)}"
    return topic.types[0]


def _listed(head: str, names: Sequence[str]) -> list[str]:
    lines = filled(map(harmless, names), WIDTH - len(head), joint=", ")
    return [(" " * len(head) if number else head) + line for number, line in enumerate(lines)]


def _indented(text: str, indent: int) -> list[str]:
    return [" " * indent + line for line in wrapped(harmless(text), WIDTH - indent)]


def _sentences(shape: GraphShape) -> Iterator[str]:
    yield f"A ROS graph with {counts_of(shape).replace(', ', ' and ')}."
    for node in shape.nodes:
        if node.count > 1:
            yield f"{node.count} nodes run under the name {node.name}."
    for topic in shape.topics:
        yield _topic_sentence(topic)
    for node in shape.alone:
        yield f"{node.name} has no topic."


def _topic_sentence(topic: TopicShape) -> str:
    name = f"{topic.name} ({types_of(topic)})"
    if not topic.publishers:
        return f"Nobody publishes on {name}; {_verb(topic.subscribers, 'subscribe')} to it."
    said = f"{_verb(topic.publishers, 'publish')} on {name}"
    if not topic.subscribers:
        return f"{said}; nobody subscribes to it."
    return f"{said}, and {_verb(topic.subscribers, 'subscribe')} to it."


def _verb(names: Sequence[str], verb: str) -> str:
    ending = "es" if verb.endswith("sh") else "s"
    if len(names) == 1:
        return f"{names[0]} {verb}{ending}"
    return f"{', '.join(names[:-1])} and {names[-1]} {verb}"
