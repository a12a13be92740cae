"""`ros2 topic echo`: print each message as it comes."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Callable
from typing import Any

from ros2_on_pip import qos
from ros2_on_pip.discovery import DirectNode
from ros2_on_pip.habits import index_in_field
from ros2_on_pip.interfaces import class_of, full_name
from ros2_on_pip.listening import filter_in, known_type, subscribe, topic_in
from ros2_on_pip.problem import CommandProblem, did_you_mean
from ros2_on_pip.words import OK
from ros2_on_pip.yaml_out import YamlOptions, as_csv, as_yaml, is_message

_PLACE = re.compile(r"([^.\[\]]+)|\[(\d+)\]")


class NoSuchField(CommandProblem):
    """`--field` names something that the message does not have."""

    def __init__(self, field: str, reason: str) -> None:
        super().__init__(f"Invalid field '{field}': {reason}")


def echo(options: argparse.Namespace) -> int:
    """`ros2 topic echo TOPIC [TYPE]`."""
    topic = topic_in(options)
    if options.message_type:  # a wrong type is said before anything is waited for
        class_of(options.message_type, "msg")
    passes = filter_in(options)
    for field in options.field or []:
        index_in_field(field)
    with DirectNode.asked_by(options) as direct_node:
        direct_node.settle()
        type_name = _type(direct_node, topic, options)
        picks = [_checked(field, class_of(type_name, "msg")) for field in options.field or []]
        printer = Printer(options, picks, passes)
        subscribe(
            direct_node,
            topic,
            type_name,
            _profile(direct_node, topic, options),
            printer.hear,
            options.raw,
            None if options.no_lost_messages else say_lost,
        )
        direct_node.until(lambda: printer.done, options.timeout)
    return OK


def _type(direct_node: DirectNode, topic: str, options: argparse.Namespace) -> str:
    if options.message_type:
        return full_name(options.message_type, "msg")
    return known_type(direct_node, topic)


def _profile(direct_node: DirectNode, topic: str, options: argparse.Namespace) -> Any:
    """The quality to ask for; a word is said where it hears less than was meant."""
    profile = qos.for_echo(options, direct_node.publishers(topic))
    if qos.hears_nothing_earlier(profile):
        print(
            "NOTE: with one --qos option, all others are those of sensor_data, which is best"
            " effort: what was sent before does not come. Add: --qos-reliability reliable",
            file=sys.stderr,
        )
    return profile


def say_lost(status: Any) -> None:
    """Messages did not arrive; printed as the real tool does."""
    print(
        f"A message was lost!!!\n\ttotal count change:{status.total_count_change}"
        f"\n\ttotal count: {status.total_count}---"
    )


class Printer:
    """Prints messages, or fields of them, in the shape that the options ask for."""

    def __init__(
        self,
        options: argparse.Namespace,
        picks: list[list[str | int]],
        passes: Callable[[Any], bool] = lambda _: True,
    ) -> None:
        """`picks` are the places of `--field`; `passes` is `--filter`."""
        self._once = options.once
        self._csv = options.csv
        self._informed = options.include_message_info
        self._shape = shape_in(options)
        self._picks = picks
        self._passes = passes
        self.done = False

    def hear(self, message: Any, info: Any) -> None:
        """Print one message."""
        if self.done:
            return
        parts = [_picked(message, places) for places in self._picks] or [message]
        if not self._passes(parts[0]):
            return
        print(self._text(parts, info if self._informed else None))
        self.done = self._once

    def _text(self, parts: list[Any], info: Any) -> str:
        if len(parts) == 1 and not is_message(parts[0]):
            return f"{_raw_head(info)}{parts[0]}\n---"
        if self._csv:
            head = [str(value) for value in info.values()] if info else []
            return ",".join([*head, *(as_csv(part, self._shape) for part in parts)])
        head = [f"{as_yaml(dict(sorted(info.items())), self._shape)}---\n"] if info else []
        return "".join([*head, *(_shown(part, self._shape) for part in parts), "---"])


def _raw_head(info: Any) -> str:
    if info is None:
        return ""
    return f"---Got new message, message info:---\n{info}\n---Message data:---\n"


def _shown(part: Any, shape: YamlOptions) -> str:
    """The real tool prints a field that is no message as Python has it."""
    return as_yaml(part, shape) if is_message(part) else f"{part}\n"


def shape_in(options: argparse.Namespace) -> YamlOptions:
    """How much of each message the options ask for."""
    return YamlOptions(
        longest=None if options.full_length else options.truncate_length,
        no_arrays=options.no_arr,
        no_texts=options.no_str,
        flow=options.flow_style,
    )


def _checked(field: str, cls: Any) -> list[str | int]:
    """The places of `--field a.b[0].c`, tried on an empty message. Raises NoSuchField."""
    places: list[str | int] = [
        int(index) if index else name for name, index in _PLACE.findall(field)
    ]
    if not places:
        raise NoSuchField(field, "it names no field")
    _follow(field, cls(), places)
    return places


def _follow(field: str, part: Any, places: list[str | int]) -> None:
    """Stops at the first list: only a real message tells how long it is."""
    for place in places:
        if isinstance(place, int) or not hasattr(part, "get_fields_and_field_types"):
            return
        fields = list(part.get_fields_and_field_types())
        if place not in fields:
            raise NoSuchField(
                field,
                f"there is no '{place}'.{did_you_mean(place, fields)}"
                f" There is: {', '.join(fields) or 'nothing'}",
            )
        part = getattr(part, place)


def _picked(message: Any, places: list[str | int]) -> Any:
    part = message
    for place in places:
        try:
            part = part[place] if isinstance(place, int) else getattr(part, place)
        except (IndexError, AttributeError, TypeError) as fault:
            raise NoSuchField(".".join(map(str, places)), str(fault)) from None
    return part
