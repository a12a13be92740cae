"""A node of our own that looks at the graph, and knows when it has seen all of it.

Discovery takes between 0.05 s and 3 s, by luck, so waiting for a fixed time is wrong both ways. But
each program that takes part in ROS on this computer holds UDP ports of its domain. The kernel lists
them. So it is known who must answer, and the look ends when all have. They are asked at once, so
that luck plays no part (`roll_call`).
"""

from __future__ import annotations

import argparse
import os
import re
import sys
import time
from collections import Counter, deque
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from threading import Lock
from types import TracebackType
from typing import Any

from ros2_on_pip import stopping
from ros2_on_pip.bare_node import BareNode, bare_node
from ros2_on_pip.look_profile import quick_look
from ros2_on_pip.names import is_hidden, node_name
from ros2_on_pip.participants import BELIEVED_READINGS, participants_here
from ros2_on_pip.problem import CommandProblem
from ros2_on_pip.roll_call import RollCall
from ros2_on_pip.surroundings import check_middleware, domain_id, looks_beyond_this_computer

QUIET_S = 0.05
"""After all have answered: the last endpoints come within this time of each other. Each speaker
sends its endpoints in order, and those by which it names its nodes are its first."""

LATE_TIMES = 5
"""On a busy computer the others wait for a processor as we do: so many of our longest waits more
must be quiet. Beside sixteen that were ready to run on two cores, we were late by up to 60 ms."""

QUIET_BEYOND_S = 1.5
"""Where other computers may answer too, nothing new for this long means that it is all."""

LOOK_EVERY_S = 0.02

SILENT_LOOKS = 300
"""A program that is alive speaks every 3 s; who is silent for twice as long is stuck or is not ROS.
Counted in looks: on a busy computer, where everybody is slow, they take longer too."""

SPIN_S = 0.05
"""Ctrl-C waits no longer than this for rclpy."""

END_WITHIN_S = 0.5

WHO = "ros_discovery_info"
"""On this topic each participant writes which nodes it has; DDS shows it, ROS hides it."""

QUIET = ["--ros-args", "--disable-external-lib-logs"]
"""A look leaves no log file in ~/.ros, which nobody ever tidies."""

UNNAMED = "_NODE_NAME_UNKNOWN_"
ROS_TOPICS = ("rt/", "rq/", "rr/")
"""How ROS marks its topics, requests and replies in DDS."""

SERVICE = re.compile(r"^(?:rq(/.+)Request|rr(/.+)Reply)$")
"""The two topics of one service."""

PREFIX, HOST = 12, 4
"""The first bytes of an endpoint's id name its participant, and of these the first its computer."""


class RosDoesNotStart(CommandProblem):
    """rclpy is missing, or it cannot open a node."""

    def __init__(self, fault: BaseException) -> None:
        reason = (str(fault) or type(fault).__name__).splitlines()[0]
        super().__init__(f"ROS does not start here: {reason}\nTo find out why: ros2 doctor")


class NodeVanished(CommandProblem):
    """A node ended while we looked at it."""

    def __init__(self, node: str) -> None:
        super().__init__(f"Unable to find node '{node}': it ended just now. Start it again.")


@dataclass(frozen=True)
class Sight:
    """What DDS has told so far: participants, those whose nodes are known, endpoints, nodes."""

    here: frozenset[bytes]
    named: frozenset[bytes]
    endpoints: int
    unnamed: int
    nodes: int
    half_known: frozenset[bytes] = frozenset()
    """Those with an endpoint whose node is not known yet, or with one half of a service."""

    def complete(self, expected: int) -> bool:
        """Everybody on this computer has said all."""
        return (
            len(self.here) >= expected
            and self.here <= self.named
            and not (self.unnamed or self.half_known & self.here)
        )

    def knows_all_of(self, participants: frozenset[bytes]) -> bool:
        """They have said all; of those who have ended meanwhile nothing more will come."""
        return participants <= (self.here & self.named) - self.half_known


Kinds = tuple[Sequence[Any], Sequence[Any]]
"""Of one topic: what is known of its publishers, and of its subscriptions."""


