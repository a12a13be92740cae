"""Timers by a simulated clock: what a plot shows then is the node's, and no busy computer's.

The site is built on computers that do other things, too. There, a cell that plots a topic of its
own nodes hears them in simulated time. The clock goes from one timer's deadline to the next, as
soon as each node has handled the step. A callback that sleeps takes no simulated time. So what is
heard is believed only where the nodes are at least twice as fast as real time.
"""

from __future__ import annotations

import threading
import time
from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from roslings_learn.notebook.hearing import HeardMessage
from roslings_learn.notebook.release import nodes_of
from roslings_learn.notebook.session import Session

NS_PER_S = 1_000_000_000
LOOK_EVERY_S = 0.001
HANDLED_WITHIN_S = 2.0
TWICE_AS_FAST = 0.5
"""At most this part of the simulated time may have passed in reality."""


@dataclass
class Clock:
    """The ticks that were given: simulated time and the wall's, both in nanoseconds."""

    nodes: Sequence[Any]
    publish: Callable[[int], None]
    """Tells all nodes the simulated time."""
    sim_ns: list[int] = field(default_factory=list)
    wall_ns: list[int] = field(default_factory=list)

    def run(self, stop: threading.Event) -> None:
        """Go from deadline to deadline, until `stop`, or until a step is not handled."""
        self._tick(time.time_ns())
        while not stop.is_set() and self._handled(stop):
            self._tick(self.sim_ns[-1] + max(1, self._until_next_ns()))

    def _tick(self, sim_ns: int) -> None:
        self.sim_ns.append(sim_ns)
        self.wall_ns.append(time.time_ns())
        self.publish(sim_ns)

    def _handled(self, stop: threading.Event) -> bool:
        """Every node knows the time, and has called each timer that was due."""
        end_s = time.monotonic() + HANDLED_WITHIN_S
        while not (self._known() and self._until_next_ns() > 0):
            if stop.is_set() or time.monotonic() > end_s:
                return False
            time.sleep(LOOK_EVERY_S)
        return True

    def _known(self) -> bool:
        return all(node.get_clock().now().nanoseconds >= self.sim_ns[-1] for node in self.nodes)

    def _until_next_ns(self) -> int:
        """To the next deadline of all timers."""
        return int(min(timer.time_until_next_call() for n in self.nodes for timer in n.timers))

    def sim_s(self, heard: HeardMessage) -> float:
        """When a message was sent: at the last tick before it, in simulated seconds."""
        passed = bisect_right(self.wall_ns, round(heard.sent_s * NS_PER_S))
        return self.sim_ns[max(0, passed - 1)] / NS_PER_S

    @property
    def believed(self) -> bool:
        """The nodes were fast enough, so nothing that took them time was left out."""
        passed_ns = self.sim_ns[-1] - self.sim_ns[0]
        return self.wall_ns[-1] - self.wall_ns[0] <= TWICE_AS_FAST * passed_ns


def simulated_times_s(ros: Session, topic: str, count: int, timeout_s: float) -> list[float] | None:
    """When `count` messages of `topic` were sent, in simulated seconds; None where not believed.

    Raises what `ros.collect` raises.
    """
    nodes = [node for node in nodes_of(ros.context) if list(node.timers)]
    if not nodes:
        return None
    with _stepping(ros, nodes) as clock:
        heard = ros.collect(topic, count=count, timeout_s=timeout_s, stamps=True)
    return [clock.sim_s(each) for each in heard] if clock.believed else None


@contextmanager
def _stepping(ros: Session, nodes: Sequence[Any]) -> Iterator[Clock]:
    """Within the block the nodes live by a clock that we step; after it, by the wall's again."""
    from rclpy.time import Time
    from rosgraph_msgs.msg import Clock as ClockMessage

    from roslings_learn.notebook.hearing import quiet_node

    clock_node = quiet_node("_notebook_clock", ros.context)
    said = clock_node.create_publisher(ClockMessage, "/clock", 10)
    clock = Clock(nodes, lambda ns: said.publish(ClockMessage(clock=Time(nanoseconds=ns).to_msg())))
    stop = threading.Event()
    thread = threading.Thread(target=clock.run, args=[stop], name="roslings clock", daemon=True)
    try:
        _use_simulated_time(nodes, True)
        ros.until(lambda: said.get_subscription_count() >= len(nodes), "the clock to be heard")
        thread.start()
        yield clock
    finally:
        stop.set()
        if thread.is_alive():
            thread.join()
        _use_simulated_time(nodes, False)
        clock_node.destroy_node()


def _use_simulated_time(nodes: Sequence[Any], simulated: bool) -> None:
    from rclpy.parameter import Parameter

    for node in nodes:
        node.set_parameters([Parameter("use_sim_time", Parameter.Type.BOOL, simulated)])
