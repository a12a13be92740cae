"""A process of a launch that is to be started."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

Targets = Mapping[str, set[str]]
"""Stream of a process to the places where what it writes goes."""


class StartsProcess(Protocol):
    """The action that asked for the process: it is told the number of what runs for it."""

    pid: int | None
    log_cmd: bool
    end_is_heard: bool


@dataclass(frozen=True)
class Respawn:
    """Whether and how a process that has ended is started again."""

    wanted: bool
    delay_s: float
    most: int
    """How often; below zero: for ever."""


@dataclass(frozen=True)
class Planned:
    """A process that is to be started, with everything filled in."""

    action: StartsProcess
    name: str
    command: list[str]
    environment: dict[str, str]
    folder: str | None
    shell: bool
    output: Targets
    respawn: Respawn
    sigterm_after_s: float
    sigkill_after_s: float
