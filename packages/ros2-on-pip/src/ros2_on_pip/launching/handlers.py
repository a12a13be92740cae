"""What is done when something happens."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ros2_on_pip.launching.description import Entity, ProcessAction, checked
from ros2_on_pip.launching.events import (
    Event,
    ExecutionComplete,
    ProcessExited,
    ProcessIO,
    ProcessStarted,
    Shutdown,
)
from ros2_on_pip.launching.places import calling_place
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
        self.matcher, self.handle_once = matcher, handle_once
        self.place = calling_place()
        self.answer = answer_of(entities or (), type(self).__name__)

    def matches(self, event: Event) -> bool:
        """Whether the event is for this handler."""
        return self.matcher(event)

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
    return answer if callable(answer) and not isinstance(answer, type) else checked(answer, where)


class OnAction(EventHandler):
    """Base of those for one process, or for every one."""

    event: type[Any] = Event

    def __init__(self, target_action: Any, answer: Answer, handle_once: bool) -> None:
        self.target = target_action
        if not (target_action is None or callable(target_action) or _is_process(target_action)):
            raise TypeError(
                f"target_action of {type(self).__name__} must be the Node(...) or"
                f" ExecuteProcess(...) that the handler is for, and not {target_action!r}"
            )
        super().__init__(matcher=self._is_meant, entities=answer, handle_once=handle_once)

    def _is_meant(self, event: Event) -> bool:
        if not isinstance(event, self.event):
            return False
        if callable(self.target):
            return bool(self.target(event.action))
        return self.target is None or event.action is self.target


def _is_process(value: Any) -> bool:
    return isinstance(value, ProcessAction)


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
    """When a process has ended and is not started again."""

    event = ExecutionComplete

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
        on_stdin: Answer = None,
        on_stdout: Answer = None,
        on_stderr: Answer = None,
        handle_once: bool = False,
    ) -> None:
        super().__init__(target_action, (), handle_once)
        self.on_stdout = answer_of(on_stdout or (), "on_stdout")
        self.on_stderr = answer_of(on_stderr or (), "on_stderr")
        self.on_stdin = answer_of(on_stdin or (), "on_stdin")

    def handle(self, event: Event, context: LaunchContext) -> list[Entity]:
        """What is to be done about the text. Raises WrongEntity."""
        super().handle(event, context)
        from_stdout = isinstance(event, ProcessIO) and event.from_stdout
        return self.answered(self.on_stdout if from_stdout else self.on_stderr, event, context)

    def more_for_answers(self, context: LaunchContext) -> list[LaunchContext]:
        """Nothing: in Jazzy, too, these functions get the event alone."""
        return []

    def inner(self) -> list[Entity]:
        """The actions that are known beforehand."""
        answers = (self.on_stdout, self.on_stderr)
        return [one for answer in answers if not callable(answer) for one in answer]


class OnShutdown(EventHandler):
    """When the whole launch ends."""

    def __init__(self, *, on_shutdown: Answer, handle_once: bool = True) -> None:
        super().__init__(
            matcher=lambda event: isinstance(event, Shutdown),
            entities=on_shutdown,
            handle_once=handle_once,
        )
