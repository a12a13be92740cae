"""Load the judge before there is anything to judge: once for many, or while colcon builds."""

from __future__ import annotations

from contextlib import suppress
from functools import cache
from pathlib import Path

from roslings.course import lab
from roslings.evidence import Evidence, MachineSeen, PackageSeen
from roslings.judge.judge import judge

NOWHERE = MachineSeen(
    roslings="", ros_distro="", rmw="", python="", platform="", isolation="domain"
)


@cache
def load_judge(name: str, hidden: Path | None = None) -> None:
    """Judge a package of which nothing was seen: pytest then has all its own plugins, and the
    graders are compiled its way.

    What cannot be loaded is told by the grading that needs it.
    """
    with suppress(Exception):
        task = lab(name, hidden)
        package = PackageSeen(name=task.card.package, folder="", build_type="")
        judge(task, Evidence(lab=name, seed=0, machine=NOWHERE, package=package))
