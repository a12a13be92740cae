"""What a launch knows while it is carried out."""

from __future__ import annotations

import heapq
import itertools
import os
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator, MutableMapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace
from typing import Any, ClassVar, Protocol

from ros2_on_pip.launching.events import Event
from ros2_on_pip.launching.planned import Planned
from ros2_on_pip.launching.screen import LaunchOutput
from ros2_on_pip.launching.wrong_kind import WrongKind

DescriptionIn = Callable[[Path, str], Any]
"""A launch file and its language, to the LaunchDescription that it asks for; without a language
the file's ending says it."""


class Visited(Protocol):
    """What a launch carries out: an entity of a launch description."""

    def visit(self, context: LaunchContext) -> Iterator[Visited]:
        """Carry it out, and name what is to be carried out next."""


class Handler(Protocol):
    """What answers events."""

    def matches(self, event: Event) -> bool:
        """Whether the event is for it."""

    def handle(self, event: Event, context: LaunchContext) -> Sequence[Visited]:
        """What is to be done about it."""


@dataclass(order=True)
class Alarm:
    """Something that is done later."""

    at_s: float
    number: int
    act: Callable[[], None] = field(compare=False)
    cancelled: bool = field(default=False, compare=False)
    ends_with_shutdown: bool = field(default=True, compare=False)


@dataclass(frozen=True)
class Around:
    """What a launch has around it."""

    screen: LaunchOutput
    folder: Path
    """For the parameter files of nodes."""
    description_in: DescriptionIn
    """Reads launch files."""


class LaunchContext:
    """Launch configurations, event handlers, and what is still to be done.

    Whoever tries substitutions out makes one by hand, `LaunchContext()`, as in Jazzy.
    """

    by_hand: ClassVar[Callable[[], Around]]
    """Makes what is around a context that no launch has made; `provided.py` knows how."""

    def __init__(
        self,
        *,
        argv: Iterable[str] | None = None,
        noninteractive: bool = False,
        around: Around | None = None,
    ) -> None:
        """`around` is None for a context that is made by hand."""
        self.argv = [] if argv is None else list(argv)
        self.noninteractive = noninteractive
        around = around or type(self).by_hand()
        self.description_in, self.folder = around.description_in, around.folder
        self._screen = around.screen
        self.launch_configurations: dict[str, Any] = {}
        self.locals = SimpleNamespace()
        self.is_shutdown = False
        self.file: Path | None = None
        self.declared: list[str] = []
        self.events: deque[Event] = deque()
        self.handlers: deque[Handler] = deque()
        self.planned: deque[Planned] = deque()
        self.alarms: list[Alarm] = []
        self._environment_at_start = dict(os.environ)
        self._numbers = itertools.count(1)
        self._names = itertools.count(1)

    @property
    def environment(self) -> MutableMapping[str, str]:
        """The environment of this process, which nodes inherit."""
        return os.environ

    @property
    def log_folder(self) -> Path:
        """Where the log files are."""
        return self._screen.folder

    def say(self, line: str) -> None:
        """One line for the screen and the log file."""
        self._screen.say(line)

    def perform_substitution(self, substitution: Any) -> Any:
        """The text, as a rule. Raises SubstitutionFailure, WrongKind."""
        if not (perform := getattr(substitution, "perform", None)):
            raise WrongKind("what is filled in", substitution)
        return perform(self)

    def visit(self, entity: Visited) -> None:
        """Carry out `entity` and all that it brings along, in order. Raises BadLaunchFile."""
        for inner in entity.visit(self):
            self.visit(inner)

    @contextmanager
    def scope(
        self, forwarding: bool, settings_in: Callable[[LaunchContext], dict[str, str]]
    ) -> Iterator[None]:
        """What is set inside does not leave it; without `forwarding` nothing comes in either.

        `settings_in` is asked while all that comes from outside is still there.
        """
        kept, environment = dict(self.launch_configurations), dict(os.environ)
        try:
            if not forwarding:
                self._put_back(self._environment_at_start)
            settings = settings_in(self)
            if not forwarding:
                self.launch_configurations.clear()
            self.launch_configurations.update(settings)
            yield
        finally:
            self._configure(kept)
            self._put_back(environment)

    @contextmanager
    def configured(self, configurations: dict[str, Any]) -> Iterator[None]:
        """With these launch configurations and no others; what is set inside does not leave it."""
        kept = dict(self.launch_configurations)
        self._configure(configurations)
        try:
            yield
        finally:
            self._configure(kept)

    def _configure(self, configurations: dict[str, Any]) -> None:
        self.launch_configurations.clear()
        self.launch_configurations.update(configurations)

    def _put_back(self, environment: dict[str, str]) -> None:
        os.environ.clear()
        os.environ.update(environment)

    @contextmanager
    def reading(self, file: Path) -> Iterator[None]:
        """`file` is the launch file that is being carried out."""
        outer, self.file = self.file, file
        try:
            yield
        finally:
            self.file = outer

    def new_name(self, base: str) -> str:
        """The name of the next process: `talker-1`."""
        return f"{base}-{next(self._names)}"

    def new_file(self, ending: str) -> Path:
        """A path in our own folder that nothing else has."""
        return self.folder / f"launch_params_{next(self._numbers)}{ending}"

    def register_event_handler(self, handler: Handler) -> None:
        """Ask `handler` about each event from now on, before those that were there earlier."""
        self.handlers.appendleft(handler)

    def unregister_event_handler(self, handler: Handler) -> None:
        """Ask it no more."""
        if handler in self.handlers:
            self.handlers.remove(handler)

    def would_handle_event(self, event: Event) -> bool:
        """Whether a handler that is there now answers it."""
        return any(handler.matches(event) for handler in self.handlers)

    def emit_event_sync(self, event: Event) -> None:
        """Tell every handler, after what is being done now."""
        self.events.append(event)

    def after(self, period_s: float, act: Callable[[], None], *, always: bool = False) -> Alarm:
        """Do `act` later; a shutdown cancels it, except where it is done `always`."""
        at_s = time.monotonic() + period_s
        alarm = Alarm(at_s, next(self._numbers), act, ends_with_shutdown=not always)
        heapq.heappush(self.alarms, alarm)
        return alarm

    def next_alarm(self) -> Alarm | None:
        """The one that comes next."""
        while self.alarms and self._is_off(self.alarms[0]):
            heapq.heappop(self.alarms)
        return self.alarms[0] if self.alarms else None

    def _is_off(self, alarm: Alarm) -> bool:
        return alarm.cancelled or (self.is_shutdown and alarm.ends_with_shutdown)
