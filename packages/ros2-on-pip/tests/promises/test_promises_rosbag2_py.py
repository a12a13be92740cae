"""What a program may lean on in `rosbag2_py`, and no other test looks at."""

from __future__ import annotations

import sys
from datetime import timedelta
from pathlib import Path
from typing import Any

import pytest

from sources import code_of

sys.path.append(str(code_of("ros2_on_pip") / "stand_ins"))

import rosbag2_py

STORAGES = ("mcap", "sqlite3")
STRING = "std_msgs/msg/String"
TALK = b"\x00\x01\x00\x00\x03\x00\x00\x00hi\x00"
"""A String as ROS serialises it."""
LATE_NS = 1_732_838_400_123_456_789
"""A time that a float cannot hold."""


def writer(folder: Path, storage: str = "mcap", **options: Any) -> rosbag2_py.SequentialWriter:
    """An open one, with the topics /a and /b."""
    found = rosbag2_py.SequentialWriter()
    found.open(
        rosbag2_py.StorageOptions(uri=str(folder), storage_id=storage, **options),
        rosbag2_py.ConverterOptions("", ""),
    )
    for number, name in enumerate(("/a", "/b")):
        found.create_topic(topic(name, number))
    return found


def topic(name: str, number: int = 0) -> rosbag2_py.TopicMetadata:
    """A topic of strings."""
    return rosbag2_py.TopicMetadata(id=number, name=name, type=STRING, serialization_format="cdr")


def reader(folder: Path) -> rosbag2_py.SequentialReader:
    """An open one."""
    found = rosbag2_py.SequentialReader()
    found.open(
        rosbag2_py.StorageOptions(uri=str(folder), storage_id=""),
        rosbag2_py.ConverterOptions("", ""),
    )
    return found


def read(found: rosbag2_py.SequentialReader) -> list[tuple[str, int]]:
    """Topic and time of all that is left."""
    rest = []
    while found.has_next():
        name, _, time_ns = found.read_next()
        rest.append((name, time_ns))
    return rest


@pytest.mark.parametrize("storage", STORAGES)
def test_messages_come_in_the_order_of_their_times(tmp_path: Path, storage: str) -> None:
    """Whatever the order in which they were written, over all topics."""
    of = writer(tmp_path / "b", storage)
    for name, time_ns in (("/a", 30), ("/b", 10), ("/a", 20), ("/b", 40)):
        of.write(name, TALK, time_ns)
    of.close()
    assert read(reader(tmp_path / "b")) == [("/b", 10), ("/a", 20), ("/a", 30), ("/b", 40)]


@pytest.mark.parametrize("storage", STORAGES)
def test_read_next_gives_topic_bytes_and_nanoseconds(tmp_path: Path, storage: str) -> None:
    """A tuple of str, bytes and int; the bytes are those that were written, the time is exact."""
    of = writer(tmp_path / "b", storage)
    of.write("/a", TALK, LATE_NS)
    of.close()
    found = reader(tmp_path / "b").read_next()
    assert isinstance(found, tuple)
    assert [type(one) for one in found] == [str, bytes, int]
    assert found == ("/a", TALK, LATE_NS)


@pytest.mark.parametrize("storage", STORAGES)
def test_topics_are_listed_with_their_types(tmp_path: Path, storage: str) -> None:
    """Also those without a message; name, type and format are plain texts."""
    of = writer(tmp_path / "b", storage)
    of.write("/a", TALK, 1)
    of.close()
    found = reader(tmp_path / "b").get_all_topics_and_types()
    assert isinstance(found, list)
    assert sorted((t.name, t.type, t.serialization_format) for t in found) == [
        ("/a", STRING, "cdr"),
        ("/b", STRING, "cdr"),
    ]


def test_the_fields_of_the_metadata(tmp_path: Path) -> None:
    """Times are objects of rclpy, a file's duration is Python's, counts are whole numbers."""
    of = writer(tmp_path / "b", custom_data={"robot": "7"})
    of.write("/a", TALK, LATE_NS)
    of.write("/b", TALK, LATE_NS + 5000)
    of.close()
    found = reader(tmp_path / "b").get_metadata()
    assert isinstance(found, rosbag2_py.BagMetadata)
    assert (found.version, found.storage_identifier, found.message_count) == (9, "mcap", 2)
    assert (found.starting_time.nanoseconds, found.duration.nanoseconds) == (LATE_NS, 5000)
    assert (found.relative_file_paths, found.custom_data) == (["b_0.mcap"], {"robot": "7"})
    assert (found.compression_format, found.compression_mode) == ("", "")
    assert (found.ros_distro, found.bag_size > 0) == ("jazzy", True)
    (file,) = found.files
    assert isinstance(file, rosbag2_py.FileInformation)
    assert (file.path, file.message_count) == ("b_0.mcap", 2)
    assert (file.starting_time.nanoseconds, file.duration) == (LATE_NS, timedelta(microseconds=5))
    counts = {one.topic_metadata.name: one.message_count for one in found.topics_with_message_count}
    assert counts == {"/a": 1, "/b": 1}


