"""A value that is no text stands where a text is needed."""

from __future__ import annotations

from typing import Any


class WrongKind(TypeError):
    """Something else stands where a text is needed."""

    def __init__(self, what: str, value: Any) -> None:
        super().__init__(
            f"{what} must be a text or a substitution, not {value!r}"
            f" ({type(value).__name__}).{_next_step(value)}"
        )


def _next_step(value: Any) -> str:
    return f" Put it between quotes: '{value}'" if isinstance(value, bool | int | float) else ""
