"""The browser's own controls, each with its label: done by keys and by screen readers as they are.

NiceGUI carries them; what is typed is kept here as `value`, and nothing is written over it while
somebody types.
"""

from __future__ import annotations

import json
from collections.abc import Awaitable, Callable, Iterable, Sequence
from inspect import isawaitable
from typing import Any

from nicegui import ui
from nicegui.elements.mixins.text_element import TextElement

from ros2_on_pip.problem import CommandProblem

VALUE = "(event) => emit(event.target.value)"
CHECKED = "(event) => emit(event.target.checked)"


class PageText(TextElement):
    """An element with words in it; `text` changes them."""

    def __init__(self, tag: str, text: str = "", kind: str = "", **attributes: Any) -> None:
        super().__init__(tag=tag, text=text)
        _dress(self, kind, attributes)

    def say(self, words: str) -> None:
        """Show these words; nothing is sent where they stand there already."""
        if self.text != words:
            self.text = words


def part(tag: str, kind: str = "", **attributes: Any) -> ui.element:
    """An element that holds others; `kind` is its class in style.css."""
    element = ui.element(tag)
    _dress(element, kind, attributes)
    return element


def _dress(element: ui.element, kind: str, attributes: dict[str, Any]) -> None:
    """`aria_label` is the attribute aria-label; what is None is left out."""
    element.classes(kind)
    for name, value in attributes.items():
        if value is not None:
            element.props[name.rstrip("_").replace("_", "-")] = value


def button(text: str, act: Callable[[], Any], kind: str = "", **attributes: Any) -> PageText:
    """What is pressed."""
    made = PageText("button", text, kind, type="button", **attributes)
    made.on("click", act, args=[])
    return made


class ControlField:
    """A control with its label before it."""

    def __init__(
        self, label: str, tag: str, value: Any, kind: str = "", /, **attributes: Any
    ) -> None:
        self.value = value
        self._changed: list[Callable[[], Any]] = []
        with part("div", f"field {kind}"):
            words = PageText("label", label)
            self.control = part(tag, **attributes)
        words.props["for"] = self.control.html_id

    def on_change(self, act: Callable[[], Any]) -> None:
        """Call `act` after each change that somebody made in the page."""
        self._changed.append(act)

    def disable(self) -> None:
        """Nobody can change it."""
        self.control.props["disabled"] = True

    def put(self, value: Any) -> None:
        """Another value, over what stands there."""
        self.value = value
        self._set("value", str(value))

    def _set(self, name: str, value: Any) -> None:
        element = f"document.getElementById({json.dumps(self.control.html_id)})"
        self.control.client.run_javascript(f"{element}.{name} = {json.dumps(value)}")

    def _take(self, value: Any) -> Awaitable[None]:
        """Keep it at once; what is to be done then may take its time."""
        self.value = value
        return self._changes()

    async def _changes(self) -> None:
        for act in self._changed:
            if isawaitable(doing := act()):
                await doing


class TextField(ControlField):
    """A line to type into; `value` is what stands there."""

    def __init__(self, label: str, value: str = "", kind: str = "", **attributes: Any) -> None:
        said = {"type": "text", "autocomplete": "off", "spellcheck": "false", **attributes}
        # As an attribute: a property is written at each change of the page, over what was typed.
        super().__init__(label, "input", value, kind, **said, **{"^value": value})
        self.control.on("input", lambda event: self._take(str(event.args)), js_handler=VALUE)


class Slider(ControlField):
    """A number between two others; `value` is the number as a text."""

    def __init__(self, label: str, value: float, least: float, most: float, step: float) -> None:
        said = {"min": least, "max": most, "step": step or "any"}
        # The value comes last: the browser fits it into the bounds that it knows by then.
        super().__init__(label, "input", str(value), "", type="range", **said, **{"^value": value})
        self.control.on("input", lambda event: self._take(str(event.args)), js_handler=VALUE)


