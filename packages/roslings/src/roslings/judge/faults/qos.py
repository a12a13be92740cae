"""Faults in the quality of service of one publisher or subscription, and what to write instead.

What is advised is always what the card asks of this one endpoint, as Python for rclpy.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from roslings.evidence import Qos
from roslings.judge.faults.base import Fault
from roslings.judge.faults.graph import CALLS, EndpointKind
from roslings.judge.faults.sentences import one_of, some_of


class MatchedPolicies(NamedTuple):
    """The two policies that a card names for each topic, in rclpy's words, lower case."""

    reliability: str
    durability: str

    def __str__(self) -> str:
        return f"{self.reliability}, {self.durability}"

    @property
    def policies(self) -> dict[str, str]:
        """Name to value."""
        return self._asdict()


USUAL = MatchedPolicies("reliable", "volatile")
ENUMS = {"reliability": "ReliabilityPolicy", "durability": "DurabilityPolicy"}
SENSORS = MatchedPolicies("best_effort", "volatile")
"""As `qos_profile_sensor_data` is."""


@dataclass(eq=False)
class OtherQos(Fault):
    """An endpoint's quality of service is not what its card asks."""

    topic: str
    kind: EndpointKind
    wanted: MatchedPolicies
    """The card's."""
    found: MatchedPolicies

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

    hint = one_of(
        publisher="`ros2 topic info -v {topic}` shows what each side offers and asks. Which QoS"
        " does"
        " create_publisher(...) get?",
        subscription="`ros2 topic info -v {topic}` shows what each side offers and asks. Which QoS"
        " does create_subscription(...) get?",
    )
    mend = some_of(
        usual="Give {call}(...) for {topic} the number 10 in place of its QoS profile: that is"
        " reliable, volatile. Where you need a profile, for a deadline say: {profile}.",
        profile="Give {call}(...) for {topic} {profile}, from rclpy.qos.",
        short="{shorter} is such a profile.",
        others="A depth of your own and other words, such as a deadline, stay.",
    )

    @property
    def which_hint(self) -> str:
        """Where it is set."""
        return self.kind

    @property
    def which_mend(self) -> tuple[str, ...]:
        """Which call gets which profile."""
        if self.wanted == USUAL:
            return ("usual",)
        return ("profile", "short", "others") if self.shorter else ("profile", "others")

    @property
    def call(self) -> str:
        """Where the code gives the quality of service."""
        return CALLS[self.kind]


@dataclass(eq=False)
class QosCannotMatch(OtherQos):
    """The quality of service keeps publisher and subscription apart."""

    why = "If one side asks for more than the other offers, no message is delivered."

    @property
    def conflicts(self) -> tuple[str, ...]:
        """The policies that keep them apart."""
        return qos_conflicts(self.kind, self.found, self.wanted)

    expected = one_of(
        publisher_reliability="a publisher on {topic} whose QoS works with reliability"
        " {wanted.reliability}",
        publisher_durability="a publisher on {topic} whose QoS works with durability"
        " {wanted.durability}",
        publisher_both="a publisher on {topic} whose QoS works with reliability"
        " {wanted.reliability} and durability {wanted.durability}",
        subscription_reliability="a subscription on {topic} whose QoS works with reliability"
        " {wanted.reliability}",
        subscription_durability="a subscription on {topic} whose QoS works with durability"
        " {wanted.durability}",
        subscription_both="a subscription on {topic} whose QoS works with reliability"
        " {wanted.reliability} and durability {wanted.durability}",
    )
    measured = one_of(
        reliability="reliability is {found.reliability}: the two can never be joined",
        durability="durability is {found.durability}: the two can never be joined",
        both="reliability is {found.reliability} and durability is {found.durability}: the two can"
        " never be joined",
    )

    @property
    def which_expected(self) -> str:
        """What the other side is."""
        return f"{self.kind}_{self.which_measured}"

    @property
    def which_measured(self) -> str:
        """What keeps them apart."""
        return self.conflicts[0] if len(self.conflicts) == 1 else "both"


@dataclass(eq=False)
class NotThisQos(OtherQos):
    """The quality of service would match, and is not the asked one."""

    expected = one_of(
        publisher="a publisher on {topic} with {wanted}",
        subscription="a subscription on {topic} with {wanted}",
    )
    measured = "it has {found}"

    why = some_of(
        reliable="Best effort does not send again what was lost on the way: it is never heard.",
        best_effort="Reliable means: send the old message again, and let the new one wait. On"
        " Wi-Fi, messages then come seconds late.",
        transient_local="Volatile keeps nothing: who comes late does not hear what was said"
        " before.",
        volatile="Transient local brings what was said before: who comes late takes it for new.",
    )

    @property
    def which_expected(self) -> str:
        """What it is."""
        return self.kind

    @property
    def which_why(self) -> tuple[str, ...]:
        """What is bad about each policy that is another one."""
        ours = self.found.policies
        asked = self.wanted.policies.items()
        return tuple(value for policy, value in asked if value != ours[policy])


def matched(qos: Qos) -> MatchedPolicies:
    """Of all that was seen, what a card names for each topic."""
    return MatchedPolicies(qos.reliability, qos.durability)


def qos_conflicts(
    kind: EndpointKind, ours: MatchedPolicies, theirs: MatchedPolicies
) -> tuple[str, ...]:
    """The policies for which an endpoint cannot be joined with the contract's other side.

    DDS joins a publisher and a subscription where the publisher offers at least what the
    subscription asks for. This is OMG DDS 1.4, 2.2.3, and the same rule as rclpy's
    qos_check_compatible.
    """
    offered, requested = (ours, theirs) if kind == "publisher" else (theirs, ours)
    weak = MatchedPolicies("best_effort", "volatile").policies
    asked = requested.policies
    return tuple(
        policy
        for policy, offer in offered.policies.items()
        if offer == weak[policy] and asked[policy] != weak[policy]
    )
