"""`./roslings grade`: grade many submissions."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from ros2_on_pip.errors import INCONCLUSIVE, OK
from roslings.commands.options import (
    hidden_option,
    lab_options,
    soak_option,
    trust_option,
    whole_number,
)

if TYPE_CHECKING:
    from roslings_class.late_days import LateRule


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    lab_options(word)
    word.add_argument(
        "submissions",
        metavar="SUBMISSIONS",
        type=Path,
        help="Moodle's or Canvas's zip of the class; or a folder of folders, .zip and .tar.gz"
        " files, or a CSV file with their paths",
    )
    word.add_argument(
        "--out",
        metavar="DIR",
        type=Path,
        required=True,
        help="where the gradebook goes; the same command goes on where it was ended",
    )
    word.add_argument(
        "--jobs", metavar="N", type=whole_number, help="how many at once (default: measured)"
    )
    hidden_option(word)
    trust_option(word)
    word.add_argument("--clock", choices=("auto", "sim", "wall"), default="auto")
    word.add_argument(
        "--limit",
        metavar="SECONDS",
        type=whole_number,
        default=900,
        help="the most that one grading may take (default: 900)",
    )
    soak_option(word, "half a minute, or what the card says")
    word.add_argument(
        "--dask", metavar="ADDRESS", help="grade on a Dask cluster, for example tcp://10.0.0.5:8786"
    )
    word.add_argument(
        "--evidence", action="store_true", help="with --dask: bring the evidence back as well"
    )
    word.add_argument(
        "--variants",
        action="store_true",
        help="each student has a card of their own (start LAB --for NAME); needs --roster",
    )
    word.add_argument(
        "--rooms",
        choices=("same", "each"),
        help="in a lab that drives in rooms: secret ones, the same for all (default), or for each"
        " student others",
    )
    word.add_argument(
        "--explain",
        action="store_true",
        help="make three questions, with answers, about each hand-in that passes",
    )
    roster_options(word)


def roster_options(word: argparse.ArgumentParser) -> None:
    """Who is in the class, and what being late costs."""
    word.add_argument(
        "--roster",
        metavar="FILE",
        type=Path,
        help="the class list, a CSV file with name, id, email; tells who is missing",
    )
    word.add_argument(
        "--deadline",
        metavar="TIME",
        help="for example 2026-11-30T23:59, or '2026-11-30 23:59 Europe/Berlin'; late days are"
        " counted, and times without a zone are read in this one",
    )
    word.add_argument(
        "--late-points", metavar="P", type=float, default=0.0, help="what each day late costs"
    )
    word.add_argument(
        "--late-free", metavar="N", type=int, default=0, help="late days that cost nothing"
    )
    word.add_argument(
        "--points",
        metavar="N",
        type=_points,
        help="what the whole is worth on your platform (default: what its class list says, or 100)",
    )
    word.add_argument(
        "--extensions",
        metavar="FILE",
        type=Path,
        help="who has more time, a CSV file with name or id, and until",
    )
    word.add_argument(
        "--times",
        metavar="FILE",
        type=Path,
        action="append",
        default=[],
        help="when each was handed in: a CSV file with name or id, and submitted; GitHub"
        " Classroom's grades; or Canvas's list of submissions (.json); may be given again",
    )
    word.add_argument(
        "--canvas-assignment",
        metavar="NAME",
        default="",
        help='the head of the column in canvas.csv, for example "Lab 3 (48151)"',
    )


def _points(text: str) -> float:
    """More than 0. Raises ValueError, which argparse tells."""
    points = float(text.replace(",", "."))
    if not 0 < points < 1e6:
        raise ValueError
    return points


def run(options: argparse.Namespace) -> int:
    """Grade many submissions; 3 where some are still inconclusive."""
    from roslings_class.command import GradeOptions, grade

    choices = GradeOptions(
        options.lab,
        options.submissions,
        options.out,
        jobs=options.jobs,
        hidden=options.hidden,
        trust=options.trust,
        clock=options.clock,
        limit_s=options.limit,
        roster=options.roster,
        rule=_late_rule(options),
        dask=options.dask,
        keeps_evidence=not options.dask or options.evidence,
        soak_s=options.soak,
        assignment=options.canvas_assignment,
        points=options.points,
        variants=options.variants,
        extensions=options.extensions,
        times=tuple(options.times),
        explain=options.explain,
        rooms=options.rooms,
    )
    try:
        report = grade(choices)
    except KeyboardInterrupt:
        print("\nWhat is graded is kept. The same command goes on from here.", file=sys.stderr)
        raise
    print("\n".join(report.lines))
    return INCONCLUSIVE if report.unclear else OK


def _late_rule(options: argparse.Namespace) -> LateRule | None:
    from roslings_class.clock_times import EXAMPLES, as_time, zone_of
    from roslings_class.errors import BatchError
    from roslings_class.late_days import LateRule

    if not options.deadline:
        return None
    try:
        deadline, zone = as_time(options.deadline), zone_of(options.deadline)
    except ValueError:
        problem = f"{options.deadline!r} is no date and time."
        raise BatchError(problem, f"Write it as {EXAMPLES}.") from None
    return LateRule(
        deadline=deadline, points_a_day=options.late_points, free_days=options.late_free, zone=zone
    )
