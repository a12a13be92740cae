"""What a launch file asks for, in order: nodes to start and lines to say."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from roslings.ros2.launch import jazzy
from roslings.ros2.launch.entity import BadLaunchFile, Entity, NotReadHere
from roslings.ros2.launch.reading import read_launch_file
from roslings.ros2.launch.substitution import Scope, UnknownSubstitution, filled_in
from roslings.ros2.problem import Problem, did_you_mean

NODE_ATTRIBUTES = (
    "pkg", "exec", "name", "namespace", "output", "args", "ros_args", "launch_prefix", "cwd",
    "emulate_tty",
)  # fmt: skip
TRUE, FALSE = ("true", "1"), ("false", "0")


@dataclass(frozen=True)
class Say:
    """A line for the screen."""

    text: str


@dataclass(frozen=True)
class Start:
    """A node to start."""

    package: str
    executable: str
    name: str | None = None
    namespace: str | None = None
    arguments: tuple[str, ...] = ()
    ros_arguments: tuple[str, ...] = ()
    prefix: tuple[str, ...] = ()
    folder: str | None = None
    parameters: dict[str, Any] = field(default_factory=dict)
    parameter_files: tuple[Path, ...] = ()
    remaps: tuple[tuple[str, str], ...] = ()
    environment: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Declared:
    """An argument of a launch file."""

    name: str
    default: str | None
    description: str


Step = Say | Start


class MissingArgument(Problem):
    """The file wants an argument that was not given."""

    def __init__(self, arg: Declared) -> None:
        about = arg.description or "no description given"
        super().__init__(
            f"[ERROR] [launch]: Required launch argument '{arg.name}' (description: '{about}')"
            f" was not provided. Add it to the command: {arg.name}:=VALUE"
        )


def plan(path: Path, arguments: dict[str, str]) -> tuple[list[Step], list[Declared]]:
    """The steps of a launch file, and the arguments that it has.

    Raises BadLaunchFile, MissingArgument, PythonLaunchFile.
    """
    planner = Planner(arguments)
    root = read_launch_file(path)
    return list(planner.steps_in(root, Scope(path))), planner.declared


def declared_in(path: Path) -> list[Declared]:
    """The arguments at the top of a launch file, without planning anything."""
    root = read_launch_file(path)
    return [_declared(arg, Scope(path), lazily=True) for arg in root.inside("arg")]


class Planner:
    """Walks through the elements, top to bottom."""

    def __init__(self, arguments: dict[str, str]) -> None:
        self._given = arguments
        self.declared: list[Declared] = []
        self._actions: dict[str, Callable[[Entity, Scope], Iterator[Step]]] = {
            "arg": self._arg,
            "let": self._let,
            "log": self._log,
            "node": self._node,
            "group": lambda entity, scope: self.steps_in(entity, scope.inner()),
            "include": self._include,
            "set_env": self._set_env,
        }

    def steps_in(self, entity: Entity, scope: Scope) -> Iterator[Step]:
        """The steps of the elements inside `entity`. Raises BadLaunchFile."""
        for child in entity.children:
            if not _wanted(child, scope):
                continue
            if child.tag == "push_ros_namespace":
                pushed = text_of(child, "namespace", scope)
                scope = replace(scope, namespace=joined(scope.namespace, pushed))
            else:
                yield from self._steps_of(child, scope)

    def _steps_of(self, entity: Entity, scope: Scope) -> Iterator[Step]:
        if entity.tag in jazzy.ELEMENTS:
            raise NotReadHere(entity.place, f"'{entity.tag}'")
        if entity.tag not in self._actions:
            known = sorted([*self._actions, "push_ros_namespace"])
            raise BadLaunchFile(
                entity.place, f"there is no '{entity.tag}'.{did_you_mean(entity.tag, known)}"
                f" Known: {', '.join(known)}.",
            )  # fmt: skip
        yield from self._actions[entity.tag](entity, scope)

    def _arg(self, entity: Entity, scope: Scope) -> Iterator[Step]:
        declared = _declared(entity, scope)
        self.declared.append(declared)
        if declared.name in self._given:
            scope.variables[declared.name] = self._given[declared.name]
        elif declared.name not in scope.variables:
            if declared.default is None:
                raise MissingArgument(declared)
            scope.variables[declared.name] = declared.default
        yield from ()

    def _let(self, entity: Entity, scope: Scope) -> Iterator[Step]:
        scope.variables[text_of(entity, "name", scope)] = text_of(entity, "value", scope)
        yield from ()

    def _set_env(self, entity: Entity, scope: Scope) -> Iterator[Step]:
        scope.environment[text_of(entity, "name", scope)] = text_of(entity, "value", scope)
        yield from ()

    def _log(self, entity: Entity, scope: Scope) -> Iterator[Step]:
        yield Say(text_of(entity, "message", scope))

    def _include(self, entity: Entity, scope: Scope) -> Iterator[Step]:
        path = Path(text_of(entity, "file", scope))
        inner = replace(scope.inner(), file=path)
        for arg in (*entity.inside("arg"), *entity.inside("let")):
            inner.variables[text_of(arg, "name", scope)] = text_of(arg, "value", scope)
        yield from self.steps_in(read_launch_file(path), inner)

    def _node(self, entity: Entity, scope: Scope) -> Iterator[Step]:
        _refuse_others(entity, NODE_ATTRIBUTES)
        own_space = optional(entity, "namespace", scope)
        space = joined(scope.namespace, own_space) if own_space else scope.namespace
        files = [optional(param, "from", scope) for param in entity.inside("param")]
        yield Start(
            package=text_of(entity, "pkg", scope),
            executable=text_of(entity, "exec", scope),
            name=optional(entity, "name", scope),
            namespace=space if space != "/" else None,
            arguments=words(entity, "args", scope),
            ros_arguments=words(entity, "ros_args", scope),
            prefix=words(entity, "launch_prefix", scope),
            folder=optional(entity, "cwd", scope),
            parameters=dict(_parameters(entity.inside("param"), scope)),
            parameter_files=tuple(Path(name) for name in files if name),
            remaps=tuple(
                (text_of(one, "from", scope), text_of(one, "to", scope))
                for one in entity.inside("remap")
            ),
            environment={**scope.environment, **_pairs(entity.inside("env"), scope)},
        )  # fmt: skip


def _pairs(entities: list[Entity], scope: Scope) -> dict[str, str]:
    return {text_of(one, "name", scope): text_of(one, "value", scope) for one in entities}


def _declared(entity: Entity, scope: Scope, lazily: bool = False) -> Declared:
    default = entity.attributes.get("default")
    if default is not None and not lazily:
        default = filled(entity, str(default), scope)
    return Declared(
        name=text_of(entity, "name", scope),
        default=None if default is None else str(default),
        description=str(entity.attributes.get("description", "")),
    )


def _parameters(
    entities: list[Entity], scope: Scope, prefix: str = ""
) -> Iterator[tuple[str, Any]]:
    """Name and value of each parameter; one inside another gets a dot between the names."""
    for entity in entities:
        if "from" in entity.attributes:
            continue
        name = prefix + text_of(entity, "name", scope)
        if inner := entity.inside("param"):
            yield from _parameters(inner, scope, f"{name}.")
        else:
            yield name, _parameter_value(entity, scope)


def _parameter_value(entity: Entity, scope: Scope) -> Any:
    """XML knows only texts: what looks like a number is one, unless `type` says otherwise."""
    value = entity.attributes.get("value")
    if value is not None and not isinstance(value, str):
        return value
    text = text_of(entity, "value", scope)
    if entity.attributes.get("type") == "str":
        return text
    import yaml

    try:
        return yaml.safe_load(text)
    except yaml.YAMLError:
        return text


def _wanted(entity: Entity, scope: Scope) -> bool:
    """What `if` and `unless` say."""
    yes, no = optional(entity, "if", scope), optional(entity, "unless", scope)
    return (yes is None or _truth(entity, yes)) and (no is None or not _truth(entity, no))


def _truth(entity: Entity, text: str) -> bool:
    if text.lower() not in (*TRUE, *FALSE):
        raise BadLaunchFile(entity.place, f"a condition is true or false, and not '{text}'")
    return text.lower() in TRUE


def _refuse_others(entity: Entity, known: tuple[str, ...]) -> None:
    """Raises BadLaunchFile where an attribute would be ignored."""
    names = {name.replace("-", "_") for name in entity.attributes} - {*known, "if", "unless"}
    for name in sorted(names):
        if entity.tag == "node" and name in jazzy.NODE_ATTRIBUTES:
            raise NotReadHere(entity.place, f"'{name}' of '{entity.tag}'")
        raise BadLaunchFile(
            entity.place, f"'{entity.tag}' has no attribute '{name}' here."
            f"{did_you_mean(name, known)}",
        )  # fmt: skip


def text_of(entity: Entity, name: str, scope: Scope) -> str:
    """The attribute `name`, filled in. Raises BadLaunchFile where it is missing."""
    value = optional(entity, name, scope)
    if value is None:
        raise BadLaunchFile(entity.place, f"'{entity.tag}' needs the attribute '{name}'")
    return value


def optional(entity: Entity, name: str, scope: Scope) -> str | None:
    """The attribute `name`, filled in; None where it is missing."""
    value = entity.attributes.get(name, entity.attributes.get(name.replace("_", "-")))
    if value is None:
        return None
    text = str(value).lower() if isinstance(value, bool) else str(value)
    return filled(entity, text, scope)


def words(entity: Entity, name: str, scope: Scope) -> tuple[str, ...]:
    """The attribute `name` as the words of a command line."""
    return tuple(shlex.split(optional(entity, name, scope) or ""))


def filled(entity: Entity, text: str, scope: Scope) -> str:
    """`text` filled in; a fault names the place. Raises BadLaunchFile."""
    try:
        return filled_in(text, scope)
    except UnknownSubstitution as unknown:
        raise NotReadHere(entity.place, str(unknown)) from None
    except Problem as problem:
        raise BadLaunchFile(entity.place, str(problem)) from None


def joined(outer: str, inner: str) -> str:
    """A namespace inside another; an absolute one stays as it is."""
    return inner if inner.startswith("/") else f"{outer.rstrip('/')}/{inner}"
