"""What a card says about reasons to stop and about two computers, and its rows in task.md."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

from pydantic import Field

from roslings.capability import Row, Words
from roslings.course.contract import (
    CardWords,
    Contract,
    Expected,
    NodeWords,
    Promise,
    Stimulus,
)
from roslings.course.kinds import Kind


class StopContract(Contract):
    """One reason for which a watching node stops the robot, and how soon."""

    when: Annotated[str, Promise]
    says: Annotated[str, Expected] = Field(description="The reason, in the node's log line")
    within_s: Annotated[float, Kind.MOST] = Field(gt=0, description="From the reason to the stop")


class HostsContract(Contract):
    """Two computers that the nodes run on, and what the link between them does."""

    delay_ms: Annotated[float, Stimulus] = Field(ge=0, description="Of each packet, one way")
    loss: Annotated[float, Stimulus] = Field(ge=0, lt=1, description="Part of all packets")
    stops_within_s: Annotated[float, Kind.MOST] = Field(
        gt=0, description="From a press on one computer to the stop on the other"
    )


class GuardWords(NodeWords):
    """What a card may say of a node."""

    stops: dict[str, StopContract] = Field(
        default_factory=dict, description="By a word for the grader, e.g. `pressed`"
    )
    walks: Annotated[int, Stimulus] = Field(
        default=0,
        ge=0,
        description="Orders of events; those beyond the grader's own are drawn for each check",
    )


class HostsWords(CardWords):
    """What a card may say of the package."""

    hosts: HostsContract | None = None


def rows(node: GuardWords) -> Iterable[Row]:
    """Each reason to stop."""
    for stop in node.stops.values():
        yield "stops when", f"{stop.when}; within {stop.within_s:g} s; the reason is `{stop.says}`"
    if node.walks:
        yield (
            f"in {node.walks} orders",
            "reasons begin and end while others hold, and a second button comes and goes; the rover"
            " drives when no reason is left",
        )


def package_rows(card: HostsWords) -> Iterable[Row]:
    """The two computers, and what the link between them does."""
    if hosts := card.hosts:
        yield (
            "on two computers",
            f"the link has no multicast, delays each packet by {hosts.delay_ms:g} ms and loses"
            f" {hosts.loss:.0%} of them; a press on one stops the rover on the other within"
            f" {hosts.stops_within_s:g} s",
        )


WORDS = Words(node=GuardWords, card=HostsWords, interface=rows, package=package_rows)
