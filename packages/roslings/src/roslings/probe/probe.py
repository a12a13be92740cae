"""The grader's own node: it watches one domain, records what is said there, and can speak."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from types import TracebackType
from typing import Any

from roslings.evidence import (
    CanarySeen,
    Endpoint,
    ExperimentSeen,
    GraphSeen,
    LogLine,
    Qos,
    Spoken,
)
from roslings.probe import canary
from roslings.probe.budget import MB, ByteBudget, Share, Store, size_of
from roslings.probe.clock import Barrier, SimClock
from roslings.probe.content import from_plain
from roslings.probe.events import no_publisher_events
from roslings.probe.graph import MOST_BYTES, Looker
from roslings.probe.raw_subscription import RawSubscription, SubscriptionQueues
from roslings.probe.recorder import Read, TopicRecorder, can_record
from roslings.seen.matching import own_endpoints
from roslings.seen.rates import place_on_ticks

NAME = "_roslings_probe"
LOOK_EVERY_S = 0.04
REST_AFTER_LOOK = 3.0
"""Times the look's own duration: to read a graph of 2,000 topics takes long, and a processor."""
HEARTBEAT_S = 0.02
BETWEEN_WITHIN_S = 20.0
MOST_LOG_LINES = 2000
LONGEST_LOG_LINE = 2000
LARGEST_LOG_BYTES = 4 * MB
MOST_LOGGERS = 200
LOGGERS_OWN_BYTES = 16 * 1024
"""Of each logger: 40 lines are kept, whatever others write."""

MOST_TOPICS = 200
"""Each one recorded costs us a subscription, and those who publish on it time."""
Condition = Callable[[], bool]


class CalledOff(BaseException):
    """Nobody wants to know any more: leave every block, and end what was started."""


