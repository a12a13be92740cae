"""What the command asks of the measuring process."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from pydantic import BaseModel

from roslings.arena import Place, Sandbox, Wall
from roslings.evidence import PackageSeen
from roslings.experiment.declare import Clock


class Assignment(BaseModel):
    """One package to measure; both processes read it from a file in the run's folder."""

    lab: str
    seed: int
    wall: Wall
    sandbox: Sandbox | None = None
    """What stands around each process of the student's, where the machine allows it."""
    clock: Clock = "auto"
    folder: Path
    """The run's own folder: the staged source, the build, the nodes' home, the evidence."""
    package: PackageSeen
    keeps_bags: bool = False
    port: Path | None = None
    """Where a real board is, when it is to take the place of the one in Python."""

    hidden: Path | None = None
    """A grader's file that students do not have; its experiments are run as well."""
    builds: Path | None = None
    """Where builds are shared between packages of equal content."""

    @property
    def file(self) -> Path:
        """Where the assignment itself lies."""
        return self.folder / "assignment.json"

    @property
    def evidence(self) -> Path:
        """Where the measuring process puts what it saw."""
        return self.folder / "evidence.json"

    @property
    def bags(self) -> Path:
        """Where the measuring process puts a bag for each experiment, when asked to."""
        return self.folder / "bags"

    @property
    def home(self) -> Path:
        """The nodes' HOME."""
        return self.folder / "home"

    @property
    def devices(self) -> Path:
        """Where the boards and cameras are that nodes may use."""
        return self.folder / "devices"

    @property
    def room(self) -> Path:
        """Where the package is built; behind a sandbox's walls it holds so much and no more."""
        return self.folder / "room"

    @property
    def place(self) -> Place:
        """Where the nodes live: in the room that the measuring process was put into."""
        around = replace(self.sandbox, terminals=True) if self.sandbox else None
        return Place(self.wall, self.home, self.devices, around)

    def make_folders(self) -> None:
        """Those that all of this needs. Raises OSError."""
        for folder in (self.home, self.devices, self.room):
            folder.mkdir()
