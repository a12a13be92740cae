"""A value stands where Jazzy takes another kind of value."""

from __future__ import annotations

from typing import Any

CALLED = {
    bool: "True or False",
    int: "a whole number",
    float: "a number with a point",
    str: "a text",
}


class Refused(RuntimeError):
    """Jazzy, too, refuses it with a RuntimeError when the object is made."""


class WrongKind(TypeError):
    """Something else stands where a text is needed."""

    def __init__(self, what: str, value: Any) -> None:
        super().__init__(
            f"{what} must be a text or a substitution, not {value!r}"
            f" ({type(value).__name__}).{_next_step(value)}"
        )


class WrongValueKind(TypeError):
    """Something else stands where a truth or a number is needed."""

    def __init__(self, what: str, kind: type[Any], value: Any) -> None:
        super().__init__(
            f"{what} must be {CALLED[kind]}, or a substitution, not {value!r}"
            f" ({type(value).__name__}).{_as(kind, value)}"
        )


class GivesNoText(TypeError):
    """A substitution gives something else than a text."""

    def __init__(self, what: str, value: Any) -> None:
        super().__init__(
            f"{what} gives {value!r} ({type(value).__name__}), and a text is needed. A function can"
            " make one of it: OpaqueFunction(function=...), or the function of an event handler,"
            " with str(...)"
        )


def _next_step(value: Any) -> str:
    if isinstance(value, bool | int | float):
        return f" Put it between quotes: '{value}'"
    inside = isinstance(value, list | tuple)
    return " Put a star before a list inside a list: *parts" if inside else ""


def _as(kind: type[Any], value: Any) -> str:
    """How the value is written as one of this kind, where that can be seen."""
    if kind is float and type(value) is int:
        return f" Write it with a point: {float(value)}"
    if kind is bool and str(value).lower() in ("true", "false"):
        return f" Write it without quotes: {str(value).capitalize()}"
    return ""
