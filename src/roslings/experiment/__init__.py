"""Run a grader's experiments on a package, and bring back the evidence.

`measure(...)` is called in the command's own process; the work is done in a second process,
behind the wall that the machine allows, so that no fault in there reaches the command.
"""

from roslings.experiment.declare import Experiment, experiment, experiments_of
from roslings.experiment.measure import Choices, MeasuringFailed, measure
from roslings.experiment.scene import Scene, mending

__all__ = [
    "Choices",
    "Experiment",
    "MeasuringFailed",
    "Scene",
    "experiment",
    "experiments_of",
    "measure",
    "mending",
]