class CheckField(ControlField):
    """A box to tick; `value` tells whether it is."""

    def __init__(self, label: str, value: bool = False, kind: str = "check") -> None:
        super().__init__(label, "input", value, kind, type="checkbox", checked=value or None)
        self.control.on("change", lambda event: self._take(bool(event.args)), js_handler=CHECKED)

    def put(self, value: Any) -> None:
        """Tick it, or not."""
        self.value = bool(value)
        self._set("checked", self.value)


class SelectField(ControlField):
    """A list to choose one of; `value` is the chosen text, "" where none is chosen yet."""

    def __init__(
        self, label: str, options: Iterable[str] = (), value: str = "", kind: str = ""
    ) -> None:
        super().__init__(label, "select", value, kind)
        self._options: list[str] = []
        self.offer(options)
        self.control.on("change", lambda event: self._take(str(event.args)), js_handler=VALUE)

    def choose(self, value: str) -> None:
        """Choose it, as somebody does in the page; what is to be done then is the caller's."""
        self.value, there = value, self._options
        self._options = []
        self.offer(there)

    def offer(self, options: Iterable[str]) -> None:
        """Another list; what was chosen stays chosen, also where it is not there any more."""
        new = list(options)
        if self.value and self.value not in new:
            new = [self.value, *new]
        if new == self._options:
            return
        self._options = new
        self.control.clear()
        with self.control:
            if not self.value:
                PageText("option", "Choose", value="", selected=True)
            for each in new:
                PageText("option", each, value=each, selected=each == self.value or None)


class Notice(PageText):
    """A line that tells of trouble; screen readers say it at once."""

    def __init__(self) -> None:
        super().__init__("p", "", "notice", role="alert")


class StatusLine(PageText):
    """A line that screen readers say when it changes, in their own time: for what was asked."""

    def __init__(self) -> None:
        super().__init__("p", "", "spoken", role="status")


def problem_of(act: Callable[[], Any]) -> str:
    """Do it; the words of what cannot be done, else nothing."""
    try:
        act()
    except CommandProblem as problem:
        return str(problem)
    return ""


def tell(notice: Notice, act: Callable[[], Any]) -> None:
    """Do it, and say in `notice` what cannot be done."""
    notice.say(problem_of(act))


def told(notice: Notice, act: Callable[[], Any]) -> Callable[[], Awaitable[None]]:
    """What does the same when it is called; `act` may take its time."""

    async def acting() -> None:
        notice.say("")
        try:
            if isawaitable(doing := act()):
                await doing
        except CommandProblem as problem:
            notice.say(str(problem))

    return acting


class NameTable:
    """A table whose first column is pressed to choose a row; it scrolls inside of its own frame.

    A row that stays is not made anew, so the focus stays where it is.
    """

    def __init__(self, caption: str, columns: Sequence[str], choose: Callable[[str], Any]) -> None:
        self._choose = choose
        self._rows: dict[str, tuple[ui.element, list[PageText]]] = {}
        frame = part("div", "scroll", role="region", tabindex=0, aria_label=caption)
        with frame, part("table"):
            with part("thead"), part("tr"):
                for each in columns:
                    PageText("th", each, scope="col")
            self._body = part("tbody")

    def show(self, rows: Sequence[Sequence[str]], chosen: str = "") -> None:
        """These rows, in this order; the first cell of each is its name."""
        for name in self._rows.keys() - {row[0] for row in rows}:
            self._rows.pop(name)[0].delete()
        for place, row in enumerate(rows):
            self._show(place, row, "true" if row[0] == chosen else None)

    def _show(self, place: int, row: Sequence[str], current: str | None) -> None:
        name, *cells = row
        if name not in self._rows:
            self._rows[name] = self._made(name, cells)
        line, texts = self._rows[name]
        if self._body.default_slot.children.index(line) != place:
            line.move(target_index=place)
        for text, words in zip(texts, cells, strict=True):
            text.say(words)
        if line.props.get("aria-current") != current:
            line.props["aria-current"] = current
            line.update()

    def _made(self, name: str, cells: Sequence[str]) -> tuple[ui.element, list[PageText]]:
        with self._body, part("tr") as line:
            with part("td"):
                button(name, lambda: self._choose(name))
            return line, [PageText("td", words) for words in cells]
