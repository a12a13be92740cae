"""The course's own message types, kept with the environment.

On the wheels they come built with the course, and are put into the environment itself, as the types
of a wheel are. What does not fit is built here, once. So is all beside a sourced ROS. There it lies
in the folder `overlay`, which `./roslings` and `setup.bash` add to the paths.
"""

import hashlib
import os
import shutil
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from roslings_launcher.built_interfaces import PYTHON, BuiltPackage, fitting, run_on
from roslings_launcher.errors import say
from roslings_launcher.interface_build import InterfaceBuild
from roslings_launcher.interface_sources import files_of, packages_of
from roslings_launcher.machine import this_machine
from roslings_launcher.place import CoursePlace
from roslings_launcher.progress import going_on
from roslings_launcher.virtual import Virtual

GROUP = "interfaces"
"""What a card asks for: the course's own types are there."""
GENERATORS = "generators"
"""What builds message types: needed where some do not come built, and for a student's own."""
PARTS = ("include", "lib", "share")
MANIFEST = "package.xml"
_STAMP = "interfaces.stamp"


@dataclass(frozen=True)
class Interfaces:
    """The packages of types in the course of `place`, and their place in `virtual`."""

    place: CoursePlace
    virtual: Virtual
    sourced: bool
    """A ROS is sourced, and brings what the build needs."""

    @property
    def build(self) -> InterfaceBuild:
        """What builds those that do not come built."""
        return InterfaceBuild(self.place, self.virtual, self.sourced)

    @property
    def sources(self) -> list[Path]:
        """The folder of each package that the environment needs: a sourced ROS may bring some."""
        return [folder for folder in packages_of(self.place.root) if not self._brought(folder.name)]

    def _brought(self, package: str) -> bool:
        prefixes = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if self.sourced else ()
        others = (Path(prefix) for prefix in prefixes if prefix and Path(prefix) != self.prefix)
        return any((prefix / "share" / package).is_dir() for prefix in others)

    @cached_property
    def come_built(self) -> list[BuiltPackage]:
        """Those that nothing is compiled for here."""
        if self.sourced or not run_on(this_machine()):
            return []
        found = (fitting(self.place.root, source) for source in self.sources)
        return [each for each in found if each]

    @property
    def to_build(self) -> list[Path]:
        """The folder of each package that must be compiled here."""
        built = {each.package for each in self.come_built}
        return [source for source in self.sources if source.name not in built]

    @property
    def prefix(self) -> Path:
        """Where they are installed."""
        return self.virtual.folder / "overlay" if self.sourced else self.virtual.folder

    @property
    def stand(self) -> bool:
        """They are there as their sources and the pins now are."""
        try:
            return self._stamp.read_text(encoding="utf-8") == self._fingerprint()
        except OSError:
            return False

    def provide(self) -> None:
        """Afterwards they stand.

        Raises:
            LauncherTrouble: some must be built, and there is no compiler, or the build failed.
        """
        if not self.sources or self.stand:
            return
        if self.to_build:
            self.build.require_compiler()
            self.build.require_headers()
        self._stamp.unlink(missing_ok=True)
        self._remove()
        with tempfile.TemporaryDirectory(prefix="roslings-") as scratch:
            self._unpack(Path(scratch))
            if self.to_build:
                self.build.prepare()  # what came built names the machine it was made on, too
                self._compile(Path(scratch))
        self._stamp.write_text(self._fingerprint(), encoding="utf-8")

    @property
    def _stamp(self) -> Path:
        return self.virtual.folder / _STAMP

    def _fingerprint(self) -> str:
        """The same for the same sources, pins and Python."""
        sums = [hashlib.sha256(self.place.constraints.read_bytes()).hexdigest()]
        for name, file in files_of(self.place.root):
            sums.append(f"{hashlib.sha256(file.read_bytes()).hexdigest()} {name}")
        return "\n".join([self.virtual.site.parent.name, str(self.sourced), *sums]) + "\n"

    def _remove(self) -> None:
        """What was there before: a library under an older name would be taken for the new one."""
        for entry in self._installed():
            if entry.is_dir() and not entry.is_symlink():
                shutil.rmtree(entry)
            else:
                entry.unlink()

    def _installed(self) -> Iterator[Path]:
        for package in (source.name for source in self.sources):
            for pattern in (
                f"include/{package}",
                f"lib/lib{package}__*",
                f"lib/python3*/*-packages/{package}",
                f"lib/python3*/*-packages/{package}-*.egg-info",
                f"share/{package}",
                f"share/ament_index/*/*/{package}",
            ):
                yield from self.prefix.glob(pattern)

    def _unpack(self, scratch: Path) -> None:
        for package in self.come_built:
            made = package.unpack(scratch / "built" / package.package)
            site = made / self.virtual.site.relative_to(self.virtual.folder)
            site.parent.mkdir(parents=True)
            (made / PYTHON).rename(site)
            self._add_manifest(package.package, made)
            self._install(made)

    def _add_manifest(self, package: str, made: Path) -> None:
        """It lies with the sources; by it, who asks for the ROS packages of a machine finds one."""
        source = next(each for each in self.sources if each.name == package)
        share = made / "share" / package
        share.mkdir(parents=True, exist_ok=True)
        shutil.copy2(source / MANIFEST, share / MANIFEST)

    def _compile(self, scratch: Path) -> None:
        names = ", ".join(source.name for source in self.to_build)
        say(f"Building the message types of {names}, once. This takes about half a minute.")
        with going_on(lambda: "Building"):
            self._install(self.build.build(self.to_build, scratch))

    def _install(self, made: Path) -> None:
        """Into the prefix, without the setup scripts that colcon writes beside."""
        for part in PARTS:
            if (made / part).is_dir():
                shutil.copytree(
                    made / part, self.prefix / part, copy_function=_put, dirs_exist_ok=True
                )


def _put(file: str, to: str) -> None:
    """In place of what is there: a program that has loaded a library keeps the old one."""
    new = Path(f"{to}.new")
    shutil.copy2(file, new)
    new.replace(to)
