"""What one execution of a lesson was: written by the tests of lessons, read by many others."""

from __future__ import annotations

from pydantic import BaseModel


class Walk(BaseModel):
    """One execution of a lesson: down as it is, for the site too; then up, with its changes made.

    The cells of the way down know that they are on the site; those of the way up are a student's.
    """

    executed: str
    """The notebook after the way down, as JSON."""
    down: list[str]
    """What went otherwise than the lesson announces, a line each."""
    up: list[str]
