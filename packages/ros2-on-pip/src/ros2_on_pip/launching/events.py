"""What can happen during a launch."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from ros2_on_pip.launching.planned import StartsProcess


class Event:
    """Something that happened."""

    name = "launch.Event"


@dataclass
class Shutdown(Event):
    """The whole launch ends."""

    reason: Any = field(default="reason not given", kw_only=True)
    """A text, where whoever ended the launch gave one."""

    due_to_sigint: bool = field(default=False, kw_only=True)
    name = "launch.events.Shutdown"


@dataclass
class ProcessEvent(Event):
    """Something happened to a process."""

    action: StartsProcess
    process_name: str
    pid: int
    cmd: list[str]
    cwd: str | None
    env: dict[str, str] | None


@dataclass
class ProcessStarted(ProcessEvent):
    """It runs."""

    name = "launch.events.process.ProcessStarted"


@dataclass
class ProcessExited(ProcessEvent):
    """It has ended."""

    returncode: int
    name = "launch.events.process.ProcessExited"


@dataclass
class ProcessIO(ProcessEvent):
    """It wrote something."""

    text: bytes
    from_stdout: bool
    name = "launch.events.process.ProcessIO"

    @property
    def from_stderr(self) -> bool:
        """It was written to standard error."""
        return not self.from_stdout


@dataclass
class ExecutionComplete(Event):
    """An action has done what it does; a process has ended, and is not started again."""

    action: Any
    name = "launch.events.ExecutionComplete"
