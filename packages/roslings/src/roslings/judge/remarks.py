"""What a check that passes says of what it saw: how long a node ran, and by which clock."""

from __future__ import annotations

from contextvars import ContextVar

from roslings.judge.faults.sentences import Text

_SAID: ContextVar[list[str] | None] = ContextVar("remarks", default=None)


def begin_remarks() -> None:
    """The next check begins: nothing is said yet."""
    _SAID.set([])


def remark(words: Text) -> None:
    """Say something of what was seen; once, however often it is said."""
    said, text = _SAID.get(), str(words)
    if said is not None and text not in said:
        said.append(text)


def remarks() -> str | None:
    """All that was said since the check began; None for nothing."""
    return "; ".join(_SAID.get() or ()) or None
