"""Bags are whole whatever happens, and independent readers open them."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Literal

import pytest
import yaml
from bags import BEGIN_NS, STEP_NS, TOPICS, TYPES, raw, read_by_mcap, read_by_rosbags, said, write
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer

from ros2_on_pip.rosbag2.choosing import BadExpression, TopicFilter
from ros2_on_pip.rosbag2.errors import (
    BadBagPath,
    BagNotWritable,
    BagThere,
    DamagedBag,
    NoBag,
    NoMetadata,
    TooSmall,
)
from ros2_on_pip.rosbag2.files import LEAST_SPLIT
from ros2_on_pip.rosbag2.metadata import Topic
from ros2_on_pip.rosbag2.quality import BadOverrides, overrides
from ros2_on_pip.rosbag2.reading import opened, read_metadata
from ros2_on_pip.rosbag2.reindexing import reindex
from ros2_on_pip.rosbag2.writing import BagWriter, BagWriterOptions, Compression

STORAGES = ("mcap", "sqlite3")
COMPRESSIONS: tuple[Compression, ...] = ("none", "file", "message")
HERE = Path(__file__).parent
TEXTS = [f"message {number}" for number in range(25)]


@pytest.mark.parametrize("storage", STORAGES)
@pytest.mark.parametrize("compression", COMPRESSIONS)
def test_others_read_what_was_written(
    tmp_path: Path, storage: str, compression: Compression
) -> None:
    """Split by time, in every way of storing: `rosbags` and MCAP's reader find all of it."""
    plan = BagWriterOptions(storage, compression, max_duration_s=1.0, custom={"robot": "seven"})
    bag = write(tmp_path / "drive", said(TEXTS), plan)
    assert read_by_rosbags(bag) == said(TEXTS)
    if storage == "mcap" and compression != "message":
        assert read_by_mcap(bag) == said(TEXTS)
    with opened(bag) as reader:
        assert [(t, n) for t, n, _ in reader.messages()] == [(t, n) for t, n, _ in said(TEXTS)]
        assert [data for _, _, data in reader.messages()] == [raw(text) for text in TEXTS]
        assert [file.span.count for file in reader.metadata.files] == [11, 11, 3]
        assert reader.metadata.custom == {"robot": "seven"}


def test_the_metadata_are_those_of_jazzy(tmp_path: Path) -> None:
    """The keys and values that rosbag2 writes in version 9."""
    bag = write(tmp_path / "drive", said(TEXTS), BagWriterOptions(compression="file"))
    about = yaml.safe_load((bag / "metadata.yaml").read_text())["rosbag2_bagfile_information"]
    assert about["version"] == 9
    assert about["ros_distro"] == "jazzy"
    assert about["storage_identifier"] == "mcap"
    assert about["compression_mode"] == "FILE" and about["compression_format"] == "zstd"
    assert about["relative_file_paths"] == ["drive_0.mcap.zstd"]
    assert about["starting_time"] == {"nanoseconds_since_epoch": BEGIN_NS}
    assert about["duration"] == {"nanoseconds": 24 * STEP_NS}
    first = about["topics_with_message_count"][0]
    assert first["topic_metadata"]["type_description_hash"].startswith("RIHS01_df668c740482")
    assert (first["message_count"], about["message_count"]) == (25, 25)


