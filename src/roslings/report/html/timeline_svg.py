"""What went to and fro as SVG: a row for each thing, a bar from question to answer, time below."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from roslings.report.html.markup import Markup, tag
from roslings.report.html.scale import Axis, unit_for

WIDTH, ROW, LABEL, FOOT = 720.0, 26.0, 190.0, 34.0
LEAST_PX = 3.0
"""A bar that is shorter would not be seen."""
ABOUT_TICKS = 6
LONGEST_LABEL = 26
LONGEST_TEXT = 90

Look = Literal["answered", "working", "missing"]


@dataclass(frozen=True)
class Bar:
    """A stretch of time, in seconds from the beginning of the picture."""

    from_s: float
    to_s: float
    look: Look = "answered"


@dataclass(frozen=True)
class Line:
    """One row: what it is about, its bars, and the moments at which something came."""

    label: str
    bars: tuple[Bar, ...] = ()
    dots_s: tuple[float, ...] = ()


def timeline(lines: Sequence[Line], words: str) -> Markup:
    """The picture of at least one line; `words` say the same to who does not see it."""
    ends = [time_s for line in lines for time_s in _times(line)]
    axis = Axis(max(ends, default=0.0) or 1.0, LABEL, WIDTH - 14.0)
    bottom = ROW * len(lines) + 8.0
    return tag(
        "svg",
        *_grid(axis, bottom),
        *(part for row, line in enumerate(lines) for part in _row(line, axis, ROW * row + ROW / 2)),
        role="img",
        aria_label=words,
        viewBox=f"0 0 {WIDTH:.0f} {bottom + FOOT:.0f}",
        class_="plot",
    )  # fmt: skip


def _times(line: Line) -> Iterator[float]:
    yield from (bar.to_s for bar in line.bars)
    yield from line.dots_s


def _grid(axis: Axis, bottom: float) -> Iterator[Markup]:
    unit = unit_for(axis.top)
    for time_s in axis.ticks(ABOUT_TICKS):
        x = axis.at(time_s)
        yield tag("line", x1=x, x2=x, y1=0.0, y2=bottom, class_="grid")
        yield tag("text", unit.number(time_s), x=x, y=bottom + 15.0, text_anchor="middle")
    yield tag("text", unit.name, x=WIDTH - 14.0, y=bottom + 30.0, text_anchor="end")


def _row(line: Line, axis: Axis, y: float) -> Iterator[Markup]:
    yield tag("text", cut(line.label, LONGEST_LABEL), x=LABEL - 10.0, y=y + 4.0, text_anchor="end")
    for bar in line.bars:
        x, end = axis.at(bar.from_s), axis.at(bar.to_s)
        yield tag("rect", x=x, y=y - 6.0, width=max(LEAST_PX, end - x), height=12.0,
                  class_=f"bar-{bar.look}")  # fmt: skip
    for time_s in line.dots_s:
        yield tag("line", x1=axis.at(time_s), x2=axis.at(time_s), y1=y, y2=y, class_="dots")


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> Markup:
    """A table whose cells break where there is little room."""
    top = tag("tr", *(tag("th", name, scope="col") for name in head))
    body = [tag("tr", *(tag("td", cell) for cell in row)) for row in rows]
    return tag("table", tag("thead", top), tag("tbody", *body), class_="exchange")


def counted(number: int, thing: str) -> str:
    """`1 call`, `2 calls`."""
    return f"{number} {thing}" if number == 1 else f"{number} {thing}s"


def fields_text(value: Any) -> str:
    """The fields of a message on one line, as far as there is room."""
    if isinstance(value, dict):
        return cut(", ".join(f"{name}: {_plain(each)}" for name, each in value.items()))
    return cut(_plain(value))


def _plain(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return f"{value:.4g}"
    return f"({fields_text(value)})" if isinstance(value, dict) else str(value)


def cut(text: str, longest: int = LONGEST_TEXT) -> str:
    """The text, or its beginning."""
    return text if len(text) <= longest else f"{text[: longest - 1]}…"
