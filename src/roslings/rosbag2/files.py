"""The files of a bag, written by `rosbags`: one at a time, each whole at every moment.

`rosbags` names a file after the bag's folder, and ends it when the bag ends. rosbag2 numbers its
files; and a disk may be full, or the power gone, before the end. So here a file is named as
rosbag2 does it, and what was written stays readable (`mended`).
"""

from __future__ import annotations

import os
import sqlite3
import struct
from collections.abc import Iterator
from contextlib import closing, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO, Protocol, cast

from rosbags.rosbag2 import CompressionMode
from rosbags.rosbag2.storage_mcap import McapWriter
from rosbags.rosbag2.storage_sqlite3 import Sqlite3Writer

from roslings.rosbag2.trouble import BadName

MAGIC = b"\x89MCAP0\r\n"
"""Begins and ends a file (mcap.dev/spec)."""

DATA_END, FOOTER = 0x0F, 0x02
HEAD = struct.Struct("<BQ")
"""Before each record: its kind, and how many bytes follow."""

BARE_END = HEAD.pack(DATA_END, 4) + bytes(4) + HEAD.pack(FOOTER, 20) + bytes(20) + MAGIC
"""The shortest end of a file: no index. Readers then look through all of it."""

LEAST_SPLIT = {"mcap": 1024, "sqlite3": 84 * 1024}
"""Bytes: rosbag2 splits into no smaller files."""


class StorageFile(Protocol):
    """A file that takes messages; the words are those of `rosbags`."""

    path: Path

    def add_msgtype(self, connection: Any) -> None:
        """Before the first topic of this type."""

    def add_connection(self, connection: Any, offered_qos_profiles: str) -> None:
        """Before the first message of this topic."""

    def write(self, connection: Any, timestamp: int, data: bytes | memoryview) -> None:
        """One message. Raises OSError, sqlite3.Error."""

    def settle(self) -> None:
        """Whatever was written is on the disk. Raises OSError, sqlite3.Error."""

    def close(self, version: int, metadata: str) -> None:
        """The end. Raises OSError, sqlite3.Error."""

    def abort(self) -> None:
        """The end, where writing has failed: what has settled stays."""


@dataclass(frozen=True)
class _Named:
    """Stands for the folder in which `rosbags` makes the file: it gets the name that we want."""

    file: Path

    @property
    def name(self) -> str:
        return self.file.stem

    def __truediv__(self, _: str) -> Path:
        return self.file


class _Mcap(McapWriter):
    """MCAP: messages lie in chunks, and a chunk counts when it is whole."""

    def __init__(self, file: Path) -> None:
        super().__init__(cast(Path, _Named(file)), CompressionMode.NONE)

    def close_chunk(self) -> None:
        whole = self.bio.tell()
        try:
            super().close_chunk()
            self.bio.flush()
        except OSError:
            self._cut(whole)
            raise

    def settle(self) -> None:
        if self.chunk.bio.tell():
            self.close_chunk()

    def _cut(self, size: int) -> None:
        """Nothing of the last chunk stays, on the disk and in the buffer before it."""
        os.truncate(self.path, size)
        torn = cast(Any, self.bio)
        self.bio = cast(Any, self.path.open("r+b"))
        self.bio.seek(size)
        with suppress(OSError, ValueError):
            torn.raw.close()
            torn.close()


class _Sqlite(Sqlite3Writer):
    """SQLite: messages count when their transaction is over."""

    def __init__(self, file: Path) -> None:
        if set("?#%") & set(str(file.absolute())):
            raise BadName(file.parent)
        super().__init__(cast(Path, _Named(file)), CompressionMode.NONE)
        # As rosbag2: to wait for the disk at each transaction takes longer than a message.
        self.conn.execute("PRAGMA synchronous=OFF")

    def settle(self) -> None:
        self.conn.commit()


def new_file(file: Path, storage: str) -> StorageFile:
    """A file for `storage`, mcap or sqlite3. Raises OSError, sqlite3.Error, BadName."""
    return _Mcap(file) if storage == "mcap" else _Sqlite(file)


def mended(file: Path) -> bool:
    """Make a file whole whose writer was killed; whether something had to be done.

    Raises OSError, sqlite3.Error, and ValueError where it is no such file.
    """
    return _mended_mcap(file) if file.suffix == ".mcap" else _mended_sqlite(file)


def _mended_mcap(file: Path) -> bool:
    with file.open("r+b") as stream:
        if stream.read(len(MAGIC)) != MAGIC:
            raise ValueError("it does not begin as an MCAP file does")
        ends = list(_ends_of_records(stream))
        if ends and _is_ended(stream):
            return False
        stream.seek(ends[-1] if ends else len(MAGIC))
        stream.truncate()
        stream.write(BARE_END)
    return True


def _is_ended(stream: BinaryIO) -> bool:
    stream.seek(-len(MAGIC), os.SEEK_END)
    return stream.read() == MAGIC


def _ends_of_records(stream: BinaryIO) -> Iterator[int]:
    """Where each record ends that is whole and is of the messages, not of an index after them."""
    size = os.fstat(stream.fileno()).st_size
    end = stream.tell()
    while len(head := stream.read(HEAD.size)) == HEAD.size:
        kind, length = HEAD.unpack(head)
        end += HEAD.size + length
        if kind in (0, DATA_END, FOOTER) or end > size:
            return
        yield end
        stream.seek(end)


def _mended_sqlite(file: Path) -> bool:
    """SQLite itself takes back the transaction that was not over, when somebody writes."""
    journal = file.with_name(f"{file.name}-journal")
    torn = journal.exists()
    with closing(sqlite3.connect(file)) as connection:
        connection.execute("SELECT count(*) FROM messages").fetchone()
    return torn
