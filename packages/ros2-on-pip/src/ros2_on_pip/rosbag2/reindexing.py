"""Make metadata.yaml anew from the files of a bag, and make those whole that were cut off."""

from __future__ import annotations

import re
import sqlite3
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ros2_on_pip.rosbag2.errors import NoBag, OtherStorage, UnknownStorage, reason_of
from ros2_on_pip.rosbag2.files import mended
from ros2_on_pip.rosbag2.metadata import ENDINGS, NAME, File, MessageSpan, Metadata, Topic, as_yaml
from ros2_on_pip.rosbag2.packing import (
    BROKEN,
    ENDING,
    MAGIC,
    ZSTD,
    pack_file,
    packed_file,
    unpack_file,
)

STORAGES = {ending: name for name, ending in ENDINGS.items()}


@dataclass(frozen=True)
class Content:
    """What one file holds."""

    file: File
    topics: tuple[Topic, ...]
    packed_messages: bool


def reindex(folder: Path, asked: str = "") -> Metadata:
    """Write the metadata.yaml of the bag in `folder`, from its files alone.

    A file that was cut off is made whole: what was in it before stays. `asked`: the storage that
    they must have. Raises NoBag, UnknownStorage, OtherStorage, OSError.
    """
    files = storage_files(folder)
    if not files:
        raise NoBag(folder, "it holds no file of messages")
    require_storage(files, asked)
    by_file = any(file.suffix == ENDING for file in files)
    contents = [_content(folder, file, by_file) for file in files]
    metadata = Metadata(
        storage=storage_of(files[0]),
        topics=_together(contents),
        files=tuple(content.file for content in contents),
        span=sum((content.file.span for content in contents), MessageSpan()),
        compression_mode=_mode(by_file, contents),
        compression_format=ZSTD if _mode(by_file, contents) else "",
    )
    write_metadata(folder, metadata)
    return metadata


def _mode(by_file: bool, contents: list[Content]) -> str:
    if by_file:
        return "FILE"
    return "MESSAGE" if any(content.packed_messages for content in contents) else ""


def write_metadata(folder: Path, metadata: Metadata) -> None:
    """metadata.yaml, whole or not at all. Raises OSError."""
    scratch = place_of_metadata(folder)
    scratch.write_text(as_yaml(metadata), encoding="utf-8")
    scratch.replace(folder / NAME)


def place_of_metadata(folder: Path) -> Path:
    """Where metadata.yaml is written, before it gets its name."""
    return folder / f"{NAME}.part"


def storage_files(folder: Path) -> list[Path]:
    """The files of messages in a folder, in the order in which they were written."""
    found = [file for file in folder.iterdir() if storage_of(file)]
    return sorted(found, key=lambda file: (_number(file), file.name))


def storage_of(file: Path) -> str:
    """How a file is stored, as its name says; empty for other files."""
    return STORAGES.get(_plain(file).suffix, "")


def require_storage(files: Iterable[Path], asked: str) -> None:
    """Raises UnknownStorage, OtherStorage. Where nothing is asked for, the files tell it."""
    if not asked:
        return
    if asked not in ENDINGS:
        raise UnknownStorage(asked, ENDINGS)
    for file in files:
        if (found := storage_of(file)) not in ("", asked):
            raise OtherStorage(file, found, asked)


def _plain(file: Path) -> Path:
    return file.with_suffix("") if file.suffix == ENDING else file


def _number(file: Path) -> int:
    found = re.search(r"_(\d+)$", _plain(file).stem)
    return int(found[1]) if found else 0


def _content(folder: Path, file: Path, by_file: bool) -> Content:
    try:
        with unpacked(file) as plain:
            torn = mended(plain)
            content = _read(plain)
            if torn and plain != file:
                pack_file(plain, file)
    except (ValueError, sqlite3.Error, BROKEN) as fault:
        raise NoBag(folder, f"{file.name} cannot be read: {reason_of(fault)}") from fault
    if by_file and file.suffix != ENDING:  # the last one, where the recorder was killed
        file = packed_file(file)
    return replace(content, file=replace(content.file, name=file.name))


def _read(file: Path) -> Content:
    from rosbags.rosbag2 import Reader, ReaderError

    try:
        with Reader(file) as reader:
            return Content(File(file.name, span_of(reader)), topics_of(reader), _is_packed(reader))
    except ReaderError as fault:
        raise ValueError(str(fault)) from fault


@contextmanager
def unpacked(file: Path) -> Iterator[Path]:
    """The file as it was before it was compressed."""
    if file.suffix != ENDING:
        yield file
        return
    with tempfile.TemporaryDirectory(prefix="roslings-") as scratch:
        place = Path(scratch) / _plain(file).name
        unpack_file(file, place)
        yield place


def span_of(reader: Any) -> MessageSpan:
    """How many messages an open reader has, and when they came."""
    if not reader.message_count:
        return MessageSpan()
    return MessageSpan(reader.message_count, reader.start_time, reader.end_time - 1)


def topics_of(reader: Any) -> tuple[Topic, ...]:
    """The topics of an open reader."""
    return tuple(
        Topic(
            each.topic,
            each.msgtype,
            each.ext.serialization_format,
            tuple(each.ext.offered_qos_profiles),
            each.digest,
            each.msgcount,
        )
        for each in reader.connections
    )


def _is_packed(reader: Any) -> bool:
    return any(bytes(raw).startswith(MAGIC) for _, _, raw in _first(reader.messages()))


def _first(messages: Iterator[Any]) -> Iterator[Any]:
    for message in messages:
        yield message
        return


def _together(contents: list[Content]) -> tuple[Topic, ...]:
    """Each topic once, with the messages of all files."""
    found: dict[str, Topic] = {}
    for content in contents:
        for topic in content.topics:
            before = found.get(topic.name)
            count = topic.count + (before.count if before else 0)
            found[topic.name] = replace(before or topic, count=count)
    return tuple(found.values())
