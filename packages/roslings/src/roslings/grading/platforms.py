"""Results for platforms that grade others' work: every grading leaves one, a refused one too."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from roslings.grading.shapes import SHAPES
from roslings.verdict import Verdict
from roslings.workspace.errors import MachineTrouble, WorkspaceError, without_places
from roslings.workspace.student import package_of

if TYPE_CHECKING:
    from roslings.course import Lab
    from roslings.report.refusal import Refusal

NOT_HERE = "It could not be graded on this machine."
TELL = "Why, stands in the output of the autograder, which your instructor can read."


def shapes_asked(options: argparse.Namespace) -> dict[str, Path]:
    """The platforms' files that the command line asks for, by the option's name."""
    asked = ((name, getattr(options, name, None)) for name in SHAPES)
    return {name: path for name, path in asked if path}


def for_others(options: argparse.Namespace) -> bool:
    """Whether the result is for a platform that grades others' work: CI's own file counts there."""
    asked = shapes_asked(options).keys()
    in_ci = os.environ.get("CI", "").lower() in ("true", "1")
    return bool(asked - {"junit"}) or (in_ci and bool(asked))


def writer_of(shape: str) -> Callable[[Verdict | Refusal, Path], None]:
    """Writes a verdict, or why there is none, to a file; raises CannotWriteFolder."""
    module = import_module(f"roslings.report.{shape}")  # only what this shape needs
    writer: Callable[[Verdict | Refusal, Path], None] = getattr(module, f"write_{shape}")
    return writer


def write_shapes(told: Verdict | Refusal, options: argparse.Namespace) -> None:
    """Write the verdict, or why there is none, for each platform. Raises CannotWriteFolder."""
    for name, path in shapes_asked(options).items():
        writer_of(name)(told, path)


class Ungradable(WorkspaceError):
    """What was handed in holds no package that could be graded."""


@contextmanager
def handed_in(lab: Lab, path: Path | None, others: bool) -> Iterator[Path]:
    """The package that `path` means; for others also in archives, which are strangers'.

    Raises what `package_of` raises, and Ungradable.
    """
    if not others or path is None:
        yield package_of(lab, path)
        return
    from roslings.experiment.run_folder import run_folder
    from roslings.hand_in.errors import HandInRefused
    from roslings.hand_in.unpack import package_in

    with run_folder() as room:
        try:
            package = package_in(path, lab.outline.package, room)
        except HandInRefused as refusal:
            raise Ungradable(refusal.reason, refusal.next_step) from refusal
        yield package


@contextmanager
def refusal_written(
    lab: str, options: argparse.Namespace, places: Iterable[Path]
) -> Iterator[None]:
    """A block whose end without a verdict is told in the platforms' files as well.

    The paths of `places` are not named there. Raises what the block raises.
    """
    try:
        yield
    except Exception as error:
        write_shapes(refusal_of(lab, error, places), options)
        raise


def refusal_of(lab: str, error: Exception, places: Iterable[Path]) -> Refusal:
    """What the student reads of an error: what is the machine's trouble is told the instructor."""
    from roslings.report.refusal import Refusal

    if not isinstance(error, WorkspaceError) or isinstance(error, MachineTrouble):
        return Refusal(lab, NOT_HERE, TELL, is_students=False)
    known = [*places]
    reason, step = (without_places(text, known) for text in (error.problem, error.next_step))
    return Refusal(lab, reason, step, is_students=True)
