"""What an instructor types: a whole class, its scores, and the platforms it hands in to."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from roslings import course
from roslings.commands.showing import show
from roslings.errors import INCONCLUSIVE, OK, RoslingsError

if TYPE_CHECKING:
    from roslings.batch.grades import LateRule


def regrade(options: argparse.Namespace) -> int:
    """Judge saved evidence again, of one check or of a whole class; nothing is run."""
    from roslings.batch.gradebook import lab_of
    from roslings.batch.regrade import regrade_all
    from roslings.judge import judge
    from roslings.report import read_evidence
    from roslings.saving import Graded

    if lab_of(options.evidence):
        told = regrade_all(options.evidence, options.lab, options.hidden)
        print("\n".join(told.lines))
        return INCONCLUSIVE if told.forged else OK
    insist_on_no_platform(options)
    lab = course.lab(options.lab, options.hidden)
    evidence = read_evidence(options.evidence, lab.name)
    verdict = judge(lab, evidence)
    if options.html:
        Graded(lab, verdict, evidence).write_page(options.html)
    print(WHOSE_WORD, file=sys.stderr)
    return show(verdict, options)


WHOSE_WORD = (
    "This evidence is not signed. The verdict is the word of who saved it, and who\n"
    "can have changed it. For a grade, have the package itself graded:\n"
    "  ./roslings grade LAB SUBMISSIONS --out DIR"
)


class WordOfSomebody(RoslingsError):
    """A platform's file is asked for, and the evidence is not signed."""

    def __init__(self, option: str) -> None:
        super().__init__(
            "this evidence is not signed: who saved it can have changed it.\n"
            "So no platform's file is made of it; --json and --html work. Instead, grade the\n"
            "package itself:\n"
            f"  ./roslings check LAB PATH --{option} FILE"
        )


def insist_on_no_platform(options: argparse.Namespace) -> None:
    """What is not signed counts nowhere. Raises WordOfSomebody."""
    from roslings.platforms import shapes_asked

    for option in shapes_asked(options):
        raise WordOfSomebody(option)


def grade_all(options: argparse.Namespace) -> int:
    """Grade many submissions; 3 where some are still inconclusive."""
    from roslings.batch.command import Choices, grade

    choices = Choices(
        options.lab, options.submissions, options.out, jobs=options.jobs, hidden=options.hidden,
        trust=options.trust, clock=options.clock, limit_s=options.limit,
        roster=options.roster, rule=_late_rule(options), dask=options.dask,
        keeps_evidence=not options.dask or options.evidence, soak_s=options.soak,
        assignment=options.canvas_assignment,
    )  # fmt: skip
    try:
        report = grade(choices)
    except KeyboardInterrupt:
        print("\nWhat is graded is kept. The same command goes on from here.", file=sys.stderr)
        raise
    print("\n".join(report.lines))
    return INCONCLUSIVE if report.unclear else OK


def cluster(options: argparse.Namespace) -> int:
    """Run a part of a Dask cluster, in this environment, until Ctrl-C."""
    from roslings.batch.cluster import run_part

    return run_part(options.part, options.rest)


def _late_rule(options: argparse.Namespace) -> LateRule | None:
    from roslings.batch.errors import BatchError
    from roslings.batch.grades import LateRule
    from roslings.batch.submissions import as_time

    if not options.deadline:
        return None
    try:
        deadline = as_time(options.deadline)
    except ValueError:
        problem = f"{options.deadline!r} is no date and time."
        raise BatchError(problem, "Write it as 2026-11-30T23:59.") from None
    return LateRule(
        deadline=deadline, points_a_day=options.late_points, free_days=options.late_free
    )


def override(options: argparse.Namespace) -> int:
    """Give a score by hand."""
    from roslings.batch.regrade import override as give

    told = give(options.folder, options.submission, options.score, options.reason, options.by)
    print("\n".join(told))
    return OK


def export(options: argparse.Namespace) -> int:
    """Make what an instructor uploads to a grading platform."""
    from roslings.export import export as make

    lab = course.lab(options.lab, options.hidden)
    for line in make(options.system, lab, options.to):
        print(line)
    return OK
