"""From the elements of an XML or YAML launch file to the actions that Python files have."""

from __future__ import annotations

import re
import shlex
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, NoReturn

from ros2_on_pip.launching import actions, elsewhere
from ros2_on_pip.launching.conditions import Condition, IfCondition, UnlessCondition
from ros2_on_pip.launching.description import Entity, LaunchDescription
from ros2_on_pip.launching.markup.tree import Element, read
from ros2_on_pip.launching.node import Node
from ros2_on_pip.launching.parameters import ParameterFile, ParameterValue, listed_by
from ros2_on_pip.launching.places import BadLaunchFile, NotReadHere, standing_at
from ros2_on_pip.launching.processes import ExecuteProcess
from ros2_on_pip.launching.sources import IncludeLaunchDescription
from ros2_on_pip.launching.substitution import (
    Parts,
    Substitution,
    TextSubstitution,
    described,
    performed,
)
from ros2_on_pip.launching.text import UnknownSubstitution, parts_in
from ros2_on_pip.launching.typed import yaml_truth
from ros2_on_pip.launching.wrong_kind import CALLED, Refused
from ros2_on_pip.problem import CommandProblem, did_you_mean

CONDITIONS = {"if": IfCondition, "unless": UnlessCondition}
PROCESS = (
    "name",
    "output",
    "cwd",
    "launch-prefix",
    "emulate_tty",
    "shell",
    "respawn",
    "respawn_delay",
    "respawn_max_retries",
    "sigterm_timeout",
    "sigkill_timeout",
    "on_exit",
)
SETTINGS = {
    "output": str,
    "cwd": str,
    "respawn": str,
    "sigterm_timeout": float,
    "sigkill_timeout": float,
}
NUMBERS: dict[str, type[Any]] = {"respawn_delay": float, "respawn_max_retries": int}
"""Attributes of a process to what YAML may read; a text may stand for each."""

VALUE = ("name", "value", "type", "value-sep")
NODE = (*PROCESS, "pkg", "exec", "exec_name", "namespace", "args", "ros_args")
TYPES: dict[str, Any] = {
    "bool": bool,
    "int": int,
    "float": float,
    "str": str,
    "list_of_bool": list[bool],
    "list_of_int": list[int],
    "list_of_float": list[float],
    "list_of_str": list[str],
    "yaml": None,
}


def description_of(file: Path, kind: str) -> LaunchDescription:
    """What an XML or YAML launch file asks for. Raises BadLaunchFile, NotReadHere."""
    root = read(file, kind)
    reason = root.attributes.get("deprecated")
    description = LaunchDescription(built_in(root), deprecated_reason=reason)
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
            element.place,
            f"there is no '{element.tag}'.{did_you_mean(element.tag, known)}"
            f" Known: {', '.join(known)}.",
        )
    return _placed(element, TAGS[element.tag])


def _placed(element: Element, make: Callable[[ElementReader], Entity]) -> Entity:
    try:
        with standing_at(element.place):
            return make(ElementReader(element))
    except BadLaunchFile:
        raise
    except (CommandProblem, TypeError, ValueError, Refused) as fault:
        raise BadLaunchFile(element.place, str(fault)) from None


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


