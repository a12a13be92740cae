"""Messages a second, written into a bag and read from one, beside the bare library `rosbags`.

    python tests/bench/bags.py [MESSAGES]

It prints, and asserts nothing. Each line is the best of three rounds with messages of that size, by
the seconds of a processor, so that other work on the machine counts little; `x` is our rate over
the bare one. The last lines are a real `ros2 bag record` beside a node of 1000 and one of 3000 Hz:
how many it sent, and how many the bag holds.
"""

from __future__ import annotations

import platform
import shutil
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from rosbags.rosbag2 import CompressionFormat, CompressionMode, Reader, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from ros2_on_pip.domain_lease import leased_domain
from ros2_on_pip.rosbag2.metadata import Topic
from ros2_on_pip.rosbag2.reading import opened, read_metadata
from ros2_on_pip.rosbag2.writing import BagWriter, BagWriterOptions, Compression

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "packages/ros2-on-pip/tests"))

from terminal import Shell, surroundings

TYPES = get_typestore(Stores.ROS2_JAZZY)
STRING = "std_msgs/msg/String"
ROUNDS = 3
SIZES = (100, 10_000)
KINDS: tuple[tuple[str, Compression], ...] = (
    ("mcap", "none"),
    ("mcap", "message"),
    ("sqlite3", "none"),
)
PLUGINS = {"mcap": StoragePlugin.MCAP, "sqlite3": StoragePlugin.SQLITE3}

FLOOD = """
import rclpy, sys, time
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("flood")
voice = node.create_publisher(String, "flood", 1000)
message = String(data="x" * 100)
while not voice.get_subscription_count():
    time.sleep(0.01)
began = time.monotonic()
for number in range(int(sys.argv[1])):
    due = began + number / float(sys.argv[2])
    time.sleep(max(0.0, due - time.monotonic()))
    voice.publish(message)
print("sent", round(int(sys.argv[1]) / (time.monotonic() - began)), flush=True)
time.sleep(5.0)
"""


def main(count: int) -> None:
    """Print all figures."""
    print(f"Python {platform.python_version()}, {count} messages, best of {ROUNDS} rounds")
    with tempfile.TemporaryDirectory() as scratch:
        for storage, compression in KINDS:
            for size in SIZES:
                compare(Path(scratch), storage, compression, size, count)
        for rate_hz in (1000, 3000):
            record(Path(scratch), rate_hz)


def compare(folder: Path, storage: str, compression: Compression, size: int, count: int) -> None:
    """One line for writing, one for reading."""
    raw = bytes(TYPES.serialize_cdr(TYPES.types[STRING]("x" * size), STRING))
    bag = folder / "bag"
    ours = best(count, bag, lambda: write(bag, BagWriterOptions(storage, compression), raw, count))
    bare = best(count, bag, lambda: write_bare(bag, storage, compression, raw, count))
    told(f"write {storage} {compression} {size} B", ours, bare)
    ours = best(count, None, lambda: read(bag))
    bare = best(count, None, lambda: read_bare(bag))
    told(f"read  {storage} {compression} {size} B", ours, bare)


def told(what: str, ours: float, bare: float) -> None:
    """Print a line."""
    print(f"{what:32} ours {ours:9.0f}/s   rosbags {bare:9.0f}/s   x {ours / bare:.2f}", flush=True)


def best(count: int, fresh: Path | None, work: Callable[[], None]) -> float:
    """Messages a second in the quickest round; `fresh` is removed before each."""
    quickest_s = float("inf")
    for _ in range(ROUNDS):
        if fresh:
            shutil.rmtree(fresh, ignore_errors=True)
        began_s = time.process_time()
        work()
        quickest_s = min(quickest_s, time.process_time() - began_s)
    return count / quickest_s


def write(bag: Path, plan: BagWriterOptions, raw: bytes, count: int) -> None:
    """By the writer under `ros2 bag record` and `rosbag2_py`."""
    writer = BagWriter(bag, plan)
    writer.add_topic(Topic("/heard", STRING))
    for number in range(count):
        writer.write("/heard", 10**18 + number, raw)
    writer.close()


def write_bare(bag: Path, storage: str, compression: Compression, raw: bytes, count: int) -> None:
    """By the library alone."""
    writer = Writer(bag, version=9, storage_plugin=PLUGINS[storage])
    writer.set_compression(CompressionMode[compression.upper()], CompressionFormat.ZSTD)
    with writer:
        heard = writer.add_connection("/heard", STRING, typestore=TYPES)
        for number in range(count):
            writer.write(heard, 10**18 + number, raw)


def read(bag: Path) -> None:
    """By the reader under `ros2 bag play` and `rosbag2_py`."""
    with opened(bag) as reader:
        for _ in reader.messages():
            pass


def read_bare(bag: Path) -> None:
    """By the library alone."""
    with Reader(bag) as reader:
        for _ in reader.messages():
            pass


def record(folder: Path, rate_hz: int) -> None:
    """A real recorder beside a real node, five seconds."""
    count = 5 * rate_hz
    with leased_domain() as domain:
        shell = Shell(surroundings(domain, folder), folder)
        shutil.rmtree(folder / "real", ignore_errors=True)
        command = [sys.executable, "-c", FLOOD, str(count), str(rate_hz)]
        local = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
        words = ("bag", "record", "--topics", "/flood", "-o", "real")
        with shell.program(command, **local) as node, shell.start(*words) as recorder:
            node.wait()
            recorder.interrupt()
    kept = read_metadata(folder / "real").span.count
    sent = node.text.rpartition(" ")[2]
    print(f"record beside a node that sends {sent}/s: {kept} of {count} messages", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 20_000)