@pytest.mark.parametrize("storage", STORAGES)
def test_a_bag_is_split_by_size(tmp_path: Path, storage: str) -> None:
    """Each file but the last is about as large as it may be."""
    least = LEAST_SPLIT[storage]
    texts = ["x" * (least // 4)] * 10
    bag = write(tmp_path / "b", said(texts), BagWriterOptions(storage, max_size=least))
    counts = [file.span.count for file in read_metadata(bag).files]
    assert counts == [4, 4, 2]
    assert [path.name for path in sorted(bag.glob("b_*"))] == [
        f.name for f in read_metadata(bag).files
    ]
    with pytest.raises(TooSmall, match=f"greater than {least}. Specified value of 10"):
        BagWriter(tmp_path / "c", BagWriterOptions(storage, max_size=10))
    assert not (tmp_path / "c").exists()


@pytest.mark.parametrize("storage", STORAGES)
@pytest.mark.parametrize("compression", COMPRESSIONS)
def test_metadata_are_made_again(tmp_path: Path, storage: str, compression: Compression) -> None:
    """From the files alone, the same as before."""
    bag = write(
        tmp_path / "b", said(TEXTS), BagWriterOptions(storage, compression, max_duration_s=1.0)
    )
    before = read_metadata(bag)
    (bag / "metadata.yaml").unlink()
    with pytest.raises(NoMetadata, match="ros2 bag reindex"):
        read_metadata(bag)
    reindex(bag)
    after = read_metadata(bag)
    assert (after.files, after.span, after.storage) == (before.files, before.span, before.storage)
    assert after.compression_mode == before.compression_mode
    assert [(t.name, t.count) for t in after.topics] == [(t.name, t.count) for t in before.topics]
    assert read_by_rosbags(bag) == said(TEXTS)


KILLED = """
import os, signal, sys
sys.path.insert(0, {here!r})
from pathlib import Path
from bags import TOPICS, raw, said
from ros2_on_pip.rosbag2.writing import BagWriter, BagWriterOptions
writer = BagWriter(Path(sys.argv[1]), BagWriterOptions(sys.argv[2]))
for topic in TOPICS:
    writer.add_topic(topic)
for number, (topic, time_ns, text) in enumerate(said([str(n) for n in range(200)])):
    writer.write(topic, time_ns, raw(text * 1000))
    if number == 99:
        writer.settle()
os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.mark.parametrize("storage", STORAGES)
def test_a_killed_recorder_leaves_what_it_wrote(tmp_path: Path, storage: str) -> None:
    """No battery, no end: all that was on the disk comes back."""
    code = KILLED.format(here=str(HERE))
    bag = tmp_path / "b"
    done = subprocess.run([sys.executable, "-c", code, str(bag), storage], check=False)
    assert done.returncode == -signal.SIGKILL
    with pytest.raises(NoMetadata):
        read_metadata(bag)
    assert reindex(bag).span.count >= 100
    texts = [text for _, _, text in read_by_rosbags(bag)]
    assert texts[:100] == [str(n) * 1000 for n in range(100)]
    if storage == "mcap":
        assert [text for _, _, text in read_by_mcap(bag)] == texts


FULL = """
import resource, sys
sys.path.insert(0, {here!r})
from pathlib import Path
from bags import TOPICS, raw, said
from ros2_on_pip.rosbag2.errors import BagNotWritable
from ros2_on_pip.rosbag2.writing import BagWriter, BagWriterOptions
resource.setrlimit(resource.RLIMIT_FSIZE, (1_500_000, 1_500_000))
writer = BagWriter(Path(sys.argv[1]), BagWriterOptions(sys.argv[2]))
for topic in TOPICS:
    writer.add_topic(topic)
try:
    for number, (topic, time_ns, text) in enumerate(said([str(n) for n in range(4000)])):
        writer.write(topic, time_ns, raw(text.rjust(1000)))
        if number % 50 == 49:
            writer.settle()
except BagNotWritable as trouble:
    print(trouble)
writer.close()
"""


@pytest.mark.parametrize("storage", STORAGES)
def test_a_full_disk_leaves_a_whole_bag(tmp_path: Path, storage: str) -> None:
    """It says so, and what found room can be read. (A bound on a file stands for the disk.)"""
    bag = tmp_path / "b"
    words = [sys.executable, "-c", FULL.format(here=str(HERE)), str(bag), storage]
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    assert f"cannot write the bag '{bag}'" in done.stdout and "Make room there" in done.stdout
    texts = [text.strip() for _, _, text in read_by_rosbags(bag)]
    assert len(texts) >= 1000 and texts == [str(n) for n in range(len(texts))]
    assert read_metadata(bag).span.count == len(texts)


@pytest.mark.parametrize("storage", STORAGES)
def test_a_bag_without_messages(tmp_path: Path, storage: str) -> None:
    """It is a bag all the same."""
    bag = write(tmp_path / "b", [], BagWriterOptions(storage))
    assert read_by_rosbags(bag) == []
    assert read_metadata(bag).span.count == 0
    assert reindex(bag).span.count == 0


def test_nothing_is_overwritten(tmp_path: Path) -> None:
    """A folder of that name stays as it is."""
    (tmp_path / "b").mkdir()
    with pytest.raises(BagThere, match="already exists"):
        BagWriter(tmp_path / "b", BagWriterOptions())
    (tmp_path / "file").write_text("mine")
    with pytest.raises(BagNotWritable, match="Not a directory"):
        BagWriter(tmp_path / "file" / "b", BagWriterOptions())
    with pytest.raises(BadBagPath, match="-s mcap"):
        write(tmp_path / "50%", [], BagWriterOptions("sqlite3"))


def test_what_is_no_bag_is_told(tmp_path: Path) -> None:
    """A reason and a next step each."""
    with pytest.raises(NoBag, match="nothing of that name"), opened(tmp_path / "b"):
        pass
    with pytest.raises(NoBag, match=r"metadata.yaml is not there"), opened(tmp_path):
        pass
    (tmp_path / "x.txt").write_text("")
    with pytest.raises(NoBag, match=r"neither .mcap nor .db3"), opened(tmp_path / "x.txt"):
        pass
    with pytest.raises(NoBag, match="no file of messages"):
        reindex(tmp_path)


Wound = Literal["cut", "letters", "gone", "no yaml", "other yaml"]


def wound(bag: Path, how: Wound) -> None:
    """Make a bag a broken one."""
    file = next(bag.glob("b_0.*"))
    data = file.read_bytes()
    if how == "cut":
        file.write_bytes(data[: len(data) // 2])
    elif how == "letters":
        file.write_bytes(b"These are no messages. " * 50)
    elif how == "gone":
        file.unlink()
    else:
        (bag / "metadata.yaml").write_text("a: [" if how == "no yaml" else "a: 1")


@pytest.mark.parametrize("storage", STORAGES)
@pytest.mark.parametrize("compression", ["none", "file"])
@pytest.mark.parametrize("how", ["cut", "letters", "gone", "no yaml", "other yaml"])
def test_a_broken_bag_is_told(
    tmp_path: Path, storage: str, compression: Compression, how: Wound
) -> None:
    """Never a traceback."""
    bag = write(tmp_path / "b", said(TEXTS * 40), BagWriterOptions(storage, compression))
    wound(bag, how)
    with pytest.raises((DamagedBag, NoBag)) as told, opened(bag) as reader:
        list(reader.messages())
    assert "\n" not in str(told.value) and "ros2 bag reindex" in str(told.value)


def test_a_torn_file_is_mended(tmp_path: Path) -> None:
    """Cut anywhere, it becomes whole up to there."""
    bag = write(tmp_path / "b", said(TEXTS))
    file = bag / "b_0.mcap"
    data = file.read_bytes()
    for size in range(len(data) - 1, 60, -97):
        file.write_bytes(data[:size])
        assert reindex(bag).span.count in (0, 25)
        assert read_by_mcap(bag) == read_by_rosbags(bag)
    file.write_bytes(data)
    assert reindex(bag).span.count == 25
    assert file.read_bytes() == data


def test_a_topic_is_chosen() -> None:
    """By name, type and expression, and left out again."""
    choice = TopicFilter(
        names=["/a"], regex="^/cam", without=["/camera/info"], without_regex="raw$"
    )
    names = ["/a", "/b", "/camera/image", "/camera/info", "/camera/raw"]
    assert [name for name in names if choice.takes(name, STRING_TYPE)] == ["/a", "/camera/image"]
    assert TopicFilter(types=[STRING_TYPE]).takes("/x", STRING_TYPE)
    assert not TopicFilter(types=[STRING_TYPE]).takes("/x", "std_msgs/msg/Bool")
    assert TopicFilter().takes("/x", STRING_TYPE)
    with pytest.raises(BadExpression, match="no regular expression"):
        TopicFilter(regex="*")


def test_an_expression_matches_a_whole_name_where_that_is_asked_for() -> None:
    """Of a bag that is read, as in rosbag2; while one is recorded a part is enough."""
    for regex, part, whole in (("cam", True, False), ("/cam.*", True, True), ("/cam", True, False)):
        assert TopicFilter(regex=regex).takes("/camera", STRING_TYPE) is part
        assert TopicFilter(regex=regex, whole_names=True).takes("/camera", STRING_TYPE) is whole
        assert TopicFilter(without_regex=regex).takes("/camera", STRING_TYPE) is not part
        left = TopicFilter(without_regex=regex, whole_names=True).takes("/camera", STRING_TYPE)
        assert left is not whole


STRING_TYPE = TOPICS[0].type


def test_profiles_come_from_a_file(tmp_path: Path) -> None:
    """In the words of rosbag2."""
    file = tmp_path / "qos.yaml"
    file.write_text(
        "/scan:\n  reliability: best_effort\n  durability: volatile\n  history: keep_last\n"
        "  depth: 5\n  deadline: {sec: 1, nsec: 5}\n"
    )
    profile = overrides(file)["/scan"]
    assert (profile.reliability.name, profile.depth) == ("BEST_EFFORT", 5)
    assert profile.deadline.nanoseconds == 10**9 + 5
    assert overrides(None) == {}


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("/scan: {reliability: sometimes, depth: 1}", "SOMETIMES"),
        ("/scan: {speed: 3}", "no policy 'speed'"),
        ("/scan: {depth: -1}", "below zero"),
        ("/scan: {depth: 1, deadline: {sec: 1}}", "nsec"),
        ("/scan: {reliability: reliable}", "history"),
        ("/scan: [", "cannot be used"),
        ("- /scan", "cannot be used"),
    ],
)
def test_profiles_that_are_wrong_are_told(tmp_path: Path, text: str, why: str) -> None:
    """With the form that is right."""
    file = tmp_path / "qos.yaml"
    file.write_text(text)
    with pytest.raises(BadOverrides, match=why) as told:
        overrides(file)
    assert "reliability: best_effort" in str(told.value)


def test_a_topic_that_comes_late_is_in_every_file(tmp_path: Path) -> None:
    """Also its quality of service, which the reader compares."""
    from rclpy.qos import qos_profile_sensor_data

    from ros2_on_pip.rosbag2.quality import kept

    writer = BagWriter(tmp_path / "b", BagWriterOptions())
    writer.add_topic(TOPICS[0])
    writer.write("/heard", 1, raw("one"))
    writer.split()
    writer.add_topic(Topic("/late", STRING_TYPE, qos=(kept(qos_profile_sensor_data),)))
    writer.write("/late", 2, raw("two"))
    writer.split()
    writer.write("/late", 3, raw("three"))
    writer.close()
    assert read_by_rosbags(tmp_path / "b") == [
        ("/heard", 1, "one"),
        ("/late", 2, "two"),
        ("/late", 3, "three"),
    ]
    late = next(t for t in read_metadata(tmp_path / "b").topics if t.name == "/late")
    assert late.qos[0].reliability.name == "BEST_EFFORT"


def test_a_torn_file_of_another_recorder_is_mended(tmp_path: Path) -> None:
    """Its chunks are compressed, its stamps not in order; both readers find all that is whole."""
    kind = TYPES.types[STRING_TYPE]
    writer = Writer(tmp_path / "b", version=9, storage_plugin=StoragePlugin.MCAP)
    writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
    with writer:
        heard = writer.add_connection("/heard", kind.__msgtype__, typestore=TYPES)
        for number in range(30):
            stamp_ns = BEGIN_NS + (number ^ 1)
            writer.write(heard, stamp_ns, raw(f"{number} {os.urandom(50_000).hex()}"))
    file = tmp_path / "b/b.mcap"
    file.write_bytes(file.read_bytes()[:-5000])
    (tmp_path / "b/metadata.yaml").unlink()
    count = reindex(tmp_path / "b").span.count
    assert 10 <= count < 30
    texts = [text.partition(" ")[0] for _, _, text in read_by_rosbags(tmp_path / "b")]
    assert texts == [str(number ^ 1) for number in range(count)]
    assert sorted(read_by_mcap(tmp_path / "b")) == sorted(read_by_rosbags(tmp_path / "b"))
    assert [path.name for path in sorted((tmp_path / "b").iterdir())] == ["b.mcap", "metadata.yaml"]


@pytest.mark.parametrize("storage", STORAGES)
def test_a_torn_compressed_file_is_mended(tmp_path: Path, storage: str) -> None:
    """What can still be unpacked is packed again, or it is said that nothing can be saved."""
    texts = [str(number).rjust(20_000) for number in range(200)]
    bag = write(tmp_path / "b", said(texts), BagWriterOptions(storage, "file"))
    file = next(bag.glob("*.zstd"))
    file.write_bytes(file.read_bytes()[:-20])
    if storage == "mcap":
        assert 0 < reindex(bag).span.count <= 200
        assert read_by_mcap(bag) == read_by_rosbags(bag)
    else:
        with pytest.raises(NoBag, match="cannot be read"):
            reindex(bag)
