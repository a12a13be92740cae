"""The course's own files: days, labs, cards, variants, hints, mutants, graders. Knows no ROS.

The only room that reads them; each mistake in them is told with file and line. The models of a card
are made when one is first used: `./roslings status` needs none.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from roslings.course.files import CourseError, NoSolution, NoSuchLab, written
from roslings.course.labs import Lab, all_labs, lab, root

if TYPE_CHECKING:
    from roslings.course.card import (
        Card,
        ConstantContract,
        GiveUpContract,
        Hint,
        NodeContract,
        OutcomeContract,
        PictureContract,
        QosContract,
        TopicContract,
    )
    from roslings.course.contract import RateContract
    from roslings.course.mutants import Edit, Mutant

__all__ = [
    "Card",
    "ConstantContract",
    "CourseError",
    "Edit",
    "GiveUpContract",
    "Hint",
    "Lab",
    "Mutant",
    "NoSolution",
    "NoSuchLab",
    "NodeContract",
    "OutcomeContract",
    "PictureContract",
    "QosContract",
    "RateContract",
    "TopicContract",
    "all_labs",
    "lab",
    "root",
    "written",
]


_MUTANTS = ("Edit", "Mutant")


if not TYPE_CHECKING:  # else each misspelt name would be one of this module

    def __getattr__(name: str) -> Any:
        """Import the module that holds `name` when it is first asked for (PEP 562)."""
        if name not in __all__:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        home = "mutants" if name in _MUTANTS else "card"
        return getattr(import_module(f"{__name__}.{home}"), name)
