"""One of the student's processes, seen from the arena: its output, its signals, its end."""

from __future__ import annotations

import json
import marshal
import socket
import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType
from typing import Literal

from roslings.arena import cgroup
from roslings.arena.cgroup import Group
from roslings.arena.isolation import guardian_command
from roslings.arena.refused_calls import asking_filter, filter_of_calls, name_of
from roslings.arena.sandbox import Sandbox
from roslings.arena.users import User
from roslings.evidence import Ending, LogLine, ProcessSeen

Listener = Callable[[], None]
OUTPUT = {
    "head_bytes": 512 * 1024,
    "tail_bytes": 64 * 1024,
    "head_lines": 10_000,
    "tail_lines": 1_000,
}
"""What is kept of its output."""
FLOOD = {"rows_a_second": 1_000, "row_bytes": 80, "seconds": 3}
"""Who writes so much for so long prints without end, and is ended.

A timer of 100 Hz that logs each of its turns writes a tenth of it. A loop that does nothing else
writes 50 times as much with print(), and twice as much with a logger on a busy computer.
"""
LONGEST_LINE = 2000
ANSWERS_WITHIN_S = 5.0
LONGEST_WAIT_S = 20.0
"""For a processor: who waits longer is not waited for."""
LOOK_AGAIN_S, WAITS_AGAIN_S = 0.1, 1.0
PATIENCE = {"SIGINT": 2.0, "SIGTERM": 1.0, "SIGKILL": 10.0}
"""Seconds given after each signal when a block ends and the process still runs."""


class CannotStart(Exception):
    """The machine refused to start a process; no fault of the student's."""

    def __init__(self, reason: str | None) -> None:
        super().__init__(f"No process can be started here: {reason or 'its walls do not stand'}.")


@dataclass(frozen=True)
class Launch:
    """What to start: a command, its whole environment, its folder, and its walls."""

    command: list[str]
    environment: dict[str, str]
    folder: Path
    namespaces: bool
    """Whether the guardian takes namespaces for it; a sandbox has its own."""
    limits: dict[str, int] = field(default_factory=dict)
    sandbox: Sandbox | None = None
    user: User | None = None
    """Who it becomes; None where that is ourselves."""

    def order(self) -> bytes:
        """What the guardian reads first."""
        bounds, watch = self._bounds()
        words = {
            "command": self.command,
            "environment": self.environment,
            "folder": str(self.folder),
            "walls": self.walls,
            "output": OUTPUT,
            "flood": FLOOD,
            "limits": {**bounds, **self.limits},
            "watch": watch,
            "user": self.user.uid if self.user else None,
            "reach": self.user.reach if self.user else None,
            "filters": self._filters(),
            "busy": self._busy(),
        }
        order = marshal.dumps(words)
        return b"%d\n%b" % (len(order), order)

    def _bounds(self) -> tuple[dict[str, int], dict[str, int]]:
        """What it may take, as the kernel's limits and as the guardian watches it."""
        if self.sandbox:
            return self.sandbox.bounds.limits(), self.sandbox.watch
        return (self.user.limits, self.user.watch) if self.user else ({}, {})

    def _filters(self) -> tuple[bytes, ...]:
        """Of its system calls; none where nothing stands around it, or where there is no filter."""
        filters = (asking_filter(), filter_of_calls())
        return filters if (self.sandbox or self.user) and all(filters) else ()

    def _busy(self) -> int:
        """So many threads may want a processor at once; 0 where the kernel shares it out."""
        wall = self.sandbox or self.user
        return 0 if wall is None or cgroup.shares_processors(wall.trees) else wall.bounds.busy

    @property
    def walls(self) -> Literal["none", "namespaces", "sandbox"]:
        """What stands around it."""
        if self.sandbox:
            return "sandbox"
        return "namespaces" if self.namespaces else "none"

    @contextmanager
    def command_of(self, guardian: list[str]) -> Iterator[tuple[list[str], Group]]:
        """The guardian's command within what stands around both, and what counts their use."""
        if wall := self.sandbox or self.user:
            with wall.around(guardian) as found:
                yield found
        else:
            yield guardian, Group(())


@dataclass
class Waiting:
    """How long the threads of a process were ready to run, and no processor was free for them."""

    before_ns: dict[str, int]
    """By thread, when it began."""
    now_ns: dict[str, int] = field(default_factory=dict)
    """By thread, as it was last seen: a thread that has ended is not forgotten."""

    def sum_s(self, without: str = "") -> float:
        """Of all threads together, but of one."""
        now = self.now_ns.items()
        return sum(ns - self.before_ns.get(each, 0) for each, ns in now if each != without) / 1e9