class ElementReader:
    """The attributes of one element, and the parts inside it."""

    def __init__(self, element: Element, conditions: Iterable[str] = CONDITIONS) -> None:
        """`conditions` are the attributes that every action may have, and no part of one."""
        self.element, self._conditions = element, conditions

    def text(self, name: str, kind: type[Any] = str) -> Parts:
        """The attribute `name`. Raises BadLaunchFile where it is missing."""
        found = self.optional(name, kind)
        if found is None:
            tag = self.element.tag
            raise BadLaunchFile(self.element.place, f"'{tag}' needs the attribute '{name}'")
        return found

    def optional(self, name: str, kind: type[Any] = str) -> Parts | None:
        """The attribute `name`; None where it is missing. Raises BadLaunchFile, NotReadHere."""
        value = self.plain(name, kind)
        if value is None:
            return None
        return self.filled(str(value).lower() if isinstance(value, bool) else str(value))

    def plain(self, name: str, kind: type[Any] = str) -> Any:
        """The attribute as it was read; XML has texts alone, and Jazzy makes nothing else of what
        YAML has read. Raises BadLaunchFile where it is neither a text nor of this kind.
        """
        value = self.element.attributes.get(name)
        if value is None or isinstance(value, str | kind):
            return value
        read = str(value).lower() if isinstance(value, bool) else value
        step = f" Write it with a point: {read}.0" if kind is float else ""
        step = f' Put it between quotes: "{read}"' if kind is str else step
        self._refuse(
            f"'{name}' of '{self.element.tag}' must be {CALLED[kind]}, and YAML reads {read} as"
            f" {type(value).__name__}.{step}"
        )

    def filled(self, text: str) -> Parts:
        """A text with its `$(...)`. Raises BadLaunchFile, NotReadHere."""
        try:
            return parts_in(text)
        except UnknownSubstitution as unknown:
            raise NotReadHere(self.element.place, str(unknown), unknown.instead) from None
        except CommandProblem as problem:
            raise BadLaunchFile(self.element.place, str(problem)) from None

    def words(self, name: str) -> list[Parts]:
        """The attribute `name` as the words of a command line; a `$(...)` is within one word."""
        parts = self.filled(self.plain(name) or "")
        known = {chr(_HIDDEN + at): part for at, part in enumerate(parts)}
        texts = (p.text if isinstance(p, TextSubstitution) else sign for sign, p in known.items())
        return [_shown(word, known) for word in shlex.split("".join(texts))]

    def condition(self) -> Condition | None:
        """What `if` and `unless` say. Raises BadLaunchFile where there are both."""
        said = [name for name in CONDITIONS if name in self.element.attributes]
        if len(said) > 1:
            raise BadLaunchFile(self.element.place, "take 'if' or 'unless', and not both")
        return CONDITIONS[said[0]](self.text(said[0])) if said else None

    def only(self, *known: str, parts: Iterable[str] = ()) -> None:
        """Raises BadLaunchFile where an attribute, or an element inside, would be ignored."""
        tag = self.element.tag
        for name in sorted(set(self.element.attributes) - {*known, *self._conditions}):
            near = did_you_mean(name, known)
            self._refuse(f"'{tag}' has no attribute '{name}' here.{near}")
        for child in self.element.children:
            if child.tag not in parts:
                near = did_you_mean(child.tag, parts)
                ElementReader(child)._refuse(f"there is no '{child.tag}' inside '{tag}'.{near}")

    def _refuse(self, reason: str) -> NoReturn:
        raise BadLaunchFile(self.element.place, reason)

    def parts(self, tag: str, *known: str, inside: Iterable[str] = ()) -> list[ElementReader]:
        """The elements of one kind inside this one; each has only the attributes `known`."""
        readers = [ElementReader(child, conditions=()) for child in self.element.inside(tag)]
        for reader in readers:
            reader.only(*known, parts=inside)
        return readers

    def pairs(self, tag: str, first: str, second: str) -> list[tuple[Parts, Parts]]:
        """Two attributes of each element of one kind inside this one."""
        readers = self.parts(tag, first, second)
        return [(reader.text(first), reader.text(second)) for reader in readers]


_HIDDEN = 0xE000
"""From here on Unicode is private: each `$(...)` is one such sign while words are parted."""


def _shown(word: str, known: Mapping[str, Substitution]) -> Parts:
    """The parts of a word in which signs stand for `$(...)`."""
    pieces = re.split(f"([{chr(_HIDDEN)}-\uf8ff])", word)
    found = [known.get(piece) or TextSubstitution(text=piece) for piece in pieces if piece]
    return found or [TextSubstitution(text="")]


def _arg(reader: ElementReader) -> Entity:
    if "value" in reader.element.attributes:
        raise BadLaunchFile(
            reader.element.place,
            "'arg' has no attribute 'value' here: its value comes from the command. Write default,"
            " which counts where nobody gives one, or let instead of arg",
        )
    reader.only("name", "default", "description", parts=["choice"])
    listed = reader.parts("choice", "value")
    choices = [str(choice.plain("value")) for choice in listed]
    return actions.DeclareLaunchArgument(
        str(reader.plain("name") or reader.text("name")),
        default_value=reader.optional("default"),
        description=str(reader.plain("description") or ""),
        choices=choices or None,
        condition=reader.condition(),
    )


