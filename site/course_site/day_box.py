"""The box at the end of a lesson and of a quiz: when all of a day is done, the student says so."""

from __future__ import annotations

from html import escape

from docutils import nodes
from sphinx.application import Sphinx

from course_site.course import html, lessons_of
from course_site.path_of_days import day_attributes, labs_of
from roslings_learn.lessons import Day


def add_box(app: Sphinx, document: nodes.document, page: str) -> None:
    """Put the box at the end of a day's pages."""
    parts = page.split("/")
    if len(parts) != 3 or parts[0] != "days" or parts[2] not in ("index", "quiz"):
        return
    day = next((each for each in lessons_of(app.config).days if each.id == parts[1]), None)
    if day:
        document += html(_box(app, day))


def _box(app: Sphinx, day: Day) -> str:
    return (
        f'<section class="day-box" {day_attributes(day, app.config)} aria-labelledby="day-box">'
        f'<h2 id="day-box">Is day {day.number} done?</h2><ul class="day-needs">{_needs(app, day)}'
        f"</ul>{_drop(day)}"
        f'<p><button type="button" class="button day-done" disabled>Day {day.number} is done'
        '</button></p><p class="day-state" role="status"></p>'
        "<noscript><p>Without JavaScript, tick it off on paper.</p></noscript></section>"
    )


def _needs(app: Sphinx, day: Day) -> str:
    quiz = lessons_of(app.config).quiz(day.id)
    needs = []
    if quiz:
        count = len(quiz.questions)
        needs.append(
            f'<li data-need="quiz"><a href="quiz.html">The quiz</a>: <span>{count} questions to'
            " answer</span></li>"
        )
    needs += [
        f'<li data-need="lab" data-lab="{lab.name}"><a href="../../labs/{lab.name}.html">'
        f"The lab: {escape(lab.card.title)}</a>: <span>load its verdict below</span></li>"
        for lab in labs_of(day)
    ]
    return "".join(needs)


def _drop(day: Day) -> str:
    """The field that takes a verdict; none for a day without a lab."""
    labs = labs_of(day)
    if not labs:
        return ""
    command = f"./roslings check {labs[0].name} --json verdict.json"
    return (
        '<div class="drop"><p>Write your verdict to a file, in the roslings folder:</p>'
        f"<pre>{command}</pre>"
        '<p><label>Load the verdict: <input type="file" accept=".json,application/json"></label>'
        " or drop the file here. It stays on this computer.</p></div>"
    )


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.connect("doctree-resolved", add_box, priority=600)  # after the words of the page
