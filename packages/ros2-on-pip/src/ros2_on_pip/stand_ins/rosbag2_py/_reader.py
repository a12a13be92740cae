"""Read a bag, message by message."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator

from ros2_on_pip.rosbag2.choosing import TopicFilter
from ros2_on_pip.rosbag2.reading import BagReader, Message, open_bag

from ._errors import as_runtime_error, path_of, require_text
from ._storage import (
    BagMetadata,
    ConverterOptions,
    MessageDefinition,
    ReadOrder,
    ReadOrderSortBy,
    StorageFilter,
    StorageOptions,
    TopicMetadata,
    from_bag,
    from_topic,
)

NOT_OPEN = "Bag is not open. Call open() before reading."
AT_END = "Bag is at end. No next message. Ask has_next() first."
ENCODINGS = {"MSG": "ros2msg", "IDL": "ros2idl"}


class SequentialReader:
    """Hands out the messages of a bag in the order in which they came."""

    def __init__(self) -> None:
        self._bag: BagReader | None = None
        self._order = ReadOrder()
        self._choice = TopicFilter()
        self._next: Message | None = None
        self._messages: Iterator[Message] = iter(())
        self._last_ns: int | None = None
        self._given = Counter[str]()

    def __del__(self) -> None:
        self.close()

    def open(self, storage_options: StorageOptions, converter_options: ConverterOptions) -> None:
        """Open the bag at `storage_options.uri`. Raises RuntimeError.

        Its files must be stored as `storage_id` says; where that is empty, the bag tells it.
        """
        self._open(storage_options.uri, storage_options.storage_id)

    def open_uri(self, uri: str) -> None:
        """Open the bag at `uri`, a folder or a file. Raises RuntimeError."""
        require_text(uri, "uri")
        self._open(uri, "")

    def _open(self, uri: str, storage_id: str) -> None:
        self.close()
        with as_runtime_error():
            self._bag = open_bag(path_of(uri), storage_id)
        self._restart(None)

    def close(self) -> None:
        """Close the bag; without one nothing happens."""
        bag, self._bag = getattr(self, "_bag", None), None
        if bag:
            bag.close()

    def has_next(self) -> bool:
        """Whether there is one more message."""
        self._require()
        if self._next is None:
            with as_runtime_error():
                self._next = next(self._messages, None)
        return self._next is not None

    def read_next(self) -> tuple[str, bytes, int]:
        """The topic, the bytes and the time (ns since 1970) of the next message.

        Raises RuntimeError at the end.
        """
        if not self.has_next() or self._next is None:
            raise RuntimeError(AT_END)
        (topic, time_ns, raw), self._next = self._next, None
        if time_ns != self._last_ns:
            self._last_ns, self._given = time_ns, Counter[str]()
        self._given[topic] += 1
        return topic, raw, time_ns

    def seek(self, timestamp: int) -> None:
        """Go on with the first message that came at `timestamp` (ns) or later."""
        self._require()
        self._restart(timestamp)

    def set_filter(self, storage_filter: StorageFilter) -> None:
        """From here on hand out only what the filter lets through. Raises RuntimeError."""
        self._require()
        asked = storage_filter
        with as_runtime_error():
            self._choice = TopicFilter(
                names=[*asked.topics, *asked.services_events],
                regex=asked.regex,
                without=[*asked.exclude_topics, *asked.exclude_service_events],
                without_regex=asked.regex_to_exclude,
                whole_names=True,
            )
        self._go_on_from_here()

    def reset_filter(self) -> None:
        """From here on hand out everything."""
        self.set_filter(StorageFilter())

    def set_read_order(self, read_order: ReadOrder) -> bool:
        """Whether there is such an order; then it counts from here on."""
        self._require()
        if read_order.sort_by == ReadOrderSortBy.PublishedTimestamp:
            return False
        self._order = read_order
        self._go_on_from_here()
        return True

    def get_metadata(self) -> BagMetadata:
        """What the bag holds."""
        return from_bag(self._require().metadata)

    def get_all_topics_and_types(self) -> list[TopicMetadata]:
        """Its topics."""
        topics = self._require().metadata.topics
        return [from_topic(number, topic) for number, topic in enumerate(topics, 1)]

    def get_all_message_definitions(self) -> list[MessageDefinition]:
        """The texts of its types."""
        return [
            MessageDefinition(
                name,
                ENCODINGS.get(each.msgdef.format.name, "unknown"),
                each.msgdef.data,
                each.digest,
            )
            for name, each in self._require().definitions.items()
        ]

    def _require(self) -> BagReader:
        if self._bag is None:
            raise RuntimeError(NOT_OPEN)
        return self._bag

    def _restart(self, from_ns: int | None) -> None:
        self._next = None
        self._last_ns, self._given = from_ns, Counter[str]()
        self._messages = self._ordered(self._require(), from_ns)

    def _go_on_from_here(self) -> None:
        """What was handed out of the very last moment does not come again."""
        last_ns, given = self._last_ns, self._given
        self._restart(last_ns)
        self._given = Counter(given)
        self._messages = _without(self._messages, last_ns, given)

    def _ordered(self, bag: BagReader, from_ns: int | None) -> Iterator[Message]:
        takes = self._choice.takes
        if not self._order.reverse:
            return bag.messages(takes, from_ns or 0)
        return _backwards(lambda: bag.messages(takes), from_ns)


def _backwards(read: Callable[[], Iterator[Message]], from_ns: int | None) -> Iterator[Message]:
    """The last message first; all of them are in memory then."""
    earlier = [each for each in read() if from_ns is None or each[1] <= from_ns]
    yield from reversed(earlier)


def _without(
    messages: Iterator[Message], time_ns: int | None, given: Counter[str]
) -> Iterator[Message]:
    left = Counter(given)
    for message in messages:
        if message[1] == time_ns and left[message[0]] > 0:
            left[message[0]] -= 1
        else:
            yield message


class SequentialCompressionReader(SequentialReader):
    """The same: compressed bags are read by either."""


def get_registered_readers() -> set[str]:
    """How bags may be stored that are read."""
    return {"mcap", "sqlite3"}
