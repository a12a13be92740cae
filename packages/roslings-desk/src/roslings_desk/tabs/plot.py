"""Plot: numbers of any topics over the last seconds, as curves and as a table."""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from nicegui import ui

from ros2_on_pip.field_types import FLOATS, INTEGERS, read_type
from ros2_on_pip.interfaces import class_of
from ros2_on_pip.problem import CommandProblem
from roslings_desk.controls import (
    Notice,
    PageText,
    SelectField,
    StatusLine,
    TextField,
    button,
    part,
    problem_of,
    tell,
    told,
)
from roslings_desk.hub import SharedSubscription
from roslings_desk.tab import OpenTab

SHOWN_S = 20.0
MOST_POINTS = 2_000
MOST_CURVES = 6
MOST_ELEMENTS = 16
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8a6d00", "#56606b")
"""They stay apart for those who see fewer colours; each curve has a dash of its own, too."""
DASHES: tuple[Any, ...] = ("solid", "dashed", "dotted", [12, 4, 2, 4], [2, 2], [16, 6])
GREY = {"color": "#7d8791"}
"""It is read on a light page and on a dark one."""
AXIS = {
    "axisLabel": GREY,
    "axisLine": {"onZero": False, "lineStyle": GREY},
    "splitLine": {"lineStyle": {"color": "rgba(125, 135, 145, 0.3)"}},
}
COLUMNS = ("Curve", "Newest", "Least", "Most", "Messages/s", "Not drawn")


class NoNumber(CommandProblem):
    """The field is no number."""

    def __init__(self, path: str, type_name: str) -> None:
        super().__init__(
            f"{type_name} has no number at '{path}'. Choose a field of the list; an element of a"
            " list is written as ranges[0]."
        )


class NoTopicToPlot(CommandProblem):
    """None was chosen, or nobody has it any more."""

    def __init__(self) -> None:
        super().__init__("Choose a topic first: one that a node has now.")


class TooMany(CommandProblem):
    """No more curves."""

    def __init__(self) -> None:
        super().__init__(f"{MOST_CURVES} curves are drawn at most. Take one away first.")


@dataclass
class Curve:
    """One field of a topic, and its points: seconds by the desk's clock, value."""

    heard: SharedSubscription
    path: str
    points: deque[tuple[float, float]] = field(default_factory=lambda: deque(maxlen=MOST_POINTS))
    seen: int = 0
    missed: int = 0
    """Messages that came faster than they could be read, or were before this curve."""
    not_finite: int = 0

    @property
    def name(self) -> str:
        """Topic and field."""
        return f"{self.heard.topic} {self.path}"

    def read(self) -> None:
        """Take in what has come. NaN and infinite values are counted, and break the curve."""
        for message in self.heard.after(self.seen):
            self.missed += message.number - self.seen - 1
            self.seen = message.number
            value = number_at(self.heard.read(message), self.path)
            if value is None or not math.isfinite(value):
                self.not_finite += 1
                value = math.nan
            self.points.append((message.came_s, value))
        self._forget(time.monotonic() - SHOWN_S)

    def _forget(self, before_s: float) -> None:
        while self.points and self.points[0][0] < before_s:
            self.points.popleft()

    def finite(self) -> list[float]:
        """The values that are drawn."""
        return [value for _, value in self.points if math.isfinite(value)]

    def row(self) -> tuple[str, ...]:
        """What the table says of it."""
        values = self.finite()
        numbers = (values[-1], min(values), max(values)) if values else (math.nan,) * 3
        said = tuple("-" if math.isnan(each) else f"{each:.4g}" for each in numbers)
        return (self.name, *said, f"{self.heard.per_second()[0]:.1f}", _not_drawn(self))