def _let(reader: ElementReader) -> Entity:
    reader.only("name", "value")
    return actions.SetLaunchConfiguration(
        reader.text("name"), reader.text("value"), condition=reader.condition()
    )


def _unset(reader: ElementReader) -> Entity:
    reader.only("name")
    name = reader.text("name")
    return actions.UnsetLaunchConfiguration(name, condition=reader.condition())


def _set_env(reader: ElementReader) -> Entity:
    reader.only("name", "value")
    return actions.SetEnvironmentVariable(
        reader.text("name"), reader.text("value"), condition=reader.condition()
    )


def _append_env(reader: ElementReader) -> Entity:
    reader.only("name", "value", "prepend", "separator")
    return actions.AppendEnvironmentVariable(
        reader.text("name"),
        reader.text("value"),
        prepend=reader.optional("prepend", bool) or False,
        separator=reader.optional("separator") or ":",
        condition=reader.condition(),
    )


def _unset_env(reader: ElementReader) -> Entity:
    reader.only("name")
    name = reader.text("name")
    return actions.UnsetEnvironmentVariable(name, condition=reader.condition())


def _log(reader: ElementReader) -> Entity:
    reader.only("message")
    return actions.LogInfo(msg=reader.text("message"), condition=reader.condition())


def _group(reader: ElementReader) -> Entity:
    element = reader.element
    inner = [child for child in element.children if child.tag != "keep"]
    reader.only("scoped", "forwarding", parts=[child.tag for child in element.children])
    kept = {tuple(name): value for name, value in reader.pairs("keep", "name", "value")}
    return actions.GroupAction(
        [built(child) for child in inner],
        scoped=_switch(reader, "scoped"),
        forwarding=_switch(reader, "forwarding"),
        launch_configurations=kept,
        condition=reader.condition(),
    )


def _switch(reader: ElementReader, name: str) -> bool:
    value = str(reader.element.attributes.get(name, "true")).lower()
    if value not in ("true", "false"):
        raise BadLaunchFile(reader.element.place, f"'{name}' is true or false, and not '{value}'")
    return value == "true"


def _include(reader: ElementReader) -> Entity:
    reader.only("file", parts=["arg", "let"])
    given = [*reader.pairs("arg", "name", "value"), *reader.pairs("let", "name", "value")]
    return IncludeLaunchDescription(
        reader.text("file"), launch_arguments=given, condition=reader.condition()
    )


def _timer(reader: ElementReader) -> Entity:
    inner = [child.tag for child in reader.element.children]
    reader.only("period", "cancel_on_shutdown", parts=inner)
    return actions.TimerAction(
        period=reader.text("period", float),
        cancel_on_shutdown=reader.optional("cancel_on_shutdown", bool) or True,
        actions=built_in(reader.element),
        condition=reader.condition(),
    )


def _shutdown(reader: ElementReader) -> Entity:
    reader.only("reason")
    reason = reader.optional("reason") or "reason not given"
    return actions.Shutdown(reason=reason, condition=reader.condition())


def _push_namespace(reader: ElementReader) -> Entity:
    reader.only("namespace")
    return actions.PushRosNamespace(reader.text("namespace"), condition=reader.condition())


def _set_parameter(reader: ElementReader) -> Entity:
    reader.only("name", "value")
    value = [Joined(reader.text("value"))]
    return actions.SetParameter(reader.text("name"), value, condition=reader.condition())


def _set_parameters_from_file(reader: ElementReader) -> Entity:
    reader.only("filename")
    return actions.SetParametersFromFile(reader.text("filename"), condition=reader.condition())


def _set_remap(reader: ElementReader) -> Entity:
    reader.only("from", "to")
    return actions.SetRemap(reader.text("from"), reader.text("to"), condition=reader.condition())


def _set_use_sim_time(reader: ElementReader) -> Entity:
    reader.only("value")
    return actions.SetUseSimTime(reader.text("value", bool), condition=reader.condition())


