"""What is in a bag, in the lines of `ros2 bag info`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from datetime import datetime

from ros2_on_pip.rosbag2.metadata import Metadata, Topic
from ros2_on_pip.rosbag2.reading import BagReader

UNITS = ("B", "KiB", "MiB", "GiB", "TiB")
INDENT = 19 * " "
EVENT = "/_service_event"


REQUESTS, RESPONSES = (0, 1), (2, 3)
"""What service_msgs/msg/ServiceEventInfo calls sent and received."""

Seen = Mapping[str, tuple[int, int]]
"""Topic of a service's events to how many requests and how many responses it holds."""


def events_in(reader: BagReader) -> Seen:
    """How often each service was asked, and answered; sent and received count once."""
    found: dict[str, set[tuple[bool, bytes]]] = {
        topic.name: set() for topic in reader.metadata.topics if is_event(topic)
    }
    for topic, _, raw in reader.messages(lambda name, _: name in found):
        found[topic].add(_call(raw))
    return {name: (_of(calls, REQUESTS), _of(calls, RESPONSES)) for name, calls in found.items()}


def _call(raw: bytes) -> tuple[bool, bytes]:
    """Whether it is an answer, and who asked: the client and the number of its question.

    The event begins with its info. That is a byte for the kind, a stamp, 16 bytes of the client's
    id, and the number. The number begins at a multiple of 8 (CDR).
    """
    body = memoryview(raw)[4:]
    return body[0] in RESPONSES, bytes(body[12:28]) + bytes(body[32:40])


def _of(calls: Iterable[tuple[bool, bytes]], kind: tuple[int, int]) -> int:
    return sum(answer == (kind == RESPONSES) for answer, _ in calls)


def is_event(topic: Topic) -> bool:
    """Whether the topic holds what was said to and by a service."""
    typed = "/srv/" in topic.type and topic.type.endswith("_Event")
    return typed and topic.name.endswith(EVENT)


def names_of(metadata: Metadata) -> list[str]:
    """What `-t` prints: the topics' names."""
    return [topic.name for topic in metadata.topics if not is_event(topic)]


def lines_of(metadata: Metadata, sort: str = "name", seen: Seen | None = None) -> list[str]:
    """The lines of Jazzy's `ros2 bag info`; with `seen`, those of `-v`."""
    span = metadata.span
    first_ns = span.first_ns if span.count else 0
    services = [topic for topic in metadata.topics if is_event(topic)]
    topics = [topic for topic in metadata.topics if not is_event(topic)]
    return [
        "",
        "Files:             " + _column(file.name for file in metadata.files),
        f"Bag size:          {readable(metadata.size)}",
        f"Storage id:        {metadata.storage}",
        f"ROS Distro:        {_distribution(metadata)}",
        f"Duration:          {seconds(span.duration_ns)}s",
        f"Start:             {moment(first_ns)}",
        f"End:               {moment(first_ns + span.duration_ns)}",
        f"Messages:          {span.count}",
        "Topic information: " + _column(map(_topic_line, in_order(topics, sort))),
        f"Service:           {len(services)}",
        "Service information: "
        + _column(_service_line(topic, seen) for topic in in_order(services, sort)),
    ]


def in_order(topics: Sequence[Topic], sort: str) -> list[Topic]:
    """By name, type or count; the most messages come last."""
    return sorted(topics, key=lambda topic: (getattr(topic, sort), topic.name))


def _column(lines: Iterable[str]) -> str:
    return f"\n{INDENT}".join(lines)


def _topic_line(topic: Topic) -> str:
    return (
        f"Topic: {topic.name} | Type: {topic.type} | Count: {topic.count}"
        f" | Serialization Format: {topic.format}"
    )


def _service_line(topic: Topic, seen: Seen | None) -> str:
    count = f"Event Count: {topic.count}"
    if seen is not None:
        requests, responses = seen[topic.name]
        count = f"Request Count: {requests} | Response Count: {responses}"
    return (
        f"Service: {topic.name.removesuffix(EVENT)} | Type: {topic.type.removesuffix('_Event')}"
        f" | {count} | Serialization Format: {topic.format}"
    )


def _distribution(metadata: Metadata) -> str:
    """The ROS that wrote the bag; `rosbags` writes its own name in that place."""
    name = metadata.distro
    return name if name and name != "rosbags" else "unknown"


def readable(size: float) -> str:
    """A size in bytes, as rosbag2 writes it."""
    index = 0
    while size >= 1024 and index < len(UNITS) - 1:
        size, index = size / 1024, index + 1
    return f"{size:.{1 if index else 0}f} {UNITS[index]}"


def seconds(duration_ns: int) -> str:
    """Seconds with nine digits, as Jazzy writes them."""
    whole, rest = divmod(duration_ns, 10**9)
    return f"{whole}.{rest:09d}"


def moment(time_ns: int) -> str:
    """A moment in local time, and as seconds since 1970."""
    local = datetime.fromtimestamp(time_ns // 10**9)
    day = f"{local:%b} {local.day:2d} {local:%Y %H:%M:%S}"
    return f"{day}.{time_ns % 10**9:09d} ({seconds(time_ns)})"
