"""Texts of a launch file that are known only when it is carried out."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

from ros2_on_pip.launching.wrong_kind import WrongKind
from ros2_on_pip.problem import Problem

if TYPE_CHECKING:
    from ros2_on_pip.launching.context import LaunchContext

SomeSubstitutionsType = Any
"""A text, a path, a Substitution, or several of them, which are put together to one text."""


class SubstitutionFailure(Problem):
    """A text cannot be filled in; whoever knows the place adds it."""


class Substitution(ABC):
    """A text that is made when the launch file is carried out."""

    @abstractmethod
    def perform(self, context: LaunchContext) -> str:
        """The text. Raises SubstitutionFailure."""

    def describe(self) -> str:
        """How it is shown by `--show-args` and `--print`."""
        return f"{type(self).__name__}()"


class TextSubstitution(Substitution):
    """A text that is known already."""

    def __init__(self, *, text: str) -> None:
        if not isinstance(text, str):
            raise WrongKind("text of TextSubstitution", text)
        self.text = text

    def perform(self, context: LaunchContext) -> str:
        """The text itself."""
        return self.text

    def describe(self) -> str:
        """The text between quotes."""
        return f"'{self.text}'"


Parts = list[Substitution]


def parts_of(value: SomeSubstitutionsType, what: str) -> Parts:
    """What is put together to one text; `what` names it. Raises WrongKind."""
    if isinstance(value, Substitution):
        return [value]
    if isinstance(value, str | PurePath):
        return [TextSubstitution(text=str(value))]
    if isinstance(value, Iterable) and not isinstance(value, Mapping | bytes):
        return [part for one in value for part in parts_of(one, what)]
    raise WrongKind(what, value)


def parts_or_none(value: SomeSubstitutionsType | None, what: str) -> Parts | None:
    """The same, where nothing may stand, too. Raises WrongKind."""
    return None if value is None else parts_of(value, what)


def performed(context: LaunchContext, parts: Iterable[Substitution]) -> str:
    """The one text. Raises SubstitutionFailure."""
    return "".join(context.perform_substitution(part) for part in parts)


def performed_or_none(context: LaunchContext, parts: Parts | None) -> str | None:
    """The one text, where there is one. Raises SubstitutionFailure."""
    return None if parts is None else performed(context, parts)


def described(parts: Iterable[Substitution]) -> str:
    """The parts for a reader."""
    return " + ".join(part.describe() for part in parts) or "''"