class Process:
    """A running process behind its guardian. Leaving the `with` block ends it, orphans included."""

    def __init__(
        self, name: str, launch: Launch, on_line: Callable[[], None] = lambda: None
    ) -> None:
        self.seen = ProcessSeen(executable=name, started_ns=time.monotonic_ns())
        self._launch = launch
        self._on_line = on_line
        self._changed = threading.Condition()
        self._unfinished = b""
        self._asked_to_end = self._waits_for_children = False
        self._started = False
        self._gone = False
        self._refused: str | None = None
        self._asked = ""
        self._answer: object = None
        self._main_thread = ""
        self._waited_ns: int | None = None
        """Its main thread, for a processor, from start to end; None where nobody knows."""
        self._around = ExitStack()

    def __enter__(self) -> Process:
        ours, theirs = socket.socketpair()
        with theirs:
            guardian = guardian_command(theirs.fileno())
            around = self._launch.command_of(guardian)
            command, self._group = self._around.enter_context(around)
            self._guardian = subprocess.Popen(
                command,
                pass_fds=[theirs.fileno()],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                start_new_session=True,
                env={},
            )
        self._channel = ours
        self._channel.sendall(self._launch.order())
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()
        with self._changed:
            self._changed.wait_for(lambda: self._started or self._gone)
        if not self._started:
            self.__exit__(CannotStart, None, None)
            raise CannotStart(self._refused)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        try:
            if kind is None:
                self._ask_to_end()
        finally:
            self._channel.shutdown(socket.SHUT_RDWR) if not self._gone else None
            self._reader.join()
            self._channel.close()
            self._guardian.wait()
            self.seen.bounds_met = sorted({*self._group.reached(), *self.seen.bounds_met})
            self._around.close()

    @property
    def alive(self) -> bool:
        """Has not ended yet, as far as we were told."""
        return not self._gone and self.seen.ended_ns is None

    def interrupt(self, within_s: float, and_children: bool = False) -> bool:
        """Press Ctrl-C: SIGINT to the process itself. True when it ended within `within_s`.

        Where it has to wait for its children (`and_children`), what these wait for a processor
        counts as what its own threads do.
        """
        self._waits_for_children = and_children
        self._asked_to_end = True
        return self._signal("SIGINT", within_s)

    def wait_until(self, condition: Callable[[], bool], within_s: float) -> bool:
        """Wait until `condition` holds or the process ended; what the condition says then."""
        with self._changed:
            self._changed.wait_for(lambda: condition() or not self.alive, within_s)
            return condition()

    def wait_ended(self, within_s: float) -> bool:
        """Wait for the process to end. True when it did."""
        return self.wait_until(lambda: not self.alive, within_s)

    def wait_ended_in_own_time(self, within_s: float, most_s: float) -> bool:
        """As `wait_ended`; while its threads wait for a processor its time stands still.

        `most_s` is the most that this gives it besides.
        """
        waiting = Waiting(self.waits_ns())
        return self._wait_own_time(within_s, waiting, self.waits_ns, WAITS_AGAIN_S, most_s)

    def lines(self) -> list[LogLine]:
        """The lines so far."""
        with self._changed:
            return list(self.seen.lines)

    def waits_ns(self) -> dict[str, int]:
        """By thread: how long it was ready to run and no processor was free, since it began.

        Empty where the kernel does not tell, and when the process is gone.
        """
        return self._ask("WAITS") or {}  # type: ignore[return-value]  # the guardian's own

    @property
    def last_waits_ns(self) -> dict[str, int]:
        """As `waits_ns`, of the main thread alone, when the process ended; empty before."""
        return {} if self._waited_ns is None else {self._main_thread: self._waited_ns}

    def worked_s(self) -> float:
        """Seconds of a processor that it and all that it started have used; 0 when it is gone."""
        return float(str(self._ask("WORKED") or 0.0))

    def asleep(self) -> bool:
        """Its main thread waits for something, as a node's does between its callbacks."""
        return self._ask("STATE") == "S"

    def commands(self) -> dict[int, list[str]]:
        """Pid to the words of its command, for it and each process that it has started.

        The pids count where the process lives. Empty when it is gone.
        """
        found: dict[str, str] = self._ask("COMMANDS") or {}  # type: ignore[assignment]  # as above
        return {int(pid): words.rstrip("\0").split("\0") for pid, words in found.items()}

    def kill(self, pid: int) -> None:
        """End a process that it has started, as a crash would: SIGKILL."""
        self._send(f"KILL:{pid}")

    def _ask(self, what: str) -> object:
        """The guardian's answer; None when the process is gone."""
        with self._changed:
            self._asked, self._answer = what, None
            self._send(what)
            self._changed.wait_for(lambda: self._answer is not None or self._gone, ANSWERS_WITHIN_S)
            return self._answer

    def _ask_to_end(self) -> None:
        self._asked_to_end = True
        for name, patience_s in PATIENCE.items():
            if self._signal(name, patience_s):
                return

    def _signal(self, name: str, patience_s: float) -> bool:
        """Send a signal, wait, and write down the first one's effect."""
        if not self.alive:
            return True
        waiting = Waiting(self._own_waits_ns() or {})
        sent_ns = time.monotonic_ns()
        self.seen.asked_to_end_ns = self.seen.asked_to_end_ns or sent_ns
        self._send(name)
        ended = self._wait_own_time(
            patience_s, waiting, self._own_waits_ns, LOOK_AGAIN_S, LONGEST_WAIT_S
        )
        if self.seen.ending is None:
            self.seen.ending = self._ending(name, sent_ns, waiting)
        return ended

    def _ending(self, name: str, sent_ns: int, waiting: Waiting) -> Ending:
        watched_s = (time.monotonic_ns() - sent_ns) / 1e9
        if self.seen.ended_ns is None:
            others_s = waiting.sum_s()
            return Ending(signal=name, after_s=None, watched_s=watched_s, others_waited_s=others_s)
        return Ending(
            signal=name,
            after_s=(self.seen.ended_ns - sent_ns) / 1e9,
            watched_s=watched_s,
            waited_s=self._waited_since(waiting.before_ns),
            others_waited_s=waiting.sum_s(without=self._main_thread),
        )

    def _own_waits_ns(self) -> dict[str, int] | None:
        """As `waits_ns`, of those whose end is waited for; None when it is gone."""
        question = "WAITS" if self._waits_for_children else "OWN_WAITS"
        return self._ask(question)  # type: ignore[return-value]  # the guardian's own

    def _waited_since(self, before: dict[str, int]) -> float:
        """How long its main thread waited for a processor, to its end; 0 where nobody knows."""
        if self._waited_ns is None or self._main_thread not in before:
            return 0.0
        return (self._waited_ns - before[self._main_thread]) / 1e9

    def _wait_own_time(
        self,
        within_s: float,
        waiting: Waiting,
        waits_ns: Callable[[], dict[str, int] | None],
        again_s: float,
        most_s: float,
    ) -> bool:
        """Wait for its end; while it waits for a processor, its time stands still, up to a bound.

        Its threads end one after the other, so the waiting of all counts.
        """
        began_s = time.monotonic()
        while True:
            given_s = within_s + min(waiting.sum_s(), most_s)
            left_s = began_s + given_s - time.monotonic()
            if self.wait_ended(min(max(left_s, 0), again_s)):
                return True
            if left_s <= 0:
                return False
            now_ns = waits_ns()
            if now_ns is None:  # it has just ended; we are told soon
                return self.wait_ended(ANSWERS_WITHIN_S)
            waiting.now_ns.update(now_ns)

    def _send(self, name: str) -> None:
        with suppress(OSError):  # it is gone: its last words may still wait to be read
            self._channel.sendall(name.encode() + b"\n")

    def _read(self) -> None:
        """In a thread: take the guardian's events until it ends."""
        # A guardian that never stood up leaves its order unread: the connection is reset.
        with suppress(ConnectionResetError), self._channel.makefile("rb") as events:
            for line in events:
                with self._changed:
                    self._take(json.loads(line))
                    self._changed.notify_all()
                self._on_line()
        self._finish()
        self._on_line()

    def _finish(self) -> None:
        with self._changed:
            self._gone = True
            if self._unfinished:
                self._add_line(self._unfinished, time.monotonic_ns())
                self._unfinished = b""
            self._changed.notify_all()

    def _take(self, event: dict[str, object]) -> None:
        if "started" in event:
            self._started = True
            self._main_thread = str(event["started"])
        elif "said" in event:
            self._hear(str(event["said"]).encode("latin-1"), int(str(event["at"])))
        elif "exited" in event:
            self._note_end(event)
        elif event.get("to") == self._asked:  # a late answer to an earlier question is not it
            self._answer = event["answer"]
        elif "refused" in event:
            self._refused = str(event["refused"])

    def _hear(self, chunk: bytes, at_ns: int) -> None:
        *whole, self._unfinished = (self._unfinished + chunk).split(b"\n")
        for line in whole:
            self._add_line(line, at_ns)
        if len(self._unfinished) > LONGEST_LINE:
            self._add_line(self._unfinished, at_ns)
            self._unfinished = b""

    def _add_line(self, line: bytes, at_ns: int) -> None:
        text = line.rstrip(b"\r")[:LONGEST_LINE].decode("utf-8", errors="replace")
        self.seen.lines.append(LogLine(arrival_ns=at_ns, text=text, source="terminal"))

    def _note_end(self, event: dict[str, object]) -> None:
        seen = self.seen
        if event["exited"] is not None:
            seen.status = int(str(event["exited"]))
            seen.ended_ns = int(str(event["at"]))
            seen.cpu_s = float(str(event["cpu_s"]))
            self._waited_ns = event["waited_ns"]  # type: ignore[assignment]  # the guardian's own
            seen.peak_memory_bytes = int(str(event["peak_memory_bytes"]))
            seen.ended_by_itself = not self._asked_to_end
        seen.left_behind = int(str(event["left_behind"]))
        seen.output_bytes = int(str(event["output_bytes"]))
        seen.output_lines = int(str(event["output_lines"]))
        seen.output_dropped_bytes = int(str(event["dropped_bytes"]))
        seen.ending_cut = bool(event["ending_cut"])
        seen.filled_its_disk = bool(event["filled_its_disk"])
        seen.most_busy = int(str(event["most_busy"]))
        refused: dict[str, int] = event["refused_calls"]  # type: ignore[assignment]  # as below
        seen.refused_calls = {name_of(int(number)): count for number, count in refused.items()}
        seen.bounds_met = event["bounds_met"]  # type: ignore[assignment]  # the guardian's own
