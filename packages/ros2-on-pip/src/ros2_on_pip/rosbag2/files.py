"""The files of a bag, written by `rosbags`: one at a time, each whole at every moment.

`rosbags` names a file after the bag's folder, and ends it when the bag ends. But `rosbag2` numbers
its files. And a disk may be full, or the power gone, before the end. So here a file is named as
rosbag2 does it, and what was written stays readable (`mended`).
"""

from __future__ import annotations

import os
import sqlite3
import struct
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO, Protocol, cast

from rosbags.rosbag2 import CompressionMode
from rosbags.rosbag2.storage_mcap import Channel, McapWriter, Schema
from rosbags.rosbag2.storage_sqlite3 import Sqlite3Writer

from ros2_on_pip.rosbag2.errors import BadBagPath
from ros2_on_pip.rosbag2.metadata import VERSION, Metadata, as_plain

MAGIC = b"\x89MCAP0\r\n"
"""Begins and ends a file (mcap.dev/spec)."""

HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, DATA_END = 1, 2, 3, 4, 5, 6, 15
"""Kinds of records."""

HEAD = struct.Struct("<BQ")
"""Before each record: its kind, and how many bytes follow."""

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

    def forget(self, topic: str) -> None:
        """No message of this topic comes any more. Raises OSError, sqlite3.Error."""

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

    def forget(self, topic: str) -> None:
        """What was written stays in the file."""

    def adopt(self, content: bytes) -> None:
        """Write a chunk of another writer, and know from now on what it holds."""
        self.chunk.bio.write(content)
        for kind, place, body in _records_in(content):
            if kind == SCHEMA:
                self._adopt_schema(body)
            elif kind == CHANNEL:
                self._adopt_channel(body)
            elif kind == MESSAGE:
                channel, _, time_ns = struct.unpack_from("<HIQ", body)
                self._count(channel, time_ns, place)
        super().close_chunk()

    def _adopt_schema(self, body: bytes) -> None:
        (number,) = struct.unpack_from("<H", body)
        if number not in {schema.id for schema in self.schemas}:
            (name, encoding, data), _ = _texts(body[2:], 3)
            self.schemas.append(Schema(number, name.decode(), encoding.decode(), data.decode()))

    def _adopt_channel(self, body: bytes) -> None:
        number, schema = struct.unpack_from("<HH", body)
        if number not in self.channel_stats:
            (topic, encoding, metadata), _ = _texts(body[4:], 3)
            named = next(each.name for each in self.schemas if each.id == schema)
            self.channels.append(
                Channel(number, named, topic.decode(), encoding.decode(), metadata)
            )
            self.channel_stats[number] = 0

    def _count(self, channel: int, time_ns: int, place: int) -> None:
        self.channel_stats[channel] += 1
        self.chunk.msgs[channel].append((time_ns, place))
        for part in (self, self.chunk):
            part.message_start_time = min(time_ns, part.message_start_time)
            part.message_end_time = max(time_ns, part.message_end_time)

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
            raise BadBagPath(file.parent)
        super().__init__(cast(Path, _Named(file)), CompressionMode.NONE)
        # As rosbag2: to wait for the disk at each transaction takes longer than a message.
        self.conn.execute("PRAGMA synchronous=OFF")

    def settle(self) -> None:
        self.conn.commit()

    def forget(self, topic: str) -> None:
        """Its messages stay, and nobody finds them without it."""
        self.conn.execute("DELETE FROM topics WHERE name = ?", (topic,))


def new_file(file: Path, storage: str) -> StorageFile:
    """A file for `storage`, mcap or sqlite3. Raises OSError, sqlite3.Error, BadBagPath."""
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
        records = list(_whole_records(stream))
        if records and _is_ended(stream):
            return False
        chunks = [_chunk(stream, record) for record in records if record.kind == CHUNK]
        begin = next((record.end for record in records if record.kind == HEADER), len(MAGIC))
        if any(chunk.compression for chunk in chunks):
            _write_again(stream, chunks, file)
        else:
            _write_over(stream, chunks, begin, file)
    return True


