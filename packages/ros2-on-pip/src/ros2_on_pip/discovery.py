"""A node of our own that looks at the graph, and knows when it has seen all of it.

Discovery takes between 0.05 s and 3 s, by luck, so waiting for a fixed time is wrong both ways.
But each program that takes part in ROS on this computer holds UDP ports of its domain, and the
kernel lists them: so it is known who must answer, and the look ends when all have. They are asked
at once, so that luck plays no part (`roll_call`).
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
from types import TracebackType
from typing import Any

from ros2_on_pip import stopping
from ros2_on_pip.names import is_hidden, node_name
from ros2_on_pip.participants import participants_here
from ros2_on_pip.problem import Problem
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
BELIEVED_READINGS = 5
"""Who stood in none of the kernel's last readings has ended."""

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


class RosDoesNotStart(Problem):
    """rclpy is missing, or it cannot open a node."""

    def __init__(self, fault: BaseException) -> None:
        reason = (str(fault) or type(fault).__name__).splitlines()[0]
        super().__init__(f"ROS does not start here: {reason}\nTo find out why: ros2 doctor")


class NodeVanished(Problem):
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


class Eye:
    """Our node, in a context of its own. A context manager: leaving the block ends both."""

    def __init__(self, name: str = "", sim_time: bool = False, look_s: float = 0.0) -> None:
        """`name` is the node's; by default a hidden one, as the real tool has it.

        With `sim_time` its clock is the topic /clock; each look takes `look_s` at least.
        """
        self._name = name or f"_ros2cli_{os.getpid()}"
        self._sim_time, self._look_s = sim_time, look_s

    @classmethod
    def asked_by(cls, options: argparse.Namespace, name: str = "") -> Eye:
        """With what `--use-sim-time` and `--spin-time` say."""
        return cls(name, options.use_sim_time, options.spin_time)

    def __enter__(self) -> Eye:
        self.domain = domain_id()
        check_middleware()
        self._roll: RollCall | None = RollCall(self.domain).__enter__()
        try:
            self._open()
        except (ImportError, RuntimeError) as fault:
            self._end_roll()
            raise RosDoesNotStart(fault) from fault
        return self

    def _open(self) -> None:
        import rclpy
        from rclpy.executors import SingleThreadedExecutor
        from rclpy.node import Node
        from rclpy.parameter import Parameter
        from rclpy.signals import SignalHandlerOptions

        self.context = rclpy.Context()
        rclpy.init(
            args=QUIET,
            context=self.context,
            domain_id=self.domain,
            signal_handler_options=SignalHandlerOptions.NO,
        )
        self.node = Node(
            self._name,
            context=self.context,
            use_global_arguments=False,
            enable_rosout=False,
            start_parameter_services=False,
            parameter_overrides=[Parameter("use_sim_time", value=self._sim_time)],
        )
        self._executor = SingleThreadedExecutor(context=self.context)
        self._executor.add_node(self.node)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._end_roll()
        # A callback that Ctrl-C cut short never counts as done, so waiting has its bound.
        self._executor.shutdown(timeout_sec=END_WITHIN_S)
        self.node.destroy_node()
        self.context.try_shutdown()

    def settle(self, only_nodes: bool = False) -> Eye:
        """Wait until the graph is complete; with `only_nodes`, until all names of nodes are."""
        self._roll = self._roll or RollCall(self.domain).__enter__()
        settling = Settling(self.domain, self._roll, self._look_s, 0.0 if only_nodes else QUIET_S)
        try:
            while not settling.after(self._sight()):
                stopping.check()
                settling.wait()
        finally:
            self._end_roll()
        return self

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
        pairs = self.node.get_node_names_and_namespaces()
        names = sorted(node_name(name, space) for name, space in pairs if name != self._name)
        return [name for name in names if hidden or not is_hidden(name)]

    def topics(self, hidden: bool = True) -> dict[str, list[str]]:
        """Every topic that somebody else takes part in, with its types."""
        found = self.node.get_topic_names_and_types()
        return {
            name: list(types)
            for name, types in sorted(found)
            if (hidden or not is_hidden(name)) and (self.publishers(name) or self.ears(name))
        }

    def publishers(self, topic: str) -> list[Any]:
        """What is known of each publisher of `topic` but our own."""
        return self._others(self.node.get_publishers_info_by_topic(topic))

    def ears(self, topic: str) -> list[Any]:
        """What is known of each subscription to `topic` but our own."""
        return self._others(self.node.get_subscriptions_info_by_topic(topic))

    def services(self, hidden: bool = True) -> dict[str, list[str]]:
        """Every service that another node offers, with its types."""
        own = set(self._by_node("service", f"/{self._name}"))
        found = self.node.get_service_names_and_types()
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
        read = getattr(self.node, f"get_{what}_names_and_types_by_node")
        return {found: list(types) for found, types in read(name, space or "/")}

    def _others(self, infos: Iterable[Any]) -> list[Any]:
        return [info for info in infos if info.node_name not in (self._name, UNNAMED)]

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
        raw = [name for name, _ in self.node.get_topic_names_and_types(no_demangle=True)]
        both = {name: self._both(name) for name in raw if name.startswith(ROS_TOPICS)}
        seen = {
            bytes(info.endpoint_gid): info.node_name
            for kinds in both.values()
            for infos in kinds
            for info in infos
        }
        own = next((gid for gid, node in seen.items() if node == self._name), b"")
        speak, hear = (
            {bytes(info.endpoint_gid)[:PREFIX] for info in infos} for infos in self._both(WHO)
        )
        return Sight(
            here=frozenset(prefix for prefix in speak & hear if prefix[:HOST] == own[:HOST]),
            named=frozenset(gid[:PREFIX] for gid, node in seen.items() if node != UNNAMED),
            endpoints=len(seen),
            unnamed=sum(node == UNNAMED for node in seen.values()),
            nodes=len(self.node.get_node_names()),
            half_known=frozenset(gid[:PREFIX] for gid, node in seen.items() if node == UNNAMED)
            | with_half_a_service(both),
        )

    def _both(self, raw_topic: str) -> tuple[list[Any], list[Any]]:
        """Its publishers, and its subscriptions: DDS tells of each kind by itself."""
        node = self.node
        return (
            node.get_publishers_info_by_topic(raw_topic, no_mangle=True),
            node.get_subscriptions_info_by_topic(raw_topic, no_mangle=True),
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
        self._ports: deque[frozenset[int]] = deque(maxlen=BELIEVED_READINGS)
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
