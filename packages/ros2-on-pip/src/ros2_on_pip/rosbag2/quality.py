"""Quality of service between rclpy's words and those that a bag keeps."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ros2_on_pip.rosbag2.errors import BagError, reason_of

DURATIONS = ("deadline", "lifespan", "liveliness_lease_duration")
POLICIES = {
    "history": "HistoryPolicy",
    "reliability": "ReliabilityPolicy",
    "durability": "DurabilityPolicy",
    "liveliness": "LivelinessPolicy",
}
NUMBERS = ("depth", "avoid_ros_namespace_conventions")

MOST_DEPTH = 10_000
"""A bag may hold 2^31 and the like where the depth was not known."""

DEPTH = 1000
"""So many messages of a topic may wait while others are written, or sent."""

BETTER = (("reliability", "RELIABLE", "BEST_EFFORT"), ("durability", "TRANSIENT_LOCAL", "VOLATILE"))
"""Policy, the better quality, and the lesser one, which any publisher can give."""


class BadOverrides(BagError):
    """The file with profiles for single topics is wrong."""

    def __init__(self, file: Path, why: str) -> None:
        super().__init__(
            f"the profiles of {file} cannot be used: {why}. The file looks like this:\n"
            "/scan:\n  reliability: best_effort\n  history: keep_last\n  depth: 10"
        )


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
        avoid_ros_namespace_conventions=bool(profile.avoid_ros_namespace_conventions),
    )


def _time(duration: Any) -> Any:
    from rosbags.interfaces import QosTime

    return QosTime(*divmod(duration.nanoseconds, 10**9))


def requested_qos(topic: str, offers: Sequence[Any]) -> tuple[Any, list[str]]:
    """The QoSProfile to record a topic with, from those of its publishers, and what to say of it.

    The better quality where all offer it; else the lesser one, which reaches each of them.
    """
    from rclpy import qos

    profile, notes = qos.QoSProfile(depth=DEPTH), []
    for policy, better, lesser in BETTER if offers else ():
        given = {getattr(offer, policy).name for offer in offers}
        kind = POLICIES[policy]
        setattr(profile, policy, getattr(qos, kind)[better if given == {better} else lesser])
        if len(given) > 1 and better in given:
            notes.append(
                f'Some, but not all, publishers on topic "{topic}" are offering {kind}.{better}.'
                f" Falling back to {kind}.{lesser} as it will connect to all publishers."
            )
    return profile, notes


def offered(profiles: Sequence[Any]) -> Any:
    """The QoSProfile to play a topic with: that of its publishers, where all had the same.

    Else, as rosbag2 does it, the default of ROS: reliable and volatile.
    """
    from rclpy.qos import QoSProfile

    if not profiles or not same(profiles):
        return QoSProfile(depth=DEPTH)
    first = profiles[0]
    return QoSProfile(
        depth=_played_depth(first),
        **{name: _policy(name, getattr(first, name).name) for name in list(POLICIES)[1:]},
        **{name: _duration(getattr(first, name)) for name in DURATIONS},
    )


def same(profiles: Sequence[Any]) -> bool:
    """Whether the publishers of a topic offered the same, but for how much they remember."""
    names = (*list(POLICIES)[1:], *DURATIONS)
    return len({tuple(getattr(one, name) for name in names) for one in profiles}) < 2


def _played_depth(profile: Any) -> int:
    """Who comes late gets as many as the first publisher remembered."""
    if profile.durability.name != "TRANSIENT_LOCAL":
        return DEPTH
    return profile.depth if 0 < profile.depth < MOST_DEPTH else 1


def _policy(name: str, word: str) -> Any:
    from rclpy import qos

    choices = getattr(qos, POLICIES[name])
    member = choices[word.upper()]
    return choices.SYSTEM_DEFAULT if member.name == "UNKNOWN" else member


def _duration(time: Any) -> Any:
    from rclpy.duration import Duration

    return Duration(nanoseconds=min(time.sec * 10**9 + time.nsec, 2**63 - 1))


def overrides(file: Path | None) -> dict[str, Any]:
    """The QoSProfile for each topic that a file names, as `--qos-profile-overrides-path` has it.

    Raises BadOverrides.
    """
    import yaml

    if file is None:
        return {}
    try:
        read = yaml.safe_load(file.read_text(encoding="utf-8")) or {}
        return {str(topic): _profile(policies) for topic, policies in dict(read).items()}
    except (OSError, ValueError, TypeError, KeyError, AttributeError, yaml.YAMLError) as fault:
        raise BadOverrides(file, _said(fault)) from fault


def _said(fault: Exception) -> str:
    return (
        "a name is unknown or missing: " + reason_of(fault)
        if isinstance(fault, KeyError)
        else reason_of(fault)
    )


def _profile(policies: Mapping[str, Any]) -> Any:
    from rclpy.qos import InvalidQoSProfileException, QoSProfile

    read = {name: _value(name, value) for name, value in dict(policies).items()}
    try:
        return QoSProfile(**read)
    except InvalidQoSProfileException as fault:
        raise ValueError(f"{reason_of(fault)} (give history or depth)") from fault


def _value(name: str, value: Any) -> Any:
    if name in POLICIES:
        return _policy(name, str(value))
    if name in DURATIONS:
        return _read_duration(value)
    if name not in NUMBERS:
        raise ValueError(f"there is no policy {name!r}")
    if value < 0:
        raise ValueError(f"{name} is {value}, below zero")
    return value


def _read_duration(value: Mapping[str, int]) -> Any:
    from rclpy.duration import Duration

    if value["sec"] < 0 or value["nsec"] < 0:
        raise ValueError("a duration is below zero")
    return Duration(seconds=value["sec"], nanoseconds=value["nsec"])
