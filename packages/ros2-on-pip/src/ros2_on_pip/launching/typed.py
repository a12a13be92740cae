"""Truths and numbers of a launch file, which may be known only when it is carried out."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from ros2_on_pip.launching.substitution import (
    Parts,
    SubstitutionFailure,
    is_substitution,
    parts_of,
    performed,
)
from ros2_on_pip.launching.wrong_kind import WrongValueKind

if TYPE_CHECKING:
    from ros2_on_pip.launching.context import LaunchContext

Kind = TypeVar("Kind", bool, float)


def typed(value: Any, kind: type[Kind], what: str) -> Kind | Parts:
    """A value of this kind as it is, or what is filled in later. Raises WrongValueKind.

    As in Jazzy, a whole number is no float, and a text is no truth: `what` names the place.
    """
    if isinstance(value, kind):
        return value
    if is_substitution(value):
        return parts_of(value, what)
    raise WrongValueKind(what, kind, value)


def truth_of(context: LaunchContext, value: bool | Parts, what: str) -> bool:
    """The truth. Raises SubstitutionFailure."""
    return value if isinstance(value, bool) else yaml_truth(performed(context, value), what)


def seconds_of(context: LaunchContext, value: float | Parts, what: str) -> float:
    """The number of seconds. Raises SubstitutionFailure."""
    if isinstance(value, float):
        return value
    text = performed(context, value)
    try:
        return float(text)
    except ValueError:
        raise SubstitutionFailure(f"{what} must be seconds, and not '{text}'") from None


def yaml_truth(text: str, what: str) -> bool:
    """What YAML takes for a truth (`true`, `no`, `on`), or `1`, or `0`. Raises SubstitutionFailure.

    A condition takes other words: that is `truth`.
    """
    import yaml

    try:
        value = yaml.safe_load({"1": "true", "0": "false"}.get(text, text))
    except yaml.YAMLError:
        value = None
    if isinstance(value, bool):
        return value
    raise SubstitutionFailure(f"{what} is true or false, and not '{text}'")
