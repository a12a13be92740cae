"""Stops on the page: when there was a reason, when the motors ran, and how soon they stood."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from graders.e_stop.faults import in_words
from graders.e_stop.record import EStopSeen, HostsSeen, MoveSeen, StopSeen
from ros2_on_pip.language import Text, counted, said
from ros2_on_pip.markup import Markup, tag
from ros2_on_pip.rates import NS_PER_S
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

LONGEST_PAUSE_NS = 300_000_000
"""Motors that hear nothing for longer are not shown as running."""

STOPS_HEAD = (
    Text("page.stops.after", "after"),
    Text("page.stops.last", "the last command that moves"),
    Text("page.stops.then", "and then"),
)


def sections(evidence: Evidence) -> Iterator[Markup]:
    """For each experiment with stops, a timeline and a table; the link."""
    seen = list(evidence.experiments.values())
    figures = [_figure(each) for each in seen if each.part(EStopSeen).stops]
    if figures:
        words = "A red bar is a reason to stop, the other bars are commands that move the motors."
        note = tag("p", said("page.stops.about", words), class_="about")
        yield tag("section", tag("h2", said("page.stops", "Stops")), note, *figures)
    for each in seen:
        if hosts := each.part(EStopSeen).hosts:
            title = said("page.hosts", "Two computers")
            yield tag("section", tag("h2", title), tag("p", _link(hosts)))


def _figure(seen: ExperimentSeen) -> Markup:
    part = seen.part(EStopSeen)
    began_ns = min((part.stops[0].began_ns, *(move.at_ns for move in part.moves[:1])))
    lines = [
        TimelineRow(
            said("page.stops.reasons", "reasons"),
            tuple(_bar(began_ns, each.began_ns, each.until_ns) for each in part.stops),
        ),
        TimelineRow(said("page.stops.motors", "motors"), tuple(_running(part.moves, began_ns))),
    ]
    words = counted(
        "page.stops.count",
        len(part.stops),
        one="{count} reason to stop.",
        other="{count} reasons to stop.",
    )
    rows = [_row(stop, part.moves) for stop in part.stops]
    return tag(
        "figure",
        tag("h3", in_experiment(seen.name)),
        timeline(lines, words),
        tag("figcaption", words),
        table(said("page.stops.table", "stops"), STOPS_HEAD, rows),
    )


def _bar(began_ns: int, from_ns: int, to_ns: int) -> Bar:
    return Bar((from_ns - began_ns) / NS_PER_S, (to_ns - began_ns) / NS_PER_S, "missing")


def _running(moves: Sequence[MoveSeen], began_ns: int) -> Iterator[Bar]:
    """A bar for each stretch of commands that move."""
    stretch: list[int] = []
    for move in moves:
        ends = not move.fields or (stretch and move.at_ns - stretch[-1] > LONGEST_PAUSE_NS)
        if ends and stretch:
            yield _stretch(stretch, began_ns)
            stretch = []
        if move.fields:
            stretch.append(move.at_ns)
    if stretch:
        yield _stretch(stretch, began_ns)


def _stretch(at_ns: Sequence[int], began_ns: int) -> Bar:
    return Bar((at_ns[0] - began_ns) / NS_PER_S, (at_ns[-1] - began_ns) / NS_PER_S)


def _row(stop: StopSeen, moves: Sequence[MoveSeen]) -> tuple[str, str, str]:
    inside = [move for move in moves if stop.began_ns < move.at_ns <= stop.until_ns]
    moving = [move.at_ns for move in inside if move.fields]
    last = said("page.stops.none", "none")
    if moving:
        later_s = (moving[-1] - stop.began_ns) / NS_PER_S
        last = said("page.stops.later", "{time} later", time=time_text(later_s))
    cause = str(in_words(stop.cause))
    if not inside:
        return cause, last, said("page.stops.nothing", "nothing came")
    zero = said("page.stops.zero", "zero")
    return cause, last, fields_text(inside[-1].fields) if inside[-1].fields else zero


def _link(hosts: HostsSeen) -> str:
    if hosts.refused:
        return said("page.hosts.refused", "Not played: {why}.", why=hosts.refused)
    counts = hosts.packets
    return counted(
        "page.hosts.link",
        counts.get("passed", 0),
        one="The link passed {count} packet, lost {lost}, took {cut} while it was cut, and stopped"
        " {multicast} of multicast.",
        other="The link passed {count} packets, lost {lost}, took {cut} while it was cut, and"
        " stopped {multicast} of multicast.",
        lost=counts.get("lost", 0),
        cut=counts.get("cut", 0),
        multicast=counts.get("multicast", 0),
    )
