"""Calls on the page: when each was made, what came back, and how soon."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from ros2_on_pip.language import Text, counted, said
from ros2_on_pip.markup import Markup, tag
from ros2_on_pip.rates import NS_PER_S
from roslings.capabilities.services.record import CallSeen, ServicesSeen
from roslings.evidence import Evidence, ExperimentSeen
from roslings.report.html.scale import time_text
from roslings.report.html.timeline_svg import (
    Bar,
    TimelineRow,
    fields_text,
    in_experiment,
    table,
    timeline,
)

FEW = 4
"""So many calls of one kind are told one by one; of more, the slowest alone."""
MOST_ROWS = 40
HEAD = (
    Text("page.calls.service", "service"),
    Text("page.calls.after", "after"),
    Text("page.calls.asked", "asked"),
    Text("page.calls.answered", "answered"),
)


def sections(evidence: Evidence) -> Iterator[Markup]:
    """For each experiment with calls, of the grader or of a node: a timeline and a table."""
    figures = [_figure(seen) for seen in evidence.experiments.values() if _calls_of(seen)]
    if figures:
        words = "A bar goes from a request to its answer; a red one has no answer."
        note = tag("p", said("page.calls.about", words), class_="about")
        yield tag("section", tag("h2", said("page.calls", "Calls of services")), note, *figures)


def _calls_of(seen: ExperimentSeen) -> list[CallSeen]:
    part = seen.part(ServicesSeen)
    return sorted((*part.calls, *part.served), key=lambda call: call.sent_ns)


def _figure(seen: ExperimentSeen) -> Markup:
    calls = _calls_of(seen)
    groups = [(label, list(each)) for label, each in groupby(calls, key=_label)][:MOST_ROWS]
    lines = [_line(each, calls) for _, each in groups]
    rows = [row for label, each in groups for row in _rows(label, each)]
    open_ = sum(call.answered_ns is None for call in calls)
    words = _counts(len(calls), open_)
    heading = tag("h3", in_experiment(seen.name))
    return tag(
        "figure",
        heading,
        timeline(lines, words),
        tag("figcaption", words),
        table(said("page.calls.table", "calls of services"), HEAD, rows),
    )


def _counts(calls: int, without_answer: int) -> str:
    if without_answer:
        return counted(
            "page.calls.without",
            calls,
            one="{count} call, {without} without an answer.",
            other="{count} calls, {without} without an answer.",
            without=without_answer,
        )
    return counted(
        "page.calls.with",
        calls,
        one="{count} call, each with an answer.",
        other="{count} calls, each with an answer.",
    )


def _label(call: CallSeen) -> str:
    return call.service if call.part in ("", call.service) else f"{call.service}, {call.part}"


def _line(calls: Sequence[CallSeen], of: Sequence[CallSeen]) -> TimelineRow:
    began_ns = of[0].sent_ns
    ended_ns = max(call.answered_ns or call.sent_ns for call in of)
    return TimelineRow(
        calls[0].part or calls[0].service, tuple(_bar(call, began_ns, ended_ns) for call in calls)
    )


def _bar(call: CallSeen, began_ns: int, ended_ns: int) -> Bar:
    to_ns, look = call.answered_ns or ended_ns, "answered" if call.answered_ns else "missing"
    return Bar((call.sent_ns - began_ns) / NS_PER_S, (to_ns - began_ns) / NS_PER_S, look)  # type: ignore[arg-type]


def _rows(label: str, calls: Sequence[CallSeen]) -> Iterator[tuple[str, ...]]:
    if len(calls) <= FEW:
        yield from ((label, *_told(call)) for call in calls)
        return
    slowest = max(calls, key=_took_s)
    words = "{label}: {count} calls, the slowest"
    yield said("page.calls.slowest", words, label=label, count=len(calls)), *_told(slowest)


def _told(call: CallSeen) -> tuple[str, str, str]:
    if call.answered_ns is None:
        return "-", fields_text(call.request), said("page.calls.no_answer", "no answer")
    return time_text(_took_s(call)), fields_text(call.request), fields_text(call.response)


def _took_s(call: CallSeen) -> float:
    """Longer than all others where no answer came."""
    if call.answered_ns is None:
        return float("inf")
    return (call.answered_ns - call.sent_ns) / NS_PER_S
