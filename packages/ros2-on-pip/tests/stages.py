"""`ros2` in processes of its own, on a domain of its own, beside real nodes."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from terminal import HERE, Shell, surroundings

from ros2_on_pip.domain_lease import leased_domain

STAGE = HERE / "nodes" / "stage.py"


@pytest.fixture(scope="package")
def stage(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Shell]:
    """A terminal on a domain where the nodes of `nodes/stage.py` run."""
    home = tmp_path_factory.mktemp("home")
    with leased_domain() as domain:
        shell = Shell(surroundings(domain, home), home)
        with shell.program(
            [sys.executable, str(STAGE)], ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST"
        ) as nodes:
            nodes.wait_for("ready")
            shell.nodes = nodes
            yield shell


@pytest.fixture
def empty(tmp_path: Path) -> Iterator[Shell]:
    """A terminal on a domain where nothing runs."""
    with leased_domain() as domain:
        yield Shell(surroundings(domain, tmp_path), tmp_path)


@pytest.fixture(scope="session")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Shell]:
    """A terminal on a domain where the nodes of `nodes/workshop.py` run."""
    home = tmp_path_factory.mktemp("workshop")
    with leased_domain() as domain:
        shell = Shell(surroundings(domain, home), home)
        with shell.program(
            [sys.executable, str(STAGE.with_name("workshop.py"))],
            ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST",
        ) as nodes:
            nodes.wait_for("ready")
            yield shell
