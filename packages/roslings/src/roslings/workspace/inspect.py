"""What stands in a package's own files: read, never run."""

from __future__ import annotations

import configparser
import os
import sys
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from pathlib import Path

from roslings.arena.bounds import MB
from roslings.course import Card
from roslings.evidence import PackageSeen, PictureSeen
from roslings.workspace import code
from roslings.workspace.bounded import Bookmark, ReaderEnded, ReadingBounds, read_in_child
from roslings.workspace.documents import text_of
from roslings.workspace.errors import TooMuchToRead, reading
from roslings.workspace.manifest import read_manifest
from roslings.workspace.normal import digest_of_files
from roslings.workspace.packages import insist_on_small_files
from roslings.workspace.pictures import look_at
from roslings.workspace.sources import files, size

NOT_THE_PACKAGES_CODE = frozenset({"test", "tests", "launch", "resource"})

ROSDEP_KEYS = {
    "cv2": "python3-opencv",
    "serial": "python3-serial",
    "rosbag2_py": "rosbag2_py",
    "rosidl_runtime_py": "rosidl_runtime_py",
}
"""Modules to their names in package.xml. They are those that no ROS package brings (rosdep's list),
and those of ROS for which a package of ours can stand in. It does so where the real one is not
installed.

Not numpy: every message package of ROS brings it along.
"""


def ros_packages() -> frozenset[str]:
    """The ROS packages of this machine: those with a `share/NAME/package.xml`."""
    prefixes = [*os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep), sys.prefix]
    shares = [Path(prefix) / "share" for prefix in prefixes if prefix]
    return frozenset(
        manifest.parent.name for share in shares for manifest in share.glob("*/package.xml")
    )


def inspect_package(folder: Path, card: Card, known: Collection[str] | None = None) -> PackageSeen:
    """Read a package against its card; `known` are the ROS packages there are.

    `imported` names only code that other nodes could run: not tests, not setup.py. Raises what
    `sources` raises: links that leave the package, too much in it, no permission; and FileTooLarge,
    TooMuchToRead, PictureTooLarge, PictureTooSlow.
    """

    def read(bookmark: Bookmark) -> str:
        return read_package(folder, card, bookmark, known).model_dump_json()

    return PackageSeen.model_validate_json(read_bounded(folder, read))


def read_bounded(folder: Path, read: Callable[[Bookmark], str]) -> str:
    """What `read` says of a package, read in a child. Raises what `inspect_package` raises."""
    files(folder)
    insist_on_small_files(folder)
    with reading(folder):
        try:
            return read_in_child(read)
        except ReaderEnded as ended:
            raise _too_much(folder, ended) from ended


WHY = {
    "time": f"it takes more than {ReadingBounds.cpu_s} s of a processor",
    "memory": f"it takes more than {ReadingBounds.memory_bytes // MB} MB of memory",
    "crash": f"Python itself breaks off at it: it takes more than"
    f" {ReadingBounds.memory_bytes // MB} MB of memory, or is nested too deeply",
}


def _too_much(folder: Path, ended: ReaderEnded) -> TooMuchToRead:
    file = folder / ended.at
    found = size(file.stat().st_size) if file.is_file() else "the package"
    return TooMuchToRead(file, found, WHY.get(ended.met, f"reading it broke off ({ended.words})"))


def read_package(
    folder: Path, card: Card, bookmark: Bookmark, known: Collection[str] | None = None
) -> PackageSeen:
    """As `inspect_package`, in this process: for a child that is bounded."""
    found = Marked(files(folder), bookmark)
    return _inspect(folder, card, found, ros_packages() if known is None else known)


class Marked(dict[str, Path]):
    """The files of a package; who takes one out is about to read it."""

    def __init__(self, found: Mapping[str, Path], bookmark: Bookmark) -> None:
        super().__init__(found)
        self._bookmark = bookmark

    def note(self, name: str) -> None:
        """This file is read next."""
        self._bookmark.put(name)

    def noted(self, names: Iterable[str]) -> Iterator[tuple[str, Path]]:
        """These files, one after the other."""
        for name in names:
            self.note(name)
            yield name, self[name]


