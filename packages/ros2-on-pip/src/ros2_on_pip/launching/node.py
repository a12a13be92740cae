"""The action that starts a node."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from ros2_on_pip.launching.actions import NAME, inside
from ros2_on_pip.launching.parameters import checked_parameters, parameter_words
from ros2_on_pip.launching.processes import ExecuteProcess
from ros2_on_pip.launching.substitution import (
    Parts,
    SomeSubstitutionsType,
    SubstitutionFailure,
    described,
    parts_of,
    parts_or_none,
    performed,
    performed_or_none,
)
from ros2_on_pip.packages import executable as program_of
from ros2_on_pip.packages import name_of
from ros2_on_pip.programs import command_of

if TYPE_CHECKING:
    from ros2_on_pip.launching.context import LaunchContext

EVERY_NODE = "/**"


class Node(ExecuteProcess):
    """Start a node of a package."""

    def __init__(
        self,
        *,
        executable: SomeSubstitutionsType | None = None,
        package: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None,
        namespace: SomeSubstitutionsType | None = None,
        exec_name: SomeSubstitutionsType | None = None,
        parameters: Iterable[Any] | None = None,
        remappings: Iterable[tuple[Any, Any]] | None = None,
        arguments: Iterable[SomeSubstitutionsType] | None = None,
        ros_arguments: Iterable[SomeSubstitutionsType] | None = None,
        **others: Any,
    ) -> None:
        super().__init__(cmd=(), name=exec_name, **others)
        if executable is None:  # asked for here, so that a misspelt keyword is told first
            raise TypeError("Node needs more: executable")
        self.executable = parts_of(executable, "executable")
        self.package = parts_or_none(package, "package")
        self.node_name_parts = parts_or_none(name, "name")
        self.namespace = parts_or_none(namespace, "namespace")
        self.parameters = checked_parameters([] if parameters is None else parameters)
        self.remappings = [_pair(one) for one in (() if remappings is None else remappings)]
        self.arguments = _words(arguments, "arguments")
        self.ros_arguments = _words(ros_arguments, "ros_arguments")
        if ros_arguments is not None and not isinstance(ros_arguments, list):
            raise TypeError(f"ros_arguments must be a list, not {ros_arguments!r}")
        self.label: str | None = None

    def command(self, context: LaunchContext) -> list[str]:
        """The program, its words, and those that ROS reads."""
        words = [performed(context, word) for word in self.arguments]
        return [*self._program(context), *words, "--ros-args", *self._ros(context)]

    def _program(self, context: LaunchContext) -> list[str]:
        name = performed(context, self.executable)
        if self.package is None:
            return [name]
        program = program_of(performed(context, self.package), name)
        self.label = name_of(program)
        return command_of(program)

    def program_name(self, first_word: str) -> str:
        """By the program, also where a Python runs it."""
        return self.label or super().program_name(first_word)

    def _ros(self, context: LaunchContext) -> list[str]:
        name = self._name(context)
        space = self._namespace(context)
        full = f"{space.rstrip('/')}/{name}" if name and space else EVERY_NODE
        known = context.launch_configurations
        pairs = [("-r", f"__node:={name}")] if name else []
        pairs += [("-r", f"__ns:={space}")] if space else []
        pairs += known.get("global_params", [])
        pairs += parameter_words(context, self.parameters, full)
        own = [(performed(context, a), performed(context, b)) for a, b in self.remappings]
        pairs += [("-r", f"{old}:={new}") for old, new in [*known.get("ros_remaps", []), *own]]
        words = [performed(context, word) for word in self.ros_arguments]
        return words + [word for pair in pairs for word in pair]

    def _name(self, context: LaunchContext) -> str | None:
        name = performed_or_none(context, self.node_name_parts)
        if name is None or NAME.fullmatch(name):
            return name
        step = " What stands before the / belongs into namespace." if "/" in name else ""
        raise SubstitutionFailure(
            f"'{name}' is no name for a node: it has letters, digits and underscores, and no digit"
            f" at its front.{step}"
        )

    def _namespace(self, context: LaunchContext) -> str | None:
        """Where the node is, where anything says so. Raises SubstitutionFailure."""
        outer = context.launch_configurations.get("ros_namespace")
        own = performed_or_none(context, self.namespace)
        if outer is None and own is None:
            return None
        return inside(outer or "", own or "") or "/"

    def details(self) -> str:
        """Package, executable, and what else is said."""
        said = {
            "package": self.package,
            "executable": self.executable,
            "name": self.node_name_parts,
            "namespace": self.namespace,
        }
        return ", ".join(f"{key}={described(one)}" for key, one in said.items() if one is not None)


def _words(words: Any, what: str) -> list[Parts]:
    if isinstance(words, str):
        raise TypeError(f"{what} must be a list of words: {what}={words.split()!r}")
    return [parts_of(word, f"each word of {what}") for word in (() if words is None else words)]


def _pair(pair: Any) -> tuple[Parts, Parts]:
    if not isinstance(pair, tuple) or len(pair) != 2:
        raise TypeError(
            f"each of the remappings has two names, remappings=[('from', 'to')], and not {pair!r}"
        )
    return parts_of(pair[0], "remappings"), parts_of(pair[1], "remappings")
