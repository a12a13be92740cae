"""The simulated clock: the probe publishes /clock, and waits until the nodes have kept up."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from typing import Any

from roslings.evidence import Tick
from roslings.probe.events import no_publisher_events

TRIPS = 2
"""After one round trip the node has taken the tick; after two it has run what became due.

Measured: with one, gaps of 0.4 s to 0.6 s; with two a single-threaded node is exact.
"""


LOOK_AGAIN_S = 0.05
"""Whoever is asked may end instead of answering."""


class Barrier:
    """Shows that nodes have handled what came to them: each answers requests for a parameter."""

    def __init__(self, probe_node: Any, nodes: Sequence[str]) -> None:
        from rcl_interfaces.srv import GetParameters

        self._node = probe_node
        self._request = GetParameters.Request(names=["use_sim_time"])
        self._clients = [
            probe_node.create_client(GetParameters, f"{n}/get_parameters") for n in nodes
        ]
        self._passed = threading.Event()
        self._left = 0
        self.lives: Callable[[], bool] = lambda: True
        """Whether somebody is still there to answer."""

    @property
    def ready(self) -> bool:
        """Every node's service is known."""
        return all(client.service_is_ready() for client in self._clients)

    def passed(self, within_s: float) -> bool:
        """Send all nodes on their round trips at once; whether all came back in time."""
        self.send()
        deadline_s = time.monotonic() + within_s
        while not self._passed.wait(min(within_s, LOOK_AGAIN_S)):
            if time.monotonic() > deadline_s or not self.lives():
                return self._passed.is_set()
        return True

    def send(self) -> None:
        """Send all nodes on their round trips at once, and do not wait."""
        self._passed.clear()
        self._left = len(self._clients)
        for client in self._clients:
            self._trip(client, TRIPS)

    @property
    def is_passed(self) -> bool:
        """All came back."""
        return self._passed.is_set()

    def close(self) -> None:
        """Forget the nodes."""
        for client in self._clients:
            self._node.destroy_client(client)

    def _trip(self, client: Any, trips: int) -> None:
        """One request; its answer, in the probe's thread, starts the next one."""

        def answered(_: Any) -> None:
            if trips > 1:
                self._trip(client, trips - 1)
            else:
                self._arrive()

        client.call_async(self._request).add_done_callback(answered)

    def _arrive(self) -> None:
        self._left -= 1
        if self._left == 0:
            self._passed.set()


class SimClock:
    """Robot time, as the nodes of one experiment see it."""

    def __init__(self, probe_node: Any, ticks: list[Tick]) -> None:
        from rclpy.qos import QoSProfile, ReliabilityPolicy
        from rosgraph_msgs.msg import Clock

        self.ticks = ticks
        self.grid_ns = 10**9
        """It begins at a multiple of this."""
        self._message = Clock
        # As a simulator has it (rclpy's own time source asks for best effort, depth 1).
        quality = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
        self._publisher = probe_node.create_publisher(
            Clock, "/clock", quality, event_callbacks=no_publisher_events()
        )

    @property
    def listeners(self) -> int:
        """How many subscriptions the clock is joined with."""
        return int(self._publisher.get_subscription_count())

    def tick(self, step_ns: int, barrier: Barrier, within_s: float) -> bool:
        """Advance by one step, or begin; whether all nodes have handled it in time."""
        from builtin_interfaces.msg import Time

        now_ns = self.ticks[-1].sim_ns + step_ns if self.ticks else self._begin_ns()
        seconds, rest_ns = divmod(now_ns, 10**9)
        message = self._message(clock=Time(sec=seconds, nanosec=rest_ns))
        wall_ns, at_ns = time.time_ns(), time.monotonic_ns()
        self._publisher.publish(message)
        kept_up = barrier.passed(within_s)
        self.ticks.append(Tick(sim_ns=now_ns, wall_ns=wall_ns, at_ns=at_ns, kept_up=kept_up))
        return kept_up

    def _begin_ns(self) -> int:
        """Where a computer's clock stands, so that `now - Duration(...)` is a time.

        A timer of ROS keeps to multiples of its period since its node's clock showed 0. Where the
        grid is that period, it speaks at steps of the clock, and never late between two of them.
        """
        return time.time_ns() // self.grid_ns * self.grid_ns
