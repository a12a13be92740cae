"""Whether strangers' code can be kept away from the rest of this machine."""

from __future__ import annotations


def sandbox_missing() -> str | None:
    """Why there is no sandbox here; None where there is one."""
    return "this installation of roslings has no sandbox"
