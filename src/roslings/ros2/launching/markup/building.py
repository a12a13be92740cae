"""From the elements of an XML or YAML launch file to the actions that Python files have."""

from __future__ import annotations

import shlex
from collections.abc import Callable
from pathlib import Path
from typing import Any

from roslings.ros2.launching import actions, elsewhere
from roslings.ros2.launching.conditions import Condition, IfCondition, UnlessCondition
from roslings.ros2.launching.description import Entity, LaunchDescription
from roslings.ros2.launching.markup.tree import Element, read
from roslings.ros2.launching.node import Node
from roslings.ros2.launching.parameters import ParameterFile, ParameterValue
from roslings.ros2.launching.places import BadLaunchFile, NotReadHere
from roslings.ros2.launching.processes import ExecuteProcess
from roslings.ros2.launching.sources import IncludeLaunchDescription
from roslings.ros2.launching.substitution import Parts, Substitution, described, performed
from roslings.ros2.launching.text import UnknownSubstitution, parts_in
from roslings.ros2.problem import Problem, did_you_mean

CONDITIONS = {"if": IfCondition, "unless": UnlessCondition}
PROCESS = (
    "name", "output", "cwd", "launch_prefix", "emulate_tty", "shell", "respawn", "respawn_delay",
    "respawn_max_retries", "sigterm_timeout", "sigkill_timeout", "on_exit",
)  # fmt: skip
NODE = (*PROCESS, "pkg", "exec", "exec_name", "namespace", "args", "ros_args")
TYPES = {"bool": bool, "int": int, "float": float, "str": str}


def description_of(file: Path, kind: str) -> LaunchDescription:
    """What an XML or YAML launch file asks for. Raises BadLaunchFile, NotReadHere."""
    root = read(file, kind)
    description = LaunchDescription(built_in(root))
    description.place = root.place
    return description


def built_in(element: Element) -> list[Entity]:
    """The actions of the elements inside `element`. Raises BadLaunchFile, NotReadHere."""
    return [built(child) for child in element.children]


def built(element: Element) -> Entity:
    """The action of one element. Raises BadLaunchFile, NotReadHere."""
    if element.tag in elsewhere.ELEMENTS:
        raise NotReadHere(element.place, f"'{element.tag}'", elsewhere.ELEMENTS[element.tag])
    if element.tag not in TAGS:
        known = sorted(TAGS)
        raise BadLaunchFile(
            element.place, f"there is no '{element.tag}'.{did_you_mean(element.tag, known)}"
            f" Known: {', '.join(known)}.",
        )  # fmt: skip
    return _placed(element, TAGS[element.tag])


def _placed(element: Element, make: Callable[[Reader], Entity]) -> Entity:
    try:
        action = make(Reader(element))
    except BadLaunchFile:
        raise
    except (Problem, TypeError, ValueError) as fault:
        raise BadLaunchFile(element.place, str(fault)) from None
    action.place = element.place
    return action


class Joined(Substitution):
    """Several parts as one, so that it is read as YAML also where it is a plain text."""

    def __init__(self, parts: Parts) -> None:
        self.parts = parts

    def perform(self, context: Any) -> str:
        """The one text."""
        return performed(context, self.parts)

    def describe(self) -> str:
        """Its parts."""
        return described(self.parts)


class Reader:
    """The attributes of one element."""

    def __init__(self, element: Element) -> None:
        self.element = element

    def text(self, name: str) -> Parts:
        """The attribute `name`. Raises BadLaunchFile where it is missing."""
        found = self.optional(name)
        if found is None:
            tag = self.element.tag
            raise BadLaunchFile(self.element.place, f"'{tag}' needs the attribute '{name}'")
        return found

    def optional(self, name: str) -> Parts | None:
        """The attribute `name`; None where it is missing. Raises BadLaunchFile, NotReadHere."""
        value = self.element.attributes.get(name)
        if value is None:
            return None
        text = str(value).lower() if isinstance(value, bool) else str(value)
        return self.filled(text)

    def filled(self, text: str) -> Parts:
        """A text with its `$(...)`. Raises BadLaunchFile, NotReadHere."""
        try:
            return parts_in(text)
        except UnknownSubstitution as unknown:
            raise NotReadHere(self.element.place, str(unknown), unknown.instead) from None
        except Problem as problem:
            raise BadLaunchFile(self.element.place, str(problem)) from None

    def words(self, name: str) -> list[Parts]:
        """The attribute `name` as the words of a command line; a `$(...)` is within one word."""
        text = str(self.element.attributes.get(name, ""))
        return [self.filled(word) for word in split_outside(text)]

    def condition(self) -> Condition | None:
        """What `if` and `unless` say. Raises BadLaunchFile where there are both."""
        said = [name for name in CONDITIONS if name in self.element.attributes]
        if len(said) > 1:
            raise BadLaunchFile(self.element.place, "take 'if' or 'unless', and not both")
        return CONDITIONS[said[0]](self.text(said[0])) if said else None

    def only(self, *known: str) -> None:
        """Raises BadLaunchFile where an attribute would be ignored."""
        for name in sorted(set(self.element.attributes) - {*known, *CONDITIONS}):
            raise BadLaunchFile(
                self.element.place, f"'{self.element.tag}' has no attribute '{name}' here."
                f"{did_you_mean(name, known)}",
            )  # fmt: skip

    def pairs(self, tag: str, first: str, second: str) -> list[tuple[Parts, Parts]]:
        """Two attributes of each element of one kind inside this one."""
        readers = [Reader(child) for child in self.element.inside(tag)]
        return [(reader.text(first), reader.text(second)) for reader in readers]


