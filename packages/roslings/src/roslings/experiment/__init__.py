"""Run a grader's experiments on a package, and bring back the evidence.

`measure(...)` is called in the command's own process. The work is done in a second process, behind
the wall that the machine allows, so that no fault in there reaches the command.
"""

from roslings.course.grader import Experiment, experiment, experiments_of
from roslings.experiment.measure import (
    MeasuringFailed,
    MeasuringOptions,
    MeasuringProcess,
    measure,
    measuring_process,
)
from roslings.experiment.running import Run
from roslings.experiment.scene import Scene
from roslings.experiment.slips import mending
from roslings.experiment.unobserved import Unobserved
from roslings.experiment.walls import NoWall, insist_on_wall

__all__ = [
    "Experiment",
    "MeasuringFailed",
    "MeasuringOptions",
    "MeasuringProcess",
    "NoWall",
    "Run",
    "Scene",
    "Unobserved",
    "experiment",
    "experiments_of",
    "insist_on_wall",
    "measure",
    "measuring_process",
    "mending",
]
