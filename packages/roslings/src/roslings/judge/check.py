"""How a grader declares a check, and which checks it needs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeVar

Function = TypeVar("Function", bound=Callable[..., None])
MARK = "roslings_check"


@dataclass(frozen=True)
class Check:
    """What a check's decorator says; the points stand on the card, under the check's name."""

    needs: tuple[str, ...] = ()
    explained_by: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """Earlier checks to the faults there that are the same mistake."""


def check(
    *, needs: Sequence[str] = (), explained_by: Mapping[str, str | tuple[str, ...]] | None = None
) -> Callable[[Function], Function]:
    """Make a pytest function a check; it is skipped when a check in `needs` did not pass.

    One mistake costs one check. `explained_by` names an earlier check and the fault (or several)
    that was found there. Then this check is skipped if it fails too. Where it passes, it has its
    points.

    Its name without `test_` is the check's name; its docstring is what the student reads, with
    the grader's own names in braces: `{CHATTER.topic} carries {CHATTER.type}.`
    """

    def mark(function: Function) -> Function:
        setattr(function, MARK, Check(tuple(needs), _each_as_several(explained_by or {})))
        return function

    return mark


def _each_as_several(kinds: Mapping[str, str | tuple[str, ...]]) -> dict[str, tuple[str, ...]]:
    return {name: (kind,) if isinstance(kind, str) else kind for name, kind in kinds.items()}


def check_of(function: Any) -> Check:
    """The declaration of a check; a plain pytest function needs nothing."""
    found: Check = getattr(function, MARK, Check())
    return found