def split_outside(text: str) -> list[str]:
    """The words of a command line; blanks inside `$(...)` part nothing."""
    hidden, depth = "", 0
    for at, letter in enumerate(text):
        opens = letter == "(" and (depth > 0 or text[at - 1 : at] == "$")
        depth += opens - (letter == ")" and depth > 0)
        hidden += _KEPT.get(letter, letter) if depth > 0 else letter
    words = shlex.split(hidden)
    return [word.translate({ord(v): k for k, v in _KEPT.items()}) for word in words]


_KEPT = {letter: chr(0xE000 + at) for at, letter in enumerate(" \t\n'\"\\")}
"""What shlex looks at, to what hides it inside of `$(...)`: private characters of Unicode."""


def _arg(reader: Reader) -> Entity:
    reader.only("name", "default", "description", "value")
    given = reader.element.attributes
    default = reader.optional("default")
    choices = [str(child.attributes.get("value")) for child in reader.element.inside("choice")]
    return actions.DeclareLaunchArgument(
        str(given.get("name") or reader.text("name")), default_value=default,
        description=str(given.get("description", "")), choices=choices or None,
        condition=reader.condition(),
    )  # fmt: skip


def _let(reader: Reader) -> Entity:
    reader.only("name", "value")
    return actions.SetLaunchConfiguration(
        reader.text("name"), reader.text("value"), condition=reader.condition()
    )


def _unset(reader: Reader) -> Entity:
    reader.only("name")
    name = reader.text("name")
    return actions.UnsetLaunchConfiguration(name, condition=reader.condition())


def _set_env(reader: Reader) -> Entity:
    reader.only("name", "value")
    return actions.SetEnvironmentVariable(
        reader.text("name"), reader.text("value"), condition=reader.condition()
    )


def _unset_env(reader: Reader) -> Entity:
    reader.only("name")
    name = reader.text("name")
    return actions.UnsetEnvironmentVariable(name, condition=reader.condition())


def _log(reader: Reader) -> Entity:
    reader.only("message", "level")
    return actions.LogInfo(msg=reader.text("message"), condition=reader.condition())


def _group(reader: Reader) -> Entity:
    reader.only("scoped", "forwarding")
    element = reader.element
    kept = [child for child in element.children if child.tag != "keep"]
    return actions.GroupAction(
        [built(child) for child in kept],
        scoped=_switch(reader, "scoped"), forwarding=_switch(reader, "forwarding"),
        launch_configurations=dict(_kept(element)), condition=reader.condition(),
    )  # fmt: skip


def _kept(element: Element) -> list[tuple[str, Parts]]:
    readers = [Reader(child) for child in element.inside("keep")]
    return [(str(one.element.attributes.get("name")), one.text("value")) for one in readers]


def _switch(reader: Reader, name: str) -> bool:
    value = str(reader.element.attributes.get(name, "true")).lower()
    if value not in ("true", "false"):
        raise BadLaunchFile(reader.element.place, f"'{name}' is true or false, and not '{value}'")
    return value == "true"


def _include(reader: Reader) -> Entity:
    reader.only("file")
    given = [*reader.pairs("arg", "name", "value"), *reader.pairs("let", "name", "value")]
    return IncludeLaunchDescription(
        reader.text("file"), launch_arguments=given, condition=reader.condition()
    )


def _timer(reader: Reader) -> Entity:
    reader.only("period")
    return actions.TimerAction(
        period=reader.text("period"), actions=built_in(reader.element),
        condition=reader.condition(),
    )  # fmt: skip


def _shutdown(reader: Reader) -> Entity:
    reader.only("reason")
    reason = reader.optional("reason") or "reason not given"
    return actions.Shutdown(reason=reason, condition=reader.condition())


def _push_namespace(reader: Reader) -> Entity:
    reader.only("namespace")
    return actions.PushRosNamespace(reader.text("namespace"), condition=reader.condition())


def _set_parameter(reader: Reader) -> Entity:
    reader.only("name", "value", "type")
    return actions.SetParameter(reader.text("name"), _value(reader), condition=reader.condition())


