"""What kind of word a card says, and so what proves that it is judged.

The kind stands where the word is defined, in `card.py` or in the `contract.py` of a capability:
`hz: Annotated[float, EXPECTED]`.
"""

from __future__ import annotations

from enum import Enum
from typing import TypeVar

from pydantic.fields import FieldInfo

Found = TypeVar("Found")


class Kind(Enum):
    """How a grader can show that it looks at a word."""

    EXPECTED = "expected"
    """The student's program must meet it: with another word on the card, the solution fails."""
    TOLERANCE = "tolerance"
    """How far off still counts: just outside fails, just inside passes, on both sides."""
    MOST = "at most"
    """Nothing may take longer: with next to nothing on the card, the solution fails."""
    LEAST = "at least"
    """Nothing may be smaller: with a huge number on the card, the solution fails."""
    EDGE = "edge"
    """The program itself refuses what is beyond: moved either way, the solution fails."""
    KEY = "key"
    """Expected, and what the grader itself may call the thing by: it gets the other word, too."""
    STIMULUS = "stimulus"
    """What the tool says, sets or tries: a mutant ignores it, and names the word."""
    PROMISE = "promise"
    """Says in words what the package does: `promises.yaml` names the checks that judge it."""
    PROSE = "prose"
    """For people; nothing can be judged by it."""


def kind_of(field: FieldInfo) -> Kind | None:
    """The kind of a field of a card; None where it only holds others."""
    return next((each for each in field.metadata if isinstance(each, Kind)), None)
