"""What can be wrong with the student's folders: one small type each, with its own next step."""

from __future__ import annotations

import errno
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from ros2_on_pip.errors import INCONCLUSIVE, RoslingsError
from ros2_on_pip.typed_paths import quoted, shown
from roslings.workspace.file_kinds import FileKind

MOST_NAMED = 5


class WorkspaceError(RoslingsError):
    """Something about the student's files that the student can mend.

    `problem` says what is, `next_step` what to do; both are whole sentences.
    """

    def __init__(self, problem: str, next_step: str) -> None:
        self.problem, self.next_step = problem, next_step
        super().__init__(f"{problem}\n{next_step}")


class MachineTrouble(WorkspaceError):
    """The disk or its permissions are in the way, not what the student wrote."""

    exit_status = INCONCLUSIVE


# --- which package is meant --------------------------------------------------------------------


class NoSuchPath(WorkspaceError):
    """The path does not exist."""

    def __init__(self, path: Path) -> None:
        super().__init__(
            f"There is no {shown(path)}.",
            "Look at the spelling. Without a path, your workspace is checked.",
        )


class NoWorkspace(WorkspaceError):
    """The workspace does not exist yet."""

    def __init__(self, path: Path, lab: str) -> None:
        super().__init__(
            f"There is no workspace yet: {shown(path)}.",
            f"Make it, with the lab's starter in it: ./roslings start {lab}",
        )


class NotBegun(WorkspaceError):
    """The workspace has no package for the lab; those of other labs may be there."""

    def __init__(self, lab: str, package: str, place: Path) -> None:
        super().__init__(
            f"The lab {lab!r} is not begun: there is no package {package!r} in\n{shown(place)}.",
            f"Get its starter: ./roslings start {lab}",
        )


class OfOtherLab(WorkspaceError):
    """The path means a package, and another lab asks for it."""

    def __init__(self, folder: Path, its_lab: str, lab: str) -> None:
        super().__init__(
            f"{shown(folder)}\nis the package of the lab {its_lab!r}, not of {lab!r}.",
            f"To check that package: ./roslings check {its_lab}\n"
            f"To begin {lab!r}: ./roslings start {lab}",
        )


class NotAFolder(WorkspaceError):
    """The path is a file."""

    def __init__(self, path: Path) -> None:
        super().__init__(
            f"{shown(path)} is a file, not a folder.",
            "Give the folder of your package: the one with package.xml in it.",
        )


UNPACK_IT = "Unpack it, and give the folder that comes out."
TO_HAND_IN = "To hand in: ./roslings pack LAB makes one zip file with nothing packed inside."
NOTHING_IN_IT = (
    "Nothing can come out of it. Pack the package anew: ./roslings pack LAB makes the file."
)


class Archive(WorkspaceError):
    """The path is a packed file."""

    def __init__(self, path: Path, kind: FileKind) -> None:
        super().__init__(
            f"{shown(path)} is {kind.name}, not a folder.",
            "Give the folder of your package itself." if kind.way == "nothing" else UNPACK_IT,
        )


class NoPackage(WorkspaceError):
    """No package.xml under the path."""

    def __init__(self, path: Path, name: str, lab: str = "LAB") -> None:
        super().__init__(
            f"There is no ROS package in {shown(path)}:\nno folder there has a package.xml.",
            f"Give the folder of the package {name!r},\nor get a starter: ./roslings start {lab}",
        )


class EmptyFolder(WorkspaceError):
    """Nothing at all is in the folder."""

    def __init__(self, folder: Path, name: str) -> None:
        super().__init__(
            f"{shown(folder)} is empty.",
            f"The folder of the package {name!r} belongs there, with package.xml in it.",
        )


class OnlyPacked(WorkspaceError):
    """No package is in the folder, but packed files are."""

    def __init__(self, folder: Path, found: Sequence[tuple[str, FileKind]]) -> None:
        (name, kind), *others = found
        self.what = f"{kind.name}: {name}" if not others else f"{len(found)} packed files"
        what = f"{self.what}{':' if others else '.'}"
        lines = [f"\n  {each}: {told.name}" for each, told in found[:MOST_NAMED] if others]
        can_be_unpacked = any(told.way != "nothing" for _, told in found)
        super().__init__(
            f"There is no ROS package in {shown(folder)}, but {what}{''.join(lines)}",
            f"{UNPACK_IT}\n{TO_HAND_IN}" if can_be_unpacked else NOTHING_IN_IT,
        )


class IgnoredByColcon(WorkspaceError):
    """A file in the folder tells colcon to pass it by."""

    def __init__(self, folder: Path, marker: str) -> None:
        super().__init__(
            f"{shown(folder)} has the file {marker}.\ncolcon builds nothing in such a folder.",
            f"Delete that file: rm {quoted(folder / marker)}",
        )


