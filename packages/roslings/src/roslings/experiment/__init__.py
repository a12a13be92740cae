"""Run a grader's experiments on a package, and bring back the evidence.

`measure(...)` is called in the command's own process; the work is done in a second process,
behind the wall that the machine allows, so that no fault in there reaches the command.
"""

from roslings.experiment.measure import (
    Choices,
    Measuring,
    MeasuringFailed,
    measure,
    measuring_process,
)
from roslings.experiment.running import Run
from roslings.experiment.scene import Scene
from roslings.experiment.slips import mending
from roslings.experiment.unobserved import Unobserved
from roslings.experiment.walls import NoWall, insist_on_wall
from roslings.grader import Experiment, experiment, experiments_of

__all__ = [
    "Choices",
    "Experiment",
    "Measuring",
    "MeasuringFailed",
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
