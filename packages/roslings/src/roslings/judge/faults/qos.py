"""Faults in the quality of service of one publisher or subscription, and what to write instead.

What is advised is always what the card asks of this one endpoint, as Python for rclpy.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, NamedTuple

from roslings.evidence import Qos
from roslings.judge.faults.base import Fault

EndpointKind = Literal["publisher", "subscription"]
CALLS: Mapping[EndpointKind, str] = {
    "publisher": "create_publisher",
    "subscription": "create_subscription",
}
"""Where the code gives the quality of service."""


class Matched(NamedTuple):
    """The two policies that a card names for each topic, in rclpy's words, lower case."""

    reliability: str
    durability: str

    def __str__(self) -> str:
        return f"{self.reliability}, {self.durability}"

    @property
    def policies(self) -> dict[str, str]:
        """Name to value."""
        return self._asdict()


USUAL = Matched("reliable", "volatile")
ENUMS = {"reliability": "ReliabilityPolicy", "durability": "DurabilityPolicy"}
OTHERS_STAY = "A depth of your own and other words, such as a deadline, stay."
SENSORS = Matched("best_effort", "volatile")
"""As `qos_profile_sensor_data` is."""

IF_OTHERWISE = {
    ("reliability", "reliable"): "Best effort does not send again what was lost on the way: it is"
    " never heard.",
    ("reliability", "best_effort"): "Reliable means: send the old message again, and let the new"
    " one wait. On Wi-Fi, messages then come seconds late.",
    ("durability", "transient_local"): "Volatile keeps nothing: who comes late does not hear what"
    " was said before.",
    ("durability", "volatile"): "Transient local brings what was said before: who comes late takes"
    " it for new.",
}
"""Policy and the value that is asked: what is bad about the other one."""


@dataclass(eq=False)
class OtherQos(Fault):
    """An endpoint's quality of service is not what its card asks."""

    topic: str
    kind: EndpointKind
    wanted: Matched
    """The card's."""
    found: Matched

    @property
    def advised(self) -> dict[str, str]:
        """Policies to write, with their values: what differs, and what no profile has by itself."""
        ours, usual = self.found.policies, USUAL.policies
        return {
            policy: value
            for policy, value in self.wanted.policies.items()
            if value != ours[policy] or value != usual[policy]
        }

    @property
    def words(self) -> str:
        """These as arguments of QoSProfile."""
        return ", ".join(
            f"{policy}={ENUMS[policy]}.{value.upper()}" for policy, value in self.advised.items()
        )

    @property
    def profile(self) -> str:
        """A whole profile, as Python. What is kept for late joiners is, as a rule, the newest."""
        depth = 1 if self.wanted.durability == "transient_local" else 10
        return f"QoSProfile(depth={depth}, {self.words})"

    @property
    def shorter(self) -> str:
        """The same in one word of rclpy's; empty where there is none."""
        return {USUAL: "10", SENSORS: "qos_profile_sensor_data"}.get(self.wanted, "")

    @property
    def hint(self) -> str:
        """Whom to ask, and where it is set."""
        return (
            f"`ros2 topic info -v {self.topic}` shows what each side offers and asks. Which QoS"
            f" does {CALLS[self.kind]}(...) get?"
        )

    @property
    def mend(self) -> str:
        """Which call gets which profile."""
        call = f"{CALLS[self.kind]}(...) for {self.topic}"
        if self.wanted == USUAL:
            return (
                f"Give {call} the number 10 in place of its QoS profile: that is {USUAL}. Where you"
                f" need a profile, for a deadline say: {self.profile}."
            )
        short = f" {self.shorter} is such a profile." if self.shorter else ""
        return f"Give {call} {self.profile}, from rclpy.qos.{short} {OTHERS_STAY}"


@dataclass(eq=False)
class QosCannotMatch(OtherQos):
    """The quality of service keeps publisher and subscription apart."""

    why = "If one side asks for more than the other offers, no message is delivered."

    @property
    def conflicts(self) -> tuple[str, ...]:
        """The policies that keep them apart."""
        return qos_conflicts(self.kind, self.found, self.wanted)

    @property
    def expected(self) -> str:
        """What the other side is."""
        other = self.wanted.policies
        sides = " and ".join(f"{policy} {other[policy]}" for policy in self.conflicts)
        return f"a {self.kind} on {self.topic} whose QoS works with {sides}"

    @property
    def measured(self) -> str:
        """What this side is."""
        ours = self.found.policies
        own = " and ".join(f"{policy} is {ours[policy]}" for policy in self.conflicts)
        return f"{own}: the two can never be joined"


@dataclass(eq=False)
class NotThisQos(OtherQos):
    """The quality of service would match, and is not the asked one."""

    expected = "a {kind} on {topic} with {wanted}"
    measured = "it has {found}"

    @property
    def why(self) -> str:  # type: ignore[override]
        """What is bad about each policy that is another one."""
        ours = self.found.policies
        return " ".join(
            IF_OTHERWISE[policy, value]
            for policy, value in self.wanted.policies.items()
            if value != ours[policy]
        )


def matched(qos: Qos) -> Matched:
    """Of all that was seen, what a card names for each topic."""
    return Matched(qos.reliability, qos.durability)


def qos_conflicts(kind: EndpointKind, ours: Matched, theirs: Matched) -> tuple[str, ...]:
    """The policies for which an endpoint cannot be joined with the contract's other side.

    DDS joins a publisher and a subscription where the publisher offers at least what the
    subscription asks for (OMG DDS 1.4, 2.2.3; the same rule as rclpy's
    qos_check_compatible).
    """
    offered, requested = (ours, theirs) if kind == "publisher" else (theirs, ours)
    weak = Matched("best_effort", "volatile").policies
    asked = requested.policies
    return tuple(
        policy
        for policy, offer in offered.policies.items()
        if offer == weak[policy] and asked[policy] != weak[policy]
    )
