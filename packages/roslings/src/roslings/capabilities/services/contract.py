"""What a card says about services, and its rows in task.md."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Annotated

from pydantic import Field

from roslings.capability import Row, Words
from roslings.course.contract import (
    Contract,
    Expected,
    NodeWords,
    Plain,
    Prose,
    Stimulus,
    as_typed,
)
from roslings.course.kinds import Kind

MOST_LATE = 0.05
"""The part of the answers that may be late: a computer does other things, too."""


class AnswerContract(Contract):
    """What a server answers to one request, and what is to be seen of it afterwards."""

    when: Annotated[str, Prose] = Field(
        description="In what state it is asked, e.g. `the limit is on`"
    )
    request: Annotated[dict[str, Plain], Stimulus] = Field(default_factory=dict)
    response: Annotated[dict[str, Plain], Expected]
    state: Annotated[Plain | None, Expected] = Field(
        default=None, description="What the node's first topic carries afterwards, in `data`"
    )


class ServiceContract(Contract):
    """One service that a node offers, or that it calls."""

    service: Annotated[str, Expected] = Field(pattern=r"^/[A-Za-z_][A-Za-z0-9_/]*$")
    type: Annotated[str, Expected] = Field(pattern=r"^[a-z][a-z0-9_]*/srv/[A-Z][A-Za-z0-9]*$")
    within_s: Annotated[float | None, Kind.MOST] = Field(
        default=None, gt=0, description="The answer comes in this time"
    )
    answers: tuple[AnswerContract, ...] = ()

    @property
    def whatever_it_answers(self) -> ServiceContract:
        """The same, with one answer that is not compared: for who asks only how soon it comes."""
        any_answer = self.answers[0].model_copy(update={"response": {}})
        return self.model_copy(update={"answers": (any_answer,)})


class ServiceWords(NodeWords):
    """What a card may say of a node."""

    serves: tuple[ServiceContract, ...] = ()
    calls: tuple[ServiceContract, ...] = ()


def rows(node: ServiceWords) -> Iterable[Row]:
    """Each service with its type, its answers and its time."""
    verbs = {"serves": node.serves, "calls": node.calls}
    for verb, service in ((verb, service) for verb, each in verbs.items() for service in each):
        yield verb, f"`{service.service}`"
        yield from _rows_of(service)


def _rows_of(service: ServiceContract) -> Iterable[Row]:
    yield "service type", f"`{service.type}`"
    for answer in service.answers:
        yield answer.when, _answer(answer)
    if service.within_s:
        yield "time to answer", f"{service.within_s:g} s at most"


def _answer(answer: AnswerContract) -> str:
    asked = f"`{_fields(answer.request)}`" if answer.request else ""
    if not answer.response:
        return asked
    asked = f"asked {asked}: " if asked else ""
    then = "" if answer.state is None else f"; the topic then says `{answer.state}`"
    return f"{asked}{_fields(answer.response, '`')}{then}"


def _fields(fields: Mapping[str, Plain], quote: str = "") -> str:
    return ", ".join(f"{name}: {quote}{as_typed(value)}{quote}" for name, value in fields.items())


WORDS = Words(node=ServiceWords, interface=rows)