def _node(reader: ElementReader) -> Entity:
    reader.only(*NODE, parts=["env", "param", "remap"])
    return Node(
        package=reader.optional("pkg"),
        executable=reader.text("exec"),
        name=reader.optional("name"),
        exec_name=reader.optional("exec_name"),
        namespace=reader.optional("namespace"),
        arguments=reader.words("args"),
        ros_arguments=reader.words("ros_args"),
        parameters=_parameters(reader),
        remappings=reader.pairs("remap", "from", "to"),
        **_process(reader),
    )


def _executable(reader: ElementReader) -> Entity:
    reader.only(*PROCESS, "cmd", "args", parts=["env"])
    words = [*reader.words("cmd"), *reader.words("args")]
    if str(reader.element.attributes.get("shell", "false")).lower() == "true":
        words = [reader.text("cmd")]
    return ExecuteProcess(cmd=words, name=reader.optional("name"), **_process(reader))


def _process(reader: ElementReader) -> dict[str, Any]:
    given = reader.element.attributes
    settings: dict[str, Any] = {
        name: reader.optional(name, kind) for name, kind in SETTINGS.items() if name in given
    }
    for name, kind in NUMBERS.items():
        if name in given:
            settings[name] = kind(reader.plain(name, kind))
    if "launch-prefix" in given:
        settings["prefix"] = reader.text("launch-prefix")
    if "on_exit" in given:
        settings["on_exit"] = _at_exit(reader)
    settings["shell"] = str(given.get("shell", "false")).lower() == "true"
    settings["additional_env"] = _environment(reader)
    return {**settings, "condition": reader.condition()}


def _environment(reader: ElementReader) -> dict[tuple[Substitution, ...], Parts]:
    return {tuple(name): value for name, value in reader.pairs("env", "name", "value")}


def _at_exit(reader: ElementReader) -> Entity:
    word = str(reader.element.attributes["on_exit"])
    if word != "shutdown":
        raise BadLaunchFile(reader.element.place, f"'on_exit' is shutdown, and not '{word}'")
    return actions.Shutdown()


def _parameters(node: ElementReader) -> list[Any]:
    """Files and values in order; values side by side are one file, as in Jazzy."""
    found: list[Any] = []
    for reader in node.parts("param", *VALUE, "from", "allow_substs", inside=["param"]):
        if "from" in reader.element.attributes:
            reader.only("from", "allow_substs")
            switch = str(reader.element.attributes.get("allow_substs", False)).lower()
            allowed = yaml_truth(switch, "allow_substs")
            found.append(ParameterFile(reader.text("from"), allow_substs=allowed))
        else:
            found.append(_nested([reader]))
    return found


def _nested(params: list[ElementReader]) -> dict[str, Any]:
    """One parameter inside another gets a dot between the names."""
    tree: dict[str, Any] = {}
    for reader in params:
        reader.only(*VALUE, parts=["param"])
        reader.text("name")
        inner = reader.parts("param", *VALUE, inside=["param"])
        tree[str(reader.element.attributes["name"])] = _nested(inner) if inner else _value(reader)
    return tree


def _value(reader: ElementReader) -> Any:
    """XML knows only texts: what looks like a number is one, unless `type` says otherwise."""
    value = reader.element.attributes.get("value")
    kind = reader.element.attributes.get("type")
    if kind is not None and kind not in TYPES:
        known = ", ".join(TYPES)
        raise BadLaunchFile(reader.element.place, f"'type' is one of {known}, and not '{kind}'")
    if value is not None and not isinstance(value, str):
        return value
    value_type = TYPES.get(str(kind))
    if separator := reader.element.attributes.get("value-sep"):
        pieces = [Joined(reader.filled(p)) for p in str(value).split(str(separator))]
        of = listed_by(value_type)
        return [ParameterValue(piece, value_type=of) for piece in pieces]
    return ParameterValue(Joined(reader.text("value")), value_type=value_type)


TAGS: dict[str, Callable[[ElementReader], Entity]] = {
    "append_env": _append_env,
    "arg": _arg,
    "executable": _executable,
    "group": _group,
    "include": _include,
    "let": _let,
    "log": _log,
    "node": _node,
    "push-ros-namespace": _push_namespace,
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