def with_half_a_service(topics: Mapping[str, Kinds]) -> frozenset[bytes]:
    """Participants of which a request came without its reply, or the other way round.

    A server is two endpoints, and a client is two; DDS tells of them one after the other.
    `topics` has them under their names in DDS.
    """
    found: set[bytes] = set()
    for name in {match[1] or match[2] for match in map(SERVICE.match, topics) if match}:
        asks, hears = topics.get(f"rq{name}Request", ((), ()))
        replies, reads = topics.get(f"rr{name}Reply", ((), ()))
        for one, other in ((hears, replies), (asks, reads)):
            counts, others = _by_participant(one), _by_participant(other)
            found |= {each for each in counts | others if counts[each] != others[each]}
    return frozenset(found)


def _by_participant(infos: Iterable[Any]) -> Counter[bytes]:
    return Counter(bytes(info.endpoint_gid)[:PREFIX] for info in infos)


class DirectNode:
    """Our node, in a context of its own. A context manager: leaving the block ends both.

    A look needs a `BareNode` only. rclpy's own comes in its place when somebody takes it (`node`),
    to hear. Who `speaks` is rclpy's own from the beginning, and so is who has a name by which
    others are to see it. It hurries nobody, so that others know it as soon as it knows them: else
    it would speak to those who do not listen yet.
    """

    def __init__(
        self,
        name: str = "",
        sim_time: bool = False,
        look_s: float = 0.0,
        *,
        speaks: bool = False,
    ) -> None:
        """`name` is the node's; by default a hidden one, as the real tool has it.

        With `sim_time` its clock is the topic /clock; each look takes `look_s` at least. Who
        `speaks` publishes, or asks a service.
        """
        self._name = name or f"_ros2cli_{os.getpid()}"
        # Another one, for ROS forgets a node by its name, and both are there for a moment.
        self._bare_name = f"_ros2cli_look_{os.getpid()}"
        self._names = (self._name, self._bare_name)
        self._only_looks = not (name or speaks)
        self._sim_time, self._look_s = sim_time, look_s
        self._bare: BareNode | None = None
        self._whole: tuple[Any, Any] | None = None
        self._opening = Lock()

    @classmethod
    def asked_by(
        cls, options: argparse.Namespace, name: str = "", *, speaks: bool = False
    ) -> DirectNode:
        """With what `--use-sim-time` and `--spin-time` say."""
        return cls(name, options.use_sim_time, options.spin_time, speaks=speaks)

    def __enter__(self) -> DirectNode:
        self.domain = domain_id()
        check_middleware()
        self._roll: RollCall | None = self._called_roll()
        try:
            self._open()
        except (ImportError, RuntimeError) as fault:
            self._end_roll()
            raise RosDoesNotStart(fault) from fault
        return self

    def _open(self) -> None:
        import rclpy
        from rclpy.signals import SignalHandlerOptions

        self.context = rclpy.Context()
        rclpy.init(
            args=QUIET,
            context=self.context,
            domain_id=self.domain,
            signal_handler_options=SignalHandlerOptions.NO,
        )
        if self._only_looks:
            with quick_look():
                self._bare = bare_node(self._bare_name, self.context)
        self._whole = None if self._bare else self._open_whole()

    @property
    def graph(self) -> Any:
        """What tells of the graph: nodes, topics, services, and who has them."""
        return self._whole[0] if self._whole else self._bare

    @property
    def node(self) -> Any:
        """rclpy's own node. Raises RosDoesNotStart."""
        return self._both_parts()[0]

    @property
    def _executor(self) -> Any:
        return self._both_parts()[1]

    def _both_parts(self) -> tuple[Any, Any]:
        """Node and executor; made when the first thread asks for one of them."""
        with self._opening:
            if self._whole is None:
                try:
                    self._whole = self._open_whole()
                except (ImportError, RuntimeError) as fault:
                    raise RosDoesNotStart(fault) from fault
                self._leave_bare()
            return self._whole

    def _open_whole(self) -> tuple[Any, Any]:
        from rclpy.executors import SingleThreadedExecutor
        from rclpy.node import Node
        from rclpy.parameter import Parameter

        node = Node(
            self._name,
            context=self.context,
            use_global_arguments=False,
            enable_rosout=False,
            start_parameter_services=False,
            parameter_overrides=[Parameter("use_sim_time", value=self._sim_time)],
        )
        executor = SingleThreadedExecutor(context=self.context)
        executor.add_node(node)
        return node, executor

    def _leave_bare(self) -> None:
        if self._bare:
            self._bare.destroy_node()
            self._bare = None

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._end_roll()
        if self._whole:
            node, executor = self._whole
            # A callback that Ctrl-C cut short never counts as done, so waiting has its bound.
            executor.shutdown(timeout_sec=END_WITHIN_S)
            node.destroy_node()
        self._leave_bare()
        self.context.try_shutdown()

    def settle(self, only_nodes: bool = False) -> DirectNode:
        """Wait until the graph is complete; with `only_nodes`, until all names of nodes are."""
        self._roll = self._roll or self._called_roll()
        settling = Settling(self.domain, self._roll, self._look_s, 0.0 if only_nodes else QUIET_S)
        try:
            while not settling.after(self._sight()):
                stopping.check()
                settling.wait()
        finally:
            self._end_roll()
        return self

    def _called_roll(self) -> RollCall:
        return RollCall(self.domain, hurries=self._only_looks).__enter__()

    def _end_roll(self) -> None:
        if self._roll:
            self._roll.__exit__(None, None, None)
            self._roll = None

    def until(self, condition: Callable[[], Any], within_s: float | None = None) -> bool:
        """Run callbacks until `condition()` holds, at most `within_s`. Whether it does."""
        end_s = None if within_s is None else time.monotonic() + within_s
        while not condition():
            if end_s is not None and time.monotonic() >= end_s:
                return False
            self._spin(SPIN_S)
        return True

    def nodes(self, hidden: bool = False) -> list[str]:
        """Full names of all nodes but our own, in order; one name as often as it is there."""
        pairs = self.graph.get_node_names_and_namespaces()
        names = sorted(node_name(name, space) for name, space in pairs if name not in self._names)
        return [name for name in names if hidden or not is_hidden(name)]

    def topics(self, hidden: bool = True) -> dict[str, list[str]]:
        """Every topic that somebody else takes part in, with its types."""
        found = self.graph.get_topic_names_and_types()
        return {
            name: list(types)
            for name, types in sorted(found)
            if (hidden or not is_hidden(name))
            and (self.publishers(name) or self.subscriptions(name))
        }

    def publishers(self, topic: str) -> list[Any]:
        """What is known of each publisher of `topic` but our own."""
        return self._others(self.graph.get_publishers_info_by_topic(topic))

    def subscriptions(self, topic: str) -> list[Any]:
        """What is known of each subscription to `topic` but our own."""
        return self._others(self.graph.get_subscriptions_info_by_topic(topic))

    def services(self, hidden: bool = True) -> dict[str, list[str]]:
        """Every service that another node offers, with its types."""
        own = set(self._by_node("service", f"/{self._name}")) if self._whole else ()
        found = self.graph.get_service_names_and_types()
        return {
            name: list(types)
            for name, types in sorted(found)
            if name not in own and (hidden or not is_hidden(name))
        }

    def of_node(self, what: str, full_name: str) -> dict[str, list[str]]:
        """Names and types of what a node has: `publisher`, `subscriber`, `service`, `client`.

        Raises NodeVanished.
        """
        try:
            return dict(sorted(self._by_node(what, full_name).items()))
        except RuntimeError:
            raise NodeVanished(full_name) from None

    def _by_node(self, what: str, full_name: str) -> dict[str, list[str]]:
        space, _, name = full_name.rpartition("/")
        read = getattr(self.graph, f"get_{what}_names_and_types_by_node")
        return {found: list(types) for found, types in read(name, space or "/")}

    def _others(self, infos: Iterable[Any]) -> list[Any]:
        return [info for info in infos if info.node_name not in (*self._names, UNNAMED)]

    def spin_to(self, due_s: float) -> None:
        """Run callbacks until the moment `due_s` of the monotonic clock."""
        while (left_s := due_s - time.monotonic()) > 0:
            self._spin(min(left_s, SPIN_S))

    def spin_some(self) -> None:
        """Run what is due, and wait for nothing."""
        self._spin(0.0)

    def _spin(self, within_s: float) -> None:
        stopping.check()
        self._executor.spin_once(timeout_sec=within_s)

    def _sight(self) -> Sight:
        raw = [name for name, _ in self.graph.get_topic_names_and_types(no_demangle=True)]
        both = {name: self._both(name) for name in raw if name.startswith(ROS_TOPICS)}
        seen = {
            bytes(info.endpoint_gid): info.node_name
            for kinds in both.values()
            for infos in kinds
            for info in infos
        }
        own = next((gid for gid, node in seen.items() if node in self._names), b"")
        speak, hear = (
            {bytes(info.endpoint_gid)[:PREFIX] for info in infos} for infos in self._both(WHO)
        )
        return Sight(
            here=frozenset(prefix for prefix in speak & hear if prefix[:HOST] == own[:HOST]),
            named=frozenset(gid[:PREFIX] for gid, node in seen.items() if node != UNNAMED),
            endpoints=len(seen),
            unnamed=sum(node == UNNAMED for node in seen.values()),
            nodes=len(self.graph.get_node_names_and_namespaces()),
            half_known=frozenset(gid[:PREFIX] for gid, node in seen.items() if node == UNNAMED)
            | with_half_a_service(both),
        )

    def _both(self, raw_topic: str) -> tuple[list[Any], list[Any]]:
        """Its publishers, and its subscriptions: DDS tells of each kind by itself."""
        graph = self.graph
        return (
            graph.get_publishers_info_by_topic(raw_topic, no_mangle=True),
            graph.get_subscriptions_info_by_topic(raw_topic, no_mangle=True),
        )


