"""Which `storage_id` opens which bag, by every way into one: as the compiled rosbag2_py of Jazzy.

What is refused is a RuntimeError there, whatever is wrong; so it is here.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from bags import said, write

from ros2_on_pip.rosbag2.writing import BagWriterOptions
from sources import code_of

sys.path.append(str(code_of("ros2_on_pip") / "stand_ins"))

import rosbag2_py

Bag = Path
Entry = Callable[[str, str], Any]
STORAGES = {"mcap": "b_0.mcap", "sqlite3": "b_0.db3"}
FILE = rosbag2_py.CompressionMode.FILE
IDS = ("", "mcap", "sqlite3", "MCAP", "rosbag_v2", " mcap")


@pytest.fixture(params=STORAGES)
def bag(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[Bag, str]:
    """A bag of each storage, and which one it is."""
    return write(tmp_path / "b", said("abc"), BagWriterOptions(request.param)), request.param


def read(uri: str, storage_id: str) -> int:
    """How many messages a reader finds."""
    return len(taken_by(rosbag2_py.SequentialReader(), uri, storage_id))


def read_compressed(uri: str, storage_id: str) -> int:
    """The same, of the reader that takes compressed bags, too."""
    return len(taken_by(rosbag2_py.SequentialCompressionReader(), uri, storage_id))


def taken_by(reader: Any, uri: str, storage_id: str) -> list[Any]:
    """All messages."""
    options = rosbag2_py.StorageOptions(uri=uri, storage_id=storage_id)
    reader.open(options, rosbag2_py.ConverterOptions("cdr", "cdr"))
    found = []
    while reader.has_next():
        found.append(reader.read_next())
    return found


def inform(uri: str, storage_id: str) -> int:
    """How many messages Info tells of."""
    return int(rosbag2_py.Info().read_metadata(uri, storage_id).message_count)


def reindex(uri: str, storage_id: str) -> int:
    """How many messages stand in a new metadata.yaml."""
    rosbag2_py.Reindexer().reindex(rosbag2_py.StorageOptions(uri, storage_id))
    return int(rosbag2_py.MetadataIo().read_metadata(uri).message_count)


def written(of: Any, uri: str, storage_id: str) -> str:
    """How a new bag is stored."""
    compressed = of is rosbag2_py.SequentialCompressionWriter
    writer = of(rosbag2_py.CompressionOptions("zstd", FILE)) if compressed else of()
    writer.open(rosbag2_py.StorageOptions(uri, storage_id), rosbag2_py.ConverterOptions())
    writer.close()
    return str(rosbag2_py.MetadataIo().read_metadata(uri).storage_identifier)


FOLDER_AND_FILE: list[tuple[Entry, bool]] = [
    (read, False),
    (read, True),
    (read_compressed, False),
    (read_compressed, True),
    (inform, True),
    (reindex, False),
]
"""Each entry point that looks at `storage_id`, with a folder and with a file of it."""


@pytest.mark.parametrize("storage_id", IDS)
@pytest.mark.parametrize(("entry", "of_file"), FOLDER_AND_FILE)
def test_only_its_own_storage_opens_a_bag(
    entry: Entry, of_file: bool, storage_id: str, bag: tuple[Bag, str]
) -> None:
    """Or an empty one: then the bag itself tells."""
    folder, storage = bag
    uri = str(folder / STORAGES[storage] if of_file else folder)
    if storage_id in ("", storage):
        assert entry(uri, storage_id) == 3
        return
    before = (folder / "metadata.yaml").read_text()
    with pytest.raises(RuntimeError, match="no storage could be initialized") as refused:
        entry(uri, storage_id)
    assert (folder / "metadata.yaml").read_text() == before
    known = storage_id in STORAGES
    wanted = f"is stored as {storage}" if known else f"there is no storage '{storage_id}'"
    assert wanted in str(refused.value)


@pytest.mark.parametrize("storage_id", IDS)
def test_the_metadata_of_a_folder_is_read_whatever_is_asked_for(
    storage_id: str, bag: tuple[Bag, str]
) -> None:
    """Info looks into metadata.yaml alone, and into no file of messages."""
    folder, storage = bag
    (folder / STORAGES[storage]).write_bytes(b"nothing that could be opened")
    assert inform(str(folder), storage_id) == 3


@pytest.mark.parametrize("storage_id", IDS)
@pytest.mark.parametrize(
    "of", [rosbag2_py.SequentialWriter, rosbag2_py.SequentialCompressionWriter]
)
def test_a_writer_takes_the_storages_that_there_are(
    of: Any, storage_id: str, tmp_path: Path
) -> None:
    """An empty one is the default."""
    if storage_id in ("", *STORAGES):
        stored = written(of, str(tmp_path / "new"), storage_id)
        assert stored == (storage_id or rosbag2_py.get_default_storage_id())
    else:
        with pytest.raises(RuntimeError, match=f"there is no storage '{storage_id}'"):
            written(of, str(tmp_path / "new"), storage_id)


EVERY_ENTRY: dict[str, Entry] = {
    "read": read,
    "open_uri": lambda uri, _: rosbag2_py.SequentialReader().open_uri(uri),
    "inform": inform,
    "reindex": reindex,
    "write": lambda uri, storage_id: written(rosbag2_py.SequentialWriter, uri, storage_id),
}


@pytest.mark.parametrize("storage_id", ["", "mcap"])
@pytest.mark.parametrize("name", EVERY_ENTRY)
def test_an_empty_uri_is_the_path_of_nothing(
    name: str, storage_id: str, bag: tuple[Bag, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where the program stands in the folder of a bag."""
    monkeypatch.chdir(bag[0])
    with pytest.raises(RuntimeError, match="uri is empty"):
        EVERY_ENTRY[name]("", storage_id)


@pytest.mark.parametrize("storage_id", IDS)
@pytest.mark.parametrize("name", ["read", "open_uri", "inform", "reindex"])
def test_what_is_not_there_is_refused(name: str, storage_id: str, tmp_path: Path) -> None:
    """A path of nothing, a folder without a bag, and a file that is none."""
    (tmp_path / "empty").mkdir()
    (tmp_path / "notes.txt").write_text("no bag")
    for path in ("nowhere", "empty", "notes.txt"):
        with pytest.raises(RuntimeError):
            EVERY_ENTRY[name](str(tmp_path / path), storage_id)


@pytest.mark.parametrize("name", EVERY_ENTRY)
def test_a_path_is_no_text(name: str, bag: tuple[Bag, str]) -> None:
    """The compiled module takes str alone, for each of both."""
    with pytest.raises(TypeError, match="must be str"):
        EVERY_ENTRY[name](bag[0], "")  # type: ignore[arg-type]  # what is tried
    if name != "open_uri":
        with pytest.raises(TypeError, match="must be str"):
            EVERY_ENTRY[name](str(bag[0]), None)  # type: ignore[arg-type]


def test_a_reader_wants_both_options(bag: tuple[Bag, str]) -> None:
    """As in Jazzy: none of them has a default."""
    with pytest.raises(TypeError, match="converter_options"):
        rosbag2_py.SequentialReader().open(rosbag2_py.StorageOptions(str(bag[0])))
