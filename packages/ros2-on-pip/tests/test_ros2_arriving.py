"""What is said once comes there, though our own node knows of the others before they know of it.

Who speaks or asks does not hurry as a look does, and `pub` waits for who was late.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import inside
import pytest
from terminal import Running, Shell

from ros2_on_pip import discovery, publishing
from ros2_on_pip.discovery import DirectNode
from sources import python_path

LOCAL = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "PYTHONPATH": python_path()}
STRING = "std_msgs/msg/String"
LISTENER = """
import rclpy
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("listener")
node.create_subscription(String, "/said", lambda told: print(f"heard {told.data}", flush=True), 10)
print("all there", flush=True)
rclpy.spin(node)
"""
TIMES = 5

WHO_SPEAK = (
    ("topic", "pub", "--once", "/heard", STRING),
    ("param", "list", "/tuner"),
    ("service", "call", "/light", "std_srvs/srv/SetBool", "{data: true}"),
    ("lifecycle", "get", "/motor"),
    ("action", "send_goal", "/fibonacci", "test_msgs/action/Fibonacci", "{order: 1}"),
)
WHO_LOOK = (("node", "list"), ("topic", "info", "/heard"), ("service", "list"))


@contextmanager
def listening(shell: Shell) -> Iterator[Running]:
    """A node that hears /said; plain Python, which announces itself seldom."""
    with shell.program([sys.executable, "-c", LISTENER], **LOCAL) as listener:
        listener.wait_for("all there")
        yield listener


def said(text: str) -> tuple[str, ...]:
    """The words that say it once."""
    return ("topic", "pub", "--once", "/said", STRING, f"{{data: {text}}}")


def test_what_is_said_once_is_heard_each_time(empty: Shell) -> None:
    """By commands that end at once; nothing is lost, nothing comes twice."""
    with listening(empty) as listener:
        for number in range(TIMES):
            ran = inside.run(empty, *said(f"no {number}"))
            assert (ran.code, ran.err) == (0, "")
        listener.wait_for(f"heard no {TIMES - 1}")
        heard = [line for line in listener.lines if line.startswith("heard")]
    assert heard == [f"heard no {number}" for number in range(TIMES)]


def test_pub_waits_for_who_is_late(empty: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    """The listener is frozen when the message is sent, and goes on while it is waited for."""
    with listening(empty) as listener:
        monkeypatch.setattr(publishing, "_send", frozen_before(listener, publishing._send))
        monkeypatch.setattr(DirectNode, "spin_some", thawing(listener, DirectNode.spin_some))
        ran = inside.run(empty, *said("late"))
        assert (ran.code, ran.err) == (0, "")
        listener.wait_for("heard late")


def test_who_never_answers_is_told_and_not_waited_for_without_end(
    empty: Shell, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A message that nobody took is a warning: it was sent all the same."""
    monkeypatch.setattr(publishing, "ASKED_TO_ARRIVE", 2)
    with listening(empty) as listener:
        monkeypatch.setattr(publishing, "_send", frozen_before(listener, publishing._send))
        ran = inside.run(empty, *said("never"))
    assert ran.code == 0
    assert ran.err.startswith("WARNING: a node that subscribes to '/said' did not take the last")


def frozen_before(listener: Running, send: Any) -> Any:
    """`send`, and before it the listener is frozen."""

    def then(*words: Any) -> None:
        os.killpg(listener.process.pid, signal.SIGSTOP)
        send(*words)

    return then


def thawing(listener: Running, spin: Any) -> Any:
    """`spin`, and before it the listener goes on."""

    def then(node: DirectNode) -> None:
        os.killpg(listener.process.pid, signal.SIGCONT)
        spin(node)

    return then


@pytest.mark.parametrize("words", WHO_SPEAK, ids=" ".join)
def test_who_speaks_or_asks_does_not_hurry(
    stage: Shell, monkeypatch: pytest.MonkeyPatch, words: tuple[str, ...]
) -> None:
    """An answer to who is not known yet would be lost."""
    monkeypatch.setattr(discovery, "bare_node", refused)
    assert inside.run(stage, *words).code == 0


@pytest.mark.parametrize("words", WHO_LOOK, ids=" ".join)
def test_who_only_looks_does(
    stage: Shell, monkeypatch: pytest.MonkeyPatch, words: tuple[str, ...]
) -> None:
    """The same refusal ends the look: so the test above is one that can fail."""
    monkeypatch.setattr(discovery, "bare_node", refused)
    assert "only a look may" in inside.run(stage, *words).err


def refused(*_: object) -> None:
    """In place of what opens a bare node."""
    raise RuntimeError("only a look may open it")
