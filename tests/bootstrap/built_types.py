"""The course's own message types, tried: a program for a Python that has them.

    python built_types.py COURSE

Each type goes through the compiled code and back. rosbags, which is Python alone, reads by the
definition what the compiled code has written, and writes what it reads. A message that was cut
raises an error, and nothing leaks. It prints a digest of all that was said.
"""

from __future__ import annotations

import gc
import hashlib
import math
import struct
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from builtin_interfaces.msg import Time
from geometry_msgs.msg import TransformStamped
from rclpy.serialization import deserialize_message, serialize_message
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rover_interfaces.action import Charge, DriveTo
from tf2_msgs.msg import TFMessage
from unique_identifier_msgs.msg import UUID

ACTIONS = "labs/actions/interfaces/rover_interfaces/action"
PARTS = ("Goal", "Result", "Feedback")
NUMBERS = (0.0, -0.0, 0.1, -1.5e300, math.inf, -math.inf, 1e-320)
TEXTS = ("", "odom", "Füße ☃ 𝄞", "x" * 300)
NAMESPACE = "rover_interfaces/msg/"
WHOLE = {
    "SendGoalService.Request": "unique_identifier_msgs/UUID goal_id\n{name}Goal goal",
    "GetResultService.Response": "int8 status\n{name}Result result",
    "FeedbackMessage": "unique_identifier_msgs/UUID goal_id\n{name}Feedback feedback",
}
"""What ROS makes of an action's parts; the texts are those of its design page."""


class Different(Exception):
    """The compiled code makes something else than its definition says."""


def definitions(course: Path) -> dict[str, str]:
    """Name of a message for rosbags to its definition."""
    found = {}
    for action in ("DriveTo", "Charge"):
        text = (course / ACTIONS / f"{action}.action").read_text("utf-8")
        for part, lines in zip(PARTS, text.split("---\n"), strict=True):
            found[f"{action}{part}"] = lines
        for name, lines in WHOLE.items():
            found[f"{action}{name.replace('.', '')}"] = lines.format(name=action)
    return found


def store(course: Path) -> Any:
    """rosbags' types: those of Jazzy, tf2_msgs among them, and the course's own."""
    made = get_typestore(Stores.ROS2_JAZZY)
    for name, text in definitions(course).items():
        made.register(get_types_from_msg(text, f"{NAMESPACE}{name}"))
    return made


def messages() -> Iterator[tuple[str, Any]]:
    """Messages of each type, with the names that rosbags knows them by."""
    for n, number in enumerate(NUMBERS):
        for action in (DriveTo, Charge):
            for part in PARTS:
                yield f"{NAMESPACE}{action.__name__}{part}", filled(getattr(action, part), number)
            yield from wholes(action, number, n)
    yield "tf2_msgs/msg/TFMessage", TFMessage()
    for text in TEXTS:
        yield "tf2_msgs/msg/TFMessage", TFMessage(transforms=[step(text, x) for x in NUMBERS])


def filled(kind: Any, number: float) -> Any:
    """A message of numbers and truths."""
    made = kind()
    for field, what in kind.get_fields_and_field_types().items():
        value: Any = number > 0 if what == "boolean" else number
        if what == "float":
            value = single(number)
        setattr(made, field, value)
    return made


def single(number: float) -> float:
    """The nearest that has 32 bits."""
    if not math.isinf(number) and abs(number) > 3e38:
        return 2.5
    nearest: float = struct.unpack("f", struct.pack("f", number))[0]
    return nearest


def wholes(action: Any, number: float, n: int) -> Iterator[tuple[str, Any]]:
    """A goal on its way, a result and a feedback, as ROS sends them."""
    parts, name = action.Impl, f"{NAMESPACE}{action.__name__}"
    goal_id = UUID(uuid=[(n * 16 + i) % 256 for i in range(16)])
    goal, result, feedback = (filled(getattr(action, part), number) for part in PARTS)
    send = parts.SendGoalService.Request(goal_id=goal_id, goal=goal)
    yield f"{name}SendGoalServiceRequest", send
    answer = parts.GetResultService.Response(status=n - 2, result=result)
    yield f"{name}GetResultServiceResponse", answer
    yield f"{name}FeedbackMessage", parts.FeedbackMessage(goal_id=goal_id, feedback=feedback)


def step(text: str, number: float) -> Any:
    """A transform, as a robot says it."""
    made = TransformStamped(child_frame_id=text[::-1])
    made.header.frame_id = text
    made.header.stamp = Time(sec=-5, nanosec=2**32 - 1)
    made.transform.translation.x, made.transform.rotation.w = number, -number
    return made


def plain(message: Any, known: Any, name: str) -> Any:
    """The same for rosbags."""
    kind = known.types[name]
    values = {}
    for field, (_, what) in zip(kind.__dataclass_fields__, known.fielddefs[name][1], strict=False):
        value = getattr(message, field) if hasattr(message, field) else 0
        values[field] = plain_value(value, what, known)
    return kind(**values)


def plain_value(value: Any, what: Any, known: Any) -> Any:
    """A field of it: a number or text, a message, an array of numbers, or a list of messages."""
    if hasattr(value, "get_fields_and_field_types"):
        return plain(value, known, what[1])
    if isinstance(value, list):
        return [plain_value(each, what[1][0], known) for each in value]
    return value


def try_one(name: str, message: Any, known: Any) -> bytes:
    """There and back again, by both, and cut; what it says. Raises Different."""
    made: bytes = serialize_message(message)
    if deserialize_message(made, type(message)) != message:
        raise Different(f"{name}: {message} comes back as another one")
    told = plain(message, known, name)
    if str(known.deserialize_cdr(made, name)) != str(told):
        raise Different(f"{name}: {message} is another one by its definition: {made.hex()}")
    by_definition = bytes(known.serialize_cdr(told, name))
    if deserialize_message(by_definition, type(message)) != message:
        raise Different(f"{name}: {by_definition.hex()} is not read as {message}")
    for bytes_left in range(4, len(made) - 3, 7):
        insist_on_error(lambda left=bytes_left: deserialize_message(made[:left], type(message)))
    return str(told).encode()


def insist_on_error(act: Callable[[], Any]) -> None:
    """Raises Different where nothing is raised."""
    try:
        act()
    except Exception:
        return
    raise Different("what is wrong was taken")


def try_leaks() -> None:
    """Again and again: no object is kept. What Python itself keeps, it keeps once."""
    some = [message for _, message in messages()]
    most = 40  # of objects: a type that kept one each time would keep several times as many
    if min(kept_by(some, rounds=40) for _ in range(5)) > most:
        raise Different("objects are kept")


def kept_by(some: list[Any], rounds: int) -> int:
    """How many more objects there are when all messages went there and back so often."""
    gc.collect()
    before = sys.getallocatedblocks()
    for _ in range(rounds):
        for message in some:
            deserialize_message(serialize_message(message), type(message))
    gc.collect()
    return sys.getallocatedblocks() - before


def main(course: Path) -> None:
    """Try all of it."""
    known = store(course)
    content = hashlib.sha256()
    for name, message in messages():
        content.update(try_one(name, message, known))
    try_leaks()
    print(content.hexdigest())


if __name__ == "__main__":
    main(Path(sys.argv[1]))