@pytest.mark.parametrize("storage", STORAGES)
def test_a_writer_that_is_deleted_leaves_a_whole_bag(tmp_path: Path, storage: str) -> None:
    """Without close(): the usual way before Jazzy."""
    of = writer(tmp_path / "b", storage)
    of.write("/a", TALK, 1)
    del of
    assert read(reader(tmp_path / "b")) == [("/a", 1)]


def test_a_writer_writes_a_second_bag(tmp_path: Path) -> None:
    """close() ends one bag, and open() begins the next."""
    of = writer(tmp_path / "one")
    of.write("/a", TALK, 1)
    of.close()
    options = rosbag2_py.StorageOptions(str(tmp_path / "two"), "mcap")
    of.open(options, rosbag2_py.ConverterOptions("", ""))
    of.create_topic(topic("/a"))
    of.write("/a", TALK, 2)
    of.close()
    assert read(reader(tmp_path / "one")) == [("/a", 1)]
    assert read(reader(tmp_path / "two")) == [("/a", 2)]


def test_a_topic_is_created_once_however_often_it_is_asked_for(tmp_path: Path) -> None:
    """A second create_topic of the same name changes nothing."""
    of = writer(tmp_path / "b")
    of.write("/a", TALK, 1)
    of.create_topic(topic("/a"))
    of.write("/a", TALK, 2)
    of.close()
    assert read(reader(tmp_path / "b")) == [("/a", 1), ("/a", 2)]
    assert len(reader(tmp_path / "b").get_all_topics_and_types()) == 2


def test_nothing_works_before_open(tmp_path: Path) -> None:
    """Each method says with a RuntimeError that the bag is not open."""
    unread, unwritten = rosbag2_py.SequentialReader(), rosbag2_py.SequentialWriter()
    for ask in (
        unread.has_next,
        unread.read_next,
        unread.get_metadata,
        unread.get_all_topics_and_types,
        unread.reset_filter,
        lambda: unread.seek(0),
        lambda: unread.set_filter(rosbag2_py.StorageFilter(topics=["/a"])),
        lambda: unwritten.create_topic(topic("/a")),
        lambda: unwritten.write("/a", TALK, 1),
    ):
        with pytest.raises(RuntimeError, match="not open"):
            ask()


def test_a_bag_is_opened_by_its_folder_or_its_file(tmp_path: Path) -> None:
    """open_uri() needs no options; a reader that is closed is not open any more."""
    of = writer(tmp_path / "b", "sqlite3")
    of.write("/a", TALK, 1)
    of.close()
    found = rosbag2_py.SequentialReader()
    for uri in (tmp_path / "b", tmp_path / "b" / "b_0.db3"):
        found.open_uri(str(uri))
        assert read(found) == [("/a", 1)]
    found.close()
    found.close()
    with pytest.raises(RuntimeError, match="not open"):
        found.has_next()


