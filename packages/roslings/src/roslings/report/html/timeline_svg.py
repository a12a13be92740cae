"""What went to and fro as SVG: a row for each thing, a bar from question to answer, time below."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from ros2_on_pip.language import Text, said
from ros2_on_pip.markup import Markup, joined, tag
from roslings.report.html.scale import Axis, unit_for

ROW, FOOT, MARGIN = 26.0, 34.0, 14.0
LEAST_PX = 3.0
"""A bar that is shorter would not be seen."""
LONGEST_TEXT = 90

PER_TICK_PX, PER_LETTER_PX = 80.0, 7.8
SCREENS = {"wide": (720.0, 190.0), "narrow": (340.0, 110.0)}
"""How wide the paper is, and how much of it is for what stands before a row."""

Look = Literal["answered", "working", "missing"]


@dataclass(frozen=True)
class Bar:
    """A stretch of time, in seconds from the beginning of the picture."""

    from_s: float
    to_s: float
    look: Look = "answered"


@dataclass(frozen=True)
class TimelineRow:
    """One row: what it is about, its bars, and the moments at which something came."""

    label: str
    bars: tuple[Bar, ...] = ()
    dots_s: tuple[float, ...] = ()


def timeline(lines: Sequence[TimelineRow], words: str) -> Markup:
    """The picture of at least one line, for wide and narrow screens.

    `words` say the same to who does not see it.
    """
    return joined(
        *(
            tag("div", _Paper(width, label, _last_s(lines)).picture(lines, words), class_=screen)
            for screen, (width, label) in SCREENS.items()
        )
    )


def _last_s(lines: Sequence[TimelineRow]) -> float:
    bars = (bar.to_s for line in lines for bar in line.bars)
    return max((*bars, *(time_s for line in lines for time_s in line.dots_s)), default=0.0) or 1.0


class _Paper:
    """One size of the picture."""

    def __init__(self, width: float, label: float, last_s: float) -> None:
        self.width, self.label = width, label
        self.axis = Axis(last_s, label, width - MARGIN)

    def picture(self, lines: Sequence[TimelineRow], words: str) -> Markup:
        bottom = ROW * len(lines) + 8.0
        rows = (self._row(line, ROW * row + ROW / 2) for row, line in enumerate(lines))
        return tag(
            "svg",
            *self._grid(bottom),
            *(part for row in rows for part in row),
            role="img",
            aria_label=words,
            viewBox=f"0 0 {self.width:.0f} {bottom + FOOT:.0f}",
            class_="plot",
        )

    def _grid(self, bottom: float) -> Iterator[Markup]:
        unit = unit_for(self.axis.top)
        for time_s in self.axis.ticks(int((self.width - self.label) / PER_TICK_PX)):
            x = self.axis.at(time_s)
            yield tag("line", x1=x, x2=x, y1=0.0, y2=bottom, class_="grid")
            yield tag("text", unit.number(time_s), x=x, y=bottom + 15.0, text_anchor="middle")
        yield tag("text", unit.name, x=self.width - MARGIN, y=bottom + 30.0, text_anchor="end")

    def _row(self, line: TimelineRow, y: float) -> Iterator[Markup]:
        label = cut(line.label, int(self.label / PER_LETTER_PX))
        yield tag("text", label, x=self.label - 10.0, y=y + 4.0, text_anchor="end")
        for bar in line.bars:
            x, end = self.axis.at(bar.from_s), self.axis.at(bar.to_s)
            yield tag(
                "rect",
                x=x,
                y=y - 6.0,
                width=max(LEAST_PX, end - x),
                height=12.0,
                class_=f"bar-{bar.look}",
            )
        for time_s in line.dots_s:
            x = self.axis.at(time_s)
            yield tag("line", x1=x, x2=x, y1=y, y2=y, class_="dots")


def table(name: str, head: Sequence[Text], rows: Sequence[Sequence[str]]) -> Markup:
    """A table whose cells break; where there is too little room for that, it scrolls by itself."""
    top = tag("tr", *(tag("th", str(title), scope="col") for title in head))
    body = [tag("tr", *(tag("td", cell) for cell in row)) for row in rows]
    whole = tag("table", tag("thead", top), tag("tbody", *body), class_="exchange")
    return tag("div", whole, class_="scroll", tabindex="0", role="group", aria_label=name)


def in_experiment(name: str) -> str:
    """The title of what an experiment saw."""
    return said("page.in", "in {experiment}", experiment=name)


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
