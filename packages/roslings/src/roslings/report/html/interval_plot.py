"""Period against time as SVG: each interval a dot, the asked period a band, losses marked."""

from __future__ import annotations

import statistics
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from ros2_on_pip.language import said
from ros2_on_pip.markup import Markup, joined, tag
from roslings.report.html.intervals import Interval, RequiredRate, TopicIntervals
from roslings.report.html.scale import Axis, Unit, time_text, unit_for

LEFT, RIGHT, TOP, BOTTOM = 62.0, 14.0, 26.0, 42.0
MOST_DOTS_PER_PIXEL = 0.4
ROOM_ABOVE = 1.15
USUAL, CLIP_AT_USUAL, CLIP_AT_ASKED = 0.95, 2.5, 2.0
CROSS, ARROW = 5.0, 5.0
EVEN = (
    "{count} periods of {topic}, all of {period}, as far as the steps of the simulated clock tell."
)
SPREAD = (
    "{count} periods of {topic}, the shortest {shortest}, the longest {longest}, half of them at"
    " most {half}."
)


def interval_plot(watched: TopicIntervals, width: float, height: float) -> Markup:
    """The picture for a topic with at least one interval; lengths in CSS pixels."""
    across = (
        said("page.plot.simulated", "simulated seconds since the first message")
        if watched.experiment.clock == "sim"
        else said("page.plot.real", "seconds since the first message")
    )
    plot = _Plot(watched.intervals, watched.asked, across, width, height)
    return tag(
        "svg",
        *plot.parts(),
        role="img",
        aria_label=describe(watched),
        viewBox=f"0 0 {width:g} {height:g}",
        width=width,
        height=height,
        class_="plot",
    )


def describe(watched: TopicIntervals) -> str:
    """The plot in sentences: its text alternative."""
    periods_s = sorted(each.period_s for each in watched.intervals)
    name = watched.seen.name
    count = len(periods_s)
    times = {"shortest": time_text(periods_s[0]), "longest": time_text(periods_s[-1])}
    half = time_text(statistics.median(periods_s))
    asked = "The lab asks for {period}."
    sentences = [
        said("page.plot.even", EVEN, count=count, topic=name, period=times["shortest"])
        if watched.within_steps
        else said("page.plot.spread", SPREAD, count=count, topic=name, half=half, **times),
        said("page.plot.asked", asked, period=_asked_words(watched.asked)) if watched.asked else "",
        _lost_words(sum(each.lost for each in watched.intervals)),
    ]
    return " ".join(filter(None, sentences))


def _lost_words(lost: int) -> str:
    if not lost:
        return said("page.plot.none_lost", "No message was lost.")
    return said("page.plot.lost", "{count} messages were lost.", count=lost)


def _asked_words(asked: RequiredRate) -> str:
    """The asked period and its limits."""
    unit = unit_for(1 / asked.hz)
    low, high = unit.number(1 / asked.high_hz), unit.number(1 / asked.low_hz)
    between = "{period} ({low} to {high} {unit})"
    period = unit.text(1 / asked.hz)
    return said("page.plot.between", between, period=period, low=low, high=high, unit=unit.name)


def _top_s(intervals: Sequence[Interval], asked: RequiredRate | None) -> float:
    """The longest period on the paper. A rare long one does not press all else flat."""
    periods_s = sorted(each.period_s for each in intervals)
    usual_s = periods_s[int(USUAL * (len(periods_s) - 1))]
    asked_s = 1 / asked.low_hz if asked else 0.0
    clip_s = max(CLIP_AT_USUAL * usual_s, CLIP_AT_ASKED * asked_s)
    return max(ROOM_ABOVE * max(min(periods_s[-1], clip_s), asked_s), 1e-9)


