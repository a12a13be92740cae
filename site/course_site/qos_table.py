"""What matches what, to play with: a field a rule, whose rules are those of the notebook's table.

The choices stand in the page from weak to strong, so `static/qos.js` only compares their places.
Without JavaScript the tables below it say the same.
"""

from __future__ import annotations

from html import escape
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from course_site.course import MarkdownDirective, html
from roslings_learn.lessons.qos import RULES, Choice, Rule

PAGE = "reference/qos"
SIDES = {"offered": "the publisher offers", "asked": "the subscription asks for"}


class QosPlay(SphinxDirective):
    """`{qos-play}`: a pair to choose, and whether it matches."""

    def run(self) -> list[nodes.Node]:
        """The fields, hidden until the script shows them."""
        fields = "".join(map(_field, RULES))
        return [
            html(
                f'<form class="qos-play" hidden>{fields}<p class="qos-says" role="status"></p>'
                '<pre class="qos-code" tabindex="0" role="region"'
                ' aria-label="The pair in Python"></pre></form>'
            )
        ]


class QosTables(MarkdownDirective):
    """`{qos-tables}`: a table a rule, with all pairs."""

    def markdown(self) -> str:
        """A section a rule."""
        return "\n\n".join(map(_section, RULES))


def _field(rule: Rule) -> str:
    lists = "".join(_list(rule, side, label) for side, label in SIDES.items())
    return (
        f'<fieldset data-broken="{escape(rule.broken)}"><legend>{rule.title}</legend>'
        f'{lists}<span class="qos-mark"></span></fieldset>'
    )


def _list(rule: Rule, side: str, label: str) -> str:
    options = "".join(
        f'<option data-code="{_code(rule, choice)}">{choice.words}</option>'
        for choice in rule.choices
    )
    return f'<label>{label} <select data-side="{side}">{options}</select></label>'


def _code(rule: Rule, choice: Choice) -> str:
    """The argument of QoSProfile; nothing for a time that is not limited."""
    if isinstance(choice.value, str):
        return f"{rule.name}={rule.title.title()}Policy.{choice.value}"
    return "" if choice.value is None else f"{rule.name}=Duration(seconds={choice.value:g})"


def _section(rule: Rule) -> str:
    head = " | ".join(f"asked: {choice.words}" for choice in rule.choices)
    rows = [f"| {_row(rule, choice)} |" for choice in rule.choices]
    lines = [f"| offered | {head} |", f"| --- |{' --- |' * len(rule.choices)}", *rows]
    return f"## {rule.title.capitalize()}\n\nWhere it fails: {rule.broken}\n\n" + "\n".join(lines)


def _row(rule: Rule, offered: Choice) -> str:
    said = ["yes" if rule.holds(offered.words, c.words) else "**no**" for c in rule.choices]
    return " | ".join([offered.words, *said])


def add_script(
    app: Sphinx, page: str, template: str, context: dict[str, Any], doctree: Any
) -> None:
    """Only where there is something to play with."""
    if page == PAGE:
        app.add_js_file("qos.js", priority=900, defer="defer")


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.add_directive("qos-play", QosPlay)
    app.add_directive("qos-tables", QosTables)
    app.connect("html-page-context", add_script)
