"""`explain` is right about any package that passes: three of each lab, two of them written anew.

A lab takes minutes, so the gate leaves it out: `./roslings test -m twice` with this file does all.
Each commit draws two of the ways in which `prove --rewritten` writes a solution.
"""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from explained import asked_about, first_that_fails
from roslings.course import all_labs, lab
from roslings_prove.proofs.command import newest_commit
from roslings_prove.rewritten import rewritten

pytestmark = pytest.mark.slow

LABS = sorted(each.name for each in all_labs())
OTHERS = 2


def packages(name: str, folder: Path) -> list[Path]:
    """The solution, and two that do the same in other words."""
    asked = lab(name)
    drawn = random.Random(f"{newest_commit()} {name}").sample(rewritten(asked), OTHERS)
    return [asked.solution, *(each.make(folder) for each in drawn)]


def holds_for_three(name: str, folder: Path) -> None:
    """Each change is made again by hand, and graded by `check`."""
    for number, package in enumerate(packages(name, folder / "packages")):
        own = folder / str(number)
        found = asked_about(name, package, own)
        assert found, f"nothing is asked about {package}"
        said = [(each, first_that_fails(name, package, each, own)) for each in found]
        assert [each for each, failed in said if failed != each.failed] == [], package


@pytest.mark.twice
@pytest.mark.parametrize("name", LABS)
def test_three_packages_of_each_lab(name: str, tmp_path: Path) -> None:
    """All of them, as they are drawn now."""
    holds_for_three(name, tmp_path)