class Probe:
    """Watches one ROS domain and writes what it sees into an `ExperimentSeen`.

    A context manager: leaving the block ends its thread, its node and its context.
    """

    def __init__(
        self,
        domain_id: int,
        seen: ExperimentSeen,
        record: bool = True,
        large_bytes: int = 0,
        whole: ByteBudget | None = None,
        queues: ByteBudget | None = None,
    ) -> None:
        """With `record` off it looks at the graph and hears no message.

        `large_bytes` of messages too large to be read are kept as bytes, for a bag. `whole` is
        what all experiments may keep together, `queues` what the middleware may hold for all.
        """
        self.seen = seen
        self._records = record
        self._domain_id = domain_id
        self.store = Store(whole, large_bytes)
        self._queues = SubscriptionQueues(queues)
        self._loggers: dict[str, Share] = {}
        self._unheard: set[str] = set()
        self._recorders: dict[str, TopicRecorder] = {}
        self._publishers: dict[str, Any] = {}
        self._readers: dict[str, Read] = {}
        self._changed = threading.Condition()
        self._closing = threading.Event()
        self._called_off = False
        self._rests_until_s = 0.0
        self._canaries = 0
        """Those begun so far; one that was ended may still be in the graph."""

    def __enter__(self) -> Probe:
        import rclpy
        from rclpy.executors import SingleThreadedExecutor
        from rclpy.node import Node
        from rclpy.parameter import Parameter

        self._context = rclpy.Context()
        rclpy.init(context=self._context, domain_id=self._domain_id, signal_handler_options=None)
        self._node = Node(
            NAME,
            context=self._context,
            enable_rosout=False,
            start_parameter_services=False,
            parameter_overrides=[Parameter("start_type_description_service", value=False)],
        )
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._graph_bytes = MOST_BYTES if self.store.budget.take(MOST_BYTES) else 0
        self._looker = Looker(self._node, self._graph_bytes)
        self._left_out = 0
        self._hear_logs()
        self._threads = [
            threading.Thread(target=self._spin, name="probe"),
            threading.Thread(target=self._beat, name="heartbeat"),
        ]
        for thread in self._threads:
            thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._closing.set()
        self._executor.create_task(_nothing)  # a task ends spin_once(); wake() does not
        for thread in self._threads:
            thread.join()
        self._executor.shutdown()
        self._node.destroy_node()
        self._context.try_shutdown()
        self._queues.close()
        for name, recorder in self._recorders.items():
            recorder.read_contents()
            place_on_ticks(recorder.seen.messages, self.seen.ticks)
            self.seen.topics[name] = recorder.seen
        self.store.drop("rosout", int(self._logs.cut_short))
        self.store.drop("topics", len(self._unheard))
        self.store.drop("graph", self._left_out)
        self.store.budget.give_back(self._graph_bytes - size_of(self.seen.graph))
        self.seen.dropped = self.store.close()

    @property
    def recorders(self) -> Mapping[str, TopicRecorder]:
        """What was heard, topic by topic, with the bytes as they came."""
        return self._recorders

    @property
    def node(self) -> Any:
        """The rclpy node behind the probe, for what else of it is to be used."""
        return self._node

    def until(self, condition: Condition, within_s: float) -> bool:
        """Watch until `condition()` is true, at most `within_s`. Whether it became true.

        The graph is looked at each time, and each new topic is recorded from then on.
        Raises CalledOff when another thread has called this watch off.
        """
        deadline_s = time.monotonic() + within_s
        while True:
            if self._called_off:
                raise CalledOff
            self.look()
            if condition():
                return True
            left_s = deadline_s - time.monotonic()
            if left_s <= 0:
                return False
            with self._changed:
                self._changed.wait(min(LOOK_EVERY_S, left_s))

    def call_off(self) -> None:
        """End the watch of another thread: it raises CalledOff there."""
        self._called_off = True
        self.notify()

    def look(self) -> GraphSeen:
        """Read the graph if it has changed, and start to record what is new in it.

        The fullest graph is the one that is kept. A node that crashes leaves the graph before its
        process ends, and must not blur what was there.
        """
        began_s = time.monotonic()
        if began_s >= self._rests_until_s:
            if graph := self._looker.changed():
                self._take_graph(graph)
            now_s = time.monotonic()
            self._rests_until_s = now_s + REST_AFTER_LOOK * (now_s - began_s)
        return self.seen.graph

    def look_now(self) -> None:
        """Read all of it without resting, where it is complete now."""
        self._take_graph(self._looker.read())

    def _take_graph(self, graph: GraphSeen) -> None:
        if fullness(graph) >= fullness(self.seen.graph):
            self.seen.graph, self._left_out = graph, self._looker.left_out
        for endpoint in own_endpoints(graph):
            if self._records and endpoint.kind == "publisher":
                self._record(endpoint)
        if self.seen.canary and self._node.count_publishers(canary.TOPIC) > self._canaries:
            self.seen.canary.imitated = True

    def count(self, topic: str) -> int:
        """How many messages came on `topic` so far."""
        recorder = self._recorders.get(topic)
        return recorder.count if recorder else 0

    def connected(self, topic: str) -> bool:
        """What a publisher on `topic` sends is heard."""
        recorder = self._recorders.get(topic)
        return recorder is not None and recorder.connected

    def messages(self, topic: str) -> list[Any]:
        """The messages on `topic` so far, without their contents."""
        recorder = self._recorders.get(topic)
        return list(recorder.seen.messages) if recorder else []

    def note_longest_watch(self, topic: str) -> None:
        """Nobody will watch `topic` for longer than this."""
        if topic in self._recorders:
            self._recorders[topic].seen.watched_to_bound = True

    def notify(self) -> None:
        """Something changed elsewhere: look again at once."""
        with self._changed:
            self._changed.notify_all()

    def between_waits(self, work: Callable[[], object]) -> None:
        """Have the probe's own thread do this, and wait until it has.

        What an executor waits for can go in between only. An action server that goes meanwhile ends
        the thread (rclpy's `add_to_wait_set` takes it without holding it).
        """
        done = threading.Event()

        def turn() -> None:
            try:
                work()
            finally:
                done.set()

        self._executor.create_task(turn)
        done.wait(BETWEEN_WITHIN_S)

    def say(self, subscription: Endpoint, content: dict[str, Any], within_s: float) -> Spoken:
        """Send one message to `subscription`, with the quality of service it asks for.

        It is sent when the two are matched, or after `within_s`. Raises UnknownType.
        """
        sent_ns, matched = self.send(subscription, from_plain(subscription.type, content), within_s)
        spoken = Spoken(
            topic=subscription.topic,
            type=subscription.type,
            content=content,
            sent_ns=sent_ns,
            matched=matched,
            offered=subscription.qos,
        )
        self.seen.spoken.append(spoken)
        return spoken

    def send(self, subscription: Endpoint, message: Any, within_s: float) -> tuple[int, bool]:
        """Send a ROS message to `subscription` as `say` does, and write nothing down.

        When it was sent (monotonic, ns), and whether somebody was there to hear it.
        """
        publisher = self._publisher_for(subscription)
        matched = self.until(lambda: publisher.get_subscription_count() > 0, within_s)
        sent_ns = time.monotonic_ns()  # before it is sent: an answer can be back at once
        publisher.publish(message)
        return sent_ns, matched

    def read_as_it_comes(self, type_name: str, read: Read) -> None:
        """From now on, messages of this type are read by `read` when they come, also large ones.

        It gives the plain values to be kept, and runs in the probe's thread: it must be quick.
        """
        self._readers[type_name] = read

    def turned(self, node: str, within_s: float) -> bool:
        """Wait until the node's executor has run the callback of all that was sent before.

        False where the node does not answer within the time.
        """
        deadline_s = time.monotonic() + within_s
        with self.barrier([node]) as barrier:
            ready = self.until(lambda: barrier.ready, within_s)
            return ready and barrier.passed(max(0.0, deadline_s - time.monotonic()))

    @contextmanager
    def barrier(self, nodes: Sequence[str]) -> Iterator[Barrier]:
        """What shows that `nodes` have kept up."""
        barrier = Barrier(self._node, nodes)
        try:
            yield barrier
        finally:
            barrier.close()

    def clock(self) -> SimClock:
        """Become the source of simulated time in this domain."""
        return SimClock(self._node, self.seen.ticks)

    def listen_to_canary(self, hz: float) -> None:
        """Record what the canary says, beside the graph that the student's nodes are in."""
        self._canaries += 1
        self.seen.canary = CanarySeen(wanted_hz=hz)
        canary_end = Endpoint(
            kind="publisher",
            node=f"/{canary.NODE}",
            topic=canary.TOPIC,
            type=canary.TYPE,
            qos=Qos(),
            gid="canary",
        )
        self._canary = TopicRecorder(
            self._node, canary_end, self.notify, self.store, queues=self._queues
        )
        self.seen.canary.messages = self._canary.seen.messages

    def _publisher_for(self, subscription: Endpoint) -> Any:
        if subscription.gid not in self._publishers:
            from roslings.probe.content import message_class

            self._publishers[subscription.gid] = self._node.create_publisher(
                message_class(subscription.type),
                subscription.topic,
                offering(subscription.qos),
                event_callbacks=no_publisher_events(),
            )
        return self._publishers[subscription.gid]

    def _record(self, endpoint: Endpoint) -> None:
        if endpoint.topic in self._recorders or not can_record(endpoint):
            return
        if len(self._recorders) == MOST_TOPICS:
            self._unheard.add(endpoint.topic)
            return
        self._recorders[endpoint.topic] = TopicRecorder(
            self._node, endpoint, self.notify, self.store, self._readers, self._queues
        )

    def _hear_logs(self) -> None:
        from rcl_interfaces.msg import Log
        from rclpy.qos import DurabilityPolicy, QoSProfile

        kept = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self._logs = RawSubscription(self._node, Log, "/rosout", self._take_log, kept, self._queues)

    def _take_log(self, raw: bytes, info: Any) -> None:
        from rcl_interfaces.msg import Log
        from rclpy.serialization import deserialize_message

        log = deserialize_message(raw, Log) if len(raw) <= LARGEST_LOG_BYTES else None
        if log is None or not self._keep_log(log.name, log.msg[:LONGEST_LOG_LINE]):
            self.store.drop("rosout", 1, len(raw))
        self.notify()

    def _keep_log(self, name: str, text: str) -> bool:
        """Whether there was room for a line."""
        line = LogLine(arrival_ns=time.monotonic_ns(), text=text, source="rosout")
        logs, size = self.seen.rosout, size_of(line)
        if name not in self._loggers:
            size += size_of(name)
            if len(logs) == MOST_LOGGERS:
                return False
            self._loggers[name] = self.store.share(LOGGERS_OWN_BYTES)
        if len(logs.get(name, ())) == MOST_LOG_LINES or not self._loggers[name].take(size):
            return False
        logs.setdefault(name, []).append(line)
        return True

    def _spin(self) -> None:
        while not self._closing.is_set():
            self._executor.spin_once(timeout_sec=0.5)

    def _beat(self) -> None:
        """Notice when this machine does not run us: then it may not run the student either."""
        before_s = time.monotonic()
        while not self._closing.is_set():
            time.sleep(HEARTBEAT_S)  # cheaper than to wait for an event
            now_s = time.monotonic()
            self.seen.stall_s = max(self.seen.stall_s, now_s - before_s - HEARTBEAT_S)
            before_s = now_s


def _nothing() -> None:
    """What an executor does that is only to look up."""


def fullness(graph: GraphSeen) -> tuple[int, int]:
    """How much is in a graph: nodes first, then endpoints."""
    return len(graph.nodes), len(graph.endpoints)


def offering(qos: Qos, depth: int = 100) -> Any:
    """An rclpy QoSProfile for a publisher that a subscription with `qos` accepts."""
    from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

    return QoSProfile(
        depth=depth,
        reliability=ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy[qos.durability.upper()],
    )
