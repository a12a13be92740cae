"""Exit codes, and what a command says when it cannot do what was asked."""

from __future__ import annotations

import sys

OK, FAILED, WRONG_USE, INCONCLUSIVE, INTERRUPTED = 0, 1, 2, 3, 130
EXIT_OF_OUTCOME = {"pass": OK, "fail": FAILED, "inconclusive": INCONCLUSIVE}
EXIT_OF_ERROR = {
    "roslings.arena.lease:NoFreeDomain": INCONCLUSIVE,
    "roslings.arena.users:NoFreeUser": INCONCLUSIVE,
    "roslings.batch.worker_pool:NurseryGone": INCONCLUSIVE,
    "roslings.batch.errors:BatchError": WRONG_USE,
    "roslings.course.files:CourseError": WRONG_USE,
    "roslings.devices.errors:DeviceTrouble": WRONG_USE,
    "roslings.drills.running:RunBrokeOff": INCONCLUSIVE,
    "roslings.experiment.measure:MeasuringFailed": INCONCLUSIVE,
    "roslings.experiment.walls:NoWall": WRONG_USE,
    "roslings.jupyter.errors:NoLessonToOpen": WRONG_USE,
    "roslings.lessons.document:BadLessons": WRONG_USE,
    "roslings.report.evidence_file:BadEvidence": WRONG_USE,
    "roslings.report.evidence_folder:CannotKeepThere": WRONG_USE,
    "roslings.report.json_file:BadVerdictFile": WRONG_USE,
    "roslings.report.terminal:NoSuchCheck": WRONG_USE,
    "roslings.report.whole_file:CannotWrite": INCONCLUSIVE,
    "roslings.ros2.problem:Problem": WRONG_USE,
    "roslings.saving:NoBagWriter": WRONG_USE,
    "roslings.saving:NothingToSave": WRONG_USE,
    "roslings.workspace.errors:MachineTrouble": INCONCLUSIVE,
    "roslings.workspace.errors:WorkspaceError": WRONG_USE,
    "builtins:FileExistsError": WRONG_USE,
    "builtins:NotADirectoryError": WRONG_USE,
}
"""What a command may raise, by name: to import all these rooms takes longer than most commands."""


def explain(error: Exception) -> int:
    """Say what went wrong; the exit code tells whose fault it is. Raises what nobody expects."""
    code = exit_code_of(error)
    if code is None:
        raise error
    print(f"roslings: {error}", file=sys.stderr)
    return code


def exit_code_of(error: Exception) -> int | None:
    """The exit code for what went wrong; None for what nobody expected.

    A narrower kind counts before a wider one: MachineTrouble is a WorkspaceError too.
    """
    kinds = (f"{kind.__module__}:{kind.__qualname__}" for kind in type(error).__mro__)
    return next((EXIT_OF_ERROR[kind] for kind in kinds if kind in EXIT_OF_ERROR), None)
