"""Quality of service as `rosbag2_py` has it: an object of its own, built step by step."""

from __future__ import annotations

from enum import IntEnum
from typing import Any


class rmw_qos_history_policy_t(IntEnum):  # noqa: N801  the name is Jazzy's, as are the next three
    """How many messages are kept."""

    RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT = 0
    RMW_QOS_POLICY_HISTORY_KEEP_LAST = 1
    RMW_QOS_POLICY_HISTORY_KEEP_ALL = 2
    RMW_QOS_POLICY_HISTORY_UNKNOWN = 3


class rmw_qos_reliability_policy_t(IntEnum):  # noqa: N801
    """Whether what was lost is sent again."""

    RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT = 0
    RMW_QOS_POLICY_RELIABILITY_RELIABLE = 1
    RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT = 2
    RMW_QOS_POLICY_RELIABILITY_UNKNOWN = 3


class rmw_qos_durability_policy_t(IntEnum):  # noqa: N801
    """Whether who comes late gets what was said before."""

    RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT = 0
    RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL = 1
    RMW_QOS_POLICY_DURABILITY_VOLATILE = 2
    RMW_QOS_POLICY_DURABILITY_UNKNOWN = 3


class rmw_qos_liveliness_policy_t(IntEnum):  # noqa: N801
    """How a publisher shows that it is alive."""

    RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT = 0
    RMW_QOS_POLICY_LIVELINESS_AUTOMATIC = 1
    RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC = 3
    RMW_QOS_POLICY_LIVELINESS_UNKNOWN = 4


class Duration:
    """Seconds and nanoseconds."""

    def __init__(self, seconds: int, nanoseconds: int) -> None:
        self.total_ns = seconds * 10**9 + nanoseconds


class QoS:
    """A profile. Each method changes it, and returns it."""

    def __init__(self, history_depth: int) -> None:
        from rclpy.qos import QoSProfile

        self._profile = QoSProfile(depth=history_depth)

    @classmethod
    def _of(cls, profile: Any) -> QoS:
        qos = cls(profile.depth)
        qos._profile = profile
        return qos

    def keep_last(self, depth: int) -> QoS:
        """Keep so many messages."""
        self._profile.depth = depth
        return self.history(rmw_qos_history_policy_t.RMW_QOS_POLICY_HISTORY_KEEP_LAST)

    def keep_all(self) -> QoS:
        """Keep all messages."""
        return self.history(rmw_qos_history_policy_t.RMW_QOS_POLICY_HISTORY_KEEP_ALL)

    def reliable(self) -> QoS:
        """Send again what was lost."""
        return self.reliability(rmw_qos_reliability_policy_t.RMW_QOS_POLICY_RELIABILITY_RELIABLE)

    def best_effort(self) -> QoS:
        """Send once."""
        return self.reliability(rmw_qos_reliability_policy_t.RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT)

    def durability_volatile(self) -> QoS:
        """Who comes late gets what comes next."""
        return self.durability(rmw_qos_durability_policy_t.RMW_QOS_POLICY_DURABILITY_VOLATILE)

    def transient_local(self) -> QoS:
        """Who comes late gets what was said before, too."""
        return self.durability(
            rmw_qos_durability_policy_t.RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL
        )

    def history(self, policy: rmw_qos_history_policy_t) -> QoS:
        """How many messages are kept."""
        return self._set("history", "HistoryPolicy", policy)

    def reliability(self, policy: rmw_qos_reliability_policy_t) -> QoS:
        """Whether what was lost is sent again."""
        return self._set("reliability", "ReliabilityPolicy", policy)

    def durability(self, policy: rmw_qos_durability_policy_t) -> QoS:
        """Whether who comes late gets what was said before."""
        return self._set("durability", "DurabilityPolicy", policy)

    def liveliness(self, policy: rmw_qos_liveliness_policy_t) -> QoS:
        """How a publisher shows that it is alive."""
        return self._set("liveliness", "LivelinessPolicy", policy)

    def deadline(self, duration: Duration) -> QoS:
        """The longest time between two messages."""
        return self._set_time("deadline", duration)

    def lifespan(self, duration: Duration) -> QoS:
        """How long a message is worth something."""
        return self._set_time("lifespan", duration)

    def liveliness_lease_duration(self, duration: Duration) -> QoS:
        """After so long without a sign, a publisher counts as dead."""
        return self._set_time("liveliness_lease_duration", duration)

    def avoid_ros_namespace_conventions(self, avoid: bool) -> QoS:
        """Whether the topic has its plain name in DDS."""
        self._profile.avoid_ros_namespace_conventions = avoid
        return self

    def _set(self, name: str, kind: str, policy: IntEnum) -> QoS:
        from rclpy import qos

        setattr(self._profile, name, getattr(qos, kind)(int(policy)))
        return self

    def _set_time(self, name: str, duration: Duration) -> QoS:
        from rclpy.duration import Duration as Of

        setattr(self._profile, name, Of(nanoseconds=duration.total_ns))
        return self


def convert_rclcpp_qos_to_rclpy_qos(qos: QoS) -> Any:
    """The same as rclpy's QoSProfile."""
    return qos._profile
