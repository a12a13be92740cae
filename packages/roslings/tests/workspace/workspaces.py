"""Real packages in real folders, and ways to take a process's rights and room away."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

import pytest
from hardship import WITHOUT_RIGHTS, Run, python

from roslings.course import Card, Lab, lab
from skips import skip_without


@pytest.fixture
def topics() -> Lab:
    """The lab topics."""
    return lab("topics")


@pytest.fixture
def card(topics: Lab) -> Card:
    """Its card."""
    return topics.card


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The student's workspace: not there yet, and under a path that a student may have."""
    path = tmp_path / "Zoë's ROS" / "roslings_ws"
    monkeypatch.setenv("ROSLINGS_WS", str(path))
    return path


@pytest.fixture
def package(topics: Lab, workspace: Path) -> Path:
    """A package as good as the solution, in the workspace."""
    path = workspace / "src" / "chatter"
    shutil.copytree(topics.solution, path)
    return path


@pytest.fixture
def without_rights() -> Run:
    """Runs a piece of Python to which file permissions apply, whoever runs the tests."""

    def run(source: str, *arguments: Path) -> str:
        return python([sys.executable, "-c", WITHOUT_RIGHTS], source, *arguments)

    return run


@pytest.fixture
def with_little_room(tmp_path: Path) -> Run:
    """Runs a piece of Python where the folder `little` has 64 kB of room."""
    little = tmp_path / "little"
    little.mkdir()
    inside = f'mount -t tmpfs -o size=64k little "{little}" && exec "$@"'
    command = ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c", inside, "sh"]
    skip_without("small disk")

    def run(source: str, *arguments: Path) -> str:
        return python([*command, sys.executable, "-c"], source, little, *arguments)

    return run
