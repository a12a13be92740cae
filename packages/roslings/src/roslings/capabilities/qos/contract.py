"""What a card says about deadlines, lifespans and liveliness, and its rows in task.md."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Literal

from pydantic import Field

from roslings.capability import Row, Words
from roslings.course.contract import Contract, Expected, NodeWords

Liveliness = Literal["automatic", "manual_by_topic"]
TOPIC = r"^/[A-Za-z_][A-Za-z0-9_/]*$"


class TimesContract(Contract):
    """The times that both sides of a topic agree on."""

    topic: Annotated[str, Expected] = Field(pattern=TOPIC)
    deadline_s: Annotated[float | None, Expected] = Field(
        default=None, gt=0, description="From one message to the next, at most"
    )
    liveliness: Annotated[Liveliness, Expected] = "automatic"
    lease_s: Annotated[float | None, Expected] = Field(
        default=None, gt=0, description="Who gives no sign of life for so long is not alive"
    )


class OfferContract(TimesContract):
    """What one publisher of a node promises."""

    lifespan_s: Annotated[float | None, Expected] = Field(
        default=None, gt=0, description="An older message is not delivered any more"
    )
    keeps: Annotated[int | None, Expected] = Field(
        default=None, gt=0, description="So many messages a late joiner gets"
    )


class AskContract(TimesContract):
    """What one subscription of a node wants to be promised."""


class QosWords(NodeWords):
    """What a card may say of a node."""

    offers: tuple[OfferContract, ...] = ()
    asks: tuple[AskContract, ...] = ()


def rows(node: QosWords) -> Iterable[Row]:
    """What each side promises or asks for."""
    for offered in node.offers:
        yield from _times_rows(offered, "offers on")
        if offered.lifespan_s:
            yield "lifespan", f"{offered.lifespan_s:g} s"
        if offered.keeps:
            yield "a late joiner gets", _messages(offered.keeps)
    for asked in node.asks:
        yield from _times_rows(asked, "asks on")


def _times_rows(times: TimesContract, verb: str) -> Iterable[Row]:
    yield verb, f"`{times.topic}`"
    if times.deadline_s:
        yield "deadline", f"{times.deadline_s:g} s"
    if times.lease_s:
        yield "liveliness", f"{times.liveliness}, with a lease of {times.lease_s:g} s"


def _messages(count: int) -> str:
    return "the last message" if count == 1 else f"the last {count} messages"


WORDS = Words(node=QosWords, interface=rows)
