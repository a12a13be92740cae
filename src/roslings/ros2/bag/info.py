"""`ros2 bag info`: what is in a bag."""

from __future__ import annotations

import argparse
from datetime import datetime
from pathlib import Path
from typing import Any

from roslings.ros2.bag.reading import NoBag, opened
from roslings.ros2.words import OK

UNITS = ("B", "KiB", "MiB", "GiB", "TiB")
INDENT = 19 * " "
STORAGE = {".mcap": "mcap", ".db3": "sqlite3"}


def show_info(options: argparse.Namespace) -> int:
    """`ros2 bag info BAG`."""
    path = options.bag_path
    with opened(path) as reader:
        print("\n" + "\n".join(lines_of(reader, _files(path))))
    return OK


def _files(path: Path) -> list[Path]:
    files = [path] if path.is_file() else sorted(p for p in path.iterdir() if p.suffix in STORAGE)
    if not files:
        raise NoBag(path, "it holds no file of messages")
    return files


def lines_of(reader: Any, files: list[Path]) -> list[str]:
    """The lines of Jazzy's `ros2 bag info`."""
    size = sum(file.stat().st_size for file in files)
    empty = not reader.message_count
    start_ns, end_ns = (0, 0) if empty else (reader.start_time, reader.end_time - 1)
    topics = [
        f"Topic: {c.topic} | Type: {c.msgtype} | Count: {c.msgcount}"
        f" | Serialization Format: {c.ext.serialization_format}"
        for c in sorted(reader.connections, key=lambda c: c.topic)
    ]
    return [
        "Files:             " + f"\n{INDENT}".join(file.name for file in files),
        f"Bag size:          {readable(size)}",
        f"Storage id:        {STORAGE.get(files[0].suffix, 'unknown')}",
        f"ROS Distro:        {distribution(reader)}",
        f"Duration:          {seconds(end_ns - start_ns)}s",
        f"Start:             {moment(start_ns)}",
        f"End:               {moment(end_ns)}",
        f"Messages:          {reader.message_count}",
        "Topic information: " + f"\n{INDENT}".join(topics),
        "Service:           0",
        "Service information: ",
    ]


def distribution(reader: Any) -> str:
    """The ROS that wrote the bag; `rosbags` writes its own name in that place."""
    name = str(reader.ros_distro or "")
    return name if name and name != "rosbags" else "unknown"


def readable(size: float) -> str:
    """A size in bytes, as rosbag2 writes it."""
    index = 0
    while size >= 1024 and index < len(UNITS) - 1:
        size, index = size / 1024, index + 1
    return f"{size:.{1 if index else 0}f} {UNITS[index]}"


def seconds(duration_ns: int) -> str:
    """Seconds with milliseconds."""
    whole, rest = divmod(duration_ns // 10**6, 1000)
    return f"{whole}.{rest:03d}"


def moment(time_ns: int) -> str:
    """A moment in local time, and as seconds since 1970."""
    local = datetime.fromtimestamp(time_ns // 10**9)
    day = f"{local:%b} {local.day:2d} {local:%Y %H:%M:%S}"
    return f"{day}.{time_ns // 10**6 % 1000:03d} ({seconds(time_ns)})"
