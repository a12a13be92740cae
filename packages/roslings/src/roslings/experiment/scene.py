"""What a grader's experiment works with: nodes to run, topics to watch, sentences to say."""

from __future__ import annotations

from roslings.experiment.running import Running
from roslings.experiment.speaking import Speaking
from roslings.experiment.watching import Watching


class Scene(Running, Watching, Speaking):
    """One experiment: an arena where nodes run, and a probe that watches them."""
