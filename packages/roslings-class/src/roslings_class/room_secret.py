"""The rooms of a class: secret ones, the same for all, or for each student others.

The text that they are drawn from is kept in the gradebook. So those who were late drive in the same
rooms as the others.
"""

from __future__ import annotations

import os
import secrets
from collections.abc import Mapping
from typing import Literal

from pydantic import BaseModel, ConfigDict

from roslings.capabilities.rooms.chosen import LabHasNoRooms, rooms_of
from roslings.capabilities.rooms.seeds import SECRET
from roslings.course import Lab
from roslings_class.errors import BatchError
from roslings_class.gradebook import Gradebook

Whose = Literal["same", "each"]
FACT = "room_secret"
"""A fact about the whole gradebook."""


class OtherRooms(BatchError):
    """The gradebook has verdicts of other rooms."""

    def __init__(self, what: str, was: str) -> None:
        super().__init__(
            f"The verdicts in this gradebook come from other rooms: {what}.",
            f"Type the same command {was}, or grade into a new folder: --out DIR",
        )


class RoomSecret(BaseModel):
    """A text that nobody else has, and whether each student has rooms of their own."""

    model_config = ConfigDict(frozen=True)

    text: str
    whose: Whose = "same"

    def of(self, submission: str) -> str:
        """What this submission's rooms are drawn from."""
        return self.text if self.whose == "same" else f"{self.text}/{submission}"


def insist_on_rooms(lab: Lab, whose: Whose | None) -> None:
    """Rooms are asked for where there are some. Raises LabHasNoRooms."""
    if whose and not rooms_of(lab):
        raise LabHasNoRooms(lab.name, "--rooms")


def room_secret(
    lab: Lab, book: Gradebook, whose: Whose | None, variables: Mapping[str, str] = os.environ
) -> RoomSecret | None:
    """The gradebook's, made where it has none yet; None for a lab that drives in no rooms.

    ROSLINGS_ROOM_SECRET is taken where it is set. Raises OtherRooms.
    """
    if not any(each.secret for each in rooms_of(lab)):
        return None
    given, kept = variables.get(SECRET, ""), book.about(FACT)
    if kept is None:
        made = RoomSecret(text=given or secrets.token_hex(16), whose=whose or "same")
        book.note(FACT, made.model_dump_json())
        return made
    return _the_same(RoomSecret.model_validate_json(kept), given, whose)


def _the_same(kept: RoomSecret, given: str, whose: Whose | None) -> RoomSecret:
    """What is asked for is what was. Raises OtherRooms."""
    if whose and whose != kept.whose:
        raise OtherRooms(f"--rooms {kept.whose}", f"with --rooms {kept.whose}")
    if given and given != kept.text:
        raise OtherRooms(f"{SECRET} was another text", f"without {SECRET}")
    return kept
