"""The ROS graph in words."""

from __future__ import annotations

import pytest
import written_graphs as written

from ros2_on_pip.graph.words import describe_graph, graph_text
from roslings.evidence import GraphSeen

GRAPHS = {
    "empty": written.empty(),
    "one": written.one(),
    "two": written.two(),
    "five": written.five(),
    "loop": written.loop(),
    "twelve": written.twelve(),
    "long names": written.long_names(),
}


def test_two_nodes_in_lines() -> None:
    """The whole text, as a student sees it."""
    assert graph_text(written.two()) == (
        "2 nodes, 1 topic\n"
        "\n"
        "Nodes\n"
        "  /listener\n"
        "  /talker\n"
        "\n"
        "Topics\n"
        "  /chatter   std_msgs/msg/String\n"
        "    from  /talker\n"
        "    to    /listener\n"
        "\n"
        "Not shown: /parameter_events, /rosout"
    )


def test_two_nodes_in_sentences() -> None:
    """The whole text alternative."""
    assert describe_graph(written.two()) == (
        "A ROS graph with 2 nodes and 1 topic. /talker publishes on /chatter"
        " (std_msgs/msg/String), and /listener subscribes to it."
    )


@pytest.mark.parametrize("graph", GRAPHS.values(), ids=GRAPHS)
def test_80_columns_and_every_name(graph: GraphSeen) -> None:
    """No line is wider, and no node is missing."""
    text = graph_text(graph)
    assert max(map(len, text.splitlines())) <= 80
    joined = "".join(text.split())
    assert all(node in joined for node in graph.nodes)
    assert all(node in describe_graph(graph) for node in graph.nodes)


def test_what_is_strange_is_said() -> None:
    """A name twice, two types on one topic, a node without topics, nobody at one end."""
    text, words = graph_text(written.five()), describe_graph(written.five())
    assert "/talker   (2 nodes of this name run)" in text
    assert "2 types that do not match: std_msgs/msg/Int32, std_msgs/msg/String" in text
    assert "2 nodes run under the name /talker." in words
    assert "/idle has no topic." in words
    assert "to    nobody listens here" in graph_text(written.one())
    assert "nobody subscribes to it" in describe_graph(written.one())
    deaf = written.graph([], [("/listener", "/chatter", written.STRING)])
    assert "from  nobody publishes here" in graph_text(deaf)
    assert "Nobody publishes on /chatter (std_msgs/msg/String)" in describe_graph(deaf)


def test_an_empty_graph_says_what_to_do() -> None:
    """Nothing runs, and the next step."""
    assert graph_text(written.empty()).startswith("Nothing runs: no node was seen.\nStart a node")
    assert describe_graph(written.empty()) == "Nothing runs: no node was seen."


def test_infrastructure_is_shown_when_it_is_asked_for() -> None:
    """Also in a namespace; a student's topic of such a type is no infrastructure."""
    assert "  /rosout   rcl_interfaces/msg/Log\n" in graph_text(written.two(), show_hidden=True)
    assert "/rosout" in describe_graph(written.two(), show_hidden=True)
    log = "rcl_interfaces/msg/Log"
    graph = written.graph([("/talker", "/chatter", log), ("/talker", "/robot/rosout", log)])
    assert "  /chatter   rcl_interfaces/msg/Log" in graph_text(graph)
    assert "Not shown: /parameter_events, /robot/rosout, /rosout" in graph_text(graph)


def test_hidden_nodes_are_hidden() -> None:
    """The command line's own node is not the student's."""
    graph = written.graph([("/talker", "/chatter", written.STRING)], nodes=["/_ros2cli_daemon_0"])
    assert "1 node, 1 topic" in graph_text(graph)
    assert "2 nodes, 3 topics" in graph_text(graph, show_hidden=True)


def test_names_cannot_steer_the_terminal() -> None:
    """The graph of a strange network may hold anything."""
    graph = written.graph([("/talker\x1b[2J", "/chatter\n", written.STRING)])
    assert "\x1b" not in graph_text(graph) + describe_graph(graph)
    assert "/talker\\x1b[2J" in graph_text(graph)
