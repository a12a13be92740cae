"""A list names everybody who answers, whoever is frozen or dies; it needs no whole node."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable
from typing import Any

import inside
import pytest
from terminal import Running, Shell

from ros2_on_pip import discovery as direct_node
from ros2_on_pip.bare_node import BareNode
from ros2_on_pip.discovery import DirectNode, Settling
from ros2_on_pip.graph.seen import graph_seen_by
from ros2_on_pip.look_profile import FILE
from ros2_on_pip.profiles import QUICK_DISCOVERY
from sources import python_path

LOCAL = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "PYTHONPATH": python_path()}
MANY = 10
PROGRAM = """
import signal, sys
import rclpy
from rclpy.context import Context
from rclpy.node import Node
from std_msgs.msg import String
kept = []
for n in range(int(sys.argv[1])):
    context = Context()
    rclpy.init(context=context)
    space = "/team" if n % 2 else "/"
    node = Node(f"{'_' if n == 3 else ''}node_{n}", namespace=space, context=context)
    kept.append((context, node, node.create_publisher(String, f"/topic_{n}", 10)))
print("all there", flush=True)
signal.pause()
"""
"""Nodes, each a participant of its own, some in a namespace and one of them hidden."""

FEW_LOOKS = 60
"""Who is silent for so many is given up: the test of a frozen program waits no longer."""


def talking(running: Running) -> Running:
    """A talker that has begun."""
    running.wait_for("Publishing")
    return running


def test_a_list_beside_many_is_complete_each_time(empty: Shell) -> None:
    """All of them introduce themselves in one moment, and none is lost."""
    names = [f"{'/team' if n % 2 else ''}/node_{n}" for n in range(MANY)]
    shown = sorted(name for name in names if name != "/team/node_3")
    everybody = sorted([*shown, "/team/_node_3"])
    topics = {f"/topic_{n}" for n in range(MANY)}
    with empty.program([sys.executable, "-c", PROGRAM, str(MANY)], **LOCAL) as program:
        program.wait_for("all there")
        for _ in range(3):
            ran = inside.run(empty, "node", "list")
            assert (ran.lines, ran.err) == (shown, "")
            assert topics <= set(inside.run(empty, "topic", "list").lines)
        assert inside.run(empty, "node", "list", "--all").lines == everybody
        info = inside.run(empty, "topic", "info", "/topic_4")
        assert "Publisher count: 1" in info.lines


def test_a_frozen_program_is_given_up_and_told(
    empty: Shell, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It holds its port and answers nothing; who does answer is in the list."""
    monkeypatch.setattr(direct_node, "SILENT_LOOKS", FEW_LOOKS)
    plain = [sys.executable, "-c", PROGRAM, "1"]
    with (
        empty.program(plain, **LOCAL) as lives,
        empty.start("run", "demo_nodes_py", "talker") as frozen,
    ):
        lives.wait_for("all there")
        talking(frozen)
        os.killpg(frozen.process.pid, signal.SIGSTOP)
        ran = inside.run(empty, "node", "list")
        assert ran.code == 0
        assert "/node_0" in ran.lines
        assert "1 program on this computer did not answer" in ran.err