@dataclass(frozen=True)
class _Plot:
    intervals: Sequence[Interval]
    asked: RequiredRate | None
    across_name: str
    width: float
    height: float

    @cached_property
    def across(self) -> Axis:
        """Seconds since the first message."""
        last_s = max(each.end_s for each in self.intervals)
        return Axis(max(last_s, 1e-9), LEFT, self.width - RIGHT)

    @cached_property
    def upwards(self) -> Axis:
        """The period."""
        return Axis(_top_s(self.intervals, self.asked), self.height - BOTTOM, TOP)

    @cached_property
    def unit(self) -> Unit:
        return unit_for(self.upwards.top)

    def parts(self) -> Iterator[Markup]:
        """All that is drawn, the ground first."""
        yield from self._band()
        yield from self._frame()
        yield from self._losses()
        yield from self._periods()
        yield from self._beyond()

    def _band(self) -> Iterator[Markup]:
        if self.asked:
            top = self.upwards.at(1 / self.asked.low_hz)
            bottom = self.upwards.at(1 / self.asked.high_hz)
            wide = self.across.end - LEFT
            yield tag("rect", x=LEFT, y=top, width=wide, height=bottom - top, class_="band")
            yield self._level(self.upwards.at(1 / self.asked.hz), "asked")

    def _level(self, y: float, kind: str) -> Markup:
        return tag("line", x1=LEFT, x2=self.across.end, y1=y, y2=y, class_=kind)

    def _frame(self) -> Iterator[Markup]:
        foot = self.upwards.start
        for value in self.upwards.ticks(5):
            y = self.upwards.at(value)
            yield self._level(y, "grid")
            yield _text(self.unit.number(value), LEFT - 8, y + 4, "end")
        for value in self.across.ticks(8 if self.width > 500 else 5):
            x = self.across.at(value)
            yield tag("line", x1=x, x2=x, y1=foot, y2=foot + 5, class_="axis")
            yield _text(f"{value:g}", x, foot + 18, "middle")
        yield self._level(foot, "axis")
        yield _text(
            said("page.plot.period", "period ({unit})", unit=self.unit.name), 4, 13, "start"
        )
        yield _text(self.across_name, self.across.end, foot + 36, "end")

    def _losses(self) -> Iterator[Markup]:
        lossy = [self.across.at(each.end_s) for each in self.intervals if each.lost]
        if lossy:
            foot, y = self.upwards.start, TOP - CROSS
            yield _path((f"M{x:.1f} {TOP}V{foot:g}" for x in lossy), "gap")
            yield _path((_cross(x, y) for x in lossy), "lost")

    def _periods(self) -> Iterator[Markup]:
        points = [
            (self.across.at(each.end_s), self.upwards.at(each.period_s)) for each in self.intervals
        ]
        if len(points) <= MOST_DOTS_PER_PIXEL * self.width:
            yield _path([_line(points)], "trace")
            yield _path((f"M{x:.1f} {y:.1f}h0" for x, y in points if y > TOP), "dots")
        else:
            yield _path(_columns(points), "columns")

    def _beyond(self) -> Iterator[Markup]:
        """An arrow for each period that is longer than the paper is high."""
        too_long = [
            self.across.at(each.end_s)
            for each in self.intervals
            if each.period_s > self.upwards.top
        ]
        if too_long:
            yield _path((_arrow(x, TOP) for x in too_long), "beyond")


def _text(text: str, x: float, y: float, anchor: str) -> Markup:
    return tag("text", text, x=float(x), y=float(y), text_anchor=anchor)


def _path(pieces: Iterable[str], kind: str) -> Markup:
    return tag("path", d="".join(pieces), class_=kind)


def _line(points: Sequence[tuple[float, float]]) -> str:
    return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)


def _columns(points: Sequence[tuple[float, float]]) -> Iterator[str]:
    """For each pixel column one stroke from the shortest period to the longest."""
    reach: dict[int, tuple[float, float]] = {}
    for x, y in points:
        low, high = reach.get(round(x), (y, y))
        reach[round(x)] = min(low, y), max(high, y)
    return (f"M{x} {low - 1.5:.1f}V{high + 1.5:.1f}" for x, (low, high) in reach.items())


def _cross(x: float, y: float) -> str:
    left, top, reach = x - CROSS, y - CROSS, 2 * CROSS
    return f"M{left:.1f} {top:.1f}l{reach:g} {reach:g}m0 {-reach:g}l{-reach:g} {reach:g}"


def _arrow(x: float, y: float) -> str:
    return f"M{x:.1f} {y:.1f}l{-ARROW:g} {1.6 * ARROW:g}h{2 * ARROW:g}z"


def legend(watched: TopicIntervals) -> Markup:
    """What the marks mean: only those that are there."""
    keys = [_key("dots", said("page.key.dots", "one period: from a message to the next"))]
    if watched.asked:
        asked = said("page.key.band", "asked: {period}", period=_asked_words(watched.asked))
        keys.append(_key("band", asked))
    if any(each.lost for each in watched.intervals):
        keys.append(_key("lost", said("page.key.lost", "messages lost on the way, not slowness")))
    longest_s = max(each.period_s for each in watched.intervals)
    if longest_s > _top_s(watched.intervals, watched.asked):
        beyond = "longer than the paper is high: up to {time}"
        keys.append(_key("beyond", said("page.key.beyond", beyond, time=time_text(longest_s))))
    return tag("ul", *keys, class_="legend")


_MARKS = {
    "dots": tag("path", d="M9 6h0", class_="dots"),
    "band": joined(
        tag("rect", x=0.0, y=1.0, width=18.0, height=10.0, class_="band"),
        tag("line", x1=0.0, x2=18.0, y1=6.0, y2=6.0, class_="asked"),
    ),
    "lost": tag("path", d="M4 1l10 10m0 -10l-10 10", class_="lost"),
    "beyond": tag("path", d=_arrow(9, 2), class_="beyond"),
}


def _key(kind: str, words: str) -> Markup:
    mark = tag(
        "svg", _MARKS[kind], width=18.0, height=12.0, viewBox="0 0 18 12", aria_hidden="true"
    )
    return tag("li", mark, " ", words)
