"""What matches what, to play with: a field a rule, whose rules are those of the notebook's table.

The choices stand in the page from weak to strong, so `static/qos.js` only compares their places.
Without JavaScript the tables below it say the same.
"""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from course_site.course import MarkdownDirective, html
from ros2_on_pip.language import Text, said, template
from roslings_learn.lessons.qos import RULES, PolicyRule, PolicyValue

PAGE = "reference/qos"
SIDES = {
    "offered": Text("site.qos.offers", "the publisher offers"),
    "asked": Text("site.qos.asks", "the subscription asks for"),
}


class QosPlay(SphinxDirective):
    """`{qos-play}`: a pair to choose, and whether it matches."""

    def run(self) -> list[nodes.Node]:
        """The fields, hidden until the script shows them."""
        fields = "".join(map(_field, RULES))
        return [
            html(
                f'<form class="qos-play" hidden>{fields}<p class="qos-says" role="status"></p>'
                '<pre class="qos-code" tabindex="0" role="region"'
                f' aria-label="{said("site.qos.pair", "The pair in Python")}"></pre></form>'
            )
        ]


class QosTables(MarkdownDirective):
    """`{qos-tables}`: a table a rule, with all pairs."""

    by_id = True

    def markdown(self) -> str:
        """A section a rule."""
        return "\n\n".join(map(_section, RULES))


def _field(rule: PolicyRule) -> str:
    lists = "".join(_list(rule, side, label) for side, label in SIDES.items())
    return (
        f'<fieldset data-broken="{escape(_broken(rule))}"><legend>{_title(rule)}</legend>'
        f'{lists}<span class="qos-mark"></span></fieldset>'
    )


def _list(rule: PolicyRule, side: str, label: Text) -> str:
    options = "".join(
        f'<option data-code="{_code(rule, choice)}">{_words(rule, choice)}</option>'
        for choice in rule.choices
    )
    return f'<label>{label} <select data-side="{side}">{options}</select></label>'


def _code(rule: PolicyRule, choice: PolicyValue) -> str:
    """The argument of QoSProfile; nothing for a time that is not limited."""
    if isinstance(choice.value, str):
        return f"{rule.name}={rule.title.title()}Policy.{choice.value}"
    return "" if choice.value is None else f"{rule.name}=Duration(seconds={choice.value:g})"


def _section(rule: PolicyRule) -> str:
    head = " | ".join(
        said("site.qos.asked", "asked: {choice}", choice=_words(rule, choice))
        for choice in rule.choices
    )
    rows = [f"| {_row(rule, choice)} |" for choice in rule.choices]
    lines = [
        f"| {said('site.qos.offered', 'offered')} | {head} |",
        f"| --- |{' --- |' * len(rule.choices)}",
        *rows,
    ]
    fails = said("site.qos.fails", "Where it fails: {why}", why=_broken(rule))
    return f"## {_title(rule).capitalize()}\n\n{fails}\n\n" + "\n".join(lines)


def _row(rule: PolicyRule, offered: PolicyValue) -> str:
    yes, no = said("site.qos.yes", "yes"), said("site.qos.no", "no")
    told = [yes if rule.holds(offered.words, c.words) else f"**{no}**" for c in rule.choices]
    return " | ".join([_words(rule, offered), *told])


def texts_of_rules() -> Iterator[tuple[str, str]]:
    """The id and the English of each text of the rules."""
    for rule in RULES:
        yield f"qos.{rule.name}.title", rule.title
        yield f"qos.{rule.name}.broken", rule.broken
        yield from ((_choice_id(rule, choice), choice.words) for choice in rule.choices)


def _title(rule: PolicyRule) -> str:
    return template(f"qos.{rule.name}.title", rule.title)


def _broken(rule: PolicyRule) -> str:
    return template(f"qos.{rule.name}.broken", rule.broken)


def _words(rule: PolicyRule, choice: PolicyValue) -> str:
    return template(_choice_id(rule, choice), choice.words)


def _choice_id(rule: PolicyRule, choice: PolicyValue) -> str:
    return f"qos.{rule.name}.{rule.choices.index(choice) + 1}"


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
