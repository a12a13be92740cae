"""The site's one local extension: words, quizzes, the path of days, and pages from the engine."""

from __future__ import annotations

from typing import Any

from sphinx.application import Sphinx

from course_site import (
    api,
    card_words,
    day_box,
    doctor_page,
    few_scripts,
    few_tags,
    glossary_page,
    grader_words,
    html_texts,
    lab_page,
    landing,
    lesson_page,
    maths,
    navigation,
    one_sheet,
    path_of_days,
    picture_sizes,
    qos_table,
    quizzes,
    run_box,
    small_scripts,
    tables,
    terminals,
    words,
)
from course_site.colours import theme_colours
from course_site.course import course_digest

__all__ = ["course_digest", "setup", "theme_colours"]


def setup(app: Sphinx) -> dict[str, Any]:
    """Called by Sphinx."""
    app.add_config_value("course_root", "", "env")
    app.add_config_value("course_digest", "", "env")
    for part in (
        maths,
        html_texts,
        words,
        tables,
        glossary_page,
        quizzes,
        path_of_days,
        qos_table,
        day_box,
        run_box,
        lesson_page,
        lab_page,
        terminals,
        landing,
    ):
        part.setup(app)
    for part in (doctor_page, api, card_words, grader_words, navigation):
        part.setup(app)
    for part in (few_scripts, few_tags, picture_sizes, small_scripts, one_sheet):
        part.setup(app)
    return {"version": "1", "parallel_read_safe": False, "parallel_write_safe": True}