def _inspect(folder: Path, card: Card, found: Marked, known: Collection[str]) -> PackageSeen:
    found.note("package.xml")
    manifest = read_manifest(folder)
    python = [name for name in found if _is_code(name)]
    found.note("setup.py")
    setup, setup_errors = _read_setup(found.get("setup.py"))
    found.note("setup.cfg")
    disagreements = _disagreements(card.package, manifest.name, setup, found)
    return PackageSeen(
        name=manifest.name,
        folder=folder.name,
        build_type=manifest.build_type,
        xml_problems=manifest.problems + disagreements,
        missing_files=list(_missing(card.package, setup, found)),
        syntax_errors=[*setup_errors, *_syntax_errors(found.noted(python))],
        declared=manifest.declared,
        imported=_imported(found.noted(python), known, card.package),
        entry_points=setup.console_scripts,
        pictures=dict(_pictures(folder, card, found)),
        documents={
            name: text_of(path)
            for name, path in found.noted(each for each in card.documents if each in found)
        },
        content=digest_of_files(found.noted(found)),
    )


def _is_code(name: str) -> bool:
    """A Python file in one of the package's modules."""
    top, slash, _ = name.partition("/")
    return bool(slash) and name.endswith(".py") and top not in NOT_THE_PACKAGES_CODE


def _read_setup(path: Path | None) -> tuple[code.Setup, list[str]]:
    try:
        return (code.read_setup(code.parse(path)) if path else code.Setup()), []
    except code.NotPython as error:
        return code.Setup(), [f"setup.py:{error}"]


def _syntax_errors(python: Iterable[tuple[str, Path]]) -> Iterator[str]:
    for name, path in python:
        try:
            code.parse(path)
        except code.NotPython as error:
            yield f"{name}:{error}"


def _imported(
    python: Iterable[tuple[str, Path]], known: Collection[str], own: str
) -> dict[str, str]:
    """Each package that package.xml must name to the first place where it is imported."""
    found: dict[str, str] = {}
    for name, path in python:
        try:
            imports = sorted(code.imports(code.parse(path)), key=lambda pair: pair[1])
        except code.NotPython:  # told as an error of syntax
            continue
        for module, line in imports:
            package = ROSDEP_KEYS.get(module, module)
            if (package in known or module in ROSDEP_KEYS) and package != own:
                found.setdefault(package, f"{name}:{line}")
    return found


def _missing(package: str, setup: code.Setup, found: dict[str, Path]) -> Iterator[str]:
    """The files of every ament_python package that are not there."""
    marker = next(iter(setup.markers), f"resource/{package}")
    wanted = ("setup.py", "setup.cfg", marker, f"{package}/__init__.py")
    return (name for name in dict.fromkeys(wanted) if name not in found)


def _disagreements(wanted: str, named: str, setup: code.Setup, found: dict[str, Path]) -> list[str]:
    """Where two files do not say the same name."""
    problems = []
    if named != wanted:
        problems.append(f"package.xml says the name is {named}; the card says {wanted}")
    if setup.name not in (None, named):
        problems.append(f"setup.py says the name is {setup.name}; package.xml says {named}")
    if "setup.cfg" in found:
        problems += setup_cfg_problems(found["setup.cfg"], wanted)
    return problems


def setup_cfg_problems(path: Path, package: str) -> list[str]:
    """Why `ros2 run` would find nothing, in words; one line at most."""
    try:
        folders = code.script_folders(path)
    except (configparser.Error, UnicodeDecodeError) as error:
        return [f"setup.cfg cannot be read: {str(error).splitlines()[0]}"]
    wanted = f"$base/lib/{package}"
    for section in ("develop", "install"):
        said = folders.get(section)
        if said is None:
            return [f"setup.cfg has no folder for executables under [{section}]: {wanted}"]
        if said.rstrip("/") != wanted:
            return [f"setup.cfg says {said} under [{section}]; ROS looks into {wanted}"]
    return []


def _pictures(folder: Path, card: Card, found: Marked) -> Iterator[tuple[str, PictureSeen]]:
    for contract in card.pictures:
        found.note(contract.path)
        seen = look_at(folder, contract)
        if seen:
            yield contract.path, seen
