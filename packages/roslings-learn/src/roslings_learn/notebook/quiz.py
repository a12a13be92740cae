"""A day's quiz below a cell: as widgets, or as plain text where there are none."""

from __future__ import annotations

from importlib.util import find_spec

from roslings_learn.notebook.picture import in_a_notebook
from roslings_learn.notebook.place import on_the_site

LINK = '<p><a href="quiz.html">The quiz of this day</a> has a page of its own.</p>'


def quiz(day: str) -> None:
    """Ask the questions of a day, e.g. `quiz("03-topics")`.

    Each answer gets its explanation. Without widgets, questions and answers are printed. Raises
    nothing: where there is no quiz, a line says so.
    """
    from roslings import course
    from roslings_learn.lessons import BadLessons, read_lessons

    try:
        lessons = read_lessons(course.root())
    except BadLessons as error:
        print(f"The quizzes cannot be read:\n{error}")
        return
    found = lessons.quiz(day)
    if found is None:
        there = ", ".join(each.day for each in lessons.quizzes) or "none"
        print(f"There is no quiz for {day!r}. There is: {there}.")
    elif on_the_site():
        from IPython.display import HTML, display

        display(HTML(LINK))
    elif in_a_notebook() and find_spec("ipywidgets") is not None:
        from roslings_learn.notebook.quiz_widgets import show

        show(found)
    else:
        from roslings_learn.lessons.quiz_text import as_text

        print(as_text(found))
