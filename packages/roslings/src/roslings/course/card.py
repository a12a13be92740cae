"""A lab's card: the contract between student and grader, said once.

An instructor changes a rate, a text or the points here for a new term; the grader, `task.md`
and the lesson read it from here.
"""

from __future__ import annotations

import string
from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field, RootModel, create_model, field_validator, model_validator

from roslings.capability import capabilities
from roslings.course.contract import (
    NUMBERS_WITHIN,
    CardWords,
    Contract,
    Expected,
    NodeWords,
    Plain,
    Promise,
    Prose,
    RateContract,
    Stimulus,
)
from roslings.course.kinds import Kind
from roslings.course.outline import DAY, PACKAGE

DEFAULT_WITHIN = 0.1
"""The part of a rate that it may be off, where the card says nothing."""


GroupName = Annotated[str, Field(pattern=r"^[a-z][a-z0-9-]*$")]


class QosContract(Contract):
    """The quality of service that the other side of the topic uses: ours must match it."""

    reliability: Annotated[Literal["reliable", "best_effort"], Expected] = "reliable"
    durability: Annotated[Literal["volatile", "transient_local"], Expected] = "volatile"
    exact: Annotated[bool, Expected] = Field(
        default=False, description="Ours must be just this, not only match it"
    )


class TopicContract(Contract):
    """One topic that a node publishes or subscribes to."""

    topic: Annotated[str, Expected] = Field(pattern=r"^/[A-Za-z_][A-Za-z0-9_/]*$")
    type: Annotated[str, Expected] = Field(pattern=r"^[a-z][a-z0-9_]*/msg/[A-Z][A-Za-z0-9]*$")
    qos: QosContract = QosContract()
    rate: RateContract | None = None
    text: Annotated[str | None, Expected] = Field(
        default=None, description="The message's text; `{n}` is a counter"
    )
    about: Annotated[str, Promise] = Field(
        default="", description="What the message says, in words"
    )
    fields: Annotated[dict[str, Plain], Expected] = Field(
        default_factory=dict, description="What each message holds; a dot leads into a field"
    )
    numbers_within: Annotated[float, Kind.TOLERANCE] = Field(
        default=NUMBERS_WITHIN,
        gt=0,
        lt=1,
        description="So far off a number still counts: as a part of it, and near 0 in its unit",
    )

    def at(self, hz: float) -> TopicContract:
        """The same topic at another rate, as tolerant as before."""
        within = self.rate.within if self.rate else DEFAULT_WITHIN
        return self.model_copy(update={"rate": RateContract(hz=hz, within=within)})


class ConstantContract(Contract):
    """A number that the node reckons with."""

    name: Annotated[str, Prose]
    value: Annotated[float, Expected]
    about: Annotated[str, Promise] = Field(description="Its unit, and what it is for")


class OutcomeContract(Contract):
    """One way in which a program that has a single task can come to its end."""

    when: Annotated[str, Promise]
    log: Annotated[str, Expected] = Field(
        description="A line it writes; `{text}` is something of the answer"
    )
    log_about: Annotated[str, Promise] = Field(default="", description="What `{text}` stands for")
    exit_code: Annotated[int, Expected]


class GiveUpContract(Contract):
    """What a client does that finds no server."""

    within_s: Annotated[float, Kind.MOST] = Field(gt=0, description="From its start to its end")
    log: Annotated[str, Expected]
    exit_code: Annotated[int, Expected]


class NodeContract(NodeWords):
    """One node: its full name, the executable that starts it, and its topics."""

    node: Annotated[str, Expected] = Field(pattern=r"^/[A-Za-z_][A-Za-z0-9_/]*$")
    executable: Annotated[str, Kind.KEY]
    publishes: tuple[TopicContract, ...] = ()
    subscribes: tuple[TopicContract, ...] = ()
    constants: tuple[ConstantContract, ...] = ()
    outcomes: dict[str, OutcomeContract] = Field(
        default_factory=dict, description="By a word for the grader, e.g. `refused`"
    )
    gives_up: GiveUpContract | None = None
    other_names: Annotated[tuple[str, ...], Stimulus] = Field(
        default=(), description="Full names that it takes when it is started with remaps"
    )
    log: Annotated[str | None, Expected] = Field(
        default=None, description="A line it writes; `{text}` is the message"
    )
    log_about: Annotated[str, Promise] = Field(
        default="the message's text", description="What `{text}` stands for"
    )
    log_examples: Annotated[tuple[str, ...], Prose] = Field(
        default=(), description="For `{text}` in the task, where no topic has a text"
    )

    @property
    def stays(self) -> bool:
        """It runs until somebody ends it; the others have one task, and end after it."""
        return not self.outcomes and self.gives_up is None

    def constant(self, name: str) -> float:
        """A number of the card. Raises KeyError where there is none of this name."""
        return {each.name: each.value for each in self.constants}[name]


