"""Why nothing can be said of a launch."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.base import Inconclusive, NothingToJudge
from roslings.judge.faults.sentences import one_of


@dataclass(eq=False)
class NothingLaunched(NothingToJudge):
    """There is no launch, or no node of it, to look at."""

    what: Literal["nothing", "no_file", "no_node"]
    name: str = ""
    text = one_of(
        nothing="nothing was launched",
        no_file="the launch was given no file",
        no_node="no node is in {name}",
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.what


@dataclass(eq=False)
class OnlyTheFullRos(Inconclusive):
    """The launch file asks for what is not there without a full ROS."""

    said: str
    """What it asks for; empty where nobody said so."""
    text = one_of(
        why="only the full ROS can carry out this launch file ({said}); launch it there, or show"
        " it to your instructor",
        plain="only the full ROS can carry out this launch file; launch it there, or show it to"
        " your instructor",
    )

    @property
    def which_text(self) -> str:
        """Whether it is known for what."""
        return "why" if self.said else "plain"


@dataclass(eq=False)
class SilentAboutParameters(Inconclusive):
    """A node that is there did not say its parameters."""

    node: str
    text = "{node} did not say in time what its parameters are"