def _set_parameters_from_file(reader: Reader) -> Entity:
    reader.only("filename")
    return actions.SetParametersFromFile(reader.text("filename"), condition=reader.condition())


def _set_remap(reader: Reader) -> Entity:
    reader.only("from", "to")
    return actions.SetRemap(reader.text("from"), reader.text("to"), condition=reader.condition())


def _set_use_sim_time(reader: Reader) -> Entity:
    reader.only("value")
    return actions.SetUseSimTime(_value(reader), condition=reader.condition())


def _node(reader: Reader) -> Entity:
    reader.only(*NODE)
    return Node(
        package=reader.optional("pkg"), executable=reader.text("exec"),
        name=reader.optional("name"), exec_name=reader.optional("exec_name"),
        namespace=reader.optional("namespace"), arguments=reader.words("args"),
        ros_arguments=reader.words("ros_args"), parameters=_parameters(reader.element),
        remappings=reader.pairs("remap", "from", "to"), **_process(reader),
    )  # fmt: skip


def _executable(reader: Reader) -> Entity:
    reader.only(*PROCESS, "cmd", "args")
    words = [*reader.words("cmd"), *reader.words("args")]
    if str(reader.element.attributes.get("shell", "false")).lower() == "true":
        words = [reader.text("cmd")]
    return ExecuteProcess(cmd=words, name=reader.optional("name"), **_process(reader))


def _process(reader: Reader) -> dict[str, Any]:
    given = reader.element.attributes
    settings: dict[str, Any] = {
        name: reader.optional(name)
        for name in ("output", "cwd", "respawn", "sigterm_timeout", "sigkill_timeout")
        if name in given
    }
    for name, kind in (("respawn_delay", float), ("respawn_max_retries", int)):
        if name in given:
            settings[name] = kind(given[name])
    if "launch_prefix" in given:
        settings["prefix"] = reader.text("launch_prefix")
    if "on_exit" in given:
        settings["on_exit"] = _at_exit(reader)
    settings["shell"] = str(given.get("shell", "false")).lower() == "true"
    settings["additional_env"] = _environment(reader)
    return {**settings, "condition": reader.condition()}


def _environment(reader: Reader) -> dict[str, Parts]:
    children = [Reader(child) for child in reader.element.inside("env")]
    return {str(one.element.attributes.get("name")): one.text("value") for one in children}


def _at_exit(reader: Reader) -> Entity:
    word = str(reader.element.attributes["on_exit"])
    if word != "shutdown":
        raise BadLaunchFile(reader.element.place, f"'on_exit' is shutdown, and not '{word}'")
    return actions.Shutdown(reason="a process that the launch needs has ended")


def _parameters(element: Element) -> list[Any]:
    """Files and values in order; values side by side are one file, as in Jazzy."""
    found: list[Any] = []
    for param in element.inside("param"):
        reader = Reader(param)
        if "from" in param.attributes:
            reader.only("from", "allow_substs")
            switch = reader.optional("allow_substs") or "false"
            found.append(ParameterFile(reader.text("from"), allow_substs=switch))
        else:
            found.append(_nested([param]))
    return found


def _nested(params: list[Element]) -> dict[str, Any]:
    """One parameter inside another gets a dot between the names."""
    tree: dict[str, Any] = {}
    for param in params:
        reader = Reader(param)
        reader.only("name", "value", "type", "value_sep")
        reader.text("name")
        inner = param.inside("param")
        tree[str(param.attributes["name"])] = _nested(inner) if inner else _value(reader)
    return tree


def _value(reader: Reader) -> Any:
    """XML knows only texts: what looks like a number is one, unless `type` says otherwise."""
    value = reader.element.attributes.get("value")
    kind = reader.element.attributes.get("type")
    if kind is not None and kind not in TYPES:
        known = ", ".join(TYPES)
        raise BadLaunchFile(reader.element.place, f"'type' is one of {known}, and not '{kind}'")
    if value is not None and not isinstance(value, str):
        return value
    if separator := reader.element.attributes.get("value_sep"):
        pieces = str(value).split(str(separator))
        return [ParameterValue(Joined(reader.filled(piece.strip()))) for piece in pieces]
    return ParameterValue(Joined(reader.text("value")), value_type=TYPES.get(str(kind)))


TAGS: dict[str, Callable[[Reader], Entity]] = {
    "arg": _arg,
    "executable": _executable,
    "group": _group,
    "include": _include,
    "let": _let,
    "log": _log,
    "node": _node,
    "push_ros_namespace": _push_namespace,
    "set_env": _set_env,
    "set_parameter": _set_parameter,
    "set_parameters_from_file": _set_parameters_from_file,
    "set_remap": _set_remap,
    "set_use_sim_time": _set_use_sim_time,
    "shutdown": _shutdown,
    "timer": _timer,
    "unset": _unset,
    "unset_env": _unset_env,
}
