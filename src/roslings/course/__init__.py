"""The course's own files: days, labs, cards, hints, mutants, graders. Knows no ROS.

The only room that reads them; each mistake in them is told with file and line.
"""

from roslings.course.card import (
    ActionContract,
    AnswerContract,
    Card,
    ConstantContract,
    GiveUpContract,
    Hint,
    LaunchContract,
    NodeContract,
    OutcomeContract,
    ParameterContract,
    PictureContract,
    QosContract,
    RateContract,
    ServiceContract,
    TopicContract,
)
from roslings.course.files import CourseError, NoSolution, NoSuchLab
from roslings.course.labs import Lab, all_labs, lab, root
from roslings.course.mutants import Edit, Mutant

__all__ = [
    "ActionContract",
    "AnswerContract",
    "Card",
    "ConstantContract",
    "CourseError",
    "Edit",
    "GiveUpContract",
    "Hint",
    "Lab",
    "LaunchContract",
    "Mutant",
    "NoSolution",
    "NoSuchLab",
    "NodeContract",
    "OutcomeContract",
    "ParameterContract",
    "PictureContract",
    "QosContract",
    "RateContract",
    "ServiceContract",
    "TopicContract",
    "all_labs",
    "lab",
    "root",
]
