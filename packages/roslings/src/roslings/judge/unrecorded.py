"""Evidence that is judged again by a grader that asks for more than was recorded."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NoReturn

from roslings.judge.faults.reasons import NotRecorded
from roslings.judge.views import View


@dataclass(frozen=True)
class NotRecordedView(View):
    """An experiment that the grader has and the evidence has not: no check can look at it."""

    name: str

    def refuse(self) -> NoReturn:
        """Raises Inconclusive."""
        raise NotRecorded(self.name)
