"""A quiz as widgets: each with a label, all of them reachable by keyboard.

Radio buttons, check boxes, lists and text fields are the browser's own: Tab, arrow keys, Space and
Enter work as everywhere. An answer's explanation is a status line, which screen readers tell.
"""

from __future__ import annotations

import html
import re
from collections.abc import Callable, Sequence
from typing import Any

from roslings_learn.lessons import One, OrderQuestion, Prints, Question, Quiz, Several
from roslings_learn.lessons.answering import explained
from roslings_learn.lessons.quiz_text import as_text, without_links

WIDE = {"width": "auto", "max_width": "46em"}
APART = {"margin": "0 0 1.4em 0"}
ASKED = "max-width:46em;line-height:1.45;font-size:1.05em"
CODE = (
    "margin:.5em 0;padding:.5em .8em;line-height:1.4;background:var(--jp-layout-color2,#eee);"
    "border-radius:4px;width:fit-content"
)
CHOOSE = "(choose)"
Answer = Callable[[], tuple[bool, Sequence[str]]]
"""Looks at what was chosen: whether all of it is right, and a sentence for each part of it."""


def show(quiz: Quiz) -> None:
    """Show all questions below the cell."""
    from IPython.display import display

    display(_Shown(quiz))


class _Shown:
    """What the notebook shows; where widgets cannot be drawn, the plain text."""

    def __init__(self, quiz: Quiz) -> None:
        self._text = as_text(quiz)
        self._box = drawn(quiz)

    def _repr_mimebundle_(self, **words: Any) -> Any:
        bundle = self._box._repr_mimebundle_(**words)
        if isinstance(bundle, dict):
            return {**bundle, "text/plain": self._text}
        return bundle


def drawn(quiz: Quiz) -> Any:
    """A box with one box for each question."""
    from ipywidgets import VBox

    return VBox([_question(number, each) for number, each in enumerate(quiz.questions, 1)])


def _question(number: int, question: Question) -> Any:
    from ipywidgets import HTML, Button, Layout, VBox

    fields, answer = _fields(question)
    button = Button(description=f"Check answer {number}")
    said = HTML()
    button.on_click(lambda _: setattr(said, "value", _feedback(*answer())))
    parts = [HTML(_heading(number, question)), *fields, button, said]
    return VBox(parts, layout=Layout(**APART))


def _heading(number: int, question: Question) -> str:
    code = question.code.rstrip()
    shown = f'<pre style="{CODE}">{html.escape(code)}</pre>' if code else ""
    more = " <em>One or more are right.</em>" if isinstance(question, Several) else ""
    return f'<div style="{ASKED}"><b>{number}.</b> {_inline(question.ask)}{more}{shown}</div>'


def _fields(question: Question) -> tuple[list[Any], Answer]:
    if isinstance(question, One):
        return _one(question)
    if isinstance(question, Several):
        return _several(question)
    if isinstance(question, OrderQuestion):
        return _order(question)
    return _prints(question)


def _one(question: One) -> tuple[list[Any], Answer]:
    from ipywidgets import Layout, RadioButtons

    options = [(_plain(choice.text), number) for number, choice in enumerate(question.choices)]
    field = RadioButtons(options=options, value=None, layout=Layout(**WIDE))

    def answer() -> tuple[bool, Sequence[str]]:
        if field.value is None:
            return False, ["Choose an answer first."]
        chosen = question.choices[field.value]
        return chosen.right, [chosen.why]

    return [field], answer


def _several(question: Several) -> tuple[list[Any], Answer]:
    from ipywidgets import Checkbox, Layout

    boxes = [
        Checkbox(description=_plain(choice.text), indent=False, layout=Layout(**WIDE))
        for choice in question.choices
    ]

    def answer() -> tuple[bool, Sequence[str]]:
        pairs = list(zip(boxes, question.choices, strict=True))
        right = all(box.value == choice.right for box, choice in pairs)
        told = [explained(choice) for box, choice in pairs if box.value]
        missing = any(choice.right and not box.value for box, choice in pairs)
        return right, [*told, *(["Something that is right is not chosen yet."] * missing)]

    return list(boxes), answer


def _order(question: OrderQuestion) -> tuple[list[Any], Answer]:
    from ipywidgets import Dropdown, Layout

    steps = [CHOOSE, *(_plain(question.steps[place].text) for place in question.shown)]
    lists = [
        Dropdown(options=steps, description=f"Step {place}", layout=Layout(**WIDE))
        for place in range(1, len(question.steps) + 1)
    ]

    def answer() -> tuple[bool, Sequence[str]]:
        if any(field.value == CHOOSE for field in lists):
            return False, ["Choose a step at each place first."]
        wrong = [s for f, s in zip(lists, question.steps, strict=True) if f.value != _plain(s.text)]
        if wrong:
            return False, [f"Look again at this step. {explained(wrong[0])}"]
        return True, [explained(step) for step in question.steps]

    return list(lists), answer


def _prints(question: Prints) -> tuple[list[Any], Answer]:
    from ipywidgets import Layout, Text

    field = Text(description="It prints:", continuous_update=False, layout=Layout(**WIDE))

    def answer() -> tuple[bool, Sequence[str]]:
        typed = " ".join(field.value.split())
        known = {" ".join(each.text.split()): each.why for each in question.mistakes}
        if typed == " ".join(question.prints.split()):
            return True, [question.why]
        return False, [known.get(typed, "Read the code once more, line by line.")]

    return [field], answer


def _feedback(right: bool, sentences: Sequence[str]) -> str:
    word, colour = ("Right.", "#1d6b2c") if right else ("Not yet.", "#a3261b")
    said = "<br>".join(_inline(sentence) for sentence in sentences)
    return (
        '<div role="status" style="max-width:46em;padding:.4em .7em;line-height:1.45;'
        f'background:#fff;color:#14181f;border-left:4px solid {colour}">'
        f'<b style="color:{colour}">{word}</b> {said}</div>'
    )


def _plain(text: str) -> str:
    """A label holds no markup."""
    return without_links(text).replace("`", "")


def _inline(text: str) -> str:
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", html.escape(without_links(text), quote=False))
