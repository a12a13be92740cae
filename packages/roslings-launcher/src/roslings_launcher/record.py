"""What an environment remembers about itself, in `roslings/` inside it.

    home              the course's folder when the environment was made
    constraints.txt   the pins it was installed from, and pyproject.toml its groups
    entry_points.txt  what the course's own packages offer, file behind file
    groups/NAME       an empty file for each group that is installed
    libraries         what LD_LIBRARY_PATH needs for the ROS wheels; empty without them
    interfaces/       the course's own message types as they were put there: sources, built ones
    bytecode          an empty file: all packages are compiled

The script `./roslings` reads the same files. A record is there only while all of it is true. It is
put aside before the first change and comes back, in one step, after the last. Where packages are
only added it stays, for what it tells stays true, and others go on meanwhile. A file beside it says
that some may be half there.
"""

import filecmp
import os
import shutil
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from roslings_launcher.interface_sources import files_of
from roslings_launcher.interfaces import GROUP
from roslings_launcher.place import CoursePlace
from roslings_launcher.sources import OFFERS, offers_as_written

BYTECODE = "bytecode"


@dataclass(frozen=True)
class EnvironmentRecord:
    """The record of the environment in `place`."""

    place: CoursePlace

    @property
    def _folder(self) -> Path:
        return self.place.environment / "roslings"

    @property
    def _aside(self) -> Path:
        return self.place.environment / "roslings.aside"

    @property
    def complete(self) -> bool:
        """Whether the last change came to its end."""
        return self._folder.is_dir()

    @property
    def is_added_to(self) -> bool:
        """Packages are on their way beside those of the record, or were when that ended."""
        return self._adding.exists()

    @property
    def _adding(self) -> Path:
        return self.place.environment / "roslings.adding"

    def begin_adding(self) -> None:
        """From here to `write`, packages beside those of the record may be half there."""
        self._adding.touch()

    @property
    def home(self) -> Path | None:
        """Where the environment was made; None where nothing is known."""
        for folder in (self._folder, self._aside):
            if (folder / "home").is_file():
                return Path((folder / "home").read_text().removesuffix("\n"))
        return None

    @property
    def groups(self) -> frozenset[str]:
        """The groups installed, or on their way when a change was interrupted."""
        folders = (self._folder / "groups", self._aside / "groups")
        return frozenset(file.name for f in folders if f.is_dir() for file in f.iterdir())

    def holds(self, groups: Iterable[str]) -> bool:
        """Whether `groups` are installed as the course now pins them."""
        return (
            self.complete
            and (self._folder / BYTECODE).exists()  # an older bootstrap left it to each build
            and self.groups >= set(groups)
            and all(self._same(file) for file in (self.place.constraints, self.place.pyproject))
            and self._offers_stand()
            and (GROUP not in groups or self._types_stand())
        )

    def _offers_stand(self) -> bool:
        try:
            kept = (self._folder / OFFERS).read_text(encoding="utf-8")
        except OSError:
            return False
        return kept == offers_as_written(self.place.root)

    def _types_stand(self) -> bool:
        kept = self._folder / GROUP
        return all(_alike(file, kept / name) for name, file in files_of(self.place.root))

    def _same(self, file: Path) -> bool:
        return _alike(file, self._folder / file.name)

    def put_aside(self) -> None:
        """From here to `write`, the environment counts as unfinished."""
        if self.complete:
            shutil.rmtree(self._aside, ignore_errors=True)
            self._folder.rename(self._aside)

    def write(self, groups: Iterable[str], libraries: Iterable[Path]) -> None:
        """The environment is finished and compiled, and all its files are on the disk."""
        new = self.place.environment / "roslings.new"
        shutil.rmtree(new, ignore_errors=True)
        (new / "groups").mkdir(parents=True)
        (new / BYTECODE).touch()
        groups = set(groups)
        for group in groups:
            (new / "groups" / group).touch()
        for file in (self.place.constraints, self.place.pyproject):
            shutil.copyfile(file, new / file.name)
        (new / OFFERS).write_text(offers_as_written(self.place.root), encoding="utf-8")
        if GROUP in groups:
            self._keep_types(new / GROUP)
        (new / "home").write_text(f"{self.place.root}\n")
        (new / "libraries").write_text(":".join(map(str, libraries)) + "\n")
        os.sync()  # after a power cut, a record must not outlive the files it speaks of
        self.put_aside()
        new.rename(self._folder)
        shutil.rmtree(self._aside, ignore_errors=True)
        self._adding.unlink(missing_ok=True)

    def _keep_types(self, folder: Path) -> None:
        for name, file in files_of(self.place.root):
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, folder / name)


def _alike(file: Path, copy: Path) -> bool:
    return copy.is_file() and filecmp.cmp(file, copy, shallow=False)
