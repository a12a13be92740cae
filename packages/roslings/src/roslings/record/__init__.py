"""Records: what is seen is written down once, and read back as it was.

This module imports nothing of ours, so that every room can speak it.
"""

from __future__ import annotations

from typing import ClassVar

from pydantic import BaseModel, ConfigDict

from roslings.record.columns import Columns as Columns


class Record(BaseModel):
    """A model that is written once, and that refuses unknown fields when it is read back.

    Numbers that JSON cannot hold become the texts NaN, Infinity and -Infinity: float() reads them.
    """

    model_config = ConfigDict(extra="forbid", ser_json_inf_nan="strings")


SMALL = ConfigDict(extra="forbid", ser_json_inf_nan="strings")
"""Of the records that there are thousands of: with slots, they take a third of a model's memory."""


class PartSeen(Record):
    """What was seen in one experiment of one kind of thing; each capability has its own.

    A change that old evidence cannot be read with raises `v`, and brings an upgrade from the
    version before.
    """

    NAME: ClassVar[str]
    """The capability's name: the key in evidence."""
    REQUESTS: ClassVar[tuple[str, ...]] = ()
    """Fields that hold what was asked of the grader: where that found no room, they lack some."""
    FOR_READERS: ClassVar[tuple[str, ...]] = ()
    """Fields that only a page shows: no check reads them."""

    v: int = 1


class UnknownPart(PartSeen):
    """A part that nobody here can read: it is kept as it is."""

    model_config = ConfigDict(extra="allow")

    NAME = "unknown"
