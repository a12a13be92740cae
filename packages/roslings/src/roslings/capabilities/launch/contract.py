"""What a card says about launch files, and its rows in task.md."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Annotated

from pydantic import Field

from roslings.capability import Row, Words
from roslings.course.contract import (
    CardWords,
    Contract,
    Expected,
    Plain,
    Promise,
    Stimulus,
    as_typed,
)
from roslings.course.kinds import Kind


class ArgumentContract(Contract):
    """An argument of the launch file: `NAME:=VALUE` behind `ros2 launch PACKAGE FILE`."""

    name: Annotated[str, Expected] = Field(pattern=r"^[a-z][a-z0-9_]*$")
    about: Annotated[str, Promise]
    default: Annotated[str, Expected] = Field(
        description="Its value where nobody gives one; of a path the end, from the share folder on"
    )
    tried: Annotated[str, Stimulus] = Field(description="The other value that the check gives it")
    sets: Annotated[str | None, Expected] = Field(
        default=None,
        pattern=r"^[a-z][a-z0-9_]*\.[a-z][a-z0-9_]*$",
        description="The parameter that gets its value in each namespace: EXECUTABLE.PARAMETER",
    )


class NamespaceContract(Contract):
    """A namespace in which the nodes are started, and their parameters there."""

    namespace: Annotated[str, Expected] = Field(pattern=r"^/[A-Za-z_][A-Za-z0-9_/]*$")
    only_with: Annotated[str | None, Expected] = Field(
        default=None, description="The argument that must be true for it"
    )
    values: Annotated[dict[str, Plain], Expected] = Field(
        default_factory=dict,
        description="What parameters are after a launch: EXECUTABLE.PARAMETER to its value",
    )


class LaunchContract(Contract):
    """A launch file of the package, and the executables that it starts."""

    file: Annotated[str, Expected] = Field(pattern=r"^launch/[a-z0-9_]+\.launch\.(xml|yaml|py)$")
    starts: Annotated[tuple[str, ...], Expected]
    namespaces: tuple[NamespaceContract, ...] = Field(
        default=(), description="All of `starts` are started in each; none: where they are anyway"
    )
    arguments: tuple[ArgumentContract, ...] = ()
    respawns: Annotated[tuple[str, ...], Expected] = Field(
        default=(), description="Executables that are started again when they were killed"
    )
    respawns_within_s: Annotated[float, Kind.MOST] = Field(
        default=3.0, gt=0, description="From the kill until the node answers again"
    )

    @property
    def name(self) -> str:
        """What stands behind `ros2 launch PACKAGE`."""
        return self.file.rpartition("/")[2]


class LaunchWords(CardWords):
    """What a card may say of the package."""

    launch: LaunchContract | None = None


def rows(card: LaunchWords) -> Iterable[Row]:
    """The launch file, what it starts where, with which arguments, and what comes back."""
    if card.launch:
        yield "launch file", f"`{card.launch.file}`, starts {_started(card.launch)}"
        yield from (("argument", _argument(each)) for each in card.launch.arguments)
        for each in card.launch.namespaces:
            yield from _namespace_rows(each)
        if card.launch.respawns:
            yield "respawn", _respawning(card.launch)


def _started(launch: LaunchContract) -> str:
    starts = _named(launch.starts)
    spaces = _named([each.namespace for each in launch.namespaces])
    return f"{starts} in each of {spaces}" if spaces else starts


def _named(names: Iterable[str]) -> str:
    return " and ".join(f"`{name}`" for name in names)


def _argument(argument: ArgumentContract) -> str:
    default = f"`{argument.default}`" + (" of the package" if "/" in argument.default else "")
    return f"`{argument.name}`, {argument.about}; {default} when nobody gives it"


def _namespace_rows(contract: NamespaceContract) -> Iterator[Row]:
    name = f"in `{contract.namespace}`"
    if contract.only_with:
        yield name, f"nothing is started with `{contract.only_with}:=false`"
    values = ", ".join(f"`{key}` is `{as_typed(value)}`" for key, value in contract.values.items())
    if values:
        yield name, values


def _respawning(launch: LaunchContract) -> str:
    return (
        f"{_named(launch.respawns)}, when somebody kills it, answers again within"
        f" {launch.respawns_within_s:g} s"
    )


WORDS = Words(card=LaunchWords, package=rows)
