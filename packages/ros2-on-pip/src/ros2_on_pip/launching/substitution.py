"""Texts of a launch file that are known only when it is carried out."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Iterable, Mapping
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

from ros2_on_pip.launching.wrong_kind import GivesNoText, WrongKind
from ros2_on_pip.problem import CommandProblem

if TYPE_CHECKING:
    from ros2_on_pip.launching.context import LaunchContext

SomeSubstitutionsType = Any
"""A text, a path, a Substitution, or several of them, which are put together to one text."""


class SubstitutionFailure(CommandProblem):
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
    if isinstance(value, Substitution | str | PurePath):
        return [_part(value, what)]
    if isinstance(value, Iterable) and not isinstance(value, Mapping | bytes):
        return [_part(one, what) for one in value]
    raise WrongKind(what, value)


def _part(value: Any, what: str) -> Substitution:
    """One part of a text; a list is none. Raises WrongKind."""
    if isinstance(value, Substitution):
        return value
    if isinstance(value, str | PurePath):
        return TextSubstitution(text=str(value))
    raise WrongKind(what, value)


def is_substitution(value: Any) -> bool:
    """Whether it is one, or texts and substitutions side by side, with one of them at least."""
    if isinstance(value, Substitution):
        return True
    if not isinstance(value, Collection) or isinstance(value, Mapping | bytes):
        return False
    of_a_text = all(isinstance(one, Substitution | str) for one in value)
    return of_a_text and any(isinstance(one, Substitution) for one in value)


def parts_or_none(value: SomeSubstitutionsType | None, what: str) -> Parts | None:
    """The same, where nothing may stand, too. Raises WrongKind."""
    return None if value is None else parts_of(value, what)


def pairs_of(pairs: Mapping[Any, Any] | None, what: str) -> list[tuple[Parts, Parts]]:
    """Names and values of a dictionary, where there is one. Raises TypeError."""
    if pairs is None:
        return []
    if not isinstance(pairs, Mapping):
        raise TypeError(f"{what} must be a dictionary, {{'name': 'value'}}, and not {pairs!r}")
    return [(parts_of(k, f"a name in {what}"), parts_of(v, what)) for k, v in pairs.items()]


def performed(context: LaunchContext, parts: Iterable[Substitution]) -> str:
    """The one text. Raises SubstitutionFailure, GivesNoText."""
    return "".join(_performed_part(context, part) for part in parts)


def _performed_part(context: LaunchContext, part: Substitution) -> str:
    found = context.perform_substitution(part)
    if not isinstance(found, str):
        raise GivesNoText(part.describe(), found)
    return found


def performed_or_none(context: LaunchContext, parts: Parts | None) -> str | None:
    """The one text, where there is one. Raises SubstitutionFailure, GivesNoText."""
    return None if parts is None else performed(context, parts)


def described(parts: Iterable[Substitution]) -> str:
    """The parts for a reader."""
    return " + ".join(part.describe() for part in parts) or "''"
