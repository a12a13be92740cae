"""What every fault says, and the two other answers that a check can give."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar


@dataclass(eq=False)
class Fault(Exception):
    """A failed check. Subclasses carry the numbers and write the sentences."""

    why: ClassVar[str] = ""
    was_seen: ClassVar[bool] = False
    """What is wrong was seen, not missed: it stands even where other evidence was dropped."""
    blocks: ClassVar[bool] = True
    """Nothing can be said by the checks that need this one."""
    log: tuple[str, ...] = field(default=(), kw_only=True)

    @property
    def expected(self) -> str:
        """What the contract asks for."""
        raise NotImplementedError

    @property
    def measured(self) -> str:
        """What was seen instead."""
        raise NotImplementedError

    @property
    def hint(self) -> str:
        """What to try."""
        raise NotImplementedError

    def __str__(self) -> str:
        return f"expected {self.expected}; measured {self.measured}"


class Inconclusive(Exception):
    """It cannot be told, mostly since the machine was too busy: no verdict, and the reason."""


class NothingToJudge(Exception):
    """What this check looks at is not there, and another check has already said so."""


@dataclass(eq=False)
class Unmet(Fault):
    """A bare `assert` of a grader did not hold."""

    sentence: str
    why = ""
    hint = "Read the lab's card again and compare."

    @property
    def expected(self) -> str:
        """The check's own sentence."""
        return self.sentence

    @property
    def measured(self) -> str:
        """That it does not hold."""
        return "it is not so"
