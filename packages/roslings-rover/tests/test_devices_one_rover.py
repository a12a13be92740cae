"""A cell's rover is alone on /cmd_vel; two of terminals tell of each other, and stay."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from ros2_on_pip.domain_lease import leased_domain
from roslings_rover.rover.one_rover import (
    RoverInCell,
    RoverThere,
    rover_of_cell,
    rover_of_terminal,
)
from sources import python_path

OTHER = """
from roslings_rover.rover.one_rover import rover_of_{kind}
with rover_of_{kind}():
    print("it runs", flush=True)
    input()
"""


@pytest.fixture(autouse=True)
def domain(monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """Nobody else's."""
    with leased_domain() as found:
        monkeypatch.setenv("ROS_DOMAIN_ID", str(found))
        yield found


@contextmanager
def another(kind: str, domain: int) -> Iterator[subprocess.Popen[str]]:
    """A rover in another process."""
    with subprocess.Popen(
        [sys.executable, "-c", OTHER.format(kind=kind)],
        text=True,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env={"PYTHONPATH": python_path(), "ROS_DOMAIN_ID": str(domain)},
    ) as process:
        assert process.stdout and process.stdout.readline() == "it runs\n"
        yield process
        process.kill()


def test_a_cell_waits_for_the_rover_of_a_terminal(domain: int) -> None:
    """With what to do; as soon as the other has ended, however, it starts."""
    with another("terminal", domain), pytest.raises(RoverThere, match="End the other one"):
        rover_of_cell().__enter__()
    with rover_of_cell():
        pass


def test_a_terminal_waits_for_the_rover_of_a_cell(domain: int) -> None:
    """And so does another cell."""
    with another("cell", domain):
        with pytest.raises(RoverInCell, match=f"domain {domain}"):
            rover_of_terminal().__enter__()
        with pytest.raises(RoverThere):
            rover_of_cell().__enter__()
    with rover_of_terminal():
        pass


def test_who_was_refused_is_not_in_the_way(domain: int) -> None:
    """A refused one leaves nothing that others would see."""
    with another("terminal", domain), pytest.raises(RoverThere):
        rover_of_cell().__enter__()
    with another("terminal", domain), rover_of_terminal():
        pass


def test_other_domains_are_other_rooms(domain: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Domain 1 is not in the way of domain 11."""
    with another("terminal", 11):
        monkeypatch.setenv("ROS_DOMAIN_ID", "1")
        with rover_of_cell():
            pass
