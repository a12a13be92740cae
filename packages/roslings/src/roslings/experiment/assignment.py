"""What the command asks of the measuring process."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from pydantic import BaseModel

from roslings.arena import ArenaPlace, Sandbox, User, Wall
from roslings.arena.users import give, let_in
from roslings.course.grader import Clock
from roslings.evidence import HeldBy, PackageSeen


class Assignment(BaseModel):
    """What is to be done with a package, once it is told which."""

    lab: str
    seed: int
    wall: Wall
    sandbox: Sandbox | None = None
    """What stands around each process of the student's, where the machine allows it."""
    user: User | None = None
    """Who the student's processes are, where they are not the grader's own user."""
    clock: Clock = "auto"
    folder: Path
    """The run's own folder: the staged source, the build, the nodes' home, the evidence."""
    keeps_bags: bool = False
    for_others: bool = False
    """Whether somebody believes the result who did not make it."""
    soak_s: float = 0.0
    """How long the nodes run among themselves, beside the experiments; 0: not at all."""
    only_soak: bool = False
    """No experiment is made."""
    port: Path | None = None
    """Where a real board is, when it is to take the place of the one in Python."""

    hidden: Path | None = None
    """A grader's file that students do not have; its experiments are run as well."""
    builds: Path | None = None
    """Where builds are shared between packages of equal content."""
    builds_from_cache: bool = False
    """Whether packages that differ in their modules alone share the work, too."""

    def source_of(self, package: PackageSeen) -> Path:
        """Where the copy of the package lies that is built."""
        return self.folder / "src" / package.name

    @property
    def errors(self) -> Path:
        """Where the measuring process writes its last words."""
        return self.folder / "stderr"

    @property
    def evidence(self) -> Path:
        """Where the measuring process puts what it saw."""
        return self.folder / "evidence.json"

    @property
    def bags(self) -> Path:
        """Where the measuring process puts a bag for each experiment, when asked to."""
        return self.folder / "bags"

    @property
    def held_by(self) -> HeldBy:
        """The wall between the student's code and whoever runs the command."""
        if self.sandbox:
            return "namespaces"
        return "user" if self.user else "none"

    @property
    def theirs(self) -> Path:
        """Where the folders are that the student's processes use; another user's lie apart."""
        return self.user.folder if self.user else self.folder

    @property
    def home(self) -> Path:
        """The nodes' HOME."""
        return self.theirs / "home"

    @property
    def devices(self) -> Path:
        """Where the boards and cameras are that nodes may use."""
        return self.theirs / "devices"

    @property
    def room(self) -> Path:
        """Where the package is built; behind a sandbox's walls it holds so much and no more."""
        return self.theirs / "room"

    @property
    def place(self) -> ArenaPlace:
        """Where the nodes live: in the room that the measuring process was put into."""
        around = replace(self.sandbox, terminals=True) if self.sandbox else None
        return ArenaPlace(self.wall, self.home, self.devices, around, user=self.user)

    def make_folders(self) -> None:
        """Those that all of this needs. Raises OSError."""
        for folder in (self.home, self.devices, self.room):
            folder.mkdir()
        if self.user:
            give(self.home, self.user.uid)
            let_in(self.devices, self.user.uid)
