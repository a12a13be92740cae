"""What is done when something happens."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ros2_on_pip.launching.description import Action, Entity, ProcessAction, checked
from ros2_on_pip.launching.events import (
    Event,
    ExecutionComplete,
    ProcessExited,
    ProcessIO,
    ProcessStarted,
    Shutdown,
)
from ros2_on_pip.launching.places import BadLaunchFile, calling_place
from ros2_on_pip.launching.python_file import students_code

if TYPE_CHECKING:
    from ros2_on_pip.launching.context import LaunchContext

Answer = Any
"""Actions, or a function of the event and the context that may return actions."""


class EventHandler:
    """Answers the events that it matches."""

    def __init__(
        self,
        *,
        matcher: Callable[[Event], bool],
        entities: Answer = None,
        handle_once: bool = False,
    ) -> None:
        """`entities` are actions; subclasses take functions, too. Raises TypeError."""
        self.matcher, self.handle_once = matcher, handle_once
        self.place = calling_place()
        if type(self) is EventHandler and is_function(entities):
            raise TypeError(
                "entities of EventHandler are actions. A function goes into one:"
                " entities=[OpaqueFunction(function=...)]"
            )
        self.answer = answer_of(entities or (), type(self).__name__)

    def matches(self, event: Event) -> bool:
        """Whether the event is for this handler. Raises BadLaunchFile."""
        with students_code(self.place):
            return bool(self.matcher(event))

    def handle(self, event: Event, context: LaunchContext) -> list[Entity]:
        """What is to be done about it. Raises WrongEntity."""
        if self.handle_once:
            context.unregister_event_handler(self)
        return self.answered(self.answer, event, context)

    def answered(self, answer: Answer, event: Event, context: LaunchContext) -> list[Entity]:
        """The actions of one answer. Raises WrongEntity."""
        if not callable(answer):
            return list(answer)
        with students_code(self.place):
            made = answer(event, *self.more_for_answers(context))
            return checked(made or (), f"what a function for {type(self).__name__} returns,")

    def more_for_answers(self, context: LaunchContext) -> list[LaunchContext]:
        """What a function gets beside the event."""
        return [context]

    def inner(self) -> list[Entity]:
        """The actions that are known beforehand."""
        return [] if callable(self.answer) else list(self.answer)


def answer_of(answer: Answer, where: str) -> Answer:
    """A function as it is; anything else as a list of actions. Raises WrongEntity."""
    return answer if is_function(answer) else checked(answer, where)


def is_function(answer: Answer) -> bool:
    """Whether it is called when the event is there; a class is an action without its brackets."""
    return callable(answer) and not isinstance(answer, type)


class OnAction(EventHandler):
    """Base of those for one action, or for every one."""

    event: type[Any] = Event
    kind: type[Any] = ProcessAction
    called = "the Node(...) or ExecuteProcess(...)"

    def __init__(self, target_action: Any, answer: Answer, handle_once: bool) -> None:
        self.target = target_action
        is_one = target_action is None or isinstance(target_action, self.kind)
        if not is_one and not callable(target_action):
            raise TypeError(
                f"target_action of {type(self).__name__} must be {self.called} that the handler is"
                f" for, and not {target_action!r}"
            )
        super().__init__(matcher=self._is_meant, entities=answer, handle_once=handle_once)
        self._says_nothing = answer is not None and not is_function(answer) and not self.answer

    def handle(self, event: Event, context: LaunchContext) -> list[Entity]:
        """What is to be done about it. Raises WrongEntity; BadLaunchFile for an empty list."""
        if self._says_nothing:
            raise BadLaunchFile(
                self.place,
                f"{type(self).__name__} has an empty list, and Jazzy ends the launch at it."
                " Take the handler out, or give it an action",
            )
        return super().handle(event, context)

    def _is_meant(self, event: Event) -> bool:
        if not isinstance(event, self.event):
            return False
        if callable(self.target):
            return bool(self.target(event.action))
        return self.target is None or event.action is self.target


class OnProcessStart(OnAction):
    """When a process has started."""

    event = ProcessStarted

    def __init__(
        self, *, target_action: Any = None, on_start: Answer, handle_once: bool = False
    ) -> None:
        super().__init__(target_action, on_start, handle_once)


class OnProcessExit(OnAction):
    """When a process has ended."""

    event = ProcessExited

    def __init__(
        self, *, target_action: Any = None, on_exit: Answer, handle_once: bool = False
    ) -> None:
        super().__init__(target_action, on_exit, handle_once)


class OnExecutionComplete(OnAction):
    """When an action has done what it does: a process is not started again, a timer was due."""

    event = ExecutionComplete
    kind = Action
    called = "the action"

    def __init__(
        self, *, target_action: Any = None, on_completion: Answer, handle_once: bool = False
    ) -> None:
        super().__init__(target_action, on_completion, handle_once)


class OnProcessIO(OnAction):
    """When a process has written something."""

    event = ProcessIO

    def __init__(
        self,
        *,
        target_action: Any = None,
        on_stdin: Callable[[ProcessIO], Any] | None = None,
        on_stdout: Callable[[ProcessIO], Any] | None = None,
        on_stderr: Callable[[ProcessIO], Any] | None = None,
        handle_once: bool = False,
    ) -> None:
        """Each takes a function alone, in Jazzy too. Raises TypeError."""
        super().__init__(target_action, None, handle_once)
        said = {"on_stdin": on_stdin, "on_stdout": on_stdout, "on_stderr": on_stderr}
        for name, function in said.items():
            if function is not None and not is_function(function):
                raise TypeError(
                    f"{name} takes a function of the event: {name}=lambda event: ..., and not"
                    f" {function!r}"
                )
        self.on_stdin, self.on_stdout, self.on_stderr = on_stdin, on_stdout, on_stderr

    def handle(self, event: Event, context: LaunchContext) -> list[Entity]:
        """What is to be done about the text. Raises WrongEntity."""
        super().handle(event, context)
        from_stdout = isinstance(event, ProcessIO) and event.from_stdout
        function = self.on_stdout if from_stdout else self.on_stderr
        return self.answered(function or (), event, context)

    def more_for_answers(self, context: LaunchContext) -> list[LaunchContext]:
        """Nothing: in Jazzy, too, these functions get the event alone."""
        return []


class OnShutdown(EventHandler):
    """When the whole launch ends."""

    def __init__(self, *, on_shutdown: Answer, handle_once: bool = True) -> None:
        super().__init__(
            matcher=lambda event: isinstance(event, Shutdown),
            entities=on_shutdown,
            handle_once=handle_once,
        )