class OtherwiseForColcon(WorkspaceError):
    """The file colcon.pkg makes another package of it than package.xml does."""

    def __init__(self, folder: Path, problem: str) -> None:
        super().__init__(
            f"{shown(folder)} has a file colcon.pkg, and {problem}.\n"
            "colcon believes that file, not package.xml.",
            f"A lab's package needs no such file. Delete it: rm {quoted(folder / 'colcon.pkg')}",
        )


class NoPackageXml(WorkspaceError):
    """A folder that would be the package has no package.xml."""

    def __init__(self, folder: Path) -> None:
        super().__init__(
            f"{shown(folder)} has no package.xml.\nROS does not see a package there.",
            "Write package.xml, or get it from a new package: `ros2 pkg create` makes one.",
        )


class TwoPackages(WorkspaceError):
    """Several folders hold a package of the same name."""

    def __init__(self, name: str, folders: Iterable[Path]) -> None:
        places = "\n".join(f"  {shown(folder)}" for folder in folders)
        super().__init__(
            f"There are several packages named {name!r}:\n{places}",
            "Give the one that you mean as PATH. colcon builds none while there are two:\n"
            "move the other one out of the workspace.",
        )


class NamedOtherwise(WorkspaceError):
    """There are packages, but none of the name that the lab asks for."""

    def __init__(
        self, wanted: str, found: Sequence[tuple[str, Path]], lab: str | None = None
    ) -> None:
        self.found = list(found)
        places = "\n".join(f"  {name!r} in {shown(folder)}" for name, folder in found[:5])
        begin = f"\nIs it none for this lab? Get the starter: ./roslings start {lab}"
        super().__init__(
            f"There is no package named {wanted!r} here, but there is:\n{places}",
            "The name stands in package.xml, in the line <name>. It must be the one on the\n"
            "lab's card. Mend it there, in setup.py, in setup.cfg and in resource/."
            f"{begin if lab else ''}",
        )


class OnlyOtherLabs(WorkspaceError):
    """What was handed in holds packages, and other labs ask for all of them."""

    def __init__(self, wanted: str, found: Sequence[tuple[str, str]]) -> None:
        places = "\n".join(f"  {name!r}, of the lab {lab!r}" for name, lab in found[:5])
        super().__init__(
            f"There is no package named {wanted!r} here, but there is:\n{places}",
            "Hand in the package of this lab: ./roslings pack LAB makes the file.",
        )


class NoSetupPy(WorkspaceError):
    """The package has no setup.py, so it is no Python package."""

    def __init__(self, folder: Path, has_cmake: bool) -> None:
        kind = "\nIt has CMakeLists.txt: it is a package for C++." if has_cmake else ""
        super().__init__(
            f"{shown(folder)} has no setup.py.{kind}",
            "The lab asks for a Python package (ament_python), and those have a setup.py.\n"
            "`ros2 pkg create --build-type ament_python NAME` makes one.",
        )


class TooManyFolders(WorkspaceError):
    """The search for the package gave up."""

    def __init__(self, path: Path, limit: int) -> None:
        super().__init__(
            f"{shown(path)} holds more than {limit:,} folders: too many to search.",
            "Give the folder of your package as PATH.",
        )


class NotThere(WorkspaceError):
    """What was being worked on is not at its place any more."""

    def __init__(self, path: Path, anew: str) -> None:
        super().__init__(
            f"{shown(path)} is gone:\nit was deleted, renamed or moved away.",
            f"Put it back there. For a fresh one, in another terminal: {anew}",
        )


class NotAFile(WorkspaceError):
    """A folder, or something else, has the name that a file must have."""

    def __init__(self, path: Path) -> None:
        what = "a folder" if path.is_dir() else "no plain file"
        super().__init__(
            f"{shown(path)} is {what}, and must be a file.",
            "Give it another name, and save your program under this one.",
        )


class ChangedMeanwhile(WorkspaceError):
    """Something vanished, or became another thing, while it was being read."""

    def __init__(self, path: Path) -> None:
        super().__init__(
            f"{shown(path)} changed while it was read.",
            "Save it once more, so that it is read as it is now.",
        )


# --- what is in a package ----------------------------------------------------------------------


class LinkLeadsOutside(WorkspaceError):
    """A symbolic link leaves the package."""

    def __init__(self, link: Path, target: str) -> None:
        """`target` as it stands in the link: where that lies on this machine is nobody's matter."""
        super().__init__(
            f"{shown(link)} is a link to\n{target}, which leads outside the package.",
            "A package must hold its own files. Replace the link by a copy of the file.",
        )


