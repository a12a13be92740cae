"""Quality of service between rclpy's words and those that a bag keeps."""

from __future__ import annotations

from typing import Any


def kept(profile: Any) -> Any:
    """An rclpy QoSProfile as `rosbags` keeps it."""
    from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability

    return Qos(
        history=QosHistory(int(profile.history.value)),
        depth=profile.depth,
        reliability=QosReliability(int(profile.reliability.value)),
        durability=QosDurability(int(profile.durability.value)),
        deadline=_time(profile.deadline),
        lifespan=_time(profile.lifespan),
        liveliness=QosLiveliness(int(profile.liveliness.value)),
        liveliness_lease_duration=_time(profile.liveliness_lease_duration),
        avoid_ros_namespace_conventions=False,
    )


def _time(duration: Any) -> Any:
    from rosbags.interfaces import QosTime

    return QosTime(*divmod(duration.nanoseconds, 10**9))


def offered(profiles: list[Any]) -> Any:
    """The QoSProfile to play a topic with: reliable and lasting where its publishers were."""
    from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

    best_effort = any(one.reliability.name == "BEST_EFFORT" for one in profiles)
    lasting = bool(profiles) and all(one.durability.name == "TRANSIENT_LOCAL" for one in profiles)
    return QoSProfile(
        depth=max([10, *(one.depth for one in profiles if one.depth < MOST_DEPTH)]),
        reliability=ReliabilityPolicy.BEST_EFFORT if best_effort else ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if lasting else DurabilityPolicy.VOLATILE,
    )


MOST_DEPTH = 10_000
"""A bag may hold 2^31 and the like where the depth was not known."""
