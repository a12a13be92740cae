"""The ROS graph in words: lines for a terminal, and sentences for who cannot see the picture."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2_on_pip.graph.seen import Graph
from ros2_on_pip.graph.shape import GraphShape, NodeShape, TopicShape, shape_of
from ros2_on_pip.language import Text, counted, said
from ros2_on_pip.safe_text import filled, harmless, wrapped

WIDTH = 80
NOTHING = Text("graph.nothing", "Nothing runs: no node was seen.")
NEXT = Text("graph.next", "Start a node in another terminal, then look again.")


def graph_text(graph: Graph, *, show_hidden: bool = False) -> str:
    """The graph in lines of at most 80 columns, ASCII where the names are; ends without newline."""
    shape = shape_of(graph, show_hidden=show_hidden)
    if not shape.nodes:
        return f"{NOTHING}\n{NEXT}"
    lines = [counts_of(shape), "", *_node_lines(shape), *_topic_lines(shape)]
    if shape.hidden:
        lines += ["", *_listed(said("graph.hidden", "Not shown: "), shape.hidden)]
    return "\n".join(lines)


def describe_graph(graph: Graph, *, show_hidden: bool = False) -> str:
    """The graph in sentences: the text alternative of its picture."""
    return sentences_of(shape_of(graph, show_hidden=show_hidden))


def sentences_of(shape: GraphShape) -> str:
    """What is left of a graph, in sentences."""
    if not shape.nodes:
        return str(NOTHING)
    return harmless(" ".join(_sentences(shape)))


def counts_of(shape: GraphShape) -> str:
    """How many nodes and topics there are."""
    return ", ".join(_numbers(shape))


def _numbers(shape: GraphShape) -> tuple[str, str]:
    nodes = sum(node.count for node in shape.nodes)
    topics = len(shape.topics)
    return (
        counted("graph.nodes.count", nodes, one="{count} node", other="{count} nodes"),
        counted("graph.topics.count", topics, one="{count} topic", other="{count} topics"),
    )


def _node_lines(shape: GraphShape) -> Iterator[str]:
    yield said("graph.nodes", "Nodes")
    for node in shape.nodes:
        yield from _indented(_node_words(node), 2)


def _node_words(node: NodeShape) -> str:
    if node.count == 1:
        return node.name
    again = "({count} nodes of this name run)"
    return f"{node.name}   {said('graph.again', again, count=node.count)}"


def _topic_lines(shape: GraphShape) -> Iterator[str]:
    if shape.topics:
        yield from ("", said("graph.topics", "Topics"))
    for topic in shape.topics:
        yield from _indented(f"{topic.name}   {types_of(topic)}", 2)
        nobody = (said("graph.no_publisher", "nobody publishes here"),)
        yield from _listed(f"    {said('graph.from', 'from  ')}", topic.publishers or nobody)
        nobody = (said("graph.no_subscriber", "nobody listens here"),)
        yield from _listed(f"    {said('graph.to', 'to    ')}", topic.subscribers or nobody)


def types_of(topic: TopicShape) -> str:
    """The type of a topic, or that it has several."""
    if len(topic.types) > 1:
        return said(
            "graph.types",
            "{count} types that do not match: {types}",
            count=len(topic.types),
            types=", ".join(topic.types),
        )
    return topic.types[0]


def _listed(head: str, names: Sequence[str]) -> list[str]:
    lines = filled(map(harmless, names), WIDTH - len(head), joint=", ")
    return [(" " * len(head) if number else head) + line for number, line in enumerate(lines)]


def _indented(text: str, indent: int) -> list[str]:
    return [" " * indent + line for line in wrapped(harmless(text), WIDTH - indent)]


def _sentences(shape: GraphShape) -> Iterator[str]:
    nodes, topics = _numbers(shape)
    yield said("graph.with", "A ROS graph with {nodes} and {topics}.", nodes=nodes, topics=topics)
    same = "{count} nodes run under the name {name}."
    for node in shape.nodes:
        if node.count > 1:
            yield said("graph.same", same, count=node.count, name=node.name)
    for topic in shape.topics:
        yield _topic_sentence(topic)
    for node in shape.alone:
        yield said("graph.alone", "{name} has no topic.", name=node.name)


def _topic_sentence(topic: TopicShape) -> str:
    name = f"{topic.name} ({types_of(topic)})"
    if not topic.publishers:
        nobody = "Nobody publishes on {topic}; {subscribe} to it."
        subscribe = _subscribe(topic.subscribers)
        return said("graph.nobody_publishes", nobody, topic=name, subscribe=subscribe)
    publish = _publish(topic.publishers)
    if not topic.subscribers:
        unheard = "{publish} on {topic}; nobody subscribes to it."
        return said("graph.nobody_subscribes", unheard, publish=publish, topic=name)
    both = "{publish} on {topic}, and {subscribe} to it."
    subscribe = _subscribe(topic.subscribers)
    return said("graph.both", both, publish=publish, topic=name, subscribe=subscribe)


def _publish(names: Sequence[str]) -> str:
    return counted(
        "graph.publish",
        len(names),
        one="{names} publishes",
        other="{names} publish",
        names=_together(names),
    )


def _subscribe(names: Sequence[str]) -> str:
    return counted(
        "graph.subscribe",
        len(names),
        one="{names} subscribes",
        other="{names} subscribe",
        names=_together(names),
    )


def _together(names: Sequence[str]) -> str:
    if len(names) == 1:
        return names[0]
    both = "{first} and {last}"
    return said("graph.together", both, first=", ".join(names[:-1]), last=names[-1])