def test_who_dies_during_the_question_holds_nobody_up(
    empty: Shell, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It was there at the first look, and is killed then: nobody waits for it, nothing is said."""
    plain = [sys.executable, "-c", PROGRAM, "1"]
    with (
        empty.program(plain, **LOCAL) as lives,
        empty.start("run", "demo_nodes_py", "talker") as dies,
    ):
        lives.wait_for("all there")
        talking(dies)
        monkeypatch.setattr(Settling, "after", killing(dies, Settling.after))
        ran = inside.run(empty, "node", "list")
        assert dies.wait() == -signal.SIGKILL
        assert (set(ran.lines) - {"/talker"}, ran.err) == ({"/node_0"}, "")


def killing(running: Running, after: Callable[..., bool]) -> Callable[..., bool]:
    """`after`, and before its first turn `running` is killed."""

    def then(settling: Settling, sight: Any) -> bool:
        if running.process.poll() is None:
            os.killpg(running.process.pid, signal.SIGKILL)
            running.process.wait()
        return after(settling, sight)

    return then


def test_a_bare_node_sees_what_a_whole_one_sees(stage: Shell) -> None:
    """The same nodes, topics, services and endpoints, from one node after the other."""
    with inside.surroundings_of(stage):
        os.environ.update(LOCAL)
        with DirectNode() as looking:
            assert isinstance(looking.settle().graph, BareNode)
            bare = everything_seen_by(looking)
            assert looking.node is looking.graph
            assert everything_seen_by(looking) == bare
        assert bare[0]


def everything_seen_by(looking: DirectNode) -> tuple[object, ...]:
    """Of others; what each node has, too."""
    nodes = looking.settle().nodes(hidden=True)
    parts = [
        looking.of_node(what, node)
        for node in nodes
        for what in ("publisher", "subscriber", "service", "client")
    ]
    services = looking.services()
    counts = [(looking.graph.count_clients(s), looking.graph.count_services(s)) for s in services]
    topics = looking.topics()
    ends = [str(info) for t in topics for info in looking.publishers(t) + looking.subscriptions(t)]
    return nodes, topics, services, counts, parts, graph_seen_by(looking).nodes, sorted(ends)


def test_two_who_look_at_once_do_not_wait_for_each_other(
    empty: Shell, capsys: pytest.CaptureFixture[str]
) -> None:
    """Each sees whose participant the other is: a bare node has an endpoint, too."""
    with inside.surroundings_of(empty):
        os.environ.update(LOCAL)
        with DirectNode() as one, DirectNode() as another:
            assert one.settle().nodes(hidden=True) == another.settle().nodes(hidden=True) == []
            assert isinstance(one.graph, BareNode)
            with DirectNode("named") as third:
                assert third.graph is third.node
                assert third.settle().nodes() == []
                assert one.settle().nodes() == ["/named"]
    assert capsys.readouterr().err == ""


def test_the_whole_node_takes_the_bare_ones_place(empty: Shell) -> None:
    """Others see one node of ours, and nobody sees two of the same name."""
    with inside.surroundings_of(empty):
        os.environ.update(LOCAL)
        with DirectNode() as looking:
            before = looking.graph.get_node_names_and_namespaces()
            after = looking.node.get_node_names_and_namespaces()
            assert len(before) == len(after) == 1
            assert before != after
            assert looking.settle().services() == {}


@pytest.mark.parametrize(
    ("where", "what"),
    [
        ("rclpy.utilities.get_rmw_implementation_identifier", lambda: "rmw_cyclonedds_cpp"),
        ("ros2_on_pip.bare_node.TYPE_OF_IT", ("rcl_interfaces", "of_a_later_ros")),
    ],
    ids=["another middleware", "another rclpy"],
)
def test_where_a_bare_node_is_not_known_to_do_rclpys_own_looks(
    empty: Shell, monkeypatch: pytest.MonkeyPatch, where: str, what: object
) -> None:
    """It is made at once, as for a node that speaks, and sees the same."""
    monkeypatch.setattr(where, what)
    with empty.start("run", "demo_nodes_py", "talker") as talker:
        talking(talker)
        with inside.surroundings_of(empty):
            os.environ.update(LOCAL)
            with DirectNode() as looking:
                assert looking.graph is looking.node
                assert looking.settle().nodes() == ["/talker"]


def test_nodes_that_are_started_are_told_what_a_terminal_tells_them(empty: Shell) -> None:
    """The file for a look is for our own participant only; another's file is left alone."""
    with inside.surroundings_of(empty):
        os.environ.update(LOCAL)
        for file in (str(QUICK_DISCOVERY), "/nowhere/of_the_student.xml"):
            os.environ[FILE] = file
            with DirectNode():
                assert os.environ[FILE] == file
