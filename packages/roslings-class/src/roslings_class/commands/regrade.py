"""`./roslings regrade`: judge saved evidence again; runs nothing."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from ros2_on_pip.errors import INCONCLUSIVE, OK, RoslingsError
from roslings import course
from roslings.commands.options import hidden_option, lab_options, verdict_options
from roslings.commands.showing import show


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    lab_options(word)
    word.add_argument(
        "evidence",
        metavar="EVIDENCE",
        type=Path,
        help="the folder that check --evidence made, or the --out of ./roslings grade",
    )
    hidden_option(word)
    verdict_options(word)
    word.set_defaults(hint=None)


def run(options: argparse.Namespace) -> int:
    """Judge saved evidence again, of one check or of a whole class; nothing is run."""
    from roslings.grading.saving import Graded
    from roslings.judge import judge
    from roslings.report.evidence_file import read_evidence
    from roslings_class.gradebook import lab_of
    from roslings_class.regrade import regrade_all

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
    from roslings.grading.platforms import shapes_asked

    for option in shapes_asked(options):
        raise WordOfSomebody(option)
