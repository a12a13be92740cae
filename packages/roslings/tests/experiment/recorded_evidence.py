"""The runs of one experiment as the evidence of a grading has them."""

from __future__ import annotations

from collections.abc import Sequence

from roslings.evidence import Evidence, ExperimentSeen, MachineSeen, PackageSeen
from roslings.judge.views import ExperimentView, views_of

MACHINE = MachineSeen(
    roslings="", ros_distro="jazzy", rmw="", python="", platform="", isolation="namespace"
)
PACKAGE = PackageSeen(name="chatter", folder="chatter", build_type="ament_python")


def recorded(runs: Sequence[ExperimentSeen]) -> Evidence:
    """Evidence in which the last run counts."""
    *before, counted = runs
    return Evidence(
        lab="topics",
        seed=0,
        machine=MACHINE,
        package=PACKAGE,
        experiments={counted.name: counted},
        attempts=before,
    )


def view(runs: Sequence[ExperimentSeen]) -> ExperimentView:
    """What a check is given of them."""
    found = views_of(recorded(runs))[runs[-1].name]
    assert isinstance(found, ExperimentView)
    return found
