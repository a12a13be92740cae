"""What a card says about parameters, and its rows in task.md."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Literal

from pydantic import Field

from roslings.capability import Row, Words
from roslings.course.contract import (
    Contract,
    Expected,
    NodeWords,
    Plain,
    Promise,
    Stimulus,
    as_typed,
)
from roslings.course.kinds import Kind


class ParameterContract(Contract):
    """A setting of a node that is chosen when it starts; a live one also while it runs."""

    name: Annotated[str, Kind.KEY] = Field(pattern=r"^[a-z][a-z0-9_]*$")
    type: Annotated[Literal["bool", "integer", "double", "string"], Expected]
    about: Annotated[str, Promise] = Field(
        description="What it sets, with its unit, e.g. `seconds between messages`"
    )
    default: Annotated[Plain, Expected]
    tried: Annotated[Plain, Stimulus] = Field(description="The other value that the check gives it")
    least: Annotated[float | None, Kind.EDGE] = Field(
        default=None, description="What is below is refused"
    )
    most: Annotated[float | None, Kind.EDGE] = Field(
        default=None, description="What is above is refused"
    )
    live: Annotated[bool, Expected] = Field(
        default=False, description="A change acts at once, while the node runs"
    )
    read_only: Annotated[bool, Expected] = Field(
        default=False, description="It is chosen at the start, and each change is refused"
    )
    not_above: Annotated[str | None, Expected] = Field(
        default=None, description="The parameter of the node that it is never larger than"
    )

    @property
    def ends(self) -> tuple[int, int]:
        """The smallest and the largest whole number that it takes. Raises ValueError."""
        if self.least is None or self.most is None:
            raise ValueError(f"the parameter {self.name} has no limits: give it least and most")
        return int(self.least), int(self.most)

    @property
    def beyond(self) -> tuple[int, int]:
        """The nearest whole numbers that it refuses, below and above. Raises ValueError."""
        least, most = self.ends
        return least - 1, most + 1

    @property
    def span(self) -> str:
        """From where to where it goes; empty where it has no limits."""
        if self.least is None or self.most is None:
            return ""
        return f"{self.least:g} to {self.most:g}"

    def allows(self, value: Plain) -> bool:
        """Whether a value lies within the limits, where there are some."""
        if self.least is None or self.most is None or isinstance(value, str):
            return True
        return self.least <= value <= self.most


class ParameterWords(NodeWords):
    """What a card may say of a node."""

    parameters: tuple[ParameterContract, ...] = ()

    def parameter(self, name: str) -> ParameterContract:
        """A parameter of the card. Raises KeyError where there is none of this name."""
        return {each.name: each for each in self.parameters}[name]

    def named(self, *names: str) -> tuple[ParameterContract, ...]:
        """Several of them, in the order of the names. Raises KeyError."""
        return tuple(map(self.parameter, names))


def rows(node: ParameterWords) -> Iterable[Row]:
    """Each parameter with its type, its default and its limits."""
    return (("parameter", _row_of(parameter)) for parameter in node.parameters)


def _row_of(parameter: ParameterContract) -> str:
    default = f"`{as_typed(parameter.default)}` when nobody sets it"
    limits = f"; {parameter.span}, all else is refused" if parameter.span else ""
    live = "; a change acts at once" if parameter.live else ""
    rule = f"; never above `{parameter.not_above}`" if parameter.not_above else ""
    fixed = "; nobody can change it while the node runs" if parameter.read_only else ""
    words = f"`{parameter.name}`, {parameter.about}; type {parameter.type}; {default}"
    return f"{words}{limits}{rule}{live}{fixed}"


WORDS = Words(node=ParameterWords, settings=rows)