class Settling:
    """Tells when nothing more is to come."""

    def __init__(
        self,
        domain: int,
        roll: RollCall | None = None,
        at_least_s: float = 0.0,
        quiet_s: float | None = None,
    ) -> None:
        """Without `roll` it is known how many must answer, and not who."""
        self._domain = domain
        self._roll = roll
        self._quiet_s = QUIET_S if quiet_s is None else quiet_s
        self._until_s = time.monotonic() + at_least_s
        read_before = roll.readings.copy() if roll else ()
        self._ports: deque[frozenset[int]] = deque(read_before, maxlen=BELIEVED_READINGS)
        self._before: Sight | None = None
        self._late_s = 0.0
        self._restart()

    def _restart(self) -> None:
        self._since_s = time.monotonic()
        self._looks = 0

    def wait(self) -> None:
        """Until the next look; how late it comes tells how busy this computer is."""
        due_s = time.monotonic() + LOOK_EVERY_S
        time.sleep(LOOK_EVERY_S)
        self._late_s = max(self._late_s, time.monotonic() - due_s)

    def after(self, sight: Sight) -> bool:
        """Whether `sight`, the newest, is the whole graph, or all that will ever be seen of it."""
        if self._roll:
            self._roll.knows(sight.here)
        if sight != self._before:
            self._before = sight
            self._restart()
        self._looks += 1
        self._ports.append(participants_here(self._domain))
        ports = frozenset().union(*self._ports)
        if not self._complete(sight, ports):
            return self._gave_up(len(ports) - len(sight.here))
        if len(self._ports) < BELIEVED_READINGS or time.monotonic() < self._until_s:
            return False
        quiet_s = time.monotonic() - self._since_s
        return quiet_s >= self._quiet_enough_s()

    def _quiet_enough_s(self) -> float:
        if looks_beyond_this_computer():
            return QUIET_BEYOND_S
        return self._quiet_s and self._quiet_s + LATE_TIMES * self._late_s

    def _complete(self, sight: Sight, ports: frozenset[int]) -> bool:
        present = self._roll.named(ports) if self._roll else None
        return sight.complete(len(ports)) or (present is not None and sight.knows_all_of(present))

    def _gave_up(self, silent: int) -> bool:
        if self._looks < SILENT_LOOKS:
            return False
        who = f"{silent} program{'s' * (silent > 1)}" if silent > 0 else "A program"
        print(f"{who} on this computer did not answer: something may be missing.", file=sys.stderr)
        return True
