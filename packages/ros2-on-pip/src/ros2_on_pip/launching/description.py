"""The parts of a launch description."""

from __future__ import annotations

import inspect
from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

from ros2_on_pip.launching.conditions import Condition
from ros2_on_pip.launching.events import ExecutionComplete
from ros2_on_pip.launching.places import BadLaunchFile, calling_place
from ros2_on_pip.launching.wrong_kind import Refused
from ros2_on_pip.problem import CommandProblem, did_you_mean

if TYPE_CHECKING:
    from ros2_on_pip.launching.context import LaunchContext

NAMES_ELSEWHERE = {
    "pkg": "package",
    "exec": "executable",
    "node_executable": "executable",
    "node_name": "name",
    "ns": "namespace",
    "node_namespace": "namespace",
    "args": "arguments",
    "ros_args": "ros_arguments",
    "params": "parameters",
    "param": "parameters",
    "remap": "remappings",
    "remaps": "remappings",
    "default": "default_value",
    "if": "condition",
}
"""What XML, YAML and older Pythons call a keyword of today's Python files."""


class UnknownKeyword(TypeError):
    """An action has no such keyword."""

    def __init__(self, cls: type, name: str) -> None:
        known = keywords_of(cls)
        meant = NAMES_ELSEWHERE.get(name)
        near = f" It is called {meant}" if meant in known else did_you_mean(name, known)
        step = near or f" It has: {', '.join(known)}"
        super().__init__(f"{cls.__name__} has no '{name}'.{step}")


def keywords_of(cls: type) -> list[str]:
    """Every keyword that the constructor of `cls` takes, those of its bases too."""
    names = [
        parameter.name
        for base in cls.__mro__
        if "__init__" in vars(base) and base is not object
        for parameter in inspect.signature(base).parameters.values()
        if parameter.kind in (parameter.KEYWORD_ONLY, parameter.POSITIONAL_OR_KEYWORD)
    ]
    return list(dict.fromkeys(names))


class WrongEntity(TypeError):
    """Something that is no action stands where actions are needed."""

    def __init__(self, where: str, value: Any) -> None:
        step = ""
        if isinstance(value, type) and issubclass(value, Entity):
            step = f" Add brackets: {value.__name__}(...)"
        elif value is None:
            step = " A function that makes an action must return it"
        elif isinstance(value, list | tuple):
            value, step = "a list inside the list", " Put a star before the inner one: *actions"
        super().__init__(f"{where} takes actions, such as Node(...), and not {value}.{step}")


class Entity(ABC):
    """Something that a launch carries out."""

    def __init__(self) -> None:
        self.place = calling_place()

    def visit(self, context: LaunchContext) -> Iterator[Entity]:
        """Carry it out, and name what is to be carried out next. Raises BadLaunchFile."""
        try:
            yield from self._visit(context) or ()
        except BadLaunchFile:
            raise
        except CommandProblem as problem:
            raise self._placed(problem) from None
        except (TypeError, ValueError, Refused) as fault:
            raise BadLaunchFile(self.place, str(fault)) from None

    def _placed(self, problem: CommandProblem) -> BadLaunchFile:
        placed = BadLaunchFile(self.place, str(problem))
        placed.exit_code = problem.exit_code
        return placed

    @abstractmethod
    def _visit(self, context: LaunchContext) -> Iterable[Entity] | None:
        """What `visit` does; a Problem needs no place here."""

    def inner(self) -> list[Entity]:
        """What it holds, for `--print` and `--show-args`."""
        return []

    def describe(self) -> str:
        """One line for `--print`."""
        return type(self).__name__


class LaunchDescription(Entity):
    """What a launch file asks for, in order."""

    def __init__(
        self,
        initial_entities: Iterable[Entity] | None = None,
        *,
        deprecated_reason: str | None = None,
    ) -> None:
        super().__init__()
        given = () if initial_entities is None else initial_entities
        self.entities = checked_list(given, "LaunchDescription")
        self.deprecated_reason = deprecated_reason

    def add_entity(self, entity: Entity) -> None:
        """Add something at the end. Raises WrongEntity."""
        self.entities += checked([entity], "add_entity")

    def add_action(self, action: Entity) -> None:
        """Add an action at the end. Raises WrongEntity."""
        self.entities += checked([action], "add_action")

    def inner(self) -> list[Entity]:
        """Its entities."""
        return self.entities

    def _visit(self, context: LaunchContext) -> Iterable[Entity]:
        if self.deprecated_reason is not None:
            file = f"launch file [{context.file}] is deprecated"
            what = file if context.file else "deprecated launch description"
            context.say(f"[WARNING] [root]: {what}: {self.deprecated_reason}")
        return self.entities

    @property
    def deprecated(self) -> bool:
        """Whether there is a reason not to use it any more."""
        return self.deprecated_reason is not None


class Action(Entity):
    """Something that a launch does, where its condition holds."""

    ends_later = False
    """Whether it has not ended yet when `execute` has: then its class tells the end."""

    end_is_heard = False
    """Whether a handler for its end was there when it was carried out."""

    def __init__(self, *, condition: Condition | None = None, **unknown: Any) -> None:
        super().__init__()
        for name in unknown:
            raise UnknownKeyword(type(self), name)
        if condition is not None and not isinstance(condition, Condition):
            raise TypeError(
                f"condition must be IfCondition(...) or UnlessCondition(...), not {condition!r}"
            )
        self.condition = condition

    def _visit(self, context: LaunchContext) -> Iterable[Entity] | None:
        if self.condition and not self.condition.evaluate(context):
            return None
        made = self.execute(context)
        self.end_is_heard = context.would_handle_event(ExecutionComplete(action=self))
        if not self.ends_later:
            self.tell_end(context)
        return made

    def tell_end(self, context: LaunchContext) -> None:
        """Let OnExecutionComplete know; a handler that came after it hears nothing."""
        if self.end_is_heard:
            context.emit_event_sync(ExecutionComplete(action=self))

    @abstractmethod
    def execute(self, context: LaunchContext) -> Iterable[Entity] | None:
        """Do it, and name what is to be done next."""

    def describe(self) -> str:
        """Its name, and its condition."""
        text = f"{type(self).__name__}({self.details()})"
        return f"{text} if {self.condition.describe()}" if self.condition else text

    def details(self) -> str:
        """What stands between its brackets for `--print`."""
        return ""


def checked_list(entities: Iterable[Entity], where: str) -> list[Entity]:
    """The entities as a list; one alone is none. Raises WrongEntity, TypeError."""
    if isinstance(entities, Entity):
        name = type(entities).__name__
        raise TypeError(f"{where} takes a list of actions. Put [ and ] around it: [{name}(...)]")
    return checked(entities, where)


def checked(entities: Iterable[Entity] | Entity, where: str) -> list[Entity]:
    """The entities as a list. Raises WrongEntity."""
    if isinstance(entities, Entity):
        return [entities]
    if isinstance(entities, str) or not isinstance(entities, Iterable):
        raise WrongEntity(where, entities)
    found = list(entities)
    for one in found:
        if not isinstance(one, Entity):
            raise WrongEntity(where, one)
    return found


class ProcessAction(Action):
    """One that starts a process: event handlers may be told which."""

    ends_later = True
