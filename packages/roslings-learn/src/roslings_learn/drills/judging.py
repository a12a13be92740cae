"""The verdict on one program: the first thing that is wrong, and its next step."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Any, Literal

from pydantic import JsonValue

from ros2_on_pip.language import said
from roslings.judge import ExperimentView
from roslings.judge.faults import Fault, NothingToJudge
from roslings.judge.faults.reasons import CheckAgain
from roslings.judge.floods import flood_in
from roslings.judge.outcome import words_for
from roslings.verdict import CheckResult
from roslings_learn.drills.faults import NoAnswerYet
from roslings_learn.drills.steps import Step


@dataclass(frozen=True)
class DrillVerdict:
    """What came of one check of a drill."""

    drill: str
    outcome: Literal["pass", "fail", "inconclusive"]
    passed: tuple[str, ...] = ()
    """The titles of what is right already, in order."""
    first: CheckResult | None = None
    """What is not right, or could not be told."""
    seconds: float = 0.0
    """From the save, or the command, to this verdict."""
    because: str = ""
    """Of a prediction: why it is so."""
    notes: tuple[str, ...] = field(default=())

    @property
    def awaits_answer(self) -> bool:
        """A question that nobody has answered: nothing is wrong yet."""
        return self.first is not None and self.first.fault == NoAnswerYet.__name__

    @property
    def headline(self) -> str:
        """The cause, in one line: Python's own last word where the program ended with one."""
        if self.first is None:
            return said("drill.all_well", "it does all that is asked")
        lines = [line for line in self.first.log if line.strip()]
        if any(line.startswith("Traceback") for line in lines):
            return _last_error(lines) or self.first.measured or lines[-1]
        if lines and self.first.exit_code:
            return next((line for line in lines if not line.startswith("[INFO]")), lines[-1])
        return self.first.measured or self.first.why or self.first.title

    def without(self, folder: str) -> DrillVerdict:
        """The same, with files of this folder by their names alone: the student has another."""
        if self.first is None:
            return self
        said = {
            name: text.replace(folder, "")
            for name in ("measured", "expected", "why", "hint")
            if (text := getattr(self.first, name))
        }
        log = tuple(line.replace(folder, "") for line in self.first.log)
        fields = _without(folder, self.first.fields)
        changed = {**said, "log": log, "fields": fields}
        return replace(self, first=self.first.model_copy(update=changed))

    def taking(self, seconds: float) -> DrillVerdict:
        """The same, with its seconds."""
        return replace(self, seconds=seconds)


def _without(folder: str, value: JsonValue) -> JsonValue:
    """A value with the texts in it cut."""
    if isinstance(value, str):
        return value.replace(folder, "")
    if isinstance(value, dict):
        return {name: _without(folder, each) for name, each in value.items()}
    return [_without(folder, each) for each in value] if isinstance(value, list) else value


def _is_error(line: str) -> bool:
    return bool(line.strip()) and not line.startswith(" ") and ":" in line


def _last_error(lines: list[str]) -> str:
    """The line that names the error of the last traceback, others may stand behind it; empty
    where it is a mere name.
    """
    begin = max(n for n, line in enumerate(lines) if line.startswith("Traceback"))
    after = (line for line in lines[begin + 1 :] if _is_error(line))
    return next(after, "").strip()


def judged(
    drill: str, steps: Iterable[Step], view: ExperimentView, only_graph: bool = False
) -> DrillVerdict:
    """Take the steps in turn until one fails. `only_graph` takes those that no clock can bend."""
    passed: list[str] = []
    flood = flood_in([view])
    for step in steps:
        if only_graph and not step.by_graph:
            continue
        if error := flood or _error_of(step, view):
            first = result_of(step, error)
            outcome: Any = "fail" if first.outcome == "fail" else "inconclusive"
            return DrillVerdict(drill, outcome, tuple(passed), first)
        passed.append(step.title)
    return DrillVerdict(drill, "pass", tuple(passed))


def _error_of(step: Step, view: ExperimentView) -> Exception | None:
    try:
        step.demand(view)
    except Exception as error:  # a demand that breaks is told as the grader's own failure
        return error
    return None


def failed(drill: str, name: str, title: str, error: Exception) -> DrillVerdict:
    """A verdict for what was wrong before anything could run."""
    return DrillVerdict(drill, "fail", (), result_of(Step(name, title, lambda _: None), error))


def result_of(step: Step, error: Exception) -> CheckResult:
    """A step that was not met, in the words of a lab's check.

    Where there was nothing to look at though all before it is right, nobody can tell.
    """
    words = words_for(error, step.title)
    if isinstance(error, Fault):
        words["measured"] = error.headline  # a drill's verdict begins with it
    if isinstance(error, NothingToJudge):
        words = {"outcome": "inconclusive", "why": str(CheckAgain(error))}
    return CheckResult(id=step.name, title=step.title, points=0.0, max_points=0.0, **words)
