"""What can be wrong with a bag, in words that name the next step."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path


class BagError(Exception):
    """A bag cannot be read or written; its text says why, and what to do."""


class NoBag(BagError):
    """There is no bag at the path."""

    def __init__(self, path: Path, reason: str) -> None:
        super().__init__(
            f"no bag can be read at '{path}': {reason}."
            " A bag is a folder with metadata.yaml in it; give the path of that folder."
        )


class NoPath(BagError):
    """An empty text is the path of nothing."""

    def __init__(self) -> None:
        super().__init__("the uri is empty. Give the path of the bag's folder")


class UnknownStorage(BagError):
    """Nobody has a storage of this name."""

    def __init__(self, asked: str, known: Iterable[str]) -> None:
        super().__init__(
            f"no storage could be initialized: there is no storage '{asked}', only"
            f" {' and '.join(known)}"
        )


class OtherStorage(BagError):
    """The bag is stored in another way than it was asked to be read."""

    def __init__(self, file: Path, found: str, asked: str) -> None:
        super().__init__(
            f"no storage could be initialized: '{file}' is stored as {found}, and cannot be opened"
            f" as {asked}. With an empty storage_id, the reader finds out by itself"
        )


class NoMetadata(BagError):
    """The messages are there, and the list of contents is not: the recording was killed."""

    def __init__(self, folder: Path) -> None:
        super().__init__(
            f"the bag '{folder}' has no metadata.yaml: its recording was cut off before the end."
            f" Make it whole with: ros2 bag reindex {folder}"
        )


class DamagedBag(BagError):
    """A file of the bag is not what it should be."""

    def __init__(self, path: Path, reason: str) -> None:
        super().__init__(
            f"the bag '{path}' is damaged: {reason}. To save what is left of it:"
            f" ros2 bag reindex {path if path.is_dir() else path.parent}"
        )


class BagThere(BagError):
    """A folder of that name exists; nothing is overwritten."""

    def __init__(self, folder: Path) -> None:
        super().__init__(f"Output folder '{folder}' already exists. Choose another one with -o")


class BagNotWritable(BagError):
    """The disk is full, or the place is not ours."""

    def __init__(self, folder: Path, fault: Exception) -> None:
        super().__init__(
            f"cannot write the bag '{folder}': {reason_of(fault)}."
            " Make room there, or choose another place with -o"
        )


class TooSmall(BagError):
    """A bag cannot be split into files of that size."""

    def __init__(self, size: int, least: int) -> None:
        super().__init__(
            f"Invalid bag splitting size given. Please provide a value greater than {least}."
            f" Specified value of {size}"
        )


class BadBagPath(BagError):
    """SQLite takes these letters of a path for its own."""

    def __init__(self, folder: Path) -> None:
        super().__init__(
            f"a bag of storage sqlite3 cannot lie at '{folder.absolute()}': none of ? # % may be in"
            " the path. Choose another place with -o, or -s mcap"
        )


def reason_of(fault: BaseException) -> str:
    """The first line of what a library says."""
    if isinstance(fault, OSError) and fault.strerror:
        return fault.strerror
    return (str(fault) or type(fault).__name__).splitlines()[0].rstrip(".")
