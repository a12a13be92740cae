"""The course's own files: days, labs, cards, hints, mutants, graders. Knows no ROS.

The only room that reads them; each mistake in them is told with file and line.
"""

from roslings.course.card import (
    Card,
    Hint,
    NodeContract,
    PictureContract,
    QosContract,
    RateContract,
    TopicContract,
)
from roslings.course.files import CourseError, NoSuchLab
from roslings.course.labs import Lab, all_labs, lab, root
from roslings.course.mutants import Edit, Mutant

__all__ = [
    "Card",
    "CourseError",
    "Edit",
    "Hint",
    "Lab",
    "Mutant",
    "NoSuchLab",
    "NodeContract",
    "PictureContract",
    "QosContract",
    "RateContract",
    "TopicContract",
    "all_labs",
    "lab",
    "root",
]
