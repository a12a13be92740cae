"""What a card says about a serial port."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from roslings.capability import Words
from roslings.course.contract import CardWords, Prose


class SerialWords(CardWords):
    """What a card may say of the package."""

    board: Annotated[bool, Prose] = Field(
        default=False, description="A node talks to a board on a serial port"
    )


WORDS = Words(card=SerialWords)
