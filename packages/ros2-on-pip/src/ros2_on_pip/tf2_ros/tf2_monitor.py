"""`ros2 run tf2_ros tf2_monitor [FRAME FRAME]`: how old steps are when they come, and how often."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import Any

import rclpy
import tf2_ros
from rclpy.clock import Clock, ClockType
from rclpy.time import Time

from ros2_on_pip.frames_heard import FrameHeard, FramesHeard
from ros2_on_pip.tf_program import FAILED, run

USAGE = "TF_Monitor: usage: tf2_monitor framea frameb"
TELLS_EVERY_S = 2.0
LOOKS_EVERY_S = 0.5
NOBODY = "<no authority available>"
TOPICS = TF_TOPIC, TF_STATIC_TOPIC = "/tf", "/tf_static"


class Monitor:
    """Tells of all frames, or of those on the way from one to another."""

    def __init__(self, node: Any, chain: list[str]) -> None:
        """`chain` is empty, or two frames."""
        self.node, self.ends = node, chain
        self.buffer = tf2_ros.Buffer(node=node)
        self.frames = FramesHeard(lambda: node.get_clock().now().nanoseconds)
        self.listeners = [tf2_ros.TransformListener(each, node) for each in self._filled]
        self.net_delays_s: list[float] = []
        clock = Clock(clock_type=ClockType.STEADY_TIME)
        self.timers = [
            node.create_timer(LOOKS_EVERY_S, self.look, clock=clock),
            node.create_timer(TELLS_EVERY_S, self.tell, clock=clock),
        ]
        if chain:
            print(f"Waiting for transform chain to become available between {' and '.join(chain)}")

    @property
    def _filled(self) -> list[Any]:
        return [self.buffer, self.frames] if self.ends else [self.frames]

    def look(self) -> None:
        """Note how old the newest between the two frames is."""
        if self.ends and self.buffer.can_transform(*self.ends, Time()):
            stamp = Time.from_msg(self.buffer.lookup_transform(*self.ends, Time()).header.stamp)
            if stamp.nanoseconds:  # 0 where nothing between them moves
                late = self.node.get_clock().now().nanoseconds - stamp.nanoseconds
                self.net_delays_s.append(late / 1e9)

    def tell(self) -> None:
        """Print what was heard so far."""
        chain = self._chain()
        if chain or not self.ends:
            print("\n".join(self._told(chain)), flush=True)

    def _chain(self) -> list[str]:
        """From the second frame to the first; empty where there is no way yet."""
        if not self.ends or not self.buffer.can_transform(*self.ends, Time()):
            return []
        to, start = self.ends
        chain: list[str] = self.buffer._chain(to, Time(), start, Time(), to)
        return chain

    def _told(self, chain: list[str]) -> Iterator[str]:
        yield f"\n\n\nRESULTS: for {' to '.join(self.ends) if self.ends else 'all Frames'}"
        if chain:
            yield f"Chain is: {' -> '.join(chain)}"
            yield f"Net delay     {_delays('avg = {:g}: max = {:g}', self.net_delays_s)}"
        yield "\nFrames:"
        for name, heard in sorted(self.frames.frames.items()):
            if not chain or name in chain:
                yield self._about(heard)
        yield "\nAll Broadcasters:"
        yield from (f"Node: {name}, on {topic}" for topic in TOPICS for name in self._on(topic))

    def _about(self, heard: FrameHeard) -> str:
        """A message does not say who sent it; the graph knows who could have."""
        names = " or ".join(self._on(TF_TOPIC if heard.moves else TF_STATIC_TOPIC)) or NOBODY
        delay = _delays("Average Delay: {:g}, Max Delay: {:g}", heard.delays_s)
        return f"Frame: {heard.name}, published by {names}, {delay if heard.moves else 'static'}"

    def _on(self, topic: str) -> list[str]:
        """The nodes that publish there."""
        found = self.node.get_publishers_info_by_topic(topic)
        return sorted({f"{each.node_namespace.rstrip('/')}/{each.node_name}" for each in found})


def _delays(form: str, delays_s: Any) -> str:
    known = list(delays_s) or [0.0]
    return form.format(sum(known) / len(known), max(known))


def main(words: list[str]) -> int:
    """Run until Ctrl-C."""
    if len(words) not in (0, 2):
        print(USAGE)
        return FAILED
    monitor = Monitor(rclpy.create_node("tf2_monitor"), words)
    rclpy.spin(monitor.node)
    return 0


if __name__ == "__main__":
    sys.exit(run(main))
