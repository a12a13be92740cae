"""The tiny lesson, read."""

from __future__ import annotations

from pathlib import Path

import pytest
from tiny_course import read_tiny, write_course

from roslings_learn.lessons.rules import Lesson


@pytest.fixture
def tiny_lesson(tmp_path: Path) -> Lesson:
    """A lesson that breaks no rule."""
    return read_tiny(write_course(tmp_path / "tiny"))