def test_a_bag_is_split_by_time_and_read_as_one(tmp_path: Path) -> None:
    """max_bagfile_duration is in seconds; the files are numbered."""
    of = writer(tmp_path / "b", max_bagfile_duration=1)
    for second in range(4):
        of.write("/a", TALK, second * 10**9 + 1)
    of.close()
    files = reader(tmp_path / "b").get_metadata().relative_file_paths
    assert files[0] == "b_0.mcap" and len(files) > 1
    assert [time_ns // 10**9 for _, time_ns in read(reader(tmp_path / "b"))] == [0, 1, 2, 3]


def test_a_file_holds_the_whole_of_its_duration(tmp_path: Path) -> None:
    """A message exactly so late still belongs to it."""
    of = writer(tmp_path / "b", max_bagfile_duration=1)
    for time_ns in (1, 10**9 + 1, 10**9 + 2):
        of.write("/a", TALK, time_ns)
    of.close()
    files = reader(tmp_path / "b").get_metadata().files
    assert [file.message_count for file in files] == [2, 1]


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_topic_that_is_removed_takes_its_messages_along(tmp_path: Path, storage: str) -> None:
    """Out of the metadata; one that is not there cannot be removed."""
    of = writer(tmp_path / "b", storage)
    for name in ("/a", "/b"):
        of.write(name, TALK, 1)
    of.remove_topic(topic("/a"))
    with pytest.raises(RuntimeError, match="Call create_topic"):
        of.write("/a", TALK, 2)
    for unknown in ("/a", "/never"):
        with pytest.raises(RuntimeError, match=f'non-existing topic "{unknown}"'):
            of.remove_topic(topic(unknown))
    of.close()
    found = reader(tmp_path / "b").get_metadata()
    assert found.message_count == 1
    names = [one.topic_metadata.name for one in found.topics_with_message_count]
    assert names == ["/b"]


def test_a_filters_expression_matches_a_whole_name(tmp_path: Path) -> None:
    """As does the one that leaves topics out."""
    of = writer(tmp_path / "b")
    for name in ("/a", "/b"):
        of.write(name, TALK, 1)
    of.close()
    for words, left in (
        ({"regex": "/a"}, ["/a"]),
        ({"regex": "a"}, []),
        ({"regex": ".*a|/b"}, ["/a", "/b"]),
        ({"regex_to_exclude": "a"}, ["/a", "/b"]),
        ({"regex_to_exclude": "/a"}, ["/b"]),
    ):
        found = reader(tmp_path / "b")
        found.set_filter(rosbag2_py.StorageFilter(**words))
        assert [name for name, _ in read(found)] == left


@pytest.mark.parametrize("options", [(), (None,), ("zstd",)])
def test_a_compressing_writer_needs_its_options(options: tuple[Any, ...]) -> None:
    """Anything else is a TypeError."""
    with pytest.raises(TypeError):
        rosbag2_py.SequentialCompressionWriter(*options)


def test_a_snapshot_is_refused_where_none_was_asked_for(tmp_path: Path) -> None:
    """take_snapshot() of a plain recording is False."""
    assert writer(tmp_path / "b").take_snapshot() is False


def test_two_topics_are_equal_by_name_type_and_format() -> None:
    """equals() looks at no id."""
    assert topic("/a", 1).equals(topic("/a", 2))
    assert not topic("/a").equals(topic("/b"))


def test_what_the_options_hold_when_nothing_is_said() -> None:
    """The fields can be set later, and have Jazzy's defaults."""
    options = rosbag2_py.StorageOptions(uri="b")
    assert (options.storage_id, options.max_bagfile_size, options.max_cache_size) == ("", 0, 0)
    assert (options.start_time_ns, options.end_time_ns, options.custom_data) == (-1, -1, {})
    asked = rosbag2_py.StorageFilter()
    asked.topics = ["/a"]
    assert (asked.topics, asked.regex, asked.exclude_topics) == (["/a"], "", [])
    order = rosbag2_py.ReadOrder()
    assert (order.sort_by, order.reverse) == (rosbag2_py.ReadOrderSortBy.ReceivedTimestamp, False)
    converter = rosbag2_py.ConverterOptions(
        input_serialization_format="cdr", output_serialization_format="cdr"
    )
    assert converter.output_serialization_format == "cdr"
    compression = rosbag2_py.CompressionOptions()
    assert compression.compression_mode == rosbag2_py.CompressionMode.NONE


def test_what_is_registered_is_a_set_of_names() -> None:
    """A program looks a storage up in it before it writes."""
    assert {"mcap", "sqlite3"} <= rosbag2_py.get_registered_writers()
    assert {"mcap", "sqlite3"} <= rosbag2_py.get_registered_readers()
    assert "zstd" in rosbag2_py.get_registered_compressors()
    assert "cdr_converter" in rosbag2_py.get_registered_serializers()


def test_metadata_are_looked_for_read_and_turned_into_text(tmp_path: Path) -> None:
    """MetadataIo knows whether a folder is a bag, and gives back what it wrote."""
    io = rosbag2_py.MetadataIo()
    assert not io.metadata_file_exists(str(tmp_path))
    of = writer(tmp_path / "b")
    of.write("/a", TALK, 7)
    of.close()
    assert io.metadata_file_exists(str(tmp_path / "b"))
    found = io.read_metadata(str(tmp_path / "b"))
    again = io.deserialize_metadata(io.serialize_metadata(found))
    assert (again.message_count, again.starting_time.nanoseconds) == (1, 7)
    with pytest.raises(RuntimeError):
        io.read_metadata(str(tmp_path))
