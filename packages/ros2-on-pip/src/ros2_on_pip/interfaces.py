"""Message, service and action types: which are installed, their text, their Python class."""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ros2_on_pip.packages import share_of
from ros2_on_pip.problem import CommandProblem, did_you_mean

KINDS = {"msg": "message", "srv": "service", "action": "action"}
FEEDBACK = "_FeedbackMessage"


class UnknownInterface(CommandProblem):
    """No installed package has this type."""

    def __init__(self, type_name: str, kind: str = "") -> None:
        what = KINDS.get(kind, "interface")
        every = [name for name in installed() if not kind or f"/{kind}/" in name]
        near = _near(type_name, every)
        super().__init__(
            f"The {what} type '{type_name}' is not installed here.{near}\n"
            "To see what there is: ros2 interface list. If the type is your own, build it and"
            " type: source install/setup.bash"
        )


def _near(type_name: str, every: list[str]) -> str:
    """A near miss; a bare `String` is most likely the standard one."""
    bare = type_name.rpartition("/")[2].lower()
    same = [name for name in every if name.rpartition("/")[2].lower() == bare]
    if same and type_name.count("/") < 2:
        return f" Did you mean {_standard_first(same)}?"
    return did_you_mean(type_name, same or every)


def _standard_first(names: list[str]) -> str:
    return min(names, key=lambda name: (not name.startswith("std_"), name))


def installed() -> list[str]:
    """Every installed type, e.g. `std_msgs/msg/String`, in order."""
    from ament_index_python.resources import get_resource, get_resources

    found = (
        f"{package}/{line.rpartition('.')[0]}"
        for package in get_resources("rosidl_interfaces")
        for line in get_resource("rosidl_interfaces", package)[0].splitlines()
        if line.endswith((".msg", ".srv", ".action", ".idl"))
    )
    return sorted(set(found))


def full_name(type_name: str, kind: str) -> str:
    """`std_msgs/String` is short for `std_msgs/msg/String`."""
    parts = type_name.split("/")
    return f"{parts[0]}/{kind}/{parts[1]}" if len(parts) == 2 and all(parts) else type_name


def class_of(type_name: str, kind: str) -> Any:
    """The Python class of a type of `kind` (msg, srv, action). Raises UnknownInterface.

    An action's feedback is a message too: `pkg/action/Name_FeedbackMessage`.
    """
    try:
        package, folder, name = full_name(type_name, kind).split("/")
        if (folder, kind) == ("action", "msg") and name.endswith(FEEDBACK):
            action = class_of(type_name.removesuffix(FEEDBACK), "action")
            return action.Impl.FeedbackMessage
        if folder != kind:
            raise ValueError
        return getattr(importlib.import_module(f"{package}.{folder}"), name)
    except (ValueError, ImportError, AttributeError):
        raise UnknownInterface(type_name, kind) from None


def name_of(cls: Any) -> str:
    """The ROS name of a message's, service's or action's class or object."""
    kind = cls if isinstance(cls, type) else type(cls)
    package, folder = kind.__module__.split(".")[:2]
    return f"{package}/{folder}/{kind.__name__}"


def text_of(type_name: str) -> str:
    """The text that defines a type. Raises UnknownInterface."""
    return file_of(type_name).read_text(encoding="utf-8")


def file_of(type_name: str) -> Path:
    """The file that defines a type. Raises UnknownInterface."""
    for candidate in _candidates(type_name):
        if candidate.is_file():
            return candidate
    raise UnknownInterface(type_name)


def _candidates(type_name: str) -> Iterator[Path]:
    """`pkg/msg/Name`, and `pkg/Name`, which may be of any kind."""
    parts = type_name.split("/")
    kinds = [parts[1]] if len(parts) == 3 else list(KINDS)
    if len(parts) not in (2, 3) or not all(parts) or kinds[0] not in KINDS:
        return
    try:
        share = share_of(parts[0])
    except CommandProblem:
        return
    for kind in kinds:
        yield share / kind / f"{parts[-1]}.{kind}"


def empty_message(type_name: str) -> Any:
    """The message of a type, the request of a service, the goal of an action, with its defaults.

    Raises UnknownInterface.
    """
    kind = file_of(type_name).parent.name
    cls = class_of(full_name(type_name, kind), kind)
    return {"msg": lambda: cls, "srv": lambda: cls.Request, "action": lambda: cls.Goal}[kind]()()
