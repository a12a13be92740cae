"""The box at the end of a lesson and of a quiz: when all of a day is done, the student says so."""

from __future__ import annotations

from html import escape

from docutils import nodes
from sphinx.application import Sphinx

from course_site.course import html, lessons_of
from course_site.path_of_days import day_attributes, labs_of
from ros2_on_pip.language import said
from roslings.course.titles import lab_title
from roslings_learn.lessons import Day

NO_SCRIPT = "Without JavaScript, tick it off on paper."


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
        f'<h2 id="day-box">{said("site.day.is_done", "Is day {day} done?", day=day.number)}</h2>'
        f'<ul class="day-needs">{_needs(app, day)}'
        f"</ul>{_drop(day)}"
        '<p><button type="button" class="button day-done" disabled>'
        f"{said('site.day.done', 'Day {day} is done', day=day.number)}"
        '</button></p><p class="day-state" role="status"></p>'
        f"<noscript><p>{said('site.day.no_script', NO_SCRIPT)}</p></noscript></section>"
    )


def _needs(app: Sphinx, day: Day) -> str:
    quiz = lessons_of(app.config).quiz(day.id)
    needs = []
    if quiz:
        count = len(quiz.questions)
        left = said("site.day.questions", "{count} questions to answer", count=count)
        quiz_words = said("site.day.quiz", "The quiz")
        needs.append(
            f'<li data-need="quiz"><a href="quiz.html">{quiz_words}</a>: <span>{left}</span></li>'
        )
    load = said("site.day.load_below", "load its verdict below")
    needs += [
        f'<li data-need="lab" data-lab="{lab.name}"><a href="../../labs/{lab.name}.html">'
        f"{said('site.day.lab', 'The lab: {title}', title=escape(lab_title(lab)))}</a>:"
        f" <span>{load}</span></li>"
        for lab in labs_of(day)
    ]
    return "".join(needs)


def _drop(day: Day) -> str:
    """The field that takes a verdict; none for a day without a lab."""
    labs = labs_of(day)
    if not labs:
        return ""
    command = f"./roslings check {labs[0].name} --json verdict.json"
    write = "Write your verdict to a file, in the roslings folder:"
    field = '<input type="file" accept=".json,application/json">'
    load = (
        "<label>Load the verdict: {field}</label> or drop the file here. It stays on this computer."
    )
    return (
        f'<div class="drop"><p>{said("site.day.write", write)}</p>'
        f"<pre>{command}</pre>"
        f"<p>{said('site.day.load', load, field=field)}</p></div>"
    )


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.connect("doctree-resolved", add_box, priority=600)  # after the words of the page