def _write_over(stream: BinaryIO, chunks: list[_Chunk], begin: int, file: Path) -> None:
    """Each chunk at its place, with the index that it lacks: no room is needed for another file."""
    with _scratch_file(file) as writer:
        writer.bio.close()
        writer.bio = cast(Any, stream)
        stream.seek(begin)
        for chunk in chunks:
            place = stream.tell()
            content = chunk.read(stream)
            stream.seek(place)
            writer.adopt(content)
        stream.truncate()
        writer.close(VERSION, _bare_yaml())


def _write_again(stream: BinaryIO, chunks: list[_Chunk], file: Path) -> None:
    """Into a new file: what another recorder compressed is larger when it is not."""
    with _scratch_file(file) as writer:
        for chunk in chunks:
            writer.adopt(chunk.read(stream))
        writer.close(VERSION, _bare_yaml())
        writer.path.replace(file)


@contextmanager
def _scratch_file(file: Path) -> Iterator[_Mcap]:
    """A new file beside `file`; nothing of it is left."""
    place = file.with_name(f".{file.name}.part")
    place.unlink(missing_ok=True)
    try:
        yield _Mcap(place)
    finally:
        place.unlink(missing_ok=True)


def _bare_yaml() -> str:
    """In the place of the metadata that a file holds: readers look at the index."""
    import yaml

    return str(yaml.safe_dump(as_plain(Metadata(storage="mcap")), sort_keys=False)).strip()


def _is_ended(stream: BinaryIO) -> bool:
    stream.seek(-len(MAGIC), os.SEEK_END)
    return stream.read() == MAGIC


@dataclass(frozen=True)
class _Record:
    """A record that is whole: its kind, and where its content begins and ends."""

    kind: int
    begin: int
    end: int


def _whole_records(stream: BinaryIO) -> Iterator[_Record]:
    """All of the messages, and none of an index after them."""
    size = os.fstat(stream.fileno()).st_size
    begin = stream.tell() + HEAD.size
    while len(head := stream.read(HEAD.size)) == HEAD.size:
        kind, length = HEAD.unpack(head)
        if kind in (0, DATA_END, FOOTER) or begin + length > size:
            return
        yield _Record(kind, begin, begin + length)
        begin = stream.seek(begin + length) + HEAD.size


@dataclass(frozen=True)
class _Chunk:
    """Where the messages of a chunk lie."""

    begin: int
    size: int
    plain_size: int
    compression: str

    def read(self, stream: BinaryIO) -> bytes:
        """Its records. Raises ValueError where it is damaged."""
        stream.seek(self.begin)
        data = stream.read(self.size)
        if not self.compression:
            return data
        from rosbags.rosbag2.storage_mcap import decompress

        return bytes(decompress(data, self.compression, self.plain_size, 0))


def _chunk(stream: BinaryIO, record: _Record) -> _Chunk:
    """Its head: two stamps, its size before compression, a sum, and how it is compressed."""
    stream.seek(record.begin)
    _, _, plain_size, _, length = struct.unpack("<QQQII", stream.read(32))
    compression = stream.read(length).decode()
    begin = stream.tell() + 8
    return _Chunk(begin, record.end - begin, plain_size, compression)


def _records_in(content: bytes) -> Iterator[tuple[int, int, bytes]]:
    """Of a chunk: the kind of each record, where it lies, and what it says."""
    place = 0
    while place + HEAD.size <= len(content):
        kind, length = HEAD.unpack_from(content, place)
        end = place + HEAD.size + length
        yield kind, place, content[place + HEAD.size : end]
        place = end


def _texts(content: bytes, count: int) -> tuple[list[bytes], bytes]:
    """The first `count` texts, each after its length, and what follows."""
    found = []
    for _ in range(count):
        (length,) = struct.unpack_from("<I", content)
        found.append(content[4 : 4 + length])
        content = content[4 + length :]
    return found, content


def _mended_sqlite(file: Path) -> bool:
    """SQLite itself takes back the transaction that was not over, when somebody writes."""
    journal = file.with_name(f"{file.name}-journal")
    torn = journal.exists()
    with closing(sqlite3.connect(file)) as connection:
        connection.execute("SELECT count(*) FROM messages").fetchone()
    return torn