class TooLarge(WorkspaceError):
    """The package holds more than a package of a lab ever does."""

    def __init__(self, folder: Path, largest: Path, size: str, limit: str) -> None:
        super().__init__(
            f"{shown(folder)} is too large:\n{size}. The limit is {limit}.",
            f"Move what is not code out of it. The largest part is\n{shown(largest)}",
        )


class FileTooLarge(WorkspaceError):
    """A file that is read to understand the package is longer than anybody writes it."""

    def __init__(self, file: Path, found: str, limit: str) -> None:
        super().__init__(
            f"{shown(file)} is too large to be read:\nit has {found}. The limit is {limit}.",
            f"Write it anew, short and plain. `ros2 pkg create` shows how such a file looks,\n"
            f"and what is not {file.name} belongs into another file.",
        )


class TooMuchToRead(WorkspaceError):
    """What a file holds takes more time or memory than any honest file does."""

    def __init__(self, file: Path, size: str, why: str) -> None:
        super().__init__(
            f"{shown(file)} ({size}) cannot be read:\n{why}.",
            "No file of a lab's package is like that. Write it anew, short and plain,\n"
            "or take it out of the package.",
        )


class PictureTooLarge(WorkspaceError):
    """A picture of more pixels than any screen has."""

    def __init__(self, file: Path, width: int, height: int, limit: int) -> None:
        super().__init__(
            f"{shown(file)} is too large to be looked at:\nit has {width} x {height} pixels,"
            f" {width * height / 1e6:,.1f} million. The limit is {limit / 1e6:g} million.",
            "Save it smaller. A whole 4K screen has 8.3 million.",
        )


class PictureTooSlow(WorkspaceError):
    """A picture that takes long to unpack."""

    def __init__(self, file: Path, bytes_of_it: int, limit_s: float) -> None:
        super().__init__(
            f"{shown(file)} ({bytes_of_it / 1e6:.1f} MB) cannot be looked at:\n"
            f"it takes more than {limit_s:g} s of a processor.",
            "Save it anew, as a plain PNG.",
        )


# --- what is in the way ------------------------------------------------------------------------


class TargetAlreadyThere(WorkspaceError):
    """Something stands where a starter or a zip would go; it stays as it is."""


class CannotRead(MachineTrouble):
    """A file or folder that this user may not read."""

    def __init__(self, path: Path) -> None:
        super().__init__(
            f"{shown(path)} cannot be read:\nyou do not have the permission.",
            f"Look at who owns it: ls -ld {quoted(path)}\n"
            "Never use sudo to build or edit: the files then belong to root.",
        )


class CannotWriteFolder(MachineTrouble):
    """A folder that this user may not write to."""

    def __init__(self, path: Path) -> None:
        super().__init__(
            f"{shown(path)} cannot be written:\nit is read-only, or it belongs to someone else.",
            f"Look at who owns it: ls -ld {quoted(path.parent)}\n"
            "Or choose another folder: the variable ROSLINGS_WS names your workspace.",
        )


class DiskFull(MachineTrouble):
    """No room is left."""

    def __init__(self, path: Path) -> None:
        super().__init__(
            f"The disk is full. This could not be written:\n{shown(path)}\nNothing was changed.",
            f"Make room, then try again. See how much there is: df -h {quoted(path.parent)}",
        )


_NO_ROOM = {errno.ENOSPC, errno.EDQUOT}
_NOT_ALLOWED = {errno.EACCES, errno.EPERM, errno.EROFS}


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """A block that writes at `path`: what the system refuses is told in our words."""
    try:
        yield
    except OSError as error:
        if error.errno in _NO_ROOM:
            raise DiskFull(path) from error
        if error.errno in _NOT_ALLOWED:
            raise CannotWriteFolder(path) from error
        if error.errno in {errno.ENOTDIR, errno.EEXIST}:
            raise NotAFolder(_file_on_the_way(path)) from error
        raise


@contextmanager
def reading(path: Path) -> Iterator[None]:
    """A block that reads `path`: what the system refuses is told in our words."""
    try:
        yield
    except PermissionError as error:
        raise CannotRead(Path(error.filename or path)) from error


def _file_on_the_way(path: Path) -> Path:
    return next((part for part in path.parents if part.is_file()), path)


def without_places(text: str, places: Iterable[Path]) -> str:
    """A text for somebody else: these folders of this machine are `submission` in it."""
    names = {
        name
        for place in places
        for path in (place, place.resolve())
        for name in (str(path), shown(path))
    }
    for name in sorted(names, key=len, reverse=True):
        text = text.replace(name, "submission")
    return text
