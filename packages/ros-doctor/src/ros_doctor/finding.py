"""What one check found: a status, one sentence, and the mend."""

from __future__ import annotations

import enum
from dataclasses import dataclass, replace


class Status(str, enum.Enum):
    """How ill the machine is in one respect, worst first."""

    FAULT = "fault"  # something will fail until this is mended
    WARNING = "warning"  # something is likely to trip the student
    ADVICE = "advice"  # it works, and could be better
    UNKNOWN = "unknown"  # could not be looked at; the finding says why
    OK = "ok"
    NOT_APPLICABLE = "not applicable"  # this machine has no such thing; the finding says why

    @property
    def needs_a_mend(self) -> bool:
        """True where the student has something to do."""
        return self in (Status.FAULT, Status.WARNING, Status.ADVICE)


@dataclass(frozen=True)
class MendStep:
    """One step of a mend: a sentence, or a command to type, or a sentence about a command."""

    text: str = ""
    command: str = ""


@dataclass(frozen=True)
class Finding:
    """The result of one check on one machine."""

    status: Status
    found: str
    mend: tuple[MendStep, ...] = ()

    def softened(self, status: Status) -> Finding:
        """Return the same finding with another status."""
        return replace(self, status=status)


def say(text: str) -> MendStep:
    """Return a step of a mend that is a sentence."""
    return MendStep(text=text)


def do(command: str, text: str = "") -> MendStep:
    """Return a step of a mend that is a command; `text` says what it does."""
    return MendStep(text=text, command=command)


def fault(found: str, *mend: MendStep) -> Finding:
    """Something will fail until this is mended."""
    return Finding(Status.FAULT, found, mend)


def warning(found: str, *mend: MendStep) -> Finding:
    """Something is likely to trip the student."""
    return Finding(Status.WARNING, found, mend)


def advice(found: str, *mend: MendStep) -> Finding:
    """It works, and could be better."""
    return Finding(Status.ADVICE, found, mend)


def ok(found: str) -> Finding:
    """Nothing to mend."""
    return Finding(Status.OK, found)


def not_applicable(reason: str) -> Finding:
    """This machine has no such thing."""
    return Finding(Status.NOT_APPLICABLE, reason)


def unknown(reason: str, *mend: MendStep) -> Finding:
    """It could not be looked at."""
    return Finding(Status.UNKNOWN, reason, mend)
