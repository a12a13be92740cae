"""Quizzes as real forms. What is right is not in the page: `static/quiz/DAY.js` brings it.

A reader without JavaScript finds the answers, with all explanations, on a page of their own.
"""

from __future__ import annotations

import base64
import json
from html import escape
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from course_site.course import html, inline_html, lessons_of
from ros2_on_pip.language import Text, counted, said
from roslings_learn.lessons import Lessons, One, OrderQuestion, Prints, Question, Quiz, Several

Values = dict[str, Any]
INTRO = (
    "{number}. Choose, then press <b>Check</b>. A wrong answer is no harm: it comes back on the"
    ' <a href="../../review.html">review page</a>.'
)
NO_SCRIPT = (
    "Your browser runs no JavaScript here. Answer on paper, then read the"
    ' <a href="{answers}">answers with explanations</a>.'
)
IT_PRINTS = Text("site.quiz.prints", "It prints:")
SEVERAL = Text("site.quiz.several", "One or more are right.")
RIGHT = Text("site.quiz.right", "Right:")
NOT_RIGHT = Text("site.quiz.not_right", "Not right:")


class QuizDirective(SphinxDirective):
    """`{quiz} 03-topics`: the questions of a day."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """One form a question."""
        quiz = lessons_of(self.config).quiz(self.arguments[0])
        assert quiz is not None, self.arguments[0]  # the page is made from the quiz
        highlight = _highlighter(self.env.app)
        forms = [_form(each, index, highlight) for index, each in enumerate(quiz.questions, 1)]
        return [html(_no_script("answers.html")), html(_intro(len(forms))), *map(html, forms)]


class ReviewDirective(SphinxDirective):
    """`{review}`: every question of the course; the script shows those that are due."""

    def run(self) -> list[nodes.Node]:
        """One form a question, each once."""
        highlight = _highlighter(self.env.app)
        questions = all_questions(lessons_of(self.config))
        forms = [_form(each, index, highlight) for index, each in enumerate(questions, 1)]
        return [html(f'<div class="review-questions">{"".join(forms)}</div>')]


class AnswersDirective(SphinxDirective):
    """`{quiz-answers} 03-topics`: for readers without JavaScript, and for print."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """One section a question."""
        quiz = lessons_of(self.config).quiz(self.arguments[0])
        assert quiz is not None, self.arguments[0]
        return [html("".join(_answer(each, n) for n, each in enumerate(quiz.questions, 1)))]


def _highlighter(app: Sphinx) -> Any:
    """Gives code its colours: a page has them, and what only takes texts out of pages has none."""
    if app.builder.format == "html":
        return app.builder.highlighter.highlight_block  # type: ignore[attr-defined]
    return lambda code, language: escape(code)


def all_questions(lessons: Lessons) -> list[Question]:
    """Every question once, in the order of the days."""
    return list({each.id: each for quiz in lessons.quizzes for each in quiz.questions}.values())


def _intro(count: int) -> str:
    number = counted("site.quiz.count", count, one="{count} question", other="{count} questions")
    return f'<p class="quiz-intro">{said("site.quiz.intro", INTRO, number=number)}</p>'


def _no_script(answers: str) -> str:
    words = said("site.quiz.no_script", NO_SCRIPT, answers=answers)
    return f'<noscript><p class="note-box">{words}</p></noscript>'


def _numbered(number: int) -> str:
    return said("site.quiz.question", "Question {number}", number=number)


# --- one question ------------------------------------------------------------------------------


def _form(question: Question, number: int, highlight: Any) -> str:
    code = highlight(question.code, question.language) if question.code else ""
    return (
        f'<form class="question" id="q-{question.id}" data-question="{question.id}"'
        f' data-kind="{question.kind}" novalidate>'
        f'<fieldset><legend><span class="question-number">{_numbered(number)}</span> '
        f"{inline_html(question.ask)}</legend>{code}{_answers_to(question)}</fieldset>"
        '<p class="question-buttons"><button type="submit" class="button">'
        f"{said('site.quiz.check', 'Check')}</button></p>"
        '<div class="outcome" role="status"></div></form>'
    )


def _answers_to(question: Question) -> str:
    if isinstance(question, OrderQuestion):
        return _steps(question)
    if isinstance(question, Prints):
        return (
            f'<p class="typed"><label for="a-{question.id}">{IT_PRINTS}</label> <input type="text"'
            f' id="a-{question.id}" name="answer" autocomplete="off" autocapitalize="off"'
            ' spellcheck="false"></p><p class="why" hidden></p>'
        )
    several = isinstance(question, Several)
    note = f'<p class="several">{SEVERAL}</p>' if several else ""
    items = "".join(
        f'<li><label><input type="{"checkbox" if several else "radio"}" name="answer"'
        f' value="{index}"><span>{inline_html(choice.text)}</span></label>'
        '<p class="why" hidden></p></li>'
        for index, choice in enumerate(question.choices)
    )
    return f'{note}<ul class="choices">{items}</ul>'


def _steps(question: OrderQuestion) -> str:
    items = "".join(
        f'<li data-step="{shown}"><span>{inline_html(question.steps[place].text)}</span>'
        '<p class="why" hidden></p></li>'
        for shown, place in enumerate(question.shown)
    )
    move = said("site.quiz.move", "Move the steps into the right order.")
    return f'<p class="several">{move}</p><ol class="steps">{items}</ol>'


def _answer(question: Question, number: int) -> str:
    head = f"<h2>{_numbered(number)}</h2><p>{inline_html(question.ask)}</p>"
    code = f"<pre>{escape(question.code)}</pre>" if question.code else ""
    return f"<section>{head}{code}{_explained(question)}</section>"


def _explained(question: Question) -> str:
    if isinstance(question, OrderQuestion):
        lines = [f"{inline_html(s.text)} <em>{inline_html(s.why)}</em>" for s in question.steps]
        return f"<ol>{''.join(f'<li>{line}</li>' for line in lines)}</ol>"
    if isinstance(question, Prints):
        printed = f"<pre>{escape(question.prints)}</pre>"
        return f"<p>{IT_PRINTS}</p>{printed}<p><em>{inline_html(question.why)}</em></p>"
    lines = [
        f"<strong>{RIGHT if each.right else NOT_RIGHT}</strong> {inline_html(each.text)}"
        f" <em>{inline_html(each.why)}</em>"
        for each in question.choices
    ]
    return f"<ul>{''.join(f'<li>{line}</li>' for line in lines)}</ul>"


# --- what is right, for the script -------------------------------------------------------------


def _key(question: Question) -> Values:
    shared: Values = {"kind": question.kind, "day": question.day}
    if isinstance(question, OrderQuestion):
        places = question.shown
        order = [places.index(place) for place in range(len(places))]
        whys = [inline_html(question.steps[place].why) for place in places]
        return {**shared, "right": order, "why": whys}
    if isinstance(question, Prints):
        mistakes = [[each.text, inline_html(each.why)] for each in question.mistakes]
        prints = {"prints": question.prints, "why": inline_html(question.why)}
        return {**shared, **prints, "mistakes": mistakes}
    right = [index for index, choice in enumerate(question.choices) if choice.right]
    return {**shared, "right": right, "why": [inline_html(each.why) for each in question.choices]}


def _card(question: Question) -> Values:
    """A question as an Anki card: front and back in HTML."""
    code = f"<pre>{escape(question.code)}</pre>" if question.code else ""
    front = inline_html(question.ask) + code
    if isinstance(question, One | Several):
        options = "".join(f"<li>{inline_html(each.text)}</li>" for each in question.choices)
        front += f"<ul>{options}</ul>"
    return {"front": front, "back": _explained(question)}


def write_keys(app: Sphinx, error: Exception | None) -> None:
    """Write a script a quiz, and one with the cards; packed, so that a glance shows no answer."""
    if error or app.builder.format != "html":
        return
    lessons = lessons_of(app.config)
    folder = Path(app.outdir) / "_static" / "quiz"
    folder.mkdir(parents=True, exist_ok=True)
    for quiz in lessons.quizzes:
        _write_script(folder / f"{quiz.day}.js", _keys_of(quiz))
    everything = {each.id: {**_key(each), **_card(each)} for each in all_questions(lessons)}
    _write_script(folder / "all.js", everything)


def _keys_of(quiz: Quiz) -> Values:
    return {each.id: _key(each) for each in quiz.questions}


def _write_script(path: Path, keys: Values) -> None:
    packed = base64.b64encode(json.dumps(keys).encode()).decode()
    path.write_text(f'window.roslingsKeys = "{packed}";\n', "utf-8")


def load_scripts(app: Sphinx, page: str, template: str, context: Values, doctree: Any) -> None:
    """Have a page load the scripts that it needs, and a page with questions what is right."""
    parts = page.split("/")
    if page == "review":
        _load(app, "all", "quiz.js", "review.js")
    elif len(parts) == 3 and parts[0] == "days":
        is_quiz = parts[2] == "quiz"
        _load(app, parts[1] if is_quiz else "", *(["quiz.js"] if is_quiz else []), "day.js")


def _load(app: Sphinx, keys: str, *scripts: str) -> None:
    if keys:
        app.add_js_file(f"quiz/{keys}.js", priority=100)
    for script in scripts:
        app.add_js_file(script, priority=900, defer="defer")  # after progress.js, which they use


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.add_directive("quiz", QuizDirective)
    app.add_directive("quiz-answers", AnswersDirective)
    app.add_directive("review", ReviewDirective)
    app.connect("html-page-context", load_scripts)
    app.connect("build-finished", write_keys)
