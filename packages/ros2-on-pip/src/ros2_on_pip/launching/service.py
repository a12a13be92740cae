"""Carries a launch description out: starts its processes, tells events, ends all together."""

from __future__ import annotations

import heapq
import selectors
import shlex
import signal
import socket
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from ros2_on_pip.launching.child import SIGNALS, Child, end_all
from ros2_on_pip.launching.context import LaunchContext
from ros2_on_pip.launching.description import Entity
from ros2_on_pip.launching.events import (
    Event,
    ExecutionComplete,
    ProcessExited,
    ProcessIO,
    ProcessStarted,
    Shutdown,
)
from ros2_on_pip.launching.handlers import OnProcessIO
from ros2_on_pip.launching.places import BadLaunchFile
from ros2_on_pip.launching.planned import Planned
from ros2_on_pip.launching.python_file import in_students_code
from ros2_on_pip.launching.screen import LaunchOutput
from ros2_on_pip.problem import CommandProblem
from ros2_on_pip.words import FAILED, OK

GIVES_UP_AFTER_S = 5.0
"""A process that SIGKILL does not end in this time hangs in the kernel."""

LOOKS_EVERY_S = 0.02
INTERRUPTS = (signal.SIGINT, signal.SIGTERM)


class LaunchService:
    """One launch, from its first action to the end of its last process."""

    def __init__(self, context: LaunchContext, screen: LaunchOutput) -> None:
        self._context, self._screen = context, screen
        self._alive: dict[int, Child] = {}
        self._ended: list[Child] = []
        self._tries: dict[int, int] = {}
        self._interrupts = 0
        self._heeded = 0
        self._selector = selectors.DefaultSelector()
        self._broken = False
        self._crashed = False

    def run(self, entity: Entity, when_read: Callable[[], None]) -> int:
        """Carry it out until every process has ended; the exit code.

        `when_read` is called before the first process starts. Raises BadLaunchFile.
        """
        self._context.visit(entity)
        when_read()
        with self._selector, self._signals(), self._all_ended():
            while self._goes_on():
                self._wait()
                self._heed_ctrl_c()
        if self._screen.nobody_reads:
            raise BrokenPipeError
        crashed = self._crashed and not self._heeded
        return FAILED if self._broken or crashed else OK

    def _goes_on(self) -> bool:
        """Do all that is due; whether there is more to wait for."""
        self._carry_out_all()
        if self._screen.nobody_reads:
            return False
        if self._alive or self._context.next_alarm():
            return True
        if not self._context.is_shutdown:
            self._begin_shutdown(Shutdown(reason="idle"))
            self._carry_out_all()
        return bool(self._alive or self._context.next_alarm())

    def _carry_out_all(self) -> None:
        """Events and starts, until nothing is left that can be done at once."""
        context = self._context
        while context.planned or context.events:
            if context.planned:
                self._start(context.planned.popleft())
            else:
                self._tell(context.events.popleft())

    # events

    def _tell(self, event: Event) -> None:
        if isinstance(event, Shutdown):
            self._begin_shutdown(event)
        else:
            self._ask_handlers(event)

    def _ask_handlers(self, event: Event) -> None:
        for handler in list(self._context.handlers):
            self._guarded(lambda handler=handler: self._answer(handler, event))

    def _answer(self, handler: Any, event: Event) -> None:
        if not handler.matches(event):
            return
        self._context.locals.event = event
        try:
            for entity in handler.handle(event, self._context):
                self._context.visit(entity)
        finally:
            del self._context.locals.event

    def _guarded(self, act: Any) -> None:
        """A fault in what is done later is told, and ends the launch."""
        try:
            act()
        except CommandProblem as problem:
            self._fail(problem)
        except KeyboardInterrupt:
            return  # it ended what the student's code did; `_interrupt` has counted it

    def _fail(self, problem: CommandProblem) -> None:
        prefix = "" if isinstance(problem, BadLaunchFile) else "[ERROR] [launch]: "
        self._screen.say(f"{prefix}{problem}")
        self._broken = True
        self._context.emit_event_sync(Shutdown(reason="a fault in the launch file"))

    # processes

    def _start(self, planned: Planned) -> None:
        if self._context.is_shutdown:
            return
        try:
            child = Child(planned)
        except OSError as fault:
            self._fail(CommandProblem(f"{planned.command[0]} could not be started: {fault}"))
            return
        planned.action.pid = child.pid
        if planned.action.log_cmd:
            words = shlex.join(planned.command)
            self._screen.say(f"[INFO] [{child.name}]: process details: cmd=[{words}]")
        self._screen.say(f"[INFO] [{child.name}]: process started with pid [{child.pid}]")
        self._alive[child.pid] = child
        for stream, number in child.streams.items():
            self._selector.register(number, selectors.EVENT_READ, (child, stream))
        self._context.emit_event_sync(child.told(ProcessStarted))

    def _read(self, child: Child, stream: str) -> None:
        lines, more = child.lines(stream)
        self._pass_on(child, stream, lines)
        if not more:
            self._selector.unregister(child.streams[stream])

    def _stop_reading(self, child: Child) -> None:
        for number in child.streams.values():
            if number in self._selector.get_map():
                self._selector.unregister(number)

    def _pass_on(self, child: Child, stream: str, lines: list[bytes]) -> None:
        for line in lines:
            text = line.decode(errors="replace").rstrip()
            self._screen.pass_on(child.name, text, sorted(child.planned.output[stream]))
            if any(isinstance(handler, OnProcessIO) for handler in self._context.handlers):
                told = child.told(ProcessIO, text=line + b"\n", from_stdout=stream == "stdout")
                self._context.emit_event_sync(told)

    def _look_for_ends(self) -> None:
        for child in [child for child in self._alive.values() if child.has_ended()]:
            self._note_end(child)

    def _note_end(self, child: Child) -> None:
        del self._alive[child.pid]
        for stream in child.streams:
            self._pass_on(child, stream, list(child.last_lines(stream)))
        for alarm in child.alarms:
            alarm.cancelled = True
        code = child.returncode
        self._say_end(child, code)
        self._context.emit_event_sync(child.told(ProcessExited, returncode=code))
        self._start_again_or_not(child)

    def _say_end(self, child: Child, code: int) -> None:
        if code == 0:
            said = f"process has finished cleanly [pid {child.pid}]"
            self._screen.say(f"[INFO] [{child.name}]: {said}")
            return
        self._crashed = self._crashed or not self._context.is_shutdown
        words = " ".join(child.planned.command)
        self._screen.say(
            f"[ERROR] [{child.name}]: process has died"
            f" [pid {child.pid}, exit code {code}, cmd '{words}']."
        )

    def _start_again_or_not(self, child: Child) -> None:
        planned, respawn = child.planned, child.planned.respawn
        tries = self._tries.get(id(planned), 0)
        again = respawn.wanted and (respawn.most < 0 or tries < respawn.most)
        if not again or self._context.is_shutdown:
            self._ended.append(child)
            if planned.action.end_is_heard:
                self._context.emit_event_sync(ExecutionComplete(action=planned.action))
            return
        self._stop_reading(child)
        child.bury()
        self._tries[id(planned)] = tries + 1
        self._context.after(respawn.delay_s, lambda: self._context.planned.append(planned))

    # the end

    def _begin_shutdown(self, event: Shutdown) -> None:
        if self._context.is_shutdown:
            return
        self._context.is_shutdown = True
        self._ask_handlers(event)
        for child in reversed(self._alive.values()):
            self._end(child, silently=event.due_to_sigint)

    def _end(self, child: Child, silently: bool) -> None:
        if not silently:
            self._say_signal(child, "SIGINT")
        child.signal("SIGINT")
        term_s, kill_s = child.planned.sigterm_after_s, child.planned.sigkill_after_s
        both_s = term_s + kill_s
        steps = (
            (term_s, lambda: self._escalate(child, "SIGINT", f"{term_s:g}", "SIGTERM")),
            (both_s, lambda: self._escalate(child, "SIGTERM", f"{both_s:.1f}", "SIGKILL")),
            (both_s + GIVES_UP_AFTER_S, lambda: self._give_up(child)),
        )
        child.alarms = [self._context.after(at_s, act, always=True) for at_s, act in steps]

    def _escalate(self, child: Child, before: str, seconds: str, name: str) -> None:
        self._screen.say(
            f"[ERROR] [{child.name}]: process[{child.name}] failed to terminate '{seconds}' seconds"
            f" after receiving '{before}', escalating to '{name}'"
        )
        self._say_signal(child, name)
        child.signal(name)

    def _say_signal(self, child: Child, name: str) -> None:
        self._screen.say(f"[INFO] [{child.name}]: sending signal '{name}' to process[{child.name}]")

    def _give_up(self, child: Child) -> None:
        if self._alive.pop(child.pid, None):
            self._screen.say(
                f"[ERROR] [{child.name}]: process {child.pid} does not end, not even by SIGKILL:"
                " the kernel holds it"
            )

    @contextmanager
    def _all_ended(self) -> Iterator[None]:
        """Whatever happens inside: no process that was started outlives the launch."""
        try:
            yield
        finally:
            end_all(list(self._alive.values()))
            self._end_what_is_left()

    def _end_what_is_left(self) -> None:
        """Of processes that have ended, what they have started may still write its last lines."""
        for child in self._ended:
            child.process.wait()
        for name in SIGNALS:
            self._await_what_is_left(name)
        for child in self._ended:
            child.close()

    def _await_what_is_left(self, name: str) -> None:
        left = [child for child in self._ended if child.has_left_something()]
        end_s = time.monotonic() + max([child.planned.sigterm_after_s for child in left], default=0)
        for child in left:
            child.signal(name)
        while time.monotonic() < end_s and any(child.has_left_something() for child in left):
            for key, _ in self._selector.select(LOOKS_EVERY_S):
                if key.data is not None:
                    self._read(*key.data)

    # waiting

    def _wait(self, at_most_s: float | None = None) -> None:
        """Until something happens: a line, an end, a signal, an alarm; and note it."""
        alarm = self._context.next_alarm()
        patience_s = max(0.0, alarm.at_s - time.monotonic()) if alarm else None
        if at_most_s is not None:
            patience_s = at_most_s if patience_s is None else min(at_most_s, patience_s)
        for key, _ in self._selector.select(patience_s):
            if key.data is None:
                self._empty(key.fileobj)
            else:
                self._read(*key.data)
        self._look_for_ends()
        self._ring()

    def _empty(self, bell: Any) -> None:
        bell.recv(4096)

    def _ring(self) -> None:
        while (alarm := self._context.next_alarm()) and alarm.at_s <= time.monotonic():
            heapq.heappop(self._context.alarms)
            self._guarded(alarm.act)

    def _heed_ctrl_c(self) -> None:
        while self._heeded < self._interrupts:
            self._heeded += 1
            if self._heeded > 1:
                again = "user interrupted with ctrl-c (SIGINT) again, ignoring..."
                self._screen.say(f"[WARNING] [launch]: {again}")
                continue
            self._screen.say("[WARNING] [launch]: user interrupted with ctrl-c (SIGINT)")
            self._begin_shutdown(Shutdown(reason="ctrl-c (SIGINT)", due_to_sigint=True))

    @contextmanager
    def _signals(self) -> Iterator[None]:
        """Signals only wake us up; what is being done is finished first.

        Except where the student's code is what is being done: it may never end.
        """
        listening, speaking = socket.socketpair()
        with listening, speaking:
            speaking.setblocking(False)
            self._selector.register(listening, selectors.EVENT_READ, None)
            before = {number: signal.signal(number, self._interrupt) for number in INTERRUPTS}
            before[signal.SIGCHLD] = signal.signal(signal.SIGCHLD, lambda *_: None)
            bell = signal.set_wakeup_fd(speaking.fileno(), warn_on_full_buffer=False)
            try:
                yield
            finally:
                signal.set_wakeup_fd(bell)
                for number, handler in before.items():
                    signal.signal(number, handler)

    def _interrupt(self, *_: object) -> None:
        self._interrupts += 1
        if in_students_code():
            raise KeyboardInterrupt
