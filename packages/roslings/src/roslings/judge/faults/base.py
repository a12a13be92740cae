"""What every fault says, and the two other answers that a check can give."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, ClassVar, TypeVar

from roslings.judge.faults.sentences import Plain, Told

SENTENCES = ("expected", "measured", "headline", "why", "hint", "mend")


@dataclass(eq=False)
class Fault(Told, Exception):
    """A failed check. Subclasses carry the numbers, and have the sentences as templates.

        expected = "a node that serves {service}"

    A sentence in which there is something to decide is `one_of` several whole templates, and one
    that counts something a `plural`; see `sentences.py`. What a template names in braces is a
    field or a property. A brace itself is written twice.
    """

    ROOM: ClassVar[str] = "faults"
    SENTENCES: ClassVar[tuple[str, ...]] = SENTENCES
    why: ClassVar[str] = ""
    was_seen: ClassVar[bool] = False
    """What is wrong was seen, not missed: it stands even where other evidence was dropped."""
    blocks: ClassVar[bool] = True
    """Nothing can be said by the checks that need this one."""
    earned = 0.0
    """The share of the check's points that is given all the same: below 1. A demand sets it."""
    UNTOLD: ClassVar[tuple[str, ...]] = ("log",)
    """Fields that no verdict has among its fields: it has the log beside them, and a student may
    have to find out the others."""
    log: tuple[str, ...] = field(default=(), kw_only=True)

    def __init_subclass__(cls) -> None:
        """Who has a hint of its own has no mend of another class."""
        super().__init_subclass__()
        if "hint" in vars(cls) and "mend" not in vars(cls):
            setattr(cls, "mend", Plain(""))  # noqa: B010 - the class above has its own hint

    @property
    def expected(self) -> str:
        """What the contract asks for."""
        raise NotImplementedError

    @property
    def measured(self) -> str:
        """What was seen instead."""
        raise NotImplementedError

    @property
    def headline(self) -> str:
        """What was measured, in a line that stands alone: it names what it speaks of."""
        return self.measured

    @property
    def hint(self) -> str:
        """Where to look. It names what is wrong, and not the mend: who finds that has learnt it."""
        raise NotImplementedError

    @property
    def mend(self) -> str:
        """What mends it, told with the last hint; empty where the hint is all that can be said."""
        return ""

    def __str__(self) -> str:
        return f"expected {self.expected}; measured {self.measured}"

    def __reduce__(self) -> tuple[Any, ...]:
        """With all of its fields, whichever way they were given."""
        return _again, (type(self), dict(vars(self)), self.args)


E = TypeVar("E", bound=Exception)


def _again(kind: type[E], fields: dict[str, Any], args: tuple[Any, ...]) -> E:
    error = kind.__new__(kind, *args)
    vars(error).update(fields)
    return error


class Reason(Told, Exception):
    """Why a check says neither yes nor no: in a template of its class, or in what it was given."""

    ROOM: ClassVar[str] = "reasons"

    @property
    def text(self) -> str:
        """The words it was given."""
        return " ".join(map(str, self.args))

    def __str__(self) -> str:
        return self.text

    def __reduce__(self) -> tuple[Any, ...]:
        """With all of its fields, whichever way they were given."""
        return _again, (type(self), dict(vars(self)), self.args)


class Inconclusive(Reason):
    """It cannot be told, mostly since the machine was too busy: no verdict, and the reason."""


class NothingToJudge(Reason):
    """What this check looks at is not there, and another check has already said so."""


@dataclass(eq=False)
class Unmet(Fault):
    """A bare `assert` of a grader did not hold."""

    NO_MESSAGE: ClassVar[str] = "it is not so"

    sentence: str
    message: str = NO_MESSAGE
    """What the grader wrote behind the `assert`."""
    why = ""
    hint = "Read the lab's card again and compare."
    expected = "{sentence}"
    measured = "{message}"
