"""The actions that start no process."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from ros2_on_pip.launching import events
from ros2_on_pip.launching.description import Action, Entity, checked
from ros2_on_pip.launching.handlers import EventHandler
from ros2_on_pip.launching.python_file import students_code
from ros2_on_pip.launching.substitution import (
    SomeSubstitutionsType,
    SubstitutionFailure,
    described,
    parts_of,
    parts_or_none,
    performed,
)
from ros2_on_pip.launching.substitutions import truth
from ros2_on_pip.problem import Problem, did_you_mean

if TYPE_CHECKING:
    from ros2_on_pip.launching.context import LaunchContext


class MissingArgument(Problem):
    """The file wants an argument that was not given."""

    def __init__(self, name: str, description: str) -> None:
        super().__init__(
            f"Required launch argument '{name}' (description:"
            f" '{description or 'no description given'}') was not provided."
            f" Add it to the command: {name}:=VALUE"
        )


class BadChoice(Problem):
    """An argument has a value that the file does not allow."""

    def __init__(self, name: str, value: str, choices: list[str]) -> None:
        near = did_you_mean(value, choices)
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
        choices: Iterable[str] | None = None,
        **others: Any,
    ) -> None:
        super().__init__(**others)
        self.name = name
        self.default_value = parts_or_none(default_value, f"default_value of '{name}'")
        self.description = description or ""
        self.choices = None if choices is None else [str(one) for one in choices]

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
        self.prepend = parts_of(str(prepend) if isinstance(prepend, bool) else prepend, "prepend")
        self.separator = parts_of(separator, "separator")

    def execute(self, context: LaunchContext) -> None:
        """Append it."""
        name, value = performed(context, self.name), performed(context, self.value)
        old = context.environment.get(name)
        first = truth(performed(context, self.prepend), "prepend")
        pieces = [value, old] if first else [old, value]
        between = performed(context, self.separator)
        context.environment[name] = between.join(piece for piece in pieces if piece)


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
        self.actions = checked(actions, "GroupAction")
        self.scoped, self.forwarding = scoped, forwarding
        self.settings = [
            (parts_of(name, "a name in launch_configurations"), parts_of(value, "a value in them"))
            for name, value in (launch_configurations or {}).items()
        ]

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
        cancel_on_shutdown: bool = True,
        **others: Any,
    ) -> None:
        super().__init__(**others)
        is_number = isinstance(period, int | float)
        self.period = parts_of(str(period) if is_number else period, "period of TimerAction")
        self.actions = checked(actions, "TimerAction")
        self.cancel_on_shutdown = cancel_on_shutdown
        self._cancelled = False

    def cancel(self) -> None:
        """Do not carry them out."""
        self._cancelled = True

    def execute(self, context: LaunchContext) -> None:
        """Begin to wait. Raises SubstitutionFailure."""
        text = performed(context, self.period)
        try:
            period_s = float(text)
        except ValueError:
            raise SubstitutionFailure(f"period must be seconds, and not '{text}'") from None
        always = not self.cancel_on_shutdown
        context.after(period_s, lambda: self._carry_out(context), always=always)

    def _carry_out(self, context: LaunchContext) -> None:
        for action in () if self._cancelled else self.actions:
            context.visit(action)

    def inner(self) -> list[Entity]:
        """The actions."""
        return self.actions

    def details(self) -> str:
        """The seconds."""
        return f"{described(self.period)} s"


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
            raise TypeError(
                f"EmitEvent takes an event, such as Shutdown() of launch.events, not {event!r}"
            )
        self.event = event

    def execute(self, context: LaunchContext) -> None:
        """Tell the handlers."""
        reason = getattr(self.event, "reason", "")
        if not isinstance(reason, str):  # a substitution is filled in when it happens
            self.event.reason = performed(context, parts_of(reason, "reason"))  # type: ignore[attr-defined]  # looked at above
        context.emit_event_sync(self.event)

    def details(self) -> str:
        """The event."""
        return type(self.event).__name__


class Shutdown(EmitEvent):
    """End the whole launch."""

    def __init__(
        self, *, reason: SomeSubstitutionsType = "reason not given", **others: Any
    ) -> None:
        super().__init__(event=events.Shutdown(), **others)
        self.reason = parts_of(reason, "reason of Shutdown")

    def execute(self, context: LaunchContext) -> None:
        """End it after what is being done now; whose end asked for it is told."""
        event = getattr(context.locals, "event", None)
        if isinstance(event, events.ProcessExited):
            context.say(
                f"[INFO] [launch]: process[{event.process_name}] was required: shutting down"
                " launched system"
            )
        context.emit_event_sync(events.Shutdown(reason=performed(context, self.reason)))

    def details(self) -> str:
        """The reason."""
        return described(self.reason)


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
        self.function, self.args, self.kwargs = function, list(args or ()), dict(kwargs or {})

    def execute(self, context: LaunchContext) -> list[Entity]:
        """Call it. Raises BadLaunchFile."""
        with students_code(self.place):
            made = self.function(context, *self.args, **self.kwargs)
        name = getattr(self.function, "__name__", "a function")
        return checked(made or (), f"what {name}() returns")

    def details(self) -> str:
        """The name of the function."""
        return getattr(self.function, "__name__", repr(self.function))


class PushRosNamespace(Action):
    """Put what follows into a namespace."""

    def __init__(self, namespace: SomeSubstitutionsType, **others: Any) -> None:
        super().__init__(**others)
        self.namespace = parts_of(namespace, "namespace of PushRosNamespace")

    def execute(self, context: LaunchContext) -> None:
        """Go one step further in."""
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
        from ros2_on_pip.launching.parameters import rule

        _remember(context, "global_params", rule(context, self.name, self.value))

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


class SetUseSimTime(SetParameter):
    """Let every node that follows take its time from /clock."""

    def __init__(self, value: bool | SomeSubstitutionsType, **others: Any) -> None:
        super().__init__("use_sim_time", value, **others)


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


def _remember(context: LaunchContext, key: str, value: Any) -> None:
    known = context.launch_configurations.get(key, [])
    context.launch_configurations[key] = [*known, value]


def inside(outer: str, inner: str) -> str:
    """A namespace inside another; an absolute one stays as it is."""
    return inner if inner.startswith("/") else f"{outer.rstrip('/')}/{inner}".rstrip("/")
