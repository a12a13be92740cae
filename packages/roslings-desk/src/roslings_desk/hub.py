"""What all pages share: one node, the thread that spins it, and subscriptions that are counted.

A subscription is there as long as an open page shows its topic. Messages are kept as they came, in
bytes, and made into objects only when a page draws: a topic at 1,000 Hz then costs little.
"""

from __future__ import annotations

import os
import threading
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, field
from functools import partial
from queue import SimpleQueue
from types import TracebackType
from typing import Any, TypeVar

from ros2_on_pip.interfaces import class_of
from ros2_on_pip.listening import SeveralTypes
from ros2_on_pip.names import is_hidden
from roslings_desk.looking import DeskNode, heard_from_all

KEPT_MESSAGES, KEPT_BYTES = 2_000, 8_000_000
RATE_OVER_S = 3.0
LOOK_EVERY_S = 0.5
LOOKING_SHARE = 0.1
"""At most this part of the time is spent on looking at all topics."""
PATIENCE_S = 30.0
T = TypeVar("T")


@dataclass(frozen=True)
class Message:
    """One that was heard: its number (from 1), when it came, and its bytes."""

    number: int
    came_s: float
    """By the monotonic clock."""
    content: bytes


@dataclass(eq=False)
class SharedSubscription:
    """A topic that is listened to: how much came, and the newest of it."""

    topic: str
    type_name: str
    cls: Any
    count: int = 0
    size_b: int = 0
    """Of all messages together."""
    lost: int = 0
    """Messages that the middleware says it had to drop."""
    users: int = 0
    subscription: Any = field(default=None, repr=False)
    fits_nobody: bool = False
    """It was subscribed before there was a publisher, whose quality is not known so."""
    _kept: deque[Message] = field(default_factory=deque, repr=False)
    _kept_b: int = field(default=0, repr=False)
    _lately: deque[tuple[float, int]] = field(default_factory=deque, repr=False)
    _lock: threading.Lock = field(default_factory=threading.Lock, repr=False)

    def add(self, content: bytes) -> None:
        """One more has come."""
        now_s = time.monotonic()
        with self._lock:
            self.count += 1
            self.size_b += len(content)
            self._lately.append((now_s, len(content)))
            self._kept.append(Message(self.count, now_s, content))
            self._kept_b += len(content)
            self._forget(now_s)

    def _forget(self, now_s: float) -> None:
        while len(self._kept) > 1 and (
            len(self._kept) > KEPT_MESSAGES or self._kept_b > KEPT_BYTES
        ):
            self._kept_b -= len(self._kept.popleft().content)
        while self._lately and now_s - self._lately[0][0] > RATE_OVER_S:
            self._lately.popleft()

    def newest(self) -> Any | None:
        """The message that came last; None before the first."""
        with self._lock:
            last = self._kept[-1] if self._kept else None
        return self.read(last) if last else None

    def after(self, number: int) -> list[Message]:
        """Those that came after the one of this number, as far as they are kept."""
        with self._lock:
            return [each for each in self._kept if each.number > number]

    def read(self, message: Message) -> Any:
        """The object that the bytes stand for."""
        from rclpy.serialization import deserialize_message

        return deserialize_message(message.content, self.cls)

    def per_second(self) -> tuple[float, float]:
        """Messages and bytes a second, over the last three seconds; 0 where nothing comes."""
        now_s = time.monotonic()
        with self._lock:
            self._forget(now_s)
            times = [at_s for at_s, _ in self._lately]
            sizes = [size for _, size in self._lately]
        if len(times) < 2 or now_s - times[-1] > RATE_OVER_S / 2:
            return 0.0, 0.0
        span_s = max(times[-1] - times[0], 1e-6)
        return (len(times) - 1) / span_s, sum(sizes[1:]) / span_s


@dataclass(frozen=True)
class GraphTopic:
    """One topic of the graph, as others have it."""

    name: str
    types: tuple[str, ...]
    publishers: int
    subscriptions: int


