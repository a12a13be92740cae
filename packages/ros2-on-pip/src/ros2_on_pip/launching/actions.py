"""The actions that start no process."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from ros2_on_pip.launching import events
from ros2_on_pip.launching.description import Action, Entity, checked_list
from ros2_on_pip.launching.handlers import EventHandler
from ros2_on_pip.launching.python_file import students_code
from ros2_on_pip.launching.substitution import (
    Parts,
    SomeSubstitutionsType,
    Substitution,
    SubstitutionFailure,
    described,
    pairs_of,
    parts_of,
    parts_or_none,
    performed,
)
from ros2_on_pip.launching.typed import seconds_of, truth_of, typed
from ros2_on_pip.launching.wrong_kind import Refused
from ros2_on_pip.problem import CommandProblem, did_you_mean

if TYPE_CHECKING:
    from ros2_on_pip.launching.context import Alarm, LaunchContext


class MissingArgument(CommandProblem):
    """The file wants an argument that was not given."""

    def __init__(self, name: str, description: str, around: bool = False) -> None:
        """`around`: the file that includes this one has it, and does not hand it on."""
        step = f"Add it to the command: {name}:=VALUE"
        if around:
            step = (
                "It is set where the file is included, and must be handed on there:"
                f" launch_arguments={{'{name}': LaunchConfiguration('{name}')}}.items()"
            )
        super().__init__(
            f"Required launch argument '{name}' (description:"
            f" '{description or 'no description given'}') was not provided. {step}"
        )


class BadChoice(CommandProblem):
    """An argument has a value that the file does not allow."""

    def __init__(self, name: str, value: str, choices: Collection[Any]) -> None:
        near = did_you_mean(value, [str(one) for one in choices])
        super().__init__(
            f'Argument "{name}" provided value "{value}" is not valid.'
            f" Valid options are: {choices}.{near}"
        )


class DeclareLaunchArgument(Action):
    """An argument of the launch file."""

    def __init__(
        self,
        name: str,
        *,
        default_value: SomeSubstitutionsType | None = None,
        description: str | None = None,
        choices: Collection[str] | None = None,
        **others: Any,
    ) -> None:
        """Raises Refused where `choices` is empty, or has no place for the default."""
        super().__init__(**others)
        self.name = name
        self.default_value = parts_or_none(default_value, f"default_value of '{name}'")
        self.description = description or ""
        self.choices = choices
        if choices is not None:
            self._require_choice(default_value, choices)

    def _require_choice(self, default: SomeSubstitutionsType, choices: Collection[str]) -> None:
        """A default with a substitution in it is looked at when its value is known."""
        if len(choices) == 0:
            raise Refused(
                f"choices of '{self.name}' is empty. Leave choices out: then every value is right"
            )
        if default is None or isinstance(default, Substitution | list) or default in choices:
            return
        raise Refused(
            f"Provided default_value \"{default}\" of '{self.name}' is not in provided choices"
            f' "{choices}".{did_you_mean(str(default), [str(one) for one in choices])}'
        )

    def execute(self, context: LaunchContext) -> None:
        """Give it its default where nobody gave a value. Raises MissingArgument, BadChoice."""
        known = context.launch_configurations
        context.declared.append(self.name)
        if self.name not in known:
            if self.default_value is None:
                raise MissingArgument(self.name, self.description)
            known[self.name] = performed(context, self.default_value)
        if self.choices is not None and known[self.name] not in self.choices:
            raise BadChoice(self.name, known[self.name], self.choices)

    def details(self) -> str:
        """Its name and its default."""
        default = "" if self.default_value is None else f", default {described(self.default_value)}"
        return f"'{self.name}'{default}"


class SetLaunchConfiguration(Action):
    """Give a launch configuration a value."""

    def __init__(
        self, name: SomeSubstitutionsType, value: SomeSubstitutionsType, **others: Any
    ) -> None:
        super().__init__(**others)
        self.name = parts_of(name, f"the name of {type(self).__name__}")
        self.value = parts_of(value, f"the value of {type(self).__name__}")

    def execute(self, context: LaunchContext) -> None:
        """Set it."""
        value = performed(context, self.value)
        context.launch_configurations[performed(context, self.name)] = value

    def details(self) -> str:
        """The name and the value."""
        return f"{described(self.name)}, {described(self.value)}"


class SetEnvironmentVariable(SetLaunchConfiguration):
    """Give a variable of the environment a value."""

    def execute(self, context: LaunchContext) -> None:
        """Set it."""
        context.environment[performed(context, self.name)] = performed(context, self.value)


class AppendEnvironmentVariable(SetLaunchConfiguration):
    """Put something behind, or before, the value of a variable of the environment."""

    def __init__(
        self,
        name: SomeSubstitutionsType,
        value: SomeSubstitutionsType,
        prepend: bool | SomeSubstitutionsType = False,
        separator: SomeSubstitutionsType = ":",
        **others: Any,
    ) -> None:
        super().__init__(name, value, **others)
        self.prepend = typed(prepend, bool, "prepend of AppendEnvironmentVariable")
        self.separator = parts_of(separator, "separator")

    def execute(self, context: LaunchContext) -> None:
        """Append it."""
        name, value = performed(context, self.name), performed(context, self.value)
        first = truth_of(context, self.prepend, "prepend")
        between = performed(context, self.separator)
        if (old := context.environment.get(name)) is not None:
            value = between.join([value, old] if first else [old, value])
        context.environment[name] = value


class _Unset(Action):
    """Base of what takes a name away."""

    def __init__(self, name: SomeSubstitutionsType, **others: Any) -> None:
        super().__init__(**others)
        self.name = parts_of(name, f"the name of {type(self).__name__}")

    def details(self) -> str:
        """The name."""
        return described(self.name)


class UnsetEnvironmentVariable(_Unset):
    """Take a variable of the environment away."""

    def execute(self, context: LaunchContext) -> None:
        """Take it away."""
        context.environment.pop(performed(context, self.name), None)


class UnsetLaunchConfiguration(_Unset):
    """Take a launch configuration away."""

    def execute(self, context: LaunchContext) -> None:
        """Take it away."""
        context.launch_configurations.pop(performed(context, self.name), None)


class GroupAction(Action):
    """Several actions with one condition; what they set stays inside."""

    def __init__(
        self,
        actions: Iterable[Entity],
        *,
        scoped: bool = True,
        forwarding: bool = True,
        launch_configurations: Mapping[Any, Any] | None = None,
        **others: Any,
    ) -> None:
        super().__init__(**others)
        self.actions = checked_list(actions, "GroupAction")
        self.scoped, self.forwarding = scoped, forwarding
        self.settings = pairs_of(launch_configurations, "launch_configurations")

    def execute(self, context: LaunchContext) -> Iterable[Entity]:
        """The actions, between a beginning and an end."""
        if not self.scoped:
            context.launch_configurations.update(self._settings_in(context))
            yield from self.actions
            return
        with context.scope(self.forwarding, self._settings_in):
            yield from self.actions

    def _settings_in(self, context: LaunchContext) -> dict[str, str]:
        return {
            performed(context, name): performed(context, value) for name, value in self.settings
        }

    def inner(self) -> list[Entity]:
        """The actions."""
        return self.actions


class LogInfo(Action):
    """A line for the screen."""

    def __init__(self, *, msg: SomeSubstitutionsType, **others: Any) -> None:
        super().__init__(**others)
        self.msg = parts_of(msg, "msg of LogInfo")

    def execute(self, context: LaunchContext) -> None:
        """Say it."""
        context.say(f"[INFO] [launch.user]: {performed(context, self.msg)}")

    def details(self) -> str:
        """The text."""
        return described(self.msg)


class TimerAction(Action):
    """Actions that are carried out later."""

    def __init__(
        self,
        *,
        period: float | SomeSubstitutionsType,
        actions: Iterable[Entity],
        cancel_on_shutdown: bool | SomeSubstitutionsType = True,
        **others: Any,
    ) -> None:
        """`period` is in seconds, `5.0` and not `5`; a text, `'5'`, is read at once.

        Raises WrongValueKind, and ValueError for a text that is no number.
        """
        super().__init__(**others)
        self.period = _period(period)
        self.actions = checked_list(actions, "TimerAction")
        self.cancel_on_shutdown = typed(cancel_on_shutdown, bool, "cancel_on_shutdown")
        self._cancelled = False
        self._cancel_alarm: Callable[[], None] = lambda: None

    def cancel(self) -> None:
        """Do not carry them out, and do not wait any longer."""
        self._cancelled = True
        self._cancel_alarm()

    def execute(self, context: LaunchContext) -> None:
        """Begin to wait. Raises SubstitutionFailure."""
        self.ends_later = not self._cancelled
        if self._cancelled:
            return
        period_s = seconds_of(context, self.period, "period")
        always = not truth_of(context, self.cancel_on_shutdown, "cancel_on_shutdown")
        known = dict(context.launch_configurations)
        alarm = context.after(period_s, lambda: self._carry_out(context, known), always=always)
        self._cancel_alarm = lambda: self._end_early(context, alarm)

    def _carry_out(self, context: LaunchContext, known: dict[str, Any]) -> None:
        """With the configurations of when it began; what they set stays among them."""
        self._cancel_alarm = lambda: None
        with context.configured(known):
            for action in self.actions:
                context.visit(action)
        self.tell_end(context)

    def _end_early(self, context: LaunchContext, alarm: Alarm) -> None:
        if not alarm.cancelled:
            alarm.cancelled = True
            self.tell_end(context)

    def inner(self) -> list[Entity]:
        """The actions."""
        return self.actions

    def details(self) -> str:
        """The seconds."""
        known = self.period
        return f"{known if isinstance(known, float) else described(known)} s"


def _period(period: float | SomeSubstitutionsType) -> float | Parts:
    """Jazzy reads a text at once, and takes a whole number for a mistake."""
    if not isinstance(period, str):
        return typed(period, float, "period of TimerAction, in seconds,")
    try:
        return float(period)
    except ValueError:
        raise ValueError(f"period of TimerAction must be seconds, and not '{period}'") from None


class RegisterEventHandler(Action):
    """Answer events from now on."""

    def __init__(self, event_handler: EventHandler, **others: Any) -> None:
        super().__init__(**others)
        if not isinstance(event_handler, EventHandler):
            raise TypeError(
                "RegisterEventHandler takes an event handler, such as OnProcessExit(...),"
                f" and not {event_handler!r}"
            )
        self.event_handler = event_handler

    def execute(self, context: LaunchContext) -> None:
        """Register it."""
        context.register_event_handler(self.event_handler)

    def inner(self) -> list[Entity]:
        """The actions of the handler."""
        return self.event_handler.inner()

    def details(self) -> str:
        """The kind of handler."""
        return type(self.event_handler).__name__


class UnregisterEventHandler(RegisterEventHandler):
    """Answer events no more."""

    def execute(self, context: LaunchContext) -> None:
        """Forget the handler."""
        context.unregister_event_handler(self.event_handler)


class EmitEvent(Action):
    """Let something happen."""

    def __init__(self, *, event: events.Event, **others: Any) -> None:
        super().__init__(**others)
        if not isinstance(event, events.Event):
            raise Refused(
                f"EmitEvent takes an event, such as Shutdown() of launch.events, not {event!r}"
            )
        self.event = event

    def execute(self, context: LaunchContext) -> None:
        """Tell the handlers."""
        context.emit_event_sync(self.event)

    def details(self) -> str:
        """The event."""
        return type(self.event).__name__


class Shutdown(EmitEvent):
    """End the whole launch."""

    def __init__(self, *, reason: Any = "reason not given", **others: Any) -> None:
        """`reason` is a text; Jazzy hands on anything else as it is, and fills nothing in."""
        super().__init__(event=events.Shutdown(reason=reason), **others)
        self.reason = reason

    def execute(self, context: LaunchContext) -> None:
        """End it after what is being done now; whose end asked for it is told."""
        event = getattr(context.locals, "event", None)
        if isinstance(event, events.ProcessExited):
            context.say(
                f"[INFO] [launch]: process[{event.process_name}] was required: shutting down"
                " launched system"
            )
        super().execute(context)

    def details(self) -> str:
        """The reason."""
        return repr(self.reason)


class OpaqueFunction(Action):
    """A function that makes actions when the values of all arguments are known."""

    def __init__(
        self,
        *,
        function: Callable[..., Iterable[Entity] | None],
        args: Iterable[Any] | None = None,
        kwargs: Mapping[str, Any] | None = None,
        **others: Any,
    ) -> None:
        super().__init__(**others)
        if not callable(function):
            raise TypeError(f"function of OpaqueFunction must be a function, not {function!r}")
        if kwargs is not None and not isinstance(kwargs, dict):
            raise TypeError(f"kwargs of OpaqueFunction must be a dict of names, not {kwargs!r}")
        if args is not None and not isinstance(args, Iterable):
            raise TypeError(f"args of OpaqueFunction must be a list, not {args!r}: args=[{args!r}]")
        self.function, self.args, self.kwargs = function, list(args or ()), dict(kwargs or {})

    def execute(self, context: LaunchContext) -> list[Entity]:
        """Call it. Raises BadLaunchFile."""
        with students_code(self.place):
            made = self.function(context, *self.args, **self.kwargs)
        name = getattr(self.function, "__name__", "a function")
        return checked_list(() if made is None else made, f"what {name}() returns")

    def details(self) -> str:
        """The name of the function."""
        return getattr(self.function, "__name__", repr(self.function))


class PushRosNamespace(Action):
    """Put what follows into a namespace."""

    def __init__(self, namespace: SomeSubstitutionsType, **others: Any) -> None:
        super().__init__(**others)
        self.namespace = parts_of(namespace, "namespace of PushRosNamespace")

    def execute(self, context: LaunchContext) -> None:
        """Go one step further in. Raises SubstitutionFailure."""
        outer = context.launch_configurations.get("ros_namespace", "")
        space = inside(outer, performed(context, self.namespace))
        context.launch_configurations["ros_namespace"] = space

    def details(self) -> str:
        """The namespace."""
        return described(self.namespace)


class SetParameter(Action):
    """Give a parameter of every node that follows a value."""

    def __init__(self, name: SomeSubstitutionsType, value: Any, **others: Any) -> None:
        super().__init__(**others)
        self.name = parts_of(name, "the name of SetParameter")
        self.value = value

    def execute(self, context: LaunchContext) -> None:
        """Remember it for the nodes."""
        from ros2_on_pip.launching.parameters import flat

        for name, value in flat(context, {tuple(self.name): self.value}):
            _remember(context, "global_params", ("-p", f"{name}:={_as_typed(value)}"))

    def details(self) -> str:
        """Name and value."""
        return f"{described(self.name)}, {self.value!r}"


class SetParametersFromFile(Action):
    """Give a parameter file to every node that follows."""

    def __init__(self, filename: SomeSubstitutionsType, **others: Any) -> None:
        super().__init__(**others)
        self.filename = parts_of(filename, "filename of SetParametersFromFile")

    def execute(self, context: LaunchContext) -> None:
        """Remember it for the nodes."""
        from ros2_on_pip.launching.parameters import existing_file

        file = existing_file(performed(context, self.filename))
        _remember(context, "global_params", ("--params-file", str(file)))


class SetUseSimTime(Action):
    """Let the launch itself take its time from /clock; the nodes that it starts hear nothing."""

    def __init__(self, value: bool | SomeSubstitutionsType, **others: Any) -> None:
        """Raises WrongValueKind."""
        super().__init__(**others)
        self.value = typed(value, bool, "value of SetUseSimTime")

    def execute(self, context: LaunchContext) -> None:
        """Say for whom it is: here, no part of the launch asks for the time of /clock.

        Raises SubstitutionFailure where the value is false, as Jazzy's ends the launch then.
        """
        nodes = "SetParameter('use_sim_time', True) of launch_ros.actions"
        if not truth_of(context, self.value, "value of SetUseSimTime"):
            raise SubstitutionFailure(f"SetUseSimTime takes True alone. For nodes: {nodes}")
        context.say(f"[INFO] [launch]: SetUseSimTime changes no node. For nodes: {nodes}")

    def details(self) -> str:
        """The value."""
        return str(self.value) if isinstance(self.value, bool) else described(self.value)


class SetRemap(Action):
    """Give a name of every node that follows another name."""

    def __init__(
        self, src: SomeSubstitutionsType, dst: SomeSubstitutionsType, **others: Any
    ) -> None:
        super().__init__(**others)
        self.src, self.dst = parts_of(src, "src of SetRemap"), parts_of(dst, "dst of SetRemap")

    def execute(self, context: LaunchContext) -> None:
        """Remember it for the nodes."""
        pair = performed(context, self.src), performed(context, self.dst)
        _remember(context, "ros_remaps", pair)

    def details(self) -> str:
        """Both names."""
        return f"{described(self.src)}, {described(self.dst)}"


def _as_typed(value: Any) -> str:
    """As Jazzy hands it on: without quotes, so that the node reads the text 7 as a number.

    A list is in round brackets, which the node reads as a text.
    """
    return str(tuple(value) if isinstance(value, list) else value)


def _remember(context: LaunchContext, key: str, value: Any) -> None:
    known = context.launch_configurations.get(key, [])
    context.launch_configurations[key] = [*known, value]


NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")


def inside(outer: str, inner: str) -> str:
    """A namespace inside another; an absolute one stays as it is. Raises SubstitutionFailure."""
    space = inner if inner.startswith("/") else f"{outer.rstrip('/')}/{inner}".rstrip("/")
    if not all(NAME.fullmatch(part) for part in space.split("/")[1:] if space != "/"):
        raise SubstitutionFailure(
            f"'{space}' is no namespace: letters, digits and underscores between slashes, and"
            " no digit after a slash"
        )
    return space
