"""Quality of service: what the options ask for, what fits the others, what cannot match."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable, Sequence
from typing import Any

from ros2_on_pip.habits import OnlyHere
from ros2_on_pip.words import not_negative, seconds

PRESETS = (
    "default",
    "system_default",
    "sensor_data",
    "services_default",
    "parameters",
    "parameter_events",
    "action_status_default",
    "best_available",
    "unknown",
)
POLICIES = {
    "history": ("keep_last", "keep_all", "system_default"),
    "reliability": ("reliable", "best_effort", "system_default", "best_available"),
    "durability": ("volatile", "transient_local", "system_default", "best_available"),
    "liveliness": ("automatic", "manual_by_topic", "system_default", "best_available"),
}
MATCHED = (
    ("reliability", "RELIABLE", "BEST_EFFORT"),
    ("durability", "TRANSIENT_LOCAL", "VOLATILE"),
)
"""Policy, the better quality, the lesser one: who offers the lesser cannot reach who asks more."""

ORDERED = (*MATCHED, ("liveliness", "MANUAL_BY_TOPIC", "AUTOMATIC"))
TIMES = (("deadline", "deadline"), ("liveliness_lease_duration", "liveliness lease (LIVELINESS)"))

SENSOR_DATA = "sensor_data"
DEFAULT_DEPTH = 10


def add_qos_options(parser: argparse.ArgumentParser, subject: str, only_here: bool = False) -> None:
    """The `--qos-*` options; `subject` is what they are for; with some verbs only we take them."""
    action = OnlyHere if only_here else "store"
    group = parser.add_argument_group(f"quality of service to {subject} with")
    group.add_argument(
        "--qos-profile",
        action=action,
        choices=PRESETS,
        metavar="NAME",
        help=f"a preset for all of them: {', '.join(PRESETS)}",
    )
    group.add_argument(
        "--qos-depth", action=action, metavar="N", type=not_negative, help="queue size"
    )
    for policy, choices in POLICIES.items():
        group.add_argument(
            f"--qos-{policy}",
            action=action,
            choices=choices,
            metavar="WORD",
            help=", ".join(choices),
        )
    group.add_argument(
        "--qos-liveliness-lease-duration-seconds",
        action=action,
        metavar="S",
        type=seconds,
        help="liveliness lease duration",
    )


def chosen(options: argparse.Namespace, preset: str = "default") -> Any:
    """The QoSProfile that the options ask for, on top of `preset`."""
    from rclpy.duration import Duration
    from rclpy.qos import QoSPresetProfiles

    base = QoSPresetProfiles.get_from_short_key(options.qos_profile or preset)
    profile = _copy(base)
    if options.qos_depth is not None:
        profile.depth = options.qos_depth
    for policy in POLICIES:
        if word := getattr(options, f"qos_{policy}"):
            setattr(profile, policy, _kind(policy)[word.upper()])
    if options.qos_liveliness_lease_duration_seconds is not None:
        profile.liveliness_lease_duration = Duration(
            nanoseconds=round(options.qos_liveliness_lease_duration_seconds * 1e9)
        )
    return profile


def _copy(profile: Any) -> Any:
    from rclpy.qos import QoSProfile

    names = [slot.removeprefix("_") for slot in QoSProfile.__slots__]
    return QoSProfile(**{name: getattr(profile, name) for name in names})


def _kind(policy: str) -> Any:
    from rclpy import qos

    return getattr(qos, f"{policy.capitalize()}Policy")


def matching(options: argparse.Namespace, publishers: Sequence[Any]) -> Any:
    """What a listener asks for: what all publishers can give, where the options leave it open."""
    profile = chosen(options)
    if options.qos_profile:
        return profile
    for policy, best, least in MATCHED:
        if not getattr(options, f"qos_{policy}"):
            offers = {getattr(info.qos_profile, policy).name for info in publishers}
            setattr(profile, policy, _kind(policy)[best if offers == {best} else least])
    return profile


def for_echo(options: argparse.Namespace, publishers: Sequence[Any]) -> Any:
    """What `topic echo` asks for.

    It is as the full tool does it. Any single policy that is given starts from the preset,
    sensor_data, and nothing of it is matched to the publishers.
    """
    profile = chosen(options, SENSOR_DATA)
    if any_policy_in(options):
        return profile
    for policy, best, least in MATCHED:
        _set_common(profile, policy, best, least, publishers)
    return profile


def any_policy_in(options: argparse.Namespace) -> bool:
    """One of the `--qos-*` options but the preset is given."""
    names = ("depth", "liveliness_lease_duration_seconds", *POLICIES)
    return any(getattr(options, f"qos_{name}") is not None for name in names)


def hears_nothing_earlier(profile: Any) -> bool:
    """It asks for what was sent before, and as best effort nothing is sent again."""
    durability, reliability = profile.durability.name, profile.reliability.name
    return bool(durability == "TRANSIENT_LOCAL" and reliability == "BEST_EFFORT")


def _set_common(
    profile: Any, policy: str, best: str, least: str, publishers: Sequence[Any]
) -> None:
    """The better quality where all publishers offer it; the lesser one reaches each of them."""
    offers = {getattr(info.qos_profile, policy).name for info in publishers}
    if len(offers) > 1 and best in offers:
        kind = f"QoS{policy.capitalize()}Policy"
        print(
            f"Some, but not all, publishers are offering {kind}.{best}. Falling back to"
            f" {kind}.{least} as it will connect to all publishers",
            file=sys.stderr,
        )
    if offers:
        setattr(profile, policy, _kind(policy)[best if offers == {best} else least])


def mismatches(asked: Any, offered: Any) -> list[str]:
    """Why a subscription that asks for `asked` hears nothing from one who offers `offered`."""
    found = []
    for policy, wanted, given in ORDERED:
        asks, gives = getattr(asked, policy).name, getattr(offered, policy).name
        if asks == wanted and gives == given:
            found.append(f"it offers {policy} {gives}, and {asks} is asked for")
    found += [f"its {what} is longer than the one asked for" for what in _longer(asked, offered)]
    return found


def _longer(asked: Any, offered: Any) -> list[str]:
    """The times within which a publisher promises too little; none at all is without end."""
    return [
        what
        for policy, what in TIMES
        if _ns(asked, policy) > 0 and not 0 < _ns(offered, policy) <= _ns(asked, policy)
    ]


def _ns(profile: Any, policy: str) -> int:
    return int(getattr(profile, policy).nanoseconds)


def said_about(publishers: Iterable[Any], asked: Any) -> list[str]:
    """A sentence for each publisher that cannot reach a listener that asks for `asked`."""
    return [
        f"No message can come from node {info.node_name}: {why}."
        for info in publishers
        for why in mismatches(asked, info.qos_profile)
    ]
