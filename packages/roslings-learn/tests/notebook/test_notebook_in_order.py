"""An answer that comes while the question is being sent is not thrown away."""

from __future__ import annotations

import subprocess
import sys

import pytest

from skips import imported

pytestmark = pytest.mark.slow

imported("rclpy")

PROGRAM = """
import threading
from rclpy.action import ActionClient, ActionServer
from roslings_learn.notebook import session
from test_msgs.action import Fibonacci

def count(handle):
    handle.succeed()
    return Fibonacci.Result()

class Slow(dict):
    # What rclpy notes a question in, on a computer that is busy just then.
    def __setitem__(self, key, value):
        threading.Event().wait(0.3)
        super().__setitem__(key, value)

with session() as ros:
    server = ActionServer(ros.node("counter"), Fibonacci, "count", count)
    client = ActionClient(ros.node("asker"), Fibonacci, "count")
    ros.until(client.server_is_ready, "the server")
    client._goal_sequence_number_to_goal_id = Slow()
    client._pending_result_requests = Slow()
    handle = ros.wait(client.send_goal_async(Fibonacci.Goal(order=3)))
    print("accepted", handle.accepted)
    print("status", ros.wait(handle.get_result_async()).status)
"""


def test_an_answer_waits_until_its_question_is_noted() -> None:
    """rclpy alone would lose both: the server answers within a millisecond."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=False
    )
    assert "accepted True" in done.stdout, done.stdout + done.stderr
    assert "status 4" in done.stdout
