"""Message types that come built with the course: no compiler is asked for, and nothing fetched.

What Python needs of message types is compiled code. For the course's own types it is made once,
against Python's stable ABI, so that one archive serves each Python. A package of ours has it, as
`interfaces/built/PACKAGE.tar.gz`. PACKAGE.json beside it says what it was made of; where that is
not what is here, the types are built here. `roslings_prove.built_interfaces` makes both.
"""

import hashlib
import json
import tarfile
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from pathlib import Path

from roslings_launcher import constraints
from roslings_launcher.errors import LauncherTrouble
from roslings_launcher.interface_sources import files_in
from roslings_launcher.machine import WheelPlatform, require_wheels

FOLDER = "packages/*/src/*/interfaces/built"
PYTHON = "python"
"""What goes where Python's packages lie: that folder has another name for each Python."""
_ENDING = ".tar.gz"
_RUNTIME = "ros-"
"""How the packages of ROS are called that the compiled code is linked with."""


@dataclass(frozen=True)
class InterfacesOrigin:
    """What a package of types was built from."""

    sources: str
    """A digest of its files."""
    ros: str
    """A digest of the pins of ROS, whose libraries it is linked with."""


@dataclass(frozen=True)
class BuiltPackage:
    """The archive of one package."""

    archive: Path
    origin: InterfacesOrigin
    digest: str
    """Of the archive."""
    made_with: str
    """The compiler and the Python."""

    @property
    def package(self) -> str:
        """Its name."""
        return self.archive.name.removesuffix(_ENDING)

    @property
    def is_whole(self) -> bool:
        """The archive is the one that was made."""
        return self.archive.is_file() and digest_of_file(self.archive) == self.digest

    def unpack(self, folder: Path) -> Path:
        """Its files in the new folder `folder`: include, lib, share and `PYTHON`."""
        with tarfile.open(self.archive) as packed:
            if hasattr(tarfile, "data_filter"):
                packed.extraction_filter = tarfile.data_filter
            packed.extractall(folder)
        return folder

    def tell(self) -> None:
        """Write what it says of itself."""
        told = {"made_with": self.made_with, "archive": self.digest, **asdict(self.origin)}
        text = json.dumps(told, indent=2, sort_keys=True)
        _told_of(self.archive).write_text(f"{text}\n", encoding="utf-8")


def in_folder(folder: Path, package: str) -> BuiltPackage | None:
    """The package that lies built in `folder`; None where there is none."""
    archive = archive_of(folder, package)
    try:
        told = json.loads(_told_of(archive).read_text(encoding="utf-8"))
        origin = InterfacesOrigin(told["sources"], told["ros"])
        return BuiltPackage(archive, origin, told["archive"], told["made_with"])
    except (OSError, ValueError, KeyError):
        return None


def archive_of(folder: Path, package: str) -> Path:
    """Where in `folder` a package lies built."""
    return folder / f"{package}{_ENDING}"


def fitting(root: Path, source: Path) -> BuiltPackage | None:
    """What comes built of the package in `source`, where it fits the course in `root`.

    None: its files or the pins of ROS are others than it was made of.
    """
    found = [in_folder(folder, source.name) for folder in sorted(root.glob(FOLDER))]
    here = origin_of(source, root / "constraints.txt")
    return next((each for each in found if each and each.origin == here and each.is_whole), None)


def run_on(machine: WheelPlatform) -> bool:
    """They are made for the machines that the wheels of ROS are made for."""
    try:
        require_wheels(machine)
    except LauncherTrouble:
        return False
    return True


def origin_of(source: Path, pins: Path) -> InterfacesOrigin:
    """Of the package in `source`, as it now is, on the ROS that `pins` names."""
    files = (f"{name} {digest_of_file(file)}" for name, file in files_in(source) if _counts(file))
    ros = (line for line in constraints.of_groups(pins, ["ros"]) if line.startswith(_RUNTIME))
    return InterfacesOrigin(_digest_of(files), _digest_of(ros))


def digest_of_file(file: Path) -> str:
    """Of its bytes."""
    return hashlib.sha256(file.read_bytes()).hexdigest()


def _digest_of(lines: Iterable[str]) -> str:
    return hashlib.sha256("\n".join(sorted(lines)).encode()).hexdigest()


def _counts(file: Path) -> bool:
    return "__pycache__" not in file.parts


def _told_of(archive: Path) -> Path:
    return archive.with_name(archive.name.removesuffix(_ENDING) + ".json")
