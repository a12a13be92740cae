"""The loop of the solution, as day 5 teaches it, ends at Ctrl-C in the middle of a goal.

On the wall's clock, on a simulated one, and where that is silent: a Rate hangs there for ever.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from ros2_on_pip.domain_lease import leased_domain
from roslings.course import lab
from skips import imported

imported("rclpy")
LAB = lab("actions")
WITHIN_S = 60.0
"""Only a test that fails waits so long."""

TRIES = 20
"""Of ends on a quiet computer, up to every second is broken by rclpy."""

OF_RCLPY = (
    "Unable to convert call argument",  # Ctrl-C came while a message was unpacked
    "rcl_shutdown already called",
    "context is invalid",
    "context is not valid",
)

FAR = {"x": 7.0, "y": 6.0, "tolerance": 0.1}
TICK_S = 0.05


class Beside:
    """A rover that stands, its clock, and who gives the goal."""

    def __init__(self, node: Any, executor: Any, *, has_clock: bool) -> None:
        from nav_msgs.msg import Odometry
        from rclpy.action import ActionClient
        from rosgraph_msgs.msg import Clock
        from rover_interfaces.action import DriveTo

        self._executor, self._has_clock, self._ticks = executor, has_clock, 0
        self._odom, self._odometry = node.create_publisher(Odometry, "odom", 10), Odometry()
        self._odometry.pose.pose.orientation.w = 1.0
        self._clock, self._now = node.create_publisher(Clock, "clock", 10), Clock()
        self._client, self._goal = ActionClient(node, DriveTo, "drive_to"), DriveTo.Goal(**FAR)
        self.feedback: list[Any] = []

    def turn(self) -> None:
        """Tell the place and the time, and hear what comes."""
        self._odom.publish(self._odometry)
        if self._has_clock:
            self._ticks += 1
            seconds, rest = divmod(self._ticks * round(TICK_S * 1e9), 10**9)
            self._now.clock.sec, self._now.clock.nanosec = seconds, rest
            self._clock.publish(self._now)
        self._executor.spin_once(timeout_sec=TICK_S)

    def until(self, condition: Callable[[], Any]) -> None:
        """Turn until it holds."""
        late_s = time.monotonic() + WITHIN_S
        while not condition():
            assert time.monotonic() < late_s
            self.turn()

    def give(self) -> None:
        """A goal that is accepted: again, while the server does not know the place."""
        self.until(self._client.server_is_ready)
        accepted = False
        while not accepted:
            future = self._client.send_goal_async(self._goal, self.feedback.append)
            self.until(future.done)
            accepted = future.result().accepted


@contextmanager
def beside(domain: int, *, has_clock: bool) -> Iterator[Beside]:
    """In a context of its own."""
    import rclpy
    from rclpy.executors import SingleThreadedExecutor
    from rclpy.signals import SignalHandlerOptions

    context = rclpy.Context()
    rclpy.init(context=context, domain_id=domain, signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node("beside", context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    try:
        yield Beside(node, executor, has_clock=has_clock)
    finally:
        executor.shutdown()
        node.destroy_node()
        context.try_shutdown()


@contextmanager
def server(domain: int, *words: str) -> Iterator[subprocess.Popen[str]]:
    """The solution's server, with the words of its command."""
    places = [str(LAB.solution), os.environ.get("PYTHONPATH", "")]
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(filter(None, places)),
        "ROS_DOMAIN_ID": str(domain),
    }
    process = subprocess.Popen(
        [sys.executable, "-m", "drive_to.drive_server", "--ros-args", *words],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    try:
        yield process
    finally:
        process.kill()
        process.wait()


@pytest.mark.parametrize("clock", ["of the wall", "simulated", "silent"])
def test_ctrl_c_ends_a_goal_under_way(clock: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """With exit code 0, and no error of its own: rclpy may write one where Ctrl-C meets it."""
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    ends = (interrupted(clock) for _ in range(TRIES))
    code, said = next(each for each in ends if not is_broken_by_rclpy(*each))
    assert code == 0, said
    assert "drive_server.py" not in said, said


def interrupted(clock: str) -> tuple[int, str]:
    """The exit code of a server with a goal under way, and what it wrote until its end."""
    words = [] if clock == "of the wall" else ["-p", "use_sim_time:=true"]
    with (
        leased_domain() as domain,
        server(domain, *words) as process,
        beside(domain, has_clock=clock == "simulated") as other,
    ):
        other.give()
        if clock != "silent":
            other.until(lambda: len(other.feedback) > 2)
        process.send_signal(signal.SIGINT)
        said, _ = process.communicate(timeout=WITHIN_S)
        return process.returncode, said


def is_broken_by_rclpy(code: int, said: str) -> bool:
    """Ctrl-C met rclpy itself: such an end tells nothing of the loop (`roslings.seen.exits`)."""
    return code != 0 and any(words in said for words in OF_RCLPY)
