"""Plays a bag for the desk: whatever tab is open hears it as it hears nodes.

It is played by real publishers, in a domain that nobody else is in, so nothing on this computer
drives by what a bag says. It stands, goes on, and jumps while the pages stay open.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

from ros2_on_pip.bag.clock import BagClock
from ros2_on_pip.discovery import DirectNode
from ros2_on_pip.domain_lease import leased_domain
from ros2_on_pip.interfaces import UnknownInterface, class_of
from ros2_on_pip.problem import CommandProblem
from ros2_on_pip.rosbag2.errors import BagError
from ros2_on_pip.rosbag2.quality import offered
from ros2_on_pip.rosbag2.reading import open_bag

NODE = "bag"
SHORTLY_BEFORE_NS = 5 * 10**9
"""After a jump each topic says again what it said last, if it was that shortly before."""
LONGEST_WAIT_S = 3600.0


class BadBag(CommandProblem):
    """It is no bag, or it is damaged."""


class EmptyBag(CommandProblem):
    """Nothing in it can be played here."""

    def __init__(self, path: Path) -> None:
        super().__init__(
            f"The bag {path} has no message of a type that is installed here.\n"
            f"To see what it holds: ros2 bag info {path}"
        )


class BagPlayer:
    """An open bag, which plays while `played_by` runs. Any thread may call its methods."""

    def __init__(self, path: Path) -> None:
        """Raises BadBag, EmptyBag."""
        self.path = path
        try:
            self._reader = open_bag(path)
        except BagError as error:
            raise BadBag(str(error)) from error
        self._span = self._reader.metadata.span
        self.left_out: list[str] = []
        """Topics of types that are not installed here."""
        self._classes = dict(self._known())
        if not (self._classes and self._span.count):
            self.close()
            raise EmptyBag(path)
        self.trouble = ""
        """What ended it before the bag's end."""
        self._clock = BagClock(self._span.first_ns, 1.0, paused=False)
        self._wished_ns: int | None = self._span.first_ns
        self._is_ended = False
        self._changed = threading.Condition()

    def _known(self) -> Iterator[tuple[str, Any]]:
        for topic in self._reader.metadata.topics:
            try:
                yield topic.name, class_of(topic.type, "msg")
            except UnknownInterface:
                self.left_out.append(topic.name)

    def close(self) -> None:
        """The bag's files."""
        self._reader.close()

    @contextmanager
    def played_by(self, node: Any) -> Iterator[None]:
        """Play, by publishers of this node and a thread; leaving the block ends the thread."""
        self._publishers = {
            topic.name: node.create_publisher(
                self._classes[topic.name], topic.name, offered(topic.qos)
            )
            for topic in self._reader.metadata.topics
            if topic.name in self._classes
        }
        thread = threading.Thread(target=self._run, name="bag")
        thread.start()
        try:
            yield
        finally:
            with self._changed:
                self._is_ended = True
                self._changed.notify_all()
            thread.join()

    # --- what a page asks and wants --------------------------------------------------------

    @property
    def duration_s(self) -> float:
        """From the first message to the last."""
        return float(self._span.duration_ns / 1e9)

    @property
    def position_s(self) -> float:
        """Where it is, from the first message on."""
        with self._changed:
            played_s = (self._clock.now_ns() - self._span.first_ns) / 1e9
        return min(max(played_s, 0.0), self.duration_s)

    @property
    def is_paused(self) -> bool:
        """Whether it stands; at its end it does."""
        return self._clock.paused

    def pause(self, paused: bool) -> None:
        """Stand, or go on: after the end from the beginning."""
        with self._changed:
            if self._clock.now_ns() >= self._span.last_ns and not paused:
                self._wished_ns = self._span.first_ns
            self._clock.pause(paused)
            self._changed.notify_all()

    def jump(self, position_s: float) -> None:
        """Go on at another place; stand there, where it stood."""
        with self._changed:
            inside_s = min(max(position_s, 0.0), self.duration_s)
            self._wished_ns = self._span.first_ns + round(inside_s * 1e9)
            self._clock.set(self._wished_ns)
            self._changed.notify_all()

    # --- in its thread ---------------------------------------------------------------------

    def _run(self) -> None:
        try:
            while (begin_ns := self._await_wish()) is not None:
                self._say_again(begin_ns)
                if self._play_from(begin_ns):
                    self._rest_at_the_end()
        except BagError as error:
            self.trouble = str(error)

    def _await_wish(self) -> int | None:
        """Where to go on; None where it is ended."""
        with self._changed:
            while not self._is_ended and self._wished_ns is None:
                self._changed.wait()
            wished_ns, self._wished_ns = self._wished_ns, None
            if self._is_ended or wished_ns is None:
                return None
            self._clock.set(wished_ns)
            return wished_ns

    def _say_again(self, before_ns: int) -> None:
        """What was true at that moment, so that a tab shows it while the bag stands."""
        newest: dict[str, bytes] = {}
        for topic, time_ns, content in self._messages(max(before_ns - SHORTLY_BEFORE_NS, 0)):
            if time_ns >= before_ns:
                break
            newest[topic] = content
        for topic, content in newest.items():
            self._publishers[topic].publish(content)

    def _play_from(self, begin_ns: int) -> bool:
        """Whether it came to the bag's end; not where it jumps or is ended."""
        for topic, time_ns, content in self._messages(begin_ns):
            if not self._is_time(time_ns):
                return False
            self._publishers[topic].publish(content)
        return True

    def _messages(self, start_ns: int) -> Iterator[tuple[str, int, bytes]]:
        return self._reader.messages(lambda name, _: name in self._publishers, start_ns)

    def _is_time(self, time_ns: int) -> bool:
        """Wait until it is; False where something else is wanted before."""
        with self._changed:
            while not self._is_ended and self._wished_ns is None:
                if (left_s := self._clock.left_s(time_ns)) <= 0:
                    return True
                self._changed.wait(min(left_s, LONGEST_WAIT_S))
        return False

    def _rest_at_the_end(self) -> None:
        with self._changed:
            if self._wished_ns is None:
                self._clock.set(self._span.last_ns)
                self._clock.pause(True)


@contextmanager
def playing(path: Path) -> Iterator[BagPlayer]:
    """It plays, in a domain of its own, which is this process's from now on."""
    with leased_domain() as domain:
        os.environ["ROS_DOMAIN_ID"] = str(domain)
        with (
            closing(BagPlayer(path)) as player,
            DirectNode(NODE) as direct_node,
            player.played_by(direct_node.node),
        ):
            yield player
