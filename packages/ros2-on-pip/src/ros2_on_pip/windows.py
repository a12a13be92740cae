"""Windows that books name, where the real ones are missing: another package may open one instead.

It offers them by the entry point group `ros2_on_pip.windows`: a mapping of names (`rqt_plot`) to
what opens. Without one there is the answer of `absent.py` and `well_known.py`.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from importlib.metadata import entry_points
from typing import Protocol

from ros2_on_pip.unbuilt import advice

GROUP = "ros2_on_pip.windows"


class WindowReplacement(Protocol):
    """What opens in place of a window."""

    @property
    def is_here(self) -> bool:
        """Whether all that it needs is installed."""

    @property
    def command(self) -> str:
        """What a person types to install and open it; empty where that cannot be said."""

    def open(self, argv: Sequence[str]) -> int:
        """Stay until it is closed; the exit code. Raises CommandProblem."""


@cache
def _offered() -> dict[str, WindowReplacement]:
    found: dict[str, WindowReplacement] = {}
    for point in entry_points(group=GROUP):
        found = {**point.load(), **found}
    return found


def window_of(name: str) -> WindowReplacement | None:
    """What opens here in place of `name`; None where it is not installed, or is one's own."""
    window = _offered().get(name)
    return window if window and window.is_here and not advice(name) else None


def command_for(name: str) -> str:
    """A line that names the window which could be here; empty where none is offered."""
    window = _offered().get(name)
    return f"In your browser: {window.command}" if window and window.command else ""