class PlotTab:
    """Curves of what was chosen; a table says the same in numbers."""

    title, every_s = "Plot", 0.1

    def __init__(self) -> None:
        self._curves: list[Curve] = []
        self._awaited: list[str] = []
        self._paused = False

    def show(self, open_tab: OpenTab) -> None:
        """What to choose, the curves, the table."""
        self._open = open_tab
        with part("div", "row"):
            self._topic = SelectField("Topic")
            self._field = SelectField("Field")
            self._other = TextField("Or type a field", placeholder="ranges[0]")
            self._trouble = Notice()
        self._topic.on_change(self._offer_fields)
        with part("div", "row"):
            button("Add the curve", told(self._trouble, self._add))
            self._pause = button("Pause", self._turn, aria_pressed="false")
            button("Take all away", self._clear)
            button("Say the values", self._say)
        self._waiting = PageText("p", "", "hint")
        self._awaited = [each for word in open_tab.shown for each in curves_in(word)]
        self._spoken = StatusLine()
        self._chart = ui.echart(_options([])).classes("curves")
        self._chart.props["role"] = "img"
        self._chart.props["aria-label"] = "The curves. The table below has their numbers."
        with part("div", "scroll", role="region", tabindex=0, aria_label="The curves in numbers"):
            self._table = part("table")
        self._rows: list[list[PageText]] = []
        self._show_rows()

    # --- choosing --------------------------------------------------------------------------

    def _offer_fields(self) -> None:
        cls = self._class_of_topic()
        self._field.value = ""
        self._field.offer(numbers_in(cls()) if cls else ())

    def _class_of_topic(self) -> Any | None:
        """None where it is not there any more; the trouble is said."""
        found: list[Any] = []

        def look() -> None:
            if type_name := self._open.hub.type_of(self._topic.value):
                found.append(class_of(type_name, "msg"))

        tell(self._trouble, look)
        return found[0] if found else None

    def _add(self) -> None:
        """Raises NoTopicToPlot, NoNumber, TooMany, SeveralTypes, UnknownInterface."""
        topic, path = self._topic.value, self._other.value.strip() or self._field.value
        self._add_curve(topic, path)

    def _add_curve(self, topic: str, path: str) -> None:
        type_name = self._open.hub.type_of(topic)
        if not type_name:
            raise NoTopicToPlot
        if number_at(class_of(type_name, "msg")(), path, only_type=True) is None:
            raise NoNumber(path, type_name)
        if len(self._curves) >= MOST_CURVES:
            raise TooMany
        heard = self._open.hear(topic, type_name)
        self._curves.append(Curve(heard, path, seen=heard.count))
        self._show_rows()

    def _add_awaited(self, there: Sequence[str]) -> None:
        """What was typed behind the tab's name, as soon as a node has the topic."""
        for word in list(self._awaited):
            if found := topic_and_path(word, there):
                self._awaited.remove(word)
                if problem := problem_of(partial(self._add_named, *found)):
                    self._trouble.say(problem)
        waiting = f"No node has such a topic yet: {', '.join(self._awaited)}"
        self._waiting.say(waiting if self._awaited else "")

    def _add_named(self, topic: str, path: str) -> None:
        """A topic alone means its first number, as `/level` of a Float64 is its data."""
        type_name = self._open.hub.type_of(topic)
        if type_name and not path:
            path = next(numbers_in(class_of(type_name, "msg")()), "")
        self._add_curve(topic, path)

    def _clear(self) -> None:
        self._curves.clear()
        self._awaited.clear()
        self._open.leave_all()
        self._show_rows()
        self._draw()

    def _turn(self) -> None:
        self._paused = not self._paused
        self._pause.props["aria-pressed"] = str(self._paused).lower()
        self._pause.update()

    def _say(self) -> None:
        values = [(curve.name, curve.row()[1]) for curve in self._curves]
        said = "; ".join(f"{name}: {value}" for name, value in values)
        self._spoken.say(said or "There is no curve yet.")

    # --- drawing ---------------------------------------------------------------------------

    def refresh(self) -> None:
        """Draw what has come, unless it is paused."""
        there = [seen.name for seen in self._open.hub.topics()]
        self._topic.offer(there)
        self._add_awaited(there)
        for curve in self._curves:
            curve.read()
        if self._curves and not self._paused:
            self._draw()
            for row, curve in zip(self._rows, self._curves, strict=True):
                for cell, words in zip(row, curve.row(), strict=True):
                    cell.say(words)

    def _draw(self) -> None:
        now_s = time.monotonic()
        self._chart.run_chart_method(
            "setOption", _options(self._curves, now_s), {"replaceMerge": ["series"]}
        )

    def _show_rows(self) -> None:
        self._table.clear()
        with self._table:
            with part("thead"), part("tr"):
                for word in COLUMNS:
                    PageText("th", word, scope="col")
            with part("tbody"):
                self._rows = [_row_of(curve) for curve in self._curves]


