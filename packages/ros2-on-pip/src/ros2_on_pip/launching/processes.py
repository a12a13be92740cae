"""Actions that start processes."""

from __future__ import annotations

import os
import re
import shlex
import shutil
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ros2_on_pip.launching.description import Entity, ProcessAction, checked
from ros2_on_pip.launching.handlers import Answer, OnProcessExit, answer_of
from ros2_on_pip.launching.planned import Planned, Respawn, Targets
from ros2_on_pip.launching.substitution import (
    Parts,
    SomeSubstitutionsType,
    SubstitutionFailure,
    described,
    parts_of,
    parts_or_none,
    performed,
    performed_or_none,
)
from ros2_on_pip.launching.substitutions import truth
from ros2_on_pip.problem import Problem
from ros2_on_pip.programs import environment_of

if TYPE_CHECKING:
    from ros2_on_pip.launching.context import LaunchContext

TARGETS = {
    "screen": {"stdout": {"screen"}, "stderr": {"screen"}},
    "log": {"stdout": {"log"}, "stderr": {"log", "screen"}},
    "both": {"stdout": {"screen", "log"}, "stderr": {"screen", "log"}},
    "own_log": {"stdout": {"own_log"}, "stderr": {"own_log"}},
    "full": {"stdout": {"screen", "log", "own_log"}, "stderr": {"screen", "log", "own_log"}},
}
"""Value of `output` to where each stream goes, as Jazzy's launch.logging has it."""

OVERRIDE_OUTPUT = "OVERRIDE_LAUNCH_PROCESS_OUTPUT"
ESCALATION_S = 5.0
"""So long a process has after SIGINT, and again after SIGTERM, where nothing else is said."""


class ExecutedTwice(Problem):
    """One object stands in two places of a launch file, or comes back with an event."""

    def __init__(self, kind: str) -> None:
        super().__init__(
            f"this {kind} is carried out a second time. Write {kind}(...) once more for a second"
            " process; for one that comes back, respawn=True"
        )


