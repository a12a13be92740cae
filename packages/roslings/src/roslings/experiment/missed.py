"""The names of what nodes make: by these an experiment tells others what it has missed."""

from __future__ import annotations

from roslings.course import TopicContract


def publishes(contract: TopicContract) -> str:
    """The name of a publisher, where it is missed."""
    return f"a publisher on {contract.topic}"


def hears(contract: TopicContract) -> str:
    """The name of a subscription, where it is missed."""
    return f"a subscription to {contract.topic}"


def says(contract: TopicContract) -> str:
    """The name of the first message on a topic, where it is missed."""
    return f"a message on {contract.topic}"


def no_timer_says(contract: TopicContract) -> str:
    """The name of what did not come while simulated time went by."""
    return f"a timer's message on {contract.topic}"


def no_timer_makes(contract: TopicContract) -> str:
    """The name of a publisher that was not made while simulated time went by."""
    return f"a timer's publisher on {contract.topic}"