def _with_words(own: type[Contract], others: Iterable[type[Contract] | None]) -> type[Contract]:
    """The words that the engine knows, and those of each capability that is here."""
    bases = [own, *(each for each in others if each)]
    bases.reverse()  # pydantic takes the fields of the last one first
    return create_model(
        own.__name__, __base__=tuple(bases), __module__=__name__, __doc__=own.__doc__
    )


_WORDS = tuple(words for each in capabilities() if (words := each.words_here))

if not TYPE_CHECKING:  # to the type checker a node has the engine's words; the others by `of`
    NodeContract = _with_words(NodeContract, (each.node for each in _WORDS))


class PictureContract(Contract):
    """An image that the package holds."""

    path: Annotated[str, Expected]
    format: Annotated[Literal["PNG"], Expected] = "PNG"
    min_width_px: Annotated[int, Kind.LEAST] = Field(gt=0)
    min_height_px: Annotated[int, Kind.LEAST] = Field(gt=0)


class Hint(Contract):
    """What a check offers to who is stuck, in three steps, and where the lesson explains it."""

    lesson: str = Field(pattern=r"^days/[0-9]{2}-[a-z0-9-]+#[a-z0-9-]+$")
    steps: tuple[str, str, str] = Field(
        description="Where to look; which idea; the same idea in other code"
    )


class Hints(RootModel[dict[str, Hint]]):
    """The file `hints.yaml`: check's name to its hint."""


class Card(CardWords):
    """All that a lab asks for. Points of all checks add up to 100."""

    id: Annotated[str, Prose] = Field(pattern=r"^[a-z][a-z0-9-]*$")
    title: Annotated[str, Prose]
    day: Annotated[str, Prose] = Field(pattern=DAY)
    needs: Annotated[tuple[str, ...], Prose] = Field(
        default=(), description="Labs to do before this one"
    )
    package: Annotated[str, Expected] = Field(pattern=PACKAGE)
    build_type: Annotated[Literal["ament_python"], Expected] = "ament_python"
    groups: Annotated[tuple[GroupName, ...], Prose] = Field(
        default=(), description="Dependency groups that its check needs besides the usual ones"
    )
    nodes: tuple[NodeContract, ...]
    builds_within_s: Annotated[float, Kind.MOST] = Field(
        default=180.0, gt=0, description="The most that colcon may take"
    )
    ends_within_s: Annotated[float, Kind.MOST] = Field(
        default=2.0, gt=0, description="After Ctrl-C"
    )
    soak_s: Annotated[float, Stimulus] = Field(
        default=30.0, ge=0, le=600, description="So long the nodes run where results count; 0: not"
    )
    pictures: tuple[PictureContract, ...] = ()
    documents: Annotated[tuple[str, ...], Expected] = Field(
        default=(), description="Texts in the package that are read, and never run: their paths"
    )
    points: Annotated[dict[str, float], Prose] = Field(description="Check's name to its points")
    not_judged: Annotated[tuple[str, ...], Prose] = Field(
        default=(), description="What the student is free in"
    )

    @field_validator("points")
    @classmethod
    def _add_up(cls, points: dict[str, float]) -> dict[str, float]:
        if sum(points.values()) != 100:
            raise ValueError(f"the points add up to {sum(points.values()):g}, not to 100")
        return points

    @model_validator(mode="after")
    def _texts_have_known_fields(self) -> Card:
        for node in self.nodes:
            for log in (node.log, *(outcome.log for outcome in node.outcomes.values())):
                _allow_fields(log, {"text"})
            for topic in (*node.publishes, *node.subscribes):
                _allow_fields(topic.text, {"n"})
        return self

    def node(self, executable: str) -> NodeContract:
        """The node that `executable` starts. Raises KeyError where the card has none."""
        for node in self.nodes:
            if node.executable == executable:
                return node
        raise KeyError(f"the card of {self.id!r} has no executable {executable!r}")


def _allow_fields(template: str | None, allowed: set[str]) -> None:
    fields = {field for _, field, _, _ in string.Formatter().parse(template or "") if field}
    if fields - allowed:
        raise ValueError(f"{template!r} has unknown fields {sorted(fields - allowed)}")


if not TYPE_CHECKING:
    Card = _with_words(Card, (each.card for each in _WORDS))
