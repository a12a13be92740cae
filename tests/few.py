"""A test that is dear for every lab: README's command runs it for one, CI's slow tests for all."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest

from roslings.course import all_labs

FIRST = "topics"
"""The lab that stays: it is the first that a student does, and the quickest to be graded."""


def few(name: str, values: Iterable[tuple[str, Any]], *stay: str, twice: bool = False) -> Any:
    """Parametrise over named values; all but those that `stay` are slow.

    With `twice`, another stage of CI proves the same, and its slow tests leave them out too.
    """
    marks = [pytest.mark.slow, *([pytest.mark.twice] if twice else [])]
    return pytest.mark.parametrize(
        name,
        [
            pytest.param(value, id=each, marks=[] if each in stay else marks)
            for each, value in values
        ],
    )


def few_labs(name: str, *, twice: bool = False) -> Any:
    """The same over the labs of the course."""
    return few(name, ((lab.name, lab) for lab in all_labs()), FIRST, twice=twice)
