"""`ros2 topic echo`: print each message as it comes."""

from __future__ import annotations

import argparse
import re
from typing import Any

from roslings.ros2.eye import Eye
from roslings.ros2.interfaces import class_of, full_name
from roslings.ros2.listening import known_type, subscribe, topic_in
from roslings.ros2.problem import Problem, did_you_mean
from roslings.ros2.words import FAILED, OK
from roslings.ros2.yaml_out import Shape, as_csv, as_yaml, plain_of

_PLACE = re.compile(r"([^.\[\]]+)|\[(\d+)\]")


class BadField(Problem):
    """`--field` names something that the message does not have."""

    def __init__(self, field: str, reason: str) -> None:
        super().__init__(f"Invalid field '{field}': {reason}")


def echo(options: argparse.Namespace) -> int:
    """`ros2 topic echo TOPIC [TYPE]`."""
    topic = topic_in(options)
    if options.message_type:  # a wrong type is said before anything is waited for
        class_of(options.message_type, "msg")
    with Eye() as eye:
        eye.settle()
        type_name = _type(eye, topic, options)
        picks = [_checked(field, class_of(type_name, "msg")) for field in options.field or []]
        printer = Printer(options, picks)
        subscribe(eye, topic, type_name, options, printer.hear)
        return OK if eye.until(lambda: printer.done, options.timeout) else FAILED


def _type(eye: Eye, topic: str, options: argparse.Namespace) -> str:
    if options.message_type:
        return full_name(options.message_type, "msg")
    return known_type(eye, topic)


class Printer:
    """Prints messages, or fields of them, in the shape that the options ask for."""

    def __init__(self, options: argparse.Namespace, picks: list[list[str | int]]) -> None:
        self._once = options.once
        self._csv = options.csv
        self._shape = shape_in(options)
        self._picks = picks
        self.done = False

    def hear(self, message: Any) -> None:
        """Print one message."""
        if self.done:
            return
        parts = [_picked(message, places) for places in self._picks] or [message]
        print(self._text(parts))
        self.done = self._once

    def _text(self, parts: list[Any]) -> str:
        if self._csv:
            return ",".join(as_csv(part, self._shape) for part in parts)
        return "".join(_shown(part, self._shape) for part in parts) + "---"


def _shown(part: Any, shape: Shape) -> str:
    """The real tool prints a text of `--field` as it is, without YAML's quotes."""
    plain = plain_of(part, shape)
    return f"{plain}\n" if isinstance(plain, str) else as_yaml(part, shape)


def shape_in(options: argparse.Namespace) -> Shape:
    """How much of each message the options ask for."""
    return Shape(
        longest=None if options.full_length else options.truncate_length,
        no_arrays=options.no_arr,
        no_texts=options.no_str,
        flow=options.flow_style,
    )


def _checked(field: str, cls: Any) -> list[str | int]:
    """The places of `--field a.b[0].c`, tried on an empty message. Raises BadField."""
    places: list[str | int] = [
        int(index) if index else name for name, index in _PLACE.findall(field)
    ]
    if not places:
        raise BadField(field, "it names no field")
    _follow(field, cls(), places)
    return places


def _follow(field: str, part: Any, places: list[str | int]) -> None:
    """Stops at the first list: only a real message tells how long it is."""
    for place in places:
        if isinstance(place, int) or not hasattr(part, "get_fields_and_field_types"):
            return
        fields = list(part.get_fields_and_field_types())
        if place not in fields:
            raise BadField(
                field, f"there is no '{place}'.{did_you_mean(place, fields)}"
                f" There is: {', '.join(fields) or 'nothing'}",
            )  # fmt: skip
        part = getattr(part, place)


def _picked(message: Any, places: list[str | int]) -> Any:
    part = message
    for place in places:
        try:
            part = part[place] if isinstance(place, int) else getattr(part, place)
        except (IndexError, AttributeError, TypeError) as fault:
            raise BadField(".".join(map(str, places)), str(fault)) from None
    return part
