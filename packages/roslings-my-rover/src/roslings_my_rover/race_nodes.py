"""The race as ROS nodes: a rover in each namespace, and the one who starts them.

All names are relative to the namespace of a rover: nothing of red is heard by blue. No /tf is
published, whose name is the same for all.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import dataclass, field
from typing import Any

from roslings_my_rover.race import Entrant, Race
from roslings_rover.rover.driven import DrivenRover
from roslings_rover.rover.frames import FrameOptions
from roslings_rover.rover.messages import QUIET
from roslings_rover.rover.node import NAME
from roslings_rover.rover.subscriptions import LONGEST_SENTENCE, SENTENCE_LASTS_S, HeardSentence

STARTER = "race"
WANTED, ALLOWED, TAG = "cmd_vel_in", "cmd_vel", "beacon"
"""What the limiter hears, what it says, and where the beacon tells the name: as on day 8's card."""
LIGHT_S = 1.0
SAY_EVERY_S = 0.1


@dataclass
class RacingRover(DrivenRover):
    """A rover in a namespace of its own, with the name that its beacon tells."""

    entrant: Entrant = field(kw_only=True)
    clash: str = ""
    """Who is there that should not be; a command does not wipe it away."""
    _tag: HeardSentence | None = None
    _tag_s: float = -math.inf

    @property
    def space(self) -> str:
        """Its namespace, as /red."""
        return f"/{self.entrant.colour}"

    @property
    def sentence(self) -> HeardSentence | None:
        """What its beacon says, as long as it says it."""
        return self._tag if time.monotonic() - self._tag_s < SENTENCE_LASTS_S else None

    def enter(self, context: Any, executor: Any) -> None:
        """In a context that several share."""
        import rclpy

        self._context, self._executor = context, executor
        self._node = rclpy.create_node(NAME, namespace=self.space, context=context)
        executor.add_node(self._node)
        self._open_topics()
        self._open_timers()
        self._stepped_s = time.monotonic()

    def leave(self) -> None:
        """The context goes on without it."""
        self._executor.remove_node(self._node)
        self._node.destroy_node()

    def _open_topics(self) -> None:
        super()._open_topics()
        from std_msgs.msg import String

        self._tag_subscription = self._node.create_subscription(String, TAG, self._take_tag, 10)

    def _take_tag(self, said: Any) -> None:
        line = "".join(letter for letter in " ".join(said.data.split()) if letter.isprintable())
        self._tag = HeardSentence(line[:LONGEST_SENTENCE], f"{self.space}/{TAG}")
        self._tag_s = time.monotonic()

    def _look_for_twins(self) -> None:
        """A rover of the same name in the same namespace, or a second one who drives this one."""
        names = self._node.get_node_names_and_namespaces()
        if names.count((NAME, self.space)) > 1:
            self.clash = "A second race runs here. End one with Ctrl-C."
            return
        there = self._node.get_publishers_info_by_topic(ALLOWED)
        speakers = sorted({f"{each.node_namespace.rstrip('/')}/{each.node_name}" for each in there})
        link = f"{self.space}/{ALLOWED}"
        self.clash = f"{' and '.join(speakers)} both say {link}." if len(speakers) > 1 else ""


@dataclass
class RaceNode:
    """Both rovers and their starter. A context manager; `turn` must be called again and again."""

    race: Race
    ended: str = ""
    """What there is to say of a launch file that has ended."""
    _parts: ExitStack = field(default_factory=ExitStack, repr=False)

    def __post_init__(self) -> None:
        self.rovers = [
            RacingRover(entrant.rover, frames=FrameOptions(published=False), entrant=entrant)
            for entrant in self.race.entrants
        ]

    def __enter__(self) -> RaceNode:
        import rclpy
        from rclpy.executors import SingleThreadedExecutor
        from rclpy.signals import SignalHandlerOptions

        context = rclpy.Context()
        rclpy.init(args=QUIET, context=context, signal_handler_options=SignalHandlerOptions.NO)
        self._parts.callback(context.try_shutdown)
        self._executor = SingleThreadedExecutor(context=context)
        self._parts.callback(self._executor.shutdown)
        for rover in self.rovers:
            rover.enter(context, self._executor)
            self._parts.callback(rover.leave)
        self._open_starter(rclpy.create_node(STARTER, context=context))
        return self

    def __exit__(self, *_: object) -> None:
        self._parts.close()

    def _open_starter(self, node: Any) -> None:
        from geometry_msgs.msg import Twist

        self._node, self._twist = node, Twist
        self._executor.add_node(node)
        self._parts.callback(node.destroy_node)
        self._publishers = {
            rover.space: node.create_publisher(Twist, f"{rover.space}/{WANTED}", 10)
            for rover in self.rovers
        }
        node.create_timer(SAY_EVERY_S, self._say)
        node.create_timer(LIGHT_S, self._count_down)

    def turn(self) -> None:
        """Do the next thing that is due."""
        self._executor.spin_once(timeout_sec=0.02)
        self.race.look()

    @property
    def missing(self) -> list[str]:
        """What a start needs and is not there yet."""
        return list(self._missing())

    def _missing(self) -> Iterator[str]:
        for rover in self.rovers:
            if not self._node.count_subscribers(f"{rover.space}/{WANTED}"):
                yield f"nobody hears {rover.space}/{WANTED}"
            elif not self._node.count_publishers(f"{rover.space}/{ALLOWED}"):
                yield f"nobody says {rover.space}/{ALLOWED}"

    @property
    def told(self) -> str:
        """The news, in one line of at most 80 columns."""
        clash = next((rover.clash for rover in self.rovers if rover.clash), "")
        if clash or self.ended:
            return clash or self.ended
        if not self.race.started and (missing := self.missing):
            return f"The race waits: {missing[0]}."
        return self.race.told

    def _count_down(self) -> None:
        if not (self.missing or self.ended):
            self.race.count_down()

    def _say(self) -> None:
        """Nothing before the start, and zero behind the finish."""
        if not self.race.started:
            return
        for rover in self.rovers:
            command = self._twist()
            command.linear.x = rover.entrant.told_m_s
            self._publishers[rover.space].publish(command)