def _row_of(curve: Curve) -> list[PageText]:
    with part("tr"):
        return [PageText("td", words) for words in curve.row()]


def _not_drawn(curve: Curve) -> str:
    said = [f"{curve.missed} too fast"] if curve.missed else []
    said += [f"{curve.not_finite} not finite"] if curve.not_finite else []
    return ", ".join(said) or "0"


def _options(curves: list[Curve], now_s: float = 0.0) -> dict[str, Any]:
    """Of ECharts: the time in seconds before now; a gap where a value is not finite."""
    return {
        "animation": False,
        "grid": {"left": 60, "right": 20, "top": 40, "bottom": 70},
        "legend": {"top": 0, "type": "scroll", "textStyle": GREY},
        "xAxis": {
            "type": "value",
            "min": -SHOWN_S,
            "max": 0,
            "name": "seconds before now",
            "nameLocation": "middle",
            "nameGap": 24,
            "nameTextStyle": GREY,
            **AXIS,
        },
        "yAxis": {"type": "value", "scale": True, **AXIS},
        "dataZoom": [{"type": "inside"}, {"type": "slider", "height": 20, "bottom": 10}],
        "color": list(COLOURS),
        "series": [
            {
                "name": curve.name,
                "type": "line",
                "showSymbol": False,
                "lineStyle": {"type": dash, "width": 2},
                "data": [
                    [round(at_s - now_s, 3), None if math.isnan(value) else value]
                    for at_s, value in curve.points
                ],
            }
            for curve, dash in zip(curves, DASHES, strict=False)
        ],
    }


# --- fields ------------------------------------------------------------------------------------


def curves_in(word: str) -> list[str]:
    """One word of `rqt_plot` may name several fields: `/pose/x:y` is `/pose/x` and `/pose/y`."""
    place, _, fields = f"/{word.strip('/')}".rpartition("/")
    return [f"{place}/{each}" for each in fields.split(":") if each]


def topic_and_path(word: str, there: Iterable[str]) -> tuple[str, str] | None:
    """`/odom/twist/linear/x` as a topic that is there and the path of a field; None without one."""
    topics = [topic for topic in there if word.startswith(f"{topic}/") or word == topic]
    if not topics:
        return None
    topic = max(topics, key=len)
    return topic, word[len(topic) + 1 :].replace("/", ".")


def numbers_in(message: Any, place: str = "") -> Iterator[str]:
    """Paths of all fields that are one number; of a list's elements those that are there."""
    for name, text in message.get_fields_and_field_types().items():
        kind, here, value = read_type(text), f"{place}{name}", getattr(message, name)
        if kind.many:
            if not kind.is_message and (kind.of in FLOATS or kind.of in INTEGERS):
                yield from (f"{here}[{at}]" for at in range(min(len(value), MOST_ELEMENTS)))
        elif kind.is_message:
            yield from numbers_in(value, f"{here}.")
        elif kind.of in FLOATS or kind.of in INTEGERS or kind.of == "boolean":
            yield here


def number_at(message: Any, path: str, only_type: bool = False) -> float | None:
    """The number at `path`, as `pose.position.x` or `ranges[3]`; None where there is none.

    With `only_type` an element of a list counts although the list is empty yet.
    """
    value = message
    for step in path.replace("[", ".[").split("."):
        try:
            value = value[int(step[1:-1])] if step.startswith("[") else _field(value, step)
        except IndexError:
            return 0.0 if only_type else None
        except (AttributeError, ValueError, TypeError):
            return None
    try:
        return float(value)
    except (TypeError, ValueError):
        return None


def _field(message: Any, name: str) -> Any:
    """Raises AttributeError for what is no field of it."""
    if name not in message.get_fields_and_field_types():
        raise AttributeError(name)
    return getattr(message, name)
