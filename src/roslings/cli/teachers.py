"""What the commands of instructors and authors take."""

from __future__ import annotations

import argparse
from pathlib import Path

from roslings.cli.options import (
    hidden_option,
    lab_options,
    soak_option,
    trust_option,
    verdict_options,
    whole_number,
)


def regrade_options(word: argparse.ArgumentParser) -> None:
    """What `regrade` takes."""
    lab_options(word)
    word.add_argument(
        "evidence", metavar="EVIDENCE", type=Path,
        help="the folder that check --evidence made, or the --out of ./roslings grade",
    )  # fmt: skip
    hidden_option(word)
    verdict_options(word)
    word.set_defaults(hint=None)


def grade_options(word: argparse.ArgumentParser) -> None:
    """What `grade` takes."""
    lab_options(word)
    word.add_argument(
        "submissions", metavar="SUBMISSIONS", type=Path,
        help="Moodle's or Canvas's zip of the class; or a folder of folders, .zip and .tar.gz"
        " files, or a CSV file with their paths",
    )  # fmt: skip
    word.add_argument(
        "--out", metavar="DIR", type=Path, required=True,
        help="where the gradebook goes; the same command goes on where it was ended",
    )  # fmt: skip
    word.add_argument(
        "--jobs", metavar="N", type=whole_number, help="how many at once (default: measured)"
    )
    hidden_option(word)
    trust_option(word)
    word.add_argument("--clock", choices=("auto", "sim", "wall"), default="auto")
    word.add_argument(
        "--limit", metavar="SECONDS", type=whole_number, default=900,
        help="the most that one grading may take (default: 900)",
    )  # fmt: skip
    soak_option(word, "half a minute, or what the card says")
    word.add_argument(
        "--dask", metavar="ADDRESS", help="grade on a Dask cluster, for example tcp://10.0.0.5:8786"
    )
    word.add_argument(
        "--evidence", action="store_true", help="with --dask: bring the evidence back as well"
    )
    roster_options(word)


def roster_options(word: argparse.ArgumentParser) -> None:
    """Who is in the class, and what being late costs."""
    word.add_argument(
        "--roster", metavar="FILE", type=Path,
        help="the class list, a CSV file with name, id, email; tells who is missing",
    )  # fmt: skip
    word.add_argument(
        "--deadline", metavar="TIME", help="for example 2026-11-30T23:59; late days are counted"
    )
    word.add_argument(
        "--late-points", metavar="P", type=float, default=0.0, help="what each day late costs"
    )
    word.add_argument(
        "--late-free", metavar="N", type=int, default=0, help="late days that cost nothing"
    )
    word.add_argument(
        "--canvas-assignment", metavar="NAME", default="",
        help='the head of the column in canvas.csv, for example "Lab 3 (48151)"',
    )  # fmt: skip


def override_options(word: argparse.ArgumentParser) -> None:
    """What `override` takes."""
    word.add_argument("folder", metavar="DIR", type=Path, help="the --out of ./roslings grade")
    word.add_argument("submission", metavar="SUBMISSION", help="its name, or the student's")
    word.add_argument("score", metavar="SCORE", type=float, help="0 to 100")
    word.add_argument("--reason", required=True, help="kept beside the score")
    word.add_argument("--by", metavar="NAME", help="who says so (default: your user name)")


def export_options(word: argparse.ArgumentParser) -> None:
    """What `export` takes."""
    word.add_argument("system", metavar="SYSTEM", help="gradescope, prairielearn, ... (any: help)")
    lab_options(word)
    word.add_argument("--to", metavar="DIR", type=Path, required=True, help="a new folder")
    hidden_option(word)


def cluster_options(word: argparse.ArgumentParser) -> None:
    """What `cluster` takes."""
    word.add_argument("part", choices=("scheduler", "worker"))
    word.add_argument("rest", nargs=argparse.REMAINDER, metavar="...", help="options for dask")


def new_lab_options(word: argparse.ArgumentParser) -> None:
    """What `new-lab` takes."""
    word.add_argument("lab", metavar="NAME", help="for example: line-follower")
    word.add_argument("--package", metavar="NAME", help="default: the lab's name, with _ for -")
    word.add_argument("--day", metavar="DAY", help="a folder of days/ (default: the last)")


def prove_options(word: argparse.ArgumentParser) -> None:
    """What `prove` takes."""
    word.add_argument("labs", metavar="LAB", nargs="*", help="for example: topics")
    word.add_argument("--all", action="store_true", help="list what holds, too")
    word.add_argument(
        "--anyway", action="store_true", help="grade even where the files do not fit each other"
    )
    word.add_argument(
        "--drills", metavar="DAY|NAME", nargs="*", help="drills, of a day or by name (default: all)"
    )
    word.add_argument(
        "--packages", action="store_true",
        help="only: solution, starter and mutants get the verdicts that they must get",
    )  # fmt: skip
    word.add_argument(
        "--contract", action="store_true",
        help="only: each word of the card, and each sentence of the task, is judged",
    )  # fmt: skip
    word.add_argument(
        "--generated", action="store_true",
        help="make 100 wrong packages of the solution; 95 of 100 must be caught",
    )  # fmt: skip
    word.add_argument(
        "--keep", metavar="DIR", type=Path,
        help="with --generated: where results stay, so that an interrupted run goes on",
    )  # fmt: skip
    word.add_argument(
        "--so-far", action="store_true",
        help="with --generated: grade nothing, and tell what is known",
    )  # fmt: skip
    word.add_argument(
        "--keep-kills", action="store_true",
        help="with --generated: name a few that were caught, for prove --record",
    )  # fmt: skip
    word.add_argument(
        "--rewritten", action="store_true",
        help="write the solution in other ways; each must get 100",
    )  # fmt: skip
    word.add_argument(
        "--kept", action="store_true",
        help="judge all proofs that are kept, and say which are stale; runs no node",
    )  # fmt: skip
    word.add_argument(
        "--record", action="store_true",
        help="measure what is stale, and keep the proofs of it; with --due: all that is due",
    )  # fmt: skip
    word.add_argument(
        "--due", action="store_true", help="measure what must be measured before a landing"
    )
    word.add_argument(
        "--told", metavar="FILE", type=Path,
        help="with --due: what came of each package, a line of JSON each",
    )  # fmt: skip
    word.add_argument(
        "--jobs", metavar="N", type=whole_number, help="how many at once (default: measured)"
    )


def release_options(word: argparse.ArgumentParser) -> None:
    """What `release` takes."""
    word.add_argument("--to", metavar="DIR", type=Path, required=True, help="a new folder")


def site_options(word: argparse.ArgumentParser) -> None:
    """What `site` takes."""
    word.add_argument("--open", action="store_true", help="open it in the browser")
    word.add_argument("--fresh", action="store_true", help="build all of it anew")
    links = word.add_mutually_exclusive_group()
    links.add_argument("--links", action="store_true", help="list the links to other sites")
    links.add_argument(
        "--check-links", action="store_true", help="try the links to other sites (needs a network)"
    )
    word.add_argument(
        "--out", metavar="DIR", type=Path, help="where to build (default: build/site)"
    )


def test_options(word: argparse.ArgumentParser) -> None:
    """What `test` takes: the rest goes to pytest."""
    word.add_argument("rest", nargs=argparse.REMAINDER, metavar="...", help="options for pytest")
