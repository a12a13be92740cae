"""What a lab is called, in the language that is asked for."""

from __future__ import annotations

from ros2_on_pip.language import template
from roslings.course.labs import Lab


def lab_title(lab: Lab) -> str:
    """As its card says it."""
    return template(lab_title_id(lab), lab.outline.title)


def lab_title_id(lab: Lab) -> str:
    """The id of that text."""
    return f"cards.{lab.name}.title"
