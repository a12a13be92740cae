"""How commands show a verdict, and where they keep it."""

from __future__ import annotations

import argparse
import sys
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from ros2_on_pip.errors import EXIT_OF_OUTCOME
from ros2_on_pip.language import said
from roslings.course import Lab
from roslings.workspace.errors import WorkspaceError
from roslings.workspace.student import workspace_root

if TYPE_CHECKING:
    from roslings.verdict import Verdict


def show(verdict: Verdict, options: argparse.Namespace, before: Verdict | None = None) -> int:
    """Print a verdict, and write it where that was asked for; the exit code."""
    from rich.console import Console

    from roslings.commands.invocation import command_line
    from roslings.grading.platforms import write_shapes
    from roslings.report.json_file import write_json
    from roslings.report.terminal import print_verdict

    if options.json:
        write_json(verdict, options.json)
    write_shapes(verdict, options)
    if not is_stdout(options.json):
        print_verdict(
            verdict,
            console=Console(),
            hint_step=options.hint,
            only=options.only,
            whole=options.all,
            before=before,
            command_line=command_line(options),
        )
    return EXIT_OF_OUTCOME[verdict.outcome]


def is_stdout(path: Path | None) -> bool:
    """Whether `-` was given instead of a file: then nothing else is printed there."""
    return str(path) == "-"


def kept(lab: Lab) -> Path:
    """Where the last verdict lies, for `--hint`."""
    return workspace_root() / ".roslings" / f"verdict-{lab.name}.json"


def replace_kept(lab: Lab, verdict: Verdict, package: Path) -> Verdict | None:
    """Keep this verdict; the one before, or None where there is none that can be read.

    The package is kept, too, where it has the best score so far: `my-rover` carries that one.
    """
    from roslings.report.json_file import BadVerdictFile

    before = None
    with suppress(BadVerdictFile):
        before = read(kept(lab))
    _keep(lab, verdict, package)
    return before


def read(path: Path) -> Verdict:
    """A verdict that was kept. Raises BadVerdictFile."""
    from roslings.report.json_file import read_json

    return read_json(path)


def _keep(lab: Lab, verdict: Verdict, package: Path) -> None:
    """Keep score and verdict; a workspace that cannot be written does not hide the verdict."""
    from roslings.report.json_file import write_json
    from roslings.report.whole_file import CannotWriteFile
    from roslings.workspace.best import keep_best
    from roslings.workspace.progress import record

    if not workspace_root().is_dir():
        return
    try:
        record(verdict)
        write_json(verdict, kept(lab))
        keep_best(lab, package, verdict.score)
    except (WorkspaceError, CannotWriteFile) as error:
        told = said("check.not_kept", "roslings: the score was not kept. {why}", why=error)
        print(told, file=sys.stderr)