class Hub:
    """A context manager: leaving the block ends node and thread."""

    def __init__(self, hidden: bool = False) -> None:
        self.name = f"{'_' if hidden else ''}desk_{os.getpid()}"
        """Of the node: two desks of one domain see each other. Lists leave a hidden one out."""
        self.desk_node = DeskNode(self.name)
        self.closing: set[Callable[[], None]] = set()
        """What is to be called before the node ends: it closes a tab that is open then."""
        self._ended = threading.Event()
        self._jobs: SimpleQueue[Callable[[], None]] = SimpleQueue()
        self._heard: dict[tuple[str, str], SharedSubscription] = {}
        self._lock = threading.Lock()
        self._look_s, self._topics = 0.0, tuple[GraphTopic, ...]()

    def __enter__(self) -> Hub:
        self.desk_node.__enter__()
        self._thread = threading.Thread(target=self._spin, name="ros")
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for close in list(self.closing):
            close()
        self.do(lambda: None).result(PATIENCE_S)  # what was asked for before is done by then
        self._ended.set()
        self._thread.join()
        self.desk_node.__exit__(kind, error, trace)

    def _spin(self) -> None:
        self.desk_node.settle()
        self.desk_node.until(self._ended.is_set)

    def do(self, act: Callable[[], T]) -> Future[T]:
        """Run `act` in the thread that spins; what it returns or raises is in the future.

        What is asked for first is done first: rclpy takes its newest task first.
        """
        future: Future[T] = Future()

        def run() -> None:
            if not future.set_running_or_notify_cancel():
                return
            try:
                future.set_result(act())
            except BaseException as error:  # it is the asker's, and must not end the thread
                future.set_exception(error)

        self._jobs.put(run)
        self.desk_node.soon(lambda: self._jobs.get_nowait()())
        return future

    # --- topics ----------------------------------------------------------------------------

    def topics(self) -> tuple[GraphTopic, ...]:
        """All topics that others take part in, hidden ones left out; half a second old at most.

        Where there are so many that a look takes long, it is made less often.
        """
        began_s = time.monotonic()
        if began_s >= self._look_s:
            names = sorted(name for name, _ in self.desk_node.node.get_topic_names_and_types())
            seen = [self._seen(name) for name in names if not is_hidden(name)]
            self._topics = tuple(each for each in seen if each.types)
            took_s = time.monotonic() - began_s
            self._fit_again()
            self._look_s = began_s + max(LOOK_EVERY_S, took_s / LOOKING_SHARE)
        return self._topics

    def _fit_again(self) -> None:
        """The first publisher of a topic has come: it may keep what it said before."""
        there = {seen.name for seen in self._topics if seen.publishers}
        with self._lock:
            late = [each for each in self._heard.values() if each.fits_nobody]
        for heard in late:
            if heard.topic in there:
                heard.fits_nobody = False
                self.do(partial(self._again, heard))

    def _seen(self, name: str) -> GraphTopic:
        """Its types as others have them: our own subscription may be of an older one."""
        publishers, subscriptions = (
            self.desk_node.publishers(name),
            self.desk_node.subscriptions(name),
        )
        types = dict.fromkeys(info.topic_type for info in (*publishers, *subscriptions))
        return GraphTopic(name, tuple(types), len(publishers), len(subscriptions))

    def type_of(self, topic: str) -> str | None:
        """The type of a topic; None where nobody has it. Raises SeveralTypes."""
        types = self._seen(topic).types if topic else ()
        if len(types) > 1:
            raise SeveralTypes(topic, list(types))
        return types[0] if types else None

    def hear(self, topic: str, type_name: str) -> SharedSubscription:
        """Listen to a topic until `leave` was called as often. Raises UnknownInterface."""
        cls = class_of(type_name, "msg")
        with self._lock:
            heard = self._heard.get((topic, type_name))
            if heard is None:
                heard = self._heard[topic, type_name] = SharedSubscription(topic, type_name, cls)
                self.do(partial(self._subscribe, heard))
            heard.users += 1
            return heard

    def leave(self, heard: SharedSubscription) -> None:
        """One page less shows it; after the last one nothing is subscribed any more."""
        with self._lock:
            heard.users -= 1
            if heard.users == 0:
                del self._heard[heard.topic, heard.type_name]
                self.do(partial(self._unsubscribe, heard))

    def _subscribe(self, heard: SharedSubscription) -> None:
        from rclpy.event_handler import SubscriptionEventCallbacks

        def lose(event: Any) -> None:
            heard.lost = event.total_count

        publishers = self.desk_node.publishers(heard.topic)
        heard.fits_nobody = not publishers
        heard.subscription = self.desk_node.node.create_subscription(
            heard.cls,
            heard.topic,
            heard.add,
            heard_from_all(publishers),
            raw=True,
            event_callbacks=SubscriptionEventCallbacks(
                incompatible_qos=lambda _: self.do(partial(self._again, heard)),
                message_lost=lose,
                use_default_callbacks=False,
            ),
        )

    def _unsubscribe(self, heard: SharedSubscription) -> None:
        if heard.subscription is not None:
            self.desk_node.node.destroy_subscription(heard.subscription)
            heard.subscription = None

    def _again(self, heard: SharedSubscription) -> None:
        """A publisher came that offers less than the others did."""
        if heard.subscription is not None:
            self._unsubscribe(heard)
            self._subscribe(heard)

    @property
    def heard(self) -> list[SharedSubscription]:
        """What is listened to now, by topic."""
        with self._lock:
            return sorted(self._heard.values(), key=lambda each: each.topic)
