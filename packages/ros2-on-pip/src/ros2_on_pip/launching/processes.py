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
    pairs_of,
    parts_of,
    parts_or_none,
    performed,
    performed_or_none,
)
from ros2_on_pip.launching.substitutions import LaunchConfiguration
from ros2_on_pip.launching.typed import seconds_of, truth_of, typed
from ros2_on_pip.problem import CommandProblem, did_you_mean
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

STREAMS, PLACES = ("stdout", "stderr", "both"), ("screen", "log", "own_log")
OVERRIDE_OUTPUT = "OVERRIDE_LAUNCH_PROCESS_OUTPUT"
_SIGTERM_TIMEOUT = LaunchConfiguration("sigterm_timeout", default=5)
_SIGKILL_TIMEOUT = LaunchConfiguration("sigkill_timeout", default=5)
"""So many seconds has a process after SIGTERM, and before it after SIGINT."""


class ExecutedTwice(CommandProblem):
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
        sigterm_timeout: SomeSubstitutionsType = _SIGTERM_TIMEOUT,
        sigkill_timeout: SomeSubstitutionsType = _SIGKILL_TIMEOUT,
        **others: Any,
    ) -> None:
        """Delays are numbers of seconds; the timeouts are seconds as texts. Raises TypeError."""
        super().__init__(**others)
        if isinstance(cmd, str):
            words = [cmd] if shell else shlex.split(cmd)
            raise TypeError(f"cmd must be a list of words: cmd={words!r}")
        self.cmd = [parts_of(word, "each word of cmd") for word in cmd]
        self.name, self.cwd = parts_or_none(name, "name"), parts_or_none(cwd, "cwd")
        self.prefix = parts_or_none(prefix, "prefix")
        self.env = None if env is None else pairs_of(env, "env")
        self.additional_env = pairs_of(additional_env, "additional_env")
        self.shell, self.emulate_tty, self.log_cmd = shell, emulate_tty, log_cmd
        self.output = output if isinstance(output, Mapping) else parts_of(output, "output")
        self.on_exit = None if on_exit is None else answer_of(on_exit, "on_exit")
        self.respawn = typed(respawn, bool, "respawn")
        self.respawn_delay = _number(respawn_delay or 0.0, "respawn_delay")
        self.respawn_max_retries = _number(respawn_max_retries, "respawn_max_retries")
        self.sigterm_timeout = parts_of(sigterm_timeout, "sigterm_timeout")
        self.sigkill_timeout = parts_of(sigkill_timeout, "sigkill_timeout")
        self.pid: int | None = None
        self._executed = False

    def execute(self, context: LaunchContext) -> None:
        """Fill everything in, and let it start when this round is over."""
        if self._executed:
            raise ExecutedTwice(type(self).__name__)
        self._executed = True
        if context.is_shutdown:
            return
        if self.on_exit is not None:
            handler = OnProcessExit(target_action=self, on_exit=self.on_exit)
            context.register_event_handler(handler)
        context.planned.append(self.plan(context))

    def command(self, context: LaunchContext) -> list[str]:
        """The words of the command. Raises SubstitutionFailure."""
        return [performed(context, word) for word in self.cmd]

    def plan(self, context: LaunchContext) -> Planned:
        """All that is needed to start it. Raises SubstitutionFailure."""
        command = self.command(context)
        environment = self._environment(context, self._found(command, context))
        program = self.program_name(self._first(command))
        prefix = self._prefix(context, program)
        name = performed_or_none(context, self.name)
        if name is None:
            name = Path(prefix[0]).name if prefix else program
        return Planned(
            action=self,
            name=context.new_name(name),
            command=[*prefix, *command],
            environment=environment,
            folder=performed_or_none(context, self.cwd),
            shell=self.shell,
            output=self._targets(context),
            respawn=self._respawning(context),
            sigterm_after_s=seconds_of(context, self.sigterm_timeout, "sigterm_timeout"),
            sigkill_after_s=seconds_of(context, self.sigkill_timeout, "sigkill_timeout"),
        )

    def program_name(self, first_word: str) -> str:
        """What the program is called, by the first word of its command."""
        return Path(first_word).name

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

    def _prefix(self, context: LaunchContext, program: str) -> list[str]:
        """The words before the command; those of the command line may be for some programs."""
        if self.prefix is not None:
            return shlex.split(performed(context, self.prefix))
        known = context.launch_configurations
        wanted = re.match(str(known.get("launch-prefix-filter", "")), program)
        return shlex.split(str(known.get("launch-prefix", ""))) if wanted else []

    def _targets(self, context: LaunchContext) -> Targets:
        chosen = os.environ.get(OVERRIDE_OUTPUT)
        if isinstance(self.output, Mapping):
            return TARGETS[chosen] if chosen in TARGETS else _targets_in(self.output)
        word = chosen or performed(context, self.output)
        if word not in TARGETS:
            raise SubstitutionFailure(
                f"output is 'screen', 'log' or 'both', and not '{word}'. With 'log', which is the"
                " default, print() of a node is not shown"
            )
        return TARGETS[word]

    def _respawning(self, context: LaunchContext) -> Respawn:
        wanted = truth_of(context, self.respawn, "respawn")
        return Respawn(wanted, self.respawn_delay, int(self.respawn_max_retries))

    def inner(self) -> list[Entity]:
        """What it does at its end."""
        if self.on_exit is None or callable(self.on_exit):
            return []
        return checked(self.on_exit, "on_exit")

    def details(self) -> str:
        """The command."""
        return "cmd=[" + ", ".join(described(word) for word in self.cmd) + "]"


def _number(value: Any, what: str) -> float:
    if not isinstance(value, int | float):
        raise TypeError(f"{what} must be a number, not {value!r} ({type(value).__name__})")
    return value


def _targets_in(chosen: Mapping[str, Any]) -> Targets:
    """Places by stream. Raises SubstitutionFailure where a word is not known."""
    places = {stream: _as_set(names) for stream, names in chosen.items()}
    said = [(name, STREAMS) for name in places]
    said += [(name, PLACES) for names in places.values() for name in names]
    for word, known in said:
        if word not in known:
            raise SubstitutionFailure(
                f"output has {', '.join(STREAMS)}, each with {', '.join(PLACES)}, and not '{word}'."
                f"{did_you_mean(str(word), known)}"
            )
    both = places.get("both", set())
    return {stream: places.get(stream, set()) | both for stream in ("stdout", "stderr")}


def _as_set(value: Any) -> set[str]:
    return {value} if isinstance(value, str) else set(value)


def _performed_pairs(
    context: LaunchContext, pairs: Iterable[tuple[Parts, Parts]]
) -> dict[str, str]:
    return {performed(context, key): performed(context, value) for key, value in pairs}
