"""What the world says in ROS: /odom, /scan and /clock; and what it hears on /cmd_vel.

Its node is spun only until all have met. After that nothing of ours runs by itself: a command lies
where the middleware has put it, until it is taken.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from roslings.lockstep.record import VelocityCommand
from roslings_rover.rover.in_room import RoomRover
from roslings_rover.rover.messages import QUIET, laser_scan, odometry

if TYPE_CHECKING:
    from roslings.lockstep.quiet import ThreadAccount
    from roslings.lockstep.stepping import LockstepPlan

NAME = "world"
NS_PER_S = 10**9
SPINS_S = 0.02
ANSWERS_WITHIN_S = 5.0
"""A node that answers no parameter request in this time is taken as met: it may have no such
service."""
COMMANDS_KEPT = 100


class NobodyFollows(Exception):
    """The nodes, or their subscriptions of /clock, are not there."""

    def __init__(self, missing: list[str], listeners: int, wanted: int) -> None:
        if missing:
            said = f"These nodes were not found: {', '.join(missing)}."
        else:
            said = f"{listeners} of {wanted} nodes listen to /clock: set use_sim_time to true."
        super().__init__(said)


class WorldNode:
    """The world's node. A context manager: leaving the block ends it and its context."""

    def __enter__(self) -> WorldNode:
        import rclpy
        from rclpy.signals import SignalHandlerOptions

        self._context = rclpy.Context()
        rclpy.init(
            args=QUIET, context=self._context, signal_handler_options=SignalHandlerOptions.NO
        )
        self._node = rclpy.create_node(
            NAME, context=self._context, enable_rosout=False, start_parameter_services=False
        )
        self._open_topics()
        return self

    def __exit__(self, *error: object) -> None:
        self._node.destroy_node()
        self._context.try_shutdown()

    def _open_topics(self) -> None:
        from geometry_msgs.msg import Twist
        from nav_msgs.msg import Odometry
        from rclpy.qos import QoSProfile, ReliabilityPolicy, qos_profile_sensor_data
        from rosgraph_msgs.msg import Clock
        from sensor_msgs.msg import LaserScan

        node = self._node
        # As a simulator has it: rclpy's own time source asks for best effort, depth 1.
        newest = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
        self._odom = node.create_publisher(Odometry, "/odom", 10)
        self._scan = node.create_publisher(LaserScan, "/scan", qos_profile_sensor_data)
        self._clock = node.create_publisher(Clock, "/clock", newest)
        self._subscription = node.create_subscription(
            Twist, "/cmd_vel", _never_called, COMMANDS_KEPT
        )

    def meet(self, plan: LockstepPlan, account: ThreadAccount) -> None:
        """Wait until all nodes are there, and have found each of our topics. Raises NobodyFollows.

        A node that has answered a request has found the client that was made last. The middleware
        tells in order what there is, so the node has found all that was made before.
        """
        with self._spun() as spin_until:
            ends_s = time.monotonic() + plan.discovery_s
            if not spin_until(lambda: self._all_there(plan), ends_s):
                raise NobodyFollows(self._missing(plan), self._listeners, len(plan.nodes))
            self._ask_all(plan, spin_until)
        account.is_quiet_within(plan.budget.cap_s)
        self.heard()

    def await_driver(self, within_s: float) -> bool:
        """Wait until somebody drives, and hears where the rover is or what it sees; whether so."""
        with self._spun() as spin_until:
            return spin_until(lambda: self._is_driven, time.monotonic() + within_s)

    @property
    def _is_driven(self) -> bool:
        hears = self._scan.get_subscription_count() or self._odom.get_subscription_count()
        return bool(hears and self._node.count_publishers("/cmd_vel"))

    def say_odom(self, rover: RoomRover, at_ns: int) -> None:
        """As the rover's own node says it."""
        self._odom.publish(odometry(rover, _stamp(at_ns)))

    def say_scan(self, rover: RoomRover, at_ns: int) -> None:
        """As the rover's own node says it."""
        self._scan.publish(laser_scan(rover, _stamp(at_ns)))

    def say_clock(self, at_ns: int) -> None:
        """To all who follow it."""
        from rosgraph_msgs.msg import Clock

        self._clock.publish(Clock(clock=_stamp(at_ns)))

    def heard(self) -> list[VelocityCommand]:
        """All commands since the last time, in their order."""
        found = []
        handle = self._subscription.handle
        with handle:
            while (taken := handle.take_message(self._subscription.msg_type, False)) is not None:
                twist = taken[0]
                found.append(
                    VelocityCommand(
                        forward_m_s=twist.linear.x,
                        turn_rad_s=twist.angular.z,
                        stray=stray_field(twist),
                    )
                )
        return found

    @property
    def _listeners(self) -> int:
        return int(self._clock.get_subscription_count())

    def _missing(self, plan: LockstepPlan) -> list[str]:
        there = {
            f"{space.rstrip('/')}/{name}"
            for name, space in self._node.get_node_names_and_namespaces()
        }
        return [name for name in plan.nodes if name not in there]

    def _all_there(self, plan: LockstepPlan) -> bool:
        return self._listeners >= len(plan.nodes) and not self._missing(plan)

    def _ask_all(
        self, plan: LockstepPlan, spin_until: Callable[[Callable[[], bool], float], bool]
    ) -> None:
        """One round trip to each node that has its parameter services."""
        from rcl_interfaces.srv import GetParameters

        ends_s = time.monotonic() + ANSWERS_WITHIN_S
        node, names = self._node, [f"{name}/get_parameters" for name in plan.nodes]
        clients = [node.create_client(GetParameters, name) for name in names]
        spin_until(lambda: all(client.service_is_ready() for client in clients), ends_s)
        request = GetParameters.Request(names=["use_sim_time"])
        answers = [each.call_async(request) for each in clients if each.service_is_ready()]
        spin_until(lambda: all(answer.done() for answer in answers), ends_s)
        for client in clients:
            node.destroy_client(client)

    @contextmanager
    def _spun(self) -> Iterator[Callable[[Callable[[], bool], float], bool]]:
        """Spin our node until something holds, or a time is over; whether it holds."""
        from rclpy.executors import SingleThreadedExecutor

        executor = SingleThreadedExecutor(context=self._context)
        executor.add_node(self._node)

        def until(holds: Callable[[], bool], ends_s: float) -> bool:
            while not holds() and time.monotonic() < ends_s:
                executor.spin_once(timeout_sec=SPINS_S)
            return holds()

        yield until
        executor.remove_node(self._node)
        executor.shutdown()


def stray_field(twist: Any) -> str:
    """The first field of a Twist that is not 0, but for linear.x and angular.z; NaN is not."""
    linear, angular = twist.linear, twist.angular
    others = {
        "linear.y": linear.y,
        "linear.z": linear.z,
        "angular.x": angular.x,
        "angular.y": angular.y,
    }
    return next((f"{name} is {value:g}" for name, value in others.items() if value != 0), "")


def _never_called(_: Any) -> None:
    """Commands are taken one by one, when it is their time."""


def _stamp(at_ns: int) -> Any:
    from builtin_interfaces.msg import Time

    seconds, rest_ns = divmod(at_ns, NS_PER_S)
    return Time(sec=seconds, nanosec=rest_ns)
