"""The parameters that a node has, and what became of each try to set one."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from roslings.record import Columns, PartSeen, Record


class ParameterDeclared(Record):
    """One parameter of a node, as the node itself says it."""

    node: str
    name: str
    type: Literal["bool", "integer", "double", "string", "other"]
    value: bool | int | float | str | None = Field(description="None where the type is another")


class ParameterSet(Record):
    """One try to set a node's parameter while it ran."""

    node: str
    name: str
    value: bool | int | float | str
    asked_ns: int = Field(description="Observer's monotonic clock")
    answered_ns: int | None = Field(default=None, description="None where no answer came")
    accepted: bool = False
    reason: str = Field(default="", description="Why it was refused, in the node's words")


GIVEN_BY_ROS = ("use_sim_time", "start_type_description_service")
"""Parameters that every node of Jazzy has."""

Values = dict[str, bool | int | float | str | None]
"""Name to value; None where it is of a type that no card has."""


class ParameterTrial(Record):
    """One request to set parameters of a running node, and what they were before and after it."""

    part: str = Field(description="What it was tried for")
    node: str
    asked: dict[str, bool | int | float | str]
    together: bool = Field(description="All at once or none: set_parameters_atomically")
    asked_ns: int = Field(description="Observer's monotonic clock")
    answered_ns: int | None = Field(default=None, description="None where no answer came")
    accepted: bool = False
    reason: str = Field(default="", description="Why it was refused, in the node's words")
    before: Values = Field(default_factory=dict)
    after: Values = Field(default_factory=dict, description="As the node says after its answer")


class ParametersRead(Record):
    """All parameters of a node at one moment, as the node itself says them."""

    node: str
    values: Values


class ParametersSeen(PartSeen):
    """All that was seen of parameters in an experiment."""

    NAME = "parameters"

    names: dict[str, list[str]] = Field(
        default_factory=dict, description="Node to the names of its parameters"
    )
    declared: Columns[ParameterDeclared] = Field(default_factory=list)
    sets: Columns[ParameterSet] = Field(default_factory=list, description="Tries to set one")
    trials: Columns[ParameterTrial] = Field(default_factory=list)
    read: Columns[ParametersRead] = Field(default_factory=list)
