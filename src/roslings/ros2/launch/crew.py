"""Run the nodes of a launch file: start them, pass on what they say, end them together."""

from __future__ import annotations

import ctypes
import os
import queue
import shlex
import signal
import subprocess
import threading
import time
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType

from roslings.ros2.launch.plan import Say, Start, Step
from roslings.ros2.packages import executable, name_of
from roslings.ros2.parameter_file import INSIDE
from roslings.ros2.parameters import nested
from roslings.ros2.problem import Problem
from roslings.ros2.programs import command_of, environment_of
from roslings.ros2.words import FAILED, OK

STEPS = (("SIGINT", "5", 5.0), ("SIGTERM", "10.0", 5.0), ("SIGKILL", "", 5.0))
"""What is sent in turn to a process that does not end, what the real tool says, the patience."""

_PR_SET_PDEATHSIG = 1
_libc = ctypes.CDLL(None)


@dataclass
class Member:
    """One process of the crew."""

    name: str
    command: list[str]
    process: subprocess.Popen[bytes]
    ended: bool = False
    threads: list[threading.Thread] = field(default_factory=list)


class Crew:
    """The processes of one launch. Leaving the `with` block ends all of them."""

    def __init__(self, folder: Path) -> None:
        """`folder` is for the parameter files of the nodes."""
        self._folder = folder
        self._members: list[Member] = []
        self._news: queue.Queue[Member | None] = queue.Queue()
        self._speaking = threading.Lock()
        self._deaf = False
        self.crashed = False

    def __enter__(self) -> Crew:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for name, _, patience_s in STEPS:
            self._signal(name)
            self._await_all(patience_s)

    def carry_out(self, steps: list[Step]) -> None:
        """Start each node and say each line, in order. Raises Problem."""
        for step in steps:
            if isinstance(step, Say):
                self.say(f"[INFO] [launch.user]: {step.text}")
            else:
                self._start(step)

    def run(self) -> int:
        """Wait until every process has ended; on Ctrl-C end them. The exit code."""
        try:
            while self._alive() and not self._deaf:
                self._take_news(None)
        except KeyboardInterrupt:
            self.say("[WARNING] [launch]: user interrupted with ctrl-c (SIGINT)")
            self._end_all()
            return OK
        if self._deaf:
            raise BrokenPipeError
        return FAILED if self.crashed else OK

    def say(self, line: str) -> None:
        """One line for the screen; nobody else writes at the same time."""
        with self._speaking:
            try:
                print(line, flush=True)
            except BrokenPipeError:
                self._deaf = True
                self._news.put(None)

    def _start(self, step: Start) -> None:
        program = executable(step.package, step.executable)
        name = f"{name_of(program)}-{len(self._members) + 1}"
        command = [*step.prefix, *command_of(program), *step.arguments, *self._ros(name, step)]
        environment = {**environment_of(program), "PYTHONUNBUFFERED": "1", **step.environment}
        try:
            process = subprocess.Popen(
                command, env=environment, cwd=step.folder, start_new_session=True,
                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                preexec_fn=_become_child,
            )  # fmt: skip
        except OSError as fault:
            raise Problem(f"[ERROR] [launch]: {command[0]} could not be started: {fault}") from None
        self.say(f"[INFO] [{name}]: process started with pid [{process.pid}]")
        self._watch(Member(name, command, process))

    def _ros(self, name: str, step: Start) -> list[str]:
        """The words that ROS itself reads."""
        rules = [f"__node:={step.name}"] if step.name else []
        rules += [f"__ns:={step.namespace}"] if step.namespace else []
        rules += [f"{old}:={new}" for old, new in step.remaps]
        files = [*step.parameter_files, *self._parameter_file(name, step)]
        found = [word for rule in rules for word in ("-r", rule)]
        found += [word for file in files for word in ("--params-file", str(file))]
        found += step.ros_arguments
        return ["--ros-args", *found] if found else []

    def _parameter_file(self, name: str, step: Start) -> list[Path]:
        if not step.parameters:
            return []
        import yaml

        place = self._folder / f"{name}.yaml"
        tree = {"/**": {INSIDE: nested(step.parameters)}}
        place.write_text(yaml.safe_dump(tree), encoding="utf-8")
        return [place]

    def _watch(self, member: Member) -> None:
        self._members.append(member)
        for task in (self._pass_on, self._await):
            thread = threading.Thread(target=task, args=(member,), daemon=True)
            thread.start()
            member.threads.append(thread)

    def _pass_on(self, member: Member) -> None:
        """In a thread: each line that the process writes, with its name before it."""
        assert member.process.stdout
        for line in member.process.stdout:
            self.say(f"[{member.name}] {line.decode(errors='replace').rstrip()}")

    def _await(self, member: Member) -> None:
        """In a thread: the end of the process."""
        member.process.wait()
        member.threads[0].join(1.0)  # its last lines come first; a grandchild may keep the pipe
        self._news.put(member)

    def _take_news(self, within_s: float | None) -> None:
        try:
            member = self._news.get(timeout=within_s)
        except queue.Empty:
            return
        if member:
            self._note_end(member)

    def _note_end(self, member: Member) -> None:
        member.ended = True
        pid, code = member.process.pid, member.process.returncode
        if code == 0:
            self.say(f"[INFO] [{member.name}]: process has finished cleanly [pid {pid}]")
            return
        self.crashed = True
        words = shlex.join(member.command)
        self.say(
            f"[ERROR] [{member.name}]: process has died"
            f" [pid {pid}, exit code {code}, cmd '{words}']."
        )

    def _alive(self) -> list[Member]:
        return [member for member in self._members if not member.ended]

    def _end_all(self) -> None:
        """SIGINT once to each, and stronger signals to those that stay."""
        for index, (name, seconds, patience_s) in enumerate(STEPS):
            self._signal(name)
            self._await_all(patience_s)
            for member in self._alive() if index + 1 < len(STEPS) else ():
                self.say(
                    f"[ERROR] [{member.name}]: process[{member.name}] failed to terminate"
                    f" '{seconds}' seconds after receiving '{name}',"
                    f" escalating to '{STEPS[index + 1][0]}'"
                )

    def _signal(self, name: str) -> None:
        for member in self._alive():
            try:
                os.killpg(member.process.pid, signal.Signals[name])
            except ProcessLookupError:
                continue

    def _await_all(self, within_s: float) -> None:
        end_s = time.monotonic() + within_s
        while self._alive() and time.monotonic() < end_s:
            try:
                self._take_news(0.1)
            except KeyboardInterrupt:
                self.say(
                    "[WARNING] [launch]: user interrupted with ctrl-c (SIGINT) again, ignoring..."
                )


def _become_child() -> None:
    """Hear Ctrl-C even where we were started deaf, and end when the launch is killed."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    _libc.prctl(_PR_SET_PDEATHSIG, int(signal.SIGTERM), 0, 0, 0)
