"""Read a bag, with words for what can be wrong with it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ros2_on_pip.rosbag2.errors import DamagedBag, NoBag, NoMetadata, reason_of
from ros2_on_pip.rosbag2.metadata import NAME, ROOT, File, Metadata, from_plain
from ros2_on_pip.rosbag2.packing import BROKEN
from ros2_on_pip.rosbag2.reindexing import (
    STORAGES,
    require_storage,
    span_of,
    storage_files,
    storage_of,
    topics_of,
)

Message = tuple[str, int, bytes]
"""The topic, when the message came (ns since 1970), and its bytes as ROS serialises them."""


class BagReader:
    """An open bag: what it holds, and its messages in the order in which they came."""

    def __init__(self, path: Path, reader: Any, metadata: Metadata) -> None:
        self.path, self.metadata = path, metadata
        self._reader = reader

    def close(self) -> None:
        """Whatever is open."""
        self._reader.close()

    @property
    def definitions(self) -> dict[str, Any]:
        """Name of a type to its definition, as `rosbags` keeps it."""
        return {each.msgtype: each for each in self._reader.connections}

    def messages(
        self, takes: Callable[[str, str], bool] = lambda _name, _type: True, start_ns: int = 0
    ) -> Iterator[Message]:
        """Of the topics whose name and type `takes` likes, from `start_ns` on.

        Raises DamagedBag.
        """
        chosen = [c for c in self._reader.connections if takes(c.topic, c.msgtype)]
        if not chosen:
            return
        try:
            for connection, time_ns, raw in self._reader.messages(chosen, start=start_ns):
                yield connection.topic, time_ns, bytes(raw)
        except _faults() as fault:
            raise DamagedBag(self.path, reason_of(fault)) from fault


@contextmanager
def opened(path: Path, asked: str = "") -> Iterator[BagReader]:
    """The bag at `path`, a folder or one of its files. `asked`: the storage that it must have.

    Raises NoBag, NoMetadata, DamagedBag, UnknownStorage, OtherStorage.
    """
    reader = open_bag(path, asked)
    try:
        yield reader
    finally:
        reader.close()


def open_bag(path: Path, asked: str = "") -> BagReader:
    """The same, for those who close it themselves."""
    from rosbags.rosbag2 import Reader

    _require(path)
    require_storage(_files_of(path) if asked else (), asked)
    try:
        reader = Reader(path)
        reader.open()
        return BagReader(path, reader, _metadata(path, reader))
    except _faults() as fault:
        raise DamagedBag(path, reason_of(fault)) from fault


def _require(path: Path) -> None:
    if not path.exists():
        raise NoBag(path, "there is nothing of that name")
    if path.is_file() and path.suffix not in STORAGES:
        raise NoBag(path, "the file is neither .mcap nor .db3")
    if path.is_dir() and not (path / NAME).exists():
        raise NoMetadata(path) if storage_files(path) else NoBag(path, "metadata.yaml is not there")


def _files_of(path: Path) -> list[Path]:
    """Where its messages lie; of a folder, what metadata.yaml lists."""
    return [path / file.name for file in read_metadata(path).files] if path.is_dir() else [path]


def _faults() -> tuple[type[Exception], ...]:
    """What `rosbags` and those below it raise where a file is damaged."""
    import struct

    import apsw
    from rosbags.rosbag2 import ReaderError

    return (
        ReaderError,
        OSError,
        ValueError,
        KeyError,
        TypeError,
        IndexError,
        AssertionError,
        EOFError,
        struct.error,
        apsw.Error,
        BROKEN,
    )


def _metadata(path: Path, reader: Any) -> Metadata:
    if path.is_dir():
        return read_metadata(path)
    file = File(path.name, span_of(reader))
    found = Metadata(
        storage=storage_of(path),
        topics=topics_of(reader),
        files=(file,),
        span=file.span,
        distro="",
    )
    return found.measured(path.parent)


def read_metadata(folder: Path) -> Metadata:
    """What metadata.yaml says. Raises NoBag, NoMetadata, DamagedBag."""
    import yaml

    _require(folder)
    try:
        text = (folder / NAME).read_text(encoding="utf-8")
        return from_plain(yaml.safe_load(text)[ROOT]).measured(folder)
    except FileNotFoundError as fault:
        raise DamagedBag(folder, f"{Path(fault.filename).name} is missing") from fault
    except (OSError, ValueError, KeyError, TypeError, AttributeError, yaml.YAMLError) as fault:
        raise DamagedBag(folder, f"{NAME} cannot be read: {reason_of(fault)}") from fault
