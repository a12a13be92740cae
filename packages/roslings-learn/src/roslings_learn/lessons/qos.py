"""What matches what: the rules of QoS that a publisher and a subscription compare.

The tables that one can play with read them here, in a notebook and on the site. That they are the
rules of the real middleware is tested for each pair of choices.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class PolicyValue:
    """One value of a rule."""

    words: str
    """As a reader sees it: `best effort`."""
    value: str | float | None
    """The name of a policy, or a time in seconds; None: no limit."""


@dataclass(frozen=True)
class PolicyRule:
    """One rule, with its choices from weak to strong."""

    name: str
    """As the argument of `QoSProfile` is called."""
    title: str
    choices: tuple[PolicyValue, ...]
    broken: str
    """What is wrong where the offer is weaker than what is asked."""

    def holds(self, offered: str, asked: str) -> bool:
        """Whether the offer is at least as strong as what is asked; both in a reader's words.

        Raises ValueError where a choice has no such words.
        """
        strength = [choice.words for choice in self.choices]
        return strength.index(offered) >= strength.index(asked)

    def value(self, words: str) -> str | float | None:
        """The value of the choice with these words. Raises KeyError."""
        return {choice.words: choice.value for choice in self.choices}[words]


RULES = (
    PolicyRule(
        "reliability",
        "reliability",
        (PolicyValue("best effort", "BEST_EFFORT"), PolicyValue("reliable", "RELIABLE")),
        "The subscription wants lost messages again, and the publisher sends none again.",
    ),
    PolicyRule(
        "durability",
        "durability",
        (PolicyValue("volatile", "VOLATILE"), PolicyValue("transient local", "TRANSIENT_LOCAL")),
        "The subscription asks for earlier messages, and the publisher keeps none.",
    ),
    PolicyRule(
        "deadline",
        "deadline",
        (PolicyValue("none", None), PolicyValue("1 s", 1.0), PolicyValue("0.2 s", 0.2)),
        "The subscription wants messages more often than the publisher promises.",
    ),
    PolicyRule(
        "liveliness",
        "liveliness",
        (PolicyValue("automatic", "AUTOMATIC"), PolicyValue("manual by topic", "MANUAL_BY_TOPIC")),
        "The subscription wants signs of life from the publisher itself, and only its program"
        " gives them.",
    ),
    PolicyRule(
        "liveliness_lease_duration",
        "lease duration",
        (PolicyValue("none", None), PolicyValue("2 s", 2.0), PolicyValue("0.5 s", 0.5)),
        "The subscription wants signs of life more often than the publisher promises.",
    ),
)
"""All that is compared. History, depth and lifespan are not: each side has its own."""


def broken_rules(offered: Mapping[str, str], asked: Mapping[str, str]) -> list[PolicyRule]:
    """The rules in which the offer is too weak; none: the two match.

    Both map a rule's name to the words of a choice. Raises KeyError and ValueError where one has
    no such rule or choice.
    """
    return [rule for rule in RULES if not rule.holds(offered[rule.name], asked[rule.name])]
