"""What found no room in the evidence, and which checks look for it there.

A check that looks at something of which a part was dropped does not pass: that would rest on what
nobody saw. It fails where the fault was found in what was kept, else it is inconclusive.
"""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass, field
from types import new_class
from typing import Any, Literal, TypeVar

from roslings.evidence import Evidence, ExperimentSeen, Kind, ProcessSeen, TopicSeen
from roslings.judge.faults import Fault, NothingToJudge
from roslings.judge.faults.reasons import Dropped, TooMuchToKeep
from roslings.record import PartSeen

R = TypeVar("R")
WHERE: dict[Kind, tuple[str, ...]] = {
    "rosout": ("rosout",),
    "graph": ("graph",),
}
"""A kind to the fields of an experiment that hold it. Messages and topics are looked at one by one,
requests to the grader lie in the parts of capabilities.
"""
JUDGED = (type(None), Fault, AssertionError, NothingToJudge)


@dataclass(frozen=True)
class Missing:
    """Something of which a part was dropped."""

    what: Dropped
    are_lines: bool = False
    """Of what a node writes, a check asks whether something is there: found is found."""


@dataclass
class LookedAt:
    """What the check that runs now has looked at, as far as it is not whole."""

    missing: dict[Missing, None] = field(default_factory=dict)

    def begin(self) -> None:
        """The next check begins."""
        self.missing.clear()

    def outcome(self, error: BaseException | None) -> BaseException | None:
        """What came of the check, once it is known what was missing."""
        rests_on = [m for m in self.missing if error is not None or not m.are_lines]
        stands = isinstance(error, Fault) and error.was_seen
        if not rests_on or stands or not isinstance(error, JUDGED):
            return error
        return TooMuchToKeep(tuple(missing.what for missing in rests_on))


def watched(evidence: Evidence, looks: LookedAt) -> Evidence:
    """The same evidence; what is not whole in it tells `looks` when it is looked at."""
    experiments = {
        name: watched_experiment(seen, looks) for name, seen in evidence.experiments.items()
    }
    return evidence.model_copy(update={"experiments": experiments})


def watched_experiment(seen: ExperimentSeen, looks: LookedAt) -> ExperimentSeen:
    """The same of one experiment alone."""
    dropped = {each.kind: each.count for each in seen.dropped}
    missing = {
        name: Missing(Dropped(kind, dropped[kind], seen.name), kind == "rosout")
        for kind, names in WHERE.items()
        if kind in dropped
        for name in names
    }
    whole = {
        "topics": Topics(
            {name: _watched_topic(each, looks) for name, each in seen.topics.items()},
            _unheard(dropped.get("topics", 0), seen.name),
            looks,
        ),
        "processes": {name: _watched_process(each, looks) for name, each in seen.processes.items()},
        "parts": Parts(seen.parts, _unasked(dropped.get("requests", 0), seen.name), looks),
    }
    return _telling(seen.model_copy(update=whole), missing, looks)


class Parts(dict[str, PartSeen]):
    """What capabilities saw; who reads what was asked of the grader is told that some is missing.

    Also where nothing is there: then all of it had no room.
    """

    def __init__(
        self, parts: Mapping[str, PartSeen], unasked: Missing | None, looks: LookedAt
    ) -> None:
        super().__init__(parts)
        self._unasked, self._looks = unasked, looks

    def get(self, name: str, default: Any = None) -> Any:
        """As `dict.get`."""
        found = super().get(name, default)
        if found is None or not self._unasked:
            return found
        return _telling(found, dict.fromkeys(found.REQUESTS, self._unasked), self._looks)


def _unasked(count: int, experiment: str) -> Missing | None:
    return Missing(Dropped("requests", count, experiment)) if count else None


class Topics(dict[str, TopicSeen]):
    """What was heard, topic by topic; a topic that is not in it may be one of the unheard ones."""

    def __init__(
        self, topics: Mapping[str, TopicSeen], unheard: Missing | None, looks: LookedAt
    ) -> None:
        super().__init__(topics)
        self._unheard, self._looks = unheard, looks

    def get(self, name: str, default: Any = None) -> Any:
        """As `dict.get`."""
        return super().get(name, default) if name in self else default

    def __contains__(self, name: object) -> bool:
        there = super().__contains__(name)
        if not there and self._unheard:
            self._looks.missing[self._unheard] = None
        return there


def _unheard(count: int, experiment: str) -> Missing | None:
    return Missing(Dropped("topics", count, experiment)) if count else None


def _watched_topic(seen: TopicSeen, looks: LookedAt) -> TopicSeen:
    missing = {}
    if seen.not_kept or seen.cut_short:
        kind: Literal["messages", "some_messages"] = (
            "messages" if seen.not_kept else "some_messages"
        )
        missing["messages"] = Missing(Dropped(kind, seen.not_kept or 0, seen.name))
    if seen.not_read:
        content = {"content": Missing(Dropped("content", seen.not_read, seen.name))}
        messages = [_telling(m, content, looks) if m.content is None else m for m in seen.messages]
        seen = seen.model_copy(update={"messages": messages})
    return _telling(seen, missing, looks)


def _watched_process(seen: ProcessSeen, looks: LookedAt) -> ProcessSeen:
    if not seen.output_dropped_bytes:
        return seen
    what = Dropped("output", seen.output_dropped_bytes, seen.executable)
    return _telling(seen, {"lines": Missing(what, are_lines=True)}, looks)


def _telling(record: R, missing: Mapping[str, Missing], looks: LookedAt) -> R:
    """The record; who reads one of these fields of it is told of."""
    if not missing:
        return record
    kind: Any = type(record)

    def look(self: Any, name: str) -> Any:
        if name in missing:
            looks.missing[missing[name]] = None
        return kind.__getattribute__(self, name)

    told = copy(record)
    body = {"__getattribute__": look, "__slots__": (), "__module__": __name__}
    told.__class__ = new_class(kind.__name__, (kind,), exec_body=lambda names: names.update(body))
    return told
