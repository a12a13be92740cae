"""A session: ROS 2 for as long as a block of a cell lasts.

    with session() as ros:
        talker = ros.start(Talker)
        print(ros.collect("/numbers", Int32, count=3))

It has a context of its own, its nodes spin in the background, and what a callback raises is
raised in the cell. Leaving the block ends all that was started, whatever happened inside.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from types import TracebackType
from typing import TYPE_CHECKING, Any

from roslings_learn.notebook.errors import NobodyListens, NoSession, StillWaiting, listed
from roslings_learn.notebook.place import settle_in

if TYPE_CHECKING:
    from roslings_learn.notebook.hearing import HeardMessage
    from roslings_learn.notebook.programs import NotebookProgram
    from roslings_my_rover.notebook import LiveMyRover
    from roslings_rover.rover.notebook import LiveRover

LOOK_EVERY_S = 0.01
USUALLY_S = 10.0
QUIET = ["--ros-args", "--disable-external-lib-logs"]
"""A cell leaves no log file in ~/.ros, which nobody ever tidies."""

_open: list[Session] = []


def session() -> Session:
    """A new session, for `with session() as ros:`. Entering raises NoFreeDomain, BadDomain."""
    return Session()


def current(what: str) -> Session:
    """The innermost open session. Raises NoSession; `what` is what needs one."""
    if not _open:
        raise NoSession(what)
    return _open[-1]


@contextmanager
def any_session() -> Iterator[Session]:
    """The open session; where there is none, one for this block."""
    if _open:
        yield _open[-1]
        return
    with session() as ros:
        yield ros


class Session:
    """See the module. All times are in seconds; every wait has a bound."""

    def __init__(self) -> None:
        self._things = ExitStack()

    def __enter__(self) -> Session:
        with ExitStack() as things:
            self._begin(things)
            self._things = things.pop_all()
        return self

    def _begin(self, things: ExitStack) -> None:
        domain = settle_in()
        import rclpy
        from rclpy.signals import SignalHandlerOptions

        from roslings_learn.notebook.default_context import as_default
        from roslings_learn.notebook.hearing import quiet_node
        from roslings_learn.notebook.in_order import wait_while_sending
        from roslings_learn.notebook.spinning import SpinThreads

        wait_while_sending()

        self.context = rclpy.Context()
        things.callback(self.context.try_shutdown)
        rclpy.init(
            args=QUIET,
            context=self.context,
            domain_id=domain,
            signal_handler_options=SignalHandlerOptions.NO,
        )
        things.enter_context(as_default(self.context))
        self._spinning = SpinThreads(self.context)
        things.callback(self._end_nodes)
        self._own_node = quiet_node("_notebook", self.context)
        self._publishers: dict[tuple[str, Any], Any] = {}
        _open.append(self)
        things.callback(_open.remove, self)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._things.close()
        if error is None or isinstance(error, Exception):
            self._tell_what_a_callback_raised(error)

    def _tell_what_a_callback_raised(self, seen: BaseException | None) -> None:
        """It is the cause of what the cell then missed, so it goes first."""
        raised = self._spinning.take_error()
        if raised is not None and raised is not seen:
            raise raised from None

    def _end_nodes(self) -> None:
        from roslings_learn.notebook.release import destroy, nodes_of, release_waits

        nodes = nodes_of(self.context)
        for node in nodes:
            release_waits(node)
        if self._spinning.stop():
            for node in nodes:
                destroy(node)
        else:
            print("A callback does not end. Restart the kernel: menu Kernel, Restart Kernel.")

    # --- nodes -----------------------------------------------------------------------------

    def start(
        self,
        kind: Any,
        /,
        *given: Any,
        ros_args: Sequence[str] = (),
        threads: int | None = None,
        **named: Any,
    ) -> Any:
        """Make a node of the class `kind` as its main() would, and spin it; returns the node.

        `ros_args` are words of the command line, e.g. `["-r", "__node:=left"]`. With `threads`, the
        node has an executor of its own with so many threads. One that is busy for long lets the
        session's other nodes go on.
        Raises NotANode, NoInit, SessionEnded, and what the node's `__init__` raises.
        """
        from roslings_learn.notebook.default_context import as_default
        from roslings_learn.notebook.starting import made

        self._spinning.check()
        with as_default(self.context):  # also where another session was opened after this one
            node = made(kind, given, named, ros_args)
        return self._spin(node, threads)

    def node(self, name: str, **named: Any) -> Any:
        """A plain rclpy Node that spins in this session."""
        from rclpy.node import Node

        self._spinning.check()
        return self._spin(Node(name, context=self.context, **named))

    def _spin(self, node: Any, threads: int | None = None) -> Any:
        self._spinning.add(node, threads)
        return node

    def names(self) -> list[str]:
        """Full names of all nodes that run in this ROS domain, e.g. `["/talker"]`."""
        from ros2_on_pip.discovery import DirectNode

        self._spinning.check()
        with DirectNode() as direct_node:
            return direct_node.settle().nodes()

    def rover(
        self,
        seed: int = 0,
        room: int | None = None,
        *,
        tf: bool = True,
        drift_percent: float = 0.0,
        map_frame: bool = False,
    ) -> LiveRover:
        """The course's simulated rover (/cmd_vel, /odom, /scan, /tf); it ends with the session.

        `room` is the seed of another room; that and the others are as of `./roslings rover`. /tf is
        published where tf2_msgs is there. Raises NoSeed and RoverThere.
        """
        from roslings_rover.rover.notebook import start

        self._spinning.check()
        return self._things.enter_context(start(seed, tf, room, drift_percent, map_frame))

    def my_rover(
        self,
        day: int | None = None,
        *,
        borrow: Collection[int] = (),
        todays: bool = False,
        follow: bool = False,
    ) -> LiveMyRover:
        """The rover of your own parts, those up to a `day`; it ends with the session.

        The options are those of `./roslings my-rover`. Raises NoPart, CannotBorrow, RoverThere.
        """
        from roslings_my_rover.notebook import start

        self._spinning.check()
        return self._things.enter_context(start(day, borrow=borrow, todays=todays, follow=follow))

    # --- messages --------------------------------------------------------------------------

    def collect(
        self,
        topic: str,
        kind: Any = None,
        *,
        count: int = 5,
        timeout_s: float = USUALLY_S,
        stamps: bool = False,
    ) -> list[Any]:
        """Wait for `count` messages of `topic`; with `stamps`, as Heard (message, sent_s).

        The type may be left out. Raises NothingHeard, OtherType, and what a callback raised.
        """
        heard = list(self.hear(topic, kind, count=count, timeout_s=timeout_s))
        return heard if stamps else [each.message for each in heard]

    def hear(
        self, topic: str, kind: Any = None, *, count: int = 5, timeout_s: float = USUALLY_S
    ) -> Iterator[HeardMessage]:
        """As `collect`, one message at a time, as they come."""
        from roslings_learn.notebook.hearing import ListenRequest, topic_listener

        self._spinning.check()
        with topic_listener(self.context, self._spinning.check) as listener:
            yield from listener.hear(ListenRequest(topic, kind, count, timeout_s))

    def say(
        self,
        topic: str,
        message: Any,
        *,
        count: int = 1,
        every_s: float = 0.1,
        timeout_s: float = USUALLY_S,
    ) -> None:
        """Wait for a subscription to `topic`, then publish `message`, `count` times.

        Raises NobodyListens, OtherType, and what a callback raised.
        """
        publisher = self._publisher(topic, type(message))
        self._await_subscriptions(topic, publisher, type(message), timeout_s)
        for number in range(count):
            if number:
                time.sleep(every_s)
            self._spinning.check()
            publisher.publish(message)

    def _publisher(self, topic: str, kind: Any) -> Any:
        """It stays: one that ends at once would take its last message along."""
        from ros2_on_pip.names import checked_topic
        from roslings_learn.notebook.hearing import one_type

        key = (checked_topic(topic), kind)
        if key not in self._publishers:
            with one_type(self._own_node, *key):
                self._publishers[key] = self._own_node.create_publisher(kind, topic, 10)
        return self._publishers[key]

    def _await_subscriptions(self, topic: str, publisher: Any, kind: Any, timeout_s: float) -> None:
        from ros2_on_pip.interfaces import name_of

        try:
            self.until(publisher.get_subscription_count, "a subscription", timeout_s=timeout_s)
        except StillWaiting:
            infos = self._own_node.get_subscriptions_info_by_topic(topic)
            hint = f"Subscriptions to {topic}: {listed(info.topic_type for info in infos)}."
            raise NobodyListens(topic, name_of(kind), timeout_s, hint) from None

    # --- waiting ---------------------------------------------------------------------------

    def until(
        self,
        condition: Callable[[], Any],
        what: str = "a condition",
        *,
        timeout_s: float = USUALLY_S,
    ) -> Any:
        """Wait until `condition()` is true; returns what it gave.

        `what` names it for the error. Raises StillWaiting, and what a callback raised.
        """
        end_s = time.monotonic() + timeout_s
        while not (found := condition()):
            self._spinning.check()
            if time.monotonic() > end_s:
                raise StillWaiting(what, timeout_s)
            time.sleep(LOOK_EVERY_S)
        return found

    def wait(self, future: Any, *, timeout_s: float = USUALLY_S) -> Any:
        """The result of a future, e.g. of `client.call_async(request)`.

        Raises StillWaiting, what the future holds, and what a callback raised.
        """
        done = threading.Event()
        future.add_done_callback(lambda _: done.set())
        try:
            self.until(lambda: done.is_set() or future.done(), "an answer", timeout_s=timeout_s)
        except StillWaiting:
            hint = "Does the other node run? And does no callback wait for this one?"
            raise StillWaiting("an answer", timeout_s, hint) from None
        return future.result()

    # --- programs --------------------------------------------------------------------------

    def run(self, command: str) -> NotebookProgram:
        """Start `command` as a terminal would; it ends with the session at the latest."""
        from roslings_learn.notebook.programs import NotebookProgram

        self._spinning.check()
        return self._things.enter_context(NotebookProgram(command))
