"""What a grading opens is what its proof is said to be measured by: the kernel tells.

A proof is stale when something of its lab's closure is another (`proofs/closure.py`). The
closure is read from imports and texts, and a program that is started in another way would be
missing in it. So each lab's solution is checked while inotify watches the engine.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from needed.opened import Opened, Watch
from roslings.capabilities.conformance import RUNS
from roslings.course import Lab, all_labs, root
from roslings.folders.lab_folders import GRADERS, lab_folders
from roslings_prove.proofs.digests import MeasuringCode, measuring
from sources import code_of
from until_told import run_until_told

PACKAGES, BESIDE = root() / "packages", root() / GRADERS
JUDGING = ("__main__.py", "commands", "judge", "report", "capabilities")
"""What the command itself is made of: it reads, judges and tells."""
ACTS = "act"
"""The module of a capability that measures: what only it leads to is no part of judging."""

pytestmark = [pytest.mark.slow, pytest.mark.alone]


@cache
def now() -> MeasuringCode:
    """What measures this course."""
    return measuring()


@cache
def judging() -> frozenset[str]:
    """All that the command may import besides, and what it starts of its own."""
    places = [*(code_of("roslings") / part for part in JUDGING), code_of("roslings_launcher")]
    places += PACKAGES.glob("*/src/*/command_names.py")  # the tables of what can be typed
    files = [file for place in places for file in (place, *place.rglob("*.py")) if file.is_file()]
    files = [file for file in files if file.stem != ACTS]
    files += filter(runs_nothing, BESIDE.glob("*/*.py"))
    modules = [now().modules.tree.name_of(file) for file in files]
    return now().modules.reached(modules)


def runs_nothing(file: Path) -> bool:
    """A module beside graders that reads and judges: it leads to nothing that measures."""
    reached = now().modules.reached([now().modules.tree.name_of(file)])
    return reached.isdisjoint(RUNS) and "import rclpy" not in file.read_text("utf-8")


def opened_by_a_check(lab: Lab, folder: Path) -> Opened:
    """Of the folders with our packages, and of those beside graders."""
    places = [each for top in (PACKAGES, *lab_folders()) for each in (top, *top.rglob("*"))]
    folders = [str(each.relative_to(root())) for each in places if each.is_dir()]
    command = [sys.executable, "-m", "roslings", "check", lab.name, "--solution"]
    with Watch(root(), folders) as watch:
        done = run_until_told(command, cwd=folder)
    assert done.returncode == 0, done.stdout + done.stderr
    return watch.opened()


def unknown(lab: Lab, opened: Opened) -> Iterator[str]:
    """What was opened and is neither measuring nor judging."""
    known = now().closure(lab) | judging()
    files = {file for name in known for file in now().modules.code(name).files}
    for name in sorted(opened.files | opened.modules):
        file = root() / name
        if not name.endswith(".py"):
            if file.is_file() and ".pyc" not in name and file not in files:
                yield name
        elif file.is_file() and now().modules.tree.name_of(file) not in known:
            yield name


@pytest.mark.parametrize("lab", all_labs(), ids=lambda lab: lab.name)
def test_all_that_a_grading_opens_is_known(lab: Lab, tmp_path: Path) -> None:
    """Modules, and files that lie beside them."""
    assert list(unknown(lab, opened_by_a_check(lab, tmp_path))) == []