class ExecuteProcess(ProcessAction):
    """Start any program."""

    def __init__(
        self,
        *,
        cmd: Iterable[SomeSubstitutionsType],
        name: SomeSubstitutionsType | None = None,
        prefix: SomeSubstitutionsType | None = None,
        cwd: SomeSubstitutionsType | None = None,
        env: Mapping[Any, Any] | None = None,
        additional_env: Mapping[Any, Any] | None = None,
        shell: bool = False,
        output: Any = "log",
        emulate_tty: bool = False,
        log_cmd: bool = False,
        cached_output: bool = False,
        output_format: str | None = None,
        on_exit: Answer = None,
        respawn: bool | SomeSubstitutionsType = False,
        respawn_delay: float | None = None,
        respawn_max_retries: int = -1,
        sigterm_timeout: Any = None,
        sigkill_timeout: Any = None,
        **others: Any,
    ) -> None:
        super().__init__(**others)
        if isinstance(cmd, str) and not shell:
            raise TypeError(f"cmd must be a list of words: cmd={shlex.split(cmd)!r}")
        words = [cmd] if isinstance(cmd, str) else cmd
        self.cmd = [parts_of(word, "each word of cmd") for word in words]
        self.name, self.cwd = parts_or_none(name, "name"), parts_or_none(cwd, "cwd")
        self.prefix = parts_or_none(prefix, "prefix")
        self.env = None if env is None else _pairs(env, "env")
        self.additional_env = _pairs(additional_env or {}, "additional_env")
        self.shell, self.emulate_tty, self.log_cmd = shell, emulate_tty, log_cmd
        self.output = output
        self.on_exit = answer_of(on_exit or (), "on_exit")
        self.respawn = parts_of(str(respawn) if isinstance(respawn, bool) else respawn, "respawn")
        self.respawn_delay, self.respawn_max_retries = respawn_delay, respawn_max_retries
        self.timeouts = {"sigterm_timeout": sigterm_timeout, "sigkill_timeout": sigkill_timeout}
        self.pid: int | None = None
        self._executed = False

    def execute(self, context: LaunchContext) -> None:
        """Fill everything in, and let it start when this round is over."""
        if self._executed:
            raise ExecutedTwice(type(self).__name__)
        self._executed = True
        if context.is_shutdown:
            return
        if self.on_exit:
            handler = OnProcessExit(target_action=self, on_exit=self.on_exit)
            context.register_event_handler(handler)
        context.planned.append(self.plan(context))

    def command(self, context: LaunchContext) -> list[str]:
        """The words of the command. Raises SubstitutionFailure."""
        return [performed(context, word) for word in self.cmd]

    def plan(self, context: LaunchContext) -> Planned:
        """All that is needed to start it. Raises SubstitutionFailure."""
        command = self.command(context)
        label = performed_or_none(context, self.name_on_screen()) or Path(self._first(command)).name
        environment = self._environment(context, self._found(command, context))
        return Planned(
            action=self,
            name=context.new_name(label),
            command=[*self._prefix(context, label), *command],
            environment=environment,
            folder=performed_or_none(context, self.cwd),
            shell=self.shell,
            output=self._targets(context),
            respawn=self._respawning(context),
            sigterm_after_s=self._seconds(context, "sigterm_timeout"),
            sigkill_after_s=self._seconds(context, "sigkill_timeout"),
        )

    def name_on_screen(self) -> Parts | None:
        """What the process is called on the screen, where it is not called as its program is."""
        return self.name

    def _first(self, command: list[str]) -> str:
        words = shlex.split(command[0]) if self.shell and command else command
        if not words:
            raise SubstitutionFailure("cmd is empty: it needs a program")
        return words[0]

    def _found(self, command: list[str], context: LaunchContext) -> Path:
        """The program. Raises SubstitutionFailure where there is none, before anything starts."""
        first = self._first(command)
        found = shutil.which(first, path=context.environment.get("PATH"))
        if found or self.shell:
            return Path(found or first)
        hint = ""
        if " " in first:
            hint = f" Each word stands alone: cmd={shlex.split(first)!r}"
        raise SubstitutionFailure(f"there is no program '{first}' that can be started.{hint}")

    def _environment(self, context: LaunchContext, program: Path) -> dict[str, str]:
        base = environment_of(program)
        if self.env is not None:
            base = {k: v for k, v in base.items() if k == "LD_LIBRARY_PATH"}
            base |= _performed_pairs(context, self.env)
        return {"PYTHONUNBUFFERED": "1", **base, **_performed_pairs(context, self.additional_env)}

    def _prefix(self, context: LaunchContext, label: str) -> list[str]:
        if self.prefix is not None:
            return shlex.split(performed(context, self.prefix))
        known = context.launch_configurations
        wanted = re.match(str(known.get("launch-prefix-filter", "")), label)
        return shlex.split(str(known.get("launch-prefix", ""))) if wanted else []

    def _targets(self, context: LaunchContext) -> Targets:
        chosen = os.environ.get(OVERRIDE_OUTPUT) or self.output
        if isinstance(chosen, Mapping):
            both = _as_set(chosen.get("both", ()))
            return {s: _as_set(chosen.get(s, ())) | both for s in ("stdout", "stderr")}
        word = performed(context, parts_of(chosen, "output"))
        if word not in TARGETS:
            raise SubstitutionFailure(
                f"output is 'screen', 'log' or 'both', and not '{word}'. With 'log', which is the"
                " default, print() of a node is not shown"
            )
        return TARGETS[word]

    def _respawning(self, context: LaunchContext) -> Respawn:
        wanted = truth(performed(context, self.respawn), "respawn")
        return Respawn(wanted, float(self.respawn_delay or 0.0), int(self.respawn_max_retries))

    def _seconds(self, context: LaunchContext, name: str) -> float:
        value = self.timeouts[name]
        if value is None:
            value = context.launch_configurations.get(name, ESCALATION_S)
        number = isinstance(value, int | float)
        return float(value if number else performed(context, parts_of(value, name)))

    def inner(self) -> list[Entity]:
        """What it does at its end."""
        return [] if callable(self.on_exit) else checked(self.on_exit, "on_exit")

    def details(self) -> str:
        """The command."""
        return "cmd=[" + ", ".join(described(word) for word in self.cmd) + "]"


def _as_set(value: Any) -> set[str]:
    return {value} if isinstance(value, str) else set(value)


def _pairs(pairs: Mapping[Any, Any], what: str) -> list[tuple[Parts, Parts]]:
    return [(parts_of(k, f"a name in {what}"), parts_of(v, what)) for k, v in pairs.items()]


def _performed_pairs(
    context: LaunchContext, pairs: Iterable[tuple[Parts, Parts]]
) -> dict[str, str]:
    return {performed(context, key): performed(context, value) for key, value in pairs}
