"""Home's path of days, and the labs' cards. Both work before the first lesson is written."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from html import escape

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.config import Config
from sphinx.util.docutils import SphinxDirective

from course_site.course import MarkdownDirective, html, lessons_of, name_of
from ros2_on_pip.language import Text, counted, said
from roslings.capabilities.actions.contract import ActionWords
from roslings.capabilities.services.contract import ServiceWords
from roslings.course import Lab, all_labs
from roslings.course.card import NodeContract
from roslings.course.titles import lab_title
from roslings_learn.lessons import Day, Quiz, Term

LEAD = (
    "{days} days of {least:g} to {most:g} hours each, {total:g} hours in all."
    " How many weeks is that?"
)
AFTERNOONS = "two afternoons of three hours a week"
PACKAGE = "Package {package} · {count} checks"
KINDS = {
    "node": Text("site.labs.node", "node"),
    "topic": Text("site.labs.topic", "topic"),
    "service": Text("site.labs.service", "service"),
    "action": Text("site.labs.action", "action"),
}


class PathOfDays(SphinxDirective):
    """`{path-of-days}`: a list of all days, what each brings, and what of it is there."""

    def run(self) -> list[nodes.Node]:
        """One list item a day."""
        items = "".join(self._item(day) for day in lessons_of(self.config).days)
        return [html(f'<ol class="path">{items}</ol>')]

    def _item(self, day: Day) -> str:
        lesson = f"days/{day.id}/index"
        there = lesson in self.env.found_docs
        title = escape(day.title)
        name = f'<a href="{lesson}.html">{title}</a>' if there else title
        number = said("site.path.day", "Day {day}", day=day.number)
        return (
            f'<li class="path-day" {day_attributes(day, self.env.config)}>'
            f'<p class="path-title"><span class="path-number">{number}</span> {name}</p>'
            f"<p>{escape(day.can)}</p>{self._links(day, there)}"
            '<p class="path-state"></p></li>'
        )

    def _links(self, day: Day, there: bool) -> str:
        lessons = lessons_of(self.config)
        parts = [
            f'<a href="labs/{lab.name}.html">'
            f"{said('site.path.lab', 'Lab: {title}', title=escape(lab_title(lab)))}</a>"
            for lab in labs_of(day)
        ]
        if lessons.quiz(day.id):
            parts.append(f'<a href="days/{day.id}/quiz.html">{said("site.quiz", "Quiz")}</a>')
        if not there:
            open_ = said("site.path.open", "The lesson is not written yet")
            parts.append(f'<span class="path-open">{open_}</span>')
        about = said("site.path.hours", "About {hours:g} hours", hours=day.hours)
        hours = f"<span>{about}</span>"
        items = "".join(f"<li>{part}</li>" for part in [hours, *parts])
        return f'<ul class="path-links">{items}</ul>{_words(lessons.words_of(day))}'


def _words(words: tuple[Term, ...]) -> str:
    """The words of a day, folded away: they are many."""
    links = " ".join(
        f'<a href="glossary.html#{word.anchor}">{escape(word.name)}</a>' for word in words
    )
    if not words:
        return ""
    title = said("site.path.words", "{count} words", count=len(words))
    return f'<details class="path-words"><summary>{title}</summary><p>{links}</p></details>'


def labs_of(day: Day) -> list[Lab]:
    """The labs of a day."""
    return [lab for lab in all_labs() if lab.card.day == day.id]


def day_attributes(day: Day, config: Config) -> str:
    """What the script needs to know of a day: its labs, and the ids of its questions."""
    quiz: Quiz | None = lessons_of(config).quiz(day.id)
    questions = " ".join(question.id for question in quiz.questions) if quiz else ""
    labs = " ".join(lab.name for lab in labs_of(day))
    return f'data-day="{day.id}" data-labs="{labs}" data-questions="{questions}"'


class DaysTree(MarkdownDirective):
    """`{days-tree}`: the lessons and quizzes in the side bar; nothing where none is written."""

    def markdown(self) -> str:
        """A hidden table of contents: one entry a day; its lesson holds the rest of the day."""
        pages = [
            (name_of(day), page)
            for day in lessons_of(self.config).days
            if (page := self._first_page(day))
        ]
        if not pages:
            return ""
        lines = "\n".join(f"{title} <{page}>" for title, page in pages)
        caption = said("site.path.caption", "The days")
        return f"```{{toctree}}\n:hidden:\n:caption: {caption}\n\n{lines}\n```"

    def _first_page(self, day: Day) -> str:
        pages = (f"days/{day.id}/index", f"days/{day.id}/quiz")
        return next((page for page in pages if page in self.env.found_docs), "")


class HowLong(MarkdownDirective):
    """`{how-long}`: how many hours all days take, and how many weeks that is."""

    by_id = True

    def markdown(self) -> str:
        """A sentence and a table, both from the path."""
        hours = [day.hours for day in lessons_of(self.config).days]
        count, total = len(hours), sum(hours)
        lead = said(
            "site.weeks.lead", LEAD, days=count, least=min(hours), most=max(hours), total=total
        )
        have, need = (
            said("site.weeks.have", "you have"),
            said("site.weeks.need", "you need about"),
        )
        breaks = said("site.weeks.breaks", "{weeks}, with breaks", weeks=_weeks(count, 5))
        return (
            f"{lead}\n\n| {have} | {need} |\n| --- | --- |\n"
            f"| {said('site.weeks.holiday', 'whole days, as in a holiday course')} | {breaks} |\n"
            f"| {said('site.weeks.afternoons', AFTERNOONS)} | {_weeks(total, 6)} |\n"
            f"| {said('site.weeks.lesson', 'one lesson of 90 minutes a week')} |"
            f" {_weeks(total, 1.5)} |"
        )


def _weeks(amount: float, each_week: float) -> str:
    weeks = math.ceil(amount / each_week)
    return counted("site.weeks", weeks, one="{count} week", other="{count} weeks")


class LabCards(MarkdownDirective):
    """`{labs}`: a card a lab, drawn from its card.yaml."""

    def run(self) -> list[nodes.Node]:
        """The cards, and the tree of their tasks."""
        days = {day.id: name_of(day) for day in lessons_of(self.config).days}
        cards = "".join(_lab_card(lab, days.get(lab.card.day, lab.card.day)) for lab in all_labs())
        return [html(f'<ul class="lab-cards">{cards}</ul>'), *super().run()]

    def markdown(self) -> str:
        """A hidden table of contents."""
        tree = "\n".join(lab.name for lab in all_labs())
        return f"```{{toctree}}\n:hidden:\n\n{tree}\n```"


def _lab_card(lab: Lab, day: str) -> str:
    card = lab.card
    package = f"<code>{escape(card.package)}</code>"
    return (
        f'<li class="lab-card"><p class="lab-day">{escape(day)}</p>'
        f'<h2><a href="{lab.name}.html">{escape(lab_title(lab))}</a></h2>'
        f'<ul class="lab-names">{"".join(_names(card.nodes))}</ul>'
        f"<p>{said('site.labs.package', PACKAGE, package=package, count=len(card.points))}</p>"
        f"<pre data-copy>./roslings start {lab.name}</pre></li>"
    )


def _names(contracts: Sequence[NodeContract]) -> Iterator[str]:
    """Each name of the card once, in the colour of its kind: what a student makes, and meets."""
    services = [each.of(ServiceWords) for each in contracts]
    actions = [each.of(ActionWords) for each in contracts]
    for kind, names in {
        "node": [each.node for each in contracts],
        "topic": [t.topic for each in contracts for t in (*each.publishes, *each.subscribes)],
        "service": [s.service for each in services for s in (*each.serves, *each.calls)],
        "action": [a.action for each in actions for a in (*each.performs, *each.orders)],
    }.items():
        for name in dict.fromkeys(names):
            word = KINDS[kind]
            yield f'<li class="kind {kind}"><span>{word}</span> <code>{escape(name)}</code></li>'


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.add_directive("path-of-days", PathOfDays)
    app.add_directive("days-tree", DaysTree)
    app.add_directive("how-long", HowLong)
    app.add_directive("labs", LabCards)
