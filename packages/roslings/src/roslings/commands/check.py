"""`./roslings check`: run what the student built, and say what to do next."""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from ros2_on_pip.label_column import wrapped
from ros2_on_pip.language import said
from ros2_on_pip.quick_exit import leave
from ros2_on_pip.typed_paths import from_here
from roslings import course
from roslings.commands.holding import is_strangers, told_of_no_wall
from roslings.commands.invocation import command_line
from roslings.commands.options import (
    hidden_option,
    package_options,
    soak_option,
    trust_option,
    verdict_options,
    whose_option,
)
from roslings.commands.showing import is_stdout, kept, read, replace_kept, show
from roslings.course import NoSolution
from roslings.workspace.student import workspace_root

if TYPE_CHECKING:
    from roslings.course import Lab
    from roslings.grading.saving import Graded
    from roslings.report.html import Own

__all__ = ["add_options", "leave", "run"]

READY = "ROSLINGS_READY_S"
WINDOW_PAGE = "ROSLINGS_CHECK_PAGE"
"""Set in the terminals and notebooks of a day's window: where it looks for the page to show."""


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    package_options(word)
    word.add_argument(
        "--solution", action="store_true", help="check the course's own solution instead"
    )
    verdict_options(word)
    hidden_option(word)
    word.add_argument(
        "--evidence",
        metavar="DIR",
        type=Path,
        help="save all that was seen in the new folder DIR, to judge it again (regrade)",
    )
    trust_option(word)
    word.add_argument(
        "--as-stranger",
        action="store_true",
        help="hold somebody else's package as grade does, or refuse it where nothing can",
    )
    whose_option(word, "check by the card of NAME, where each student has another one")
    soak_option(word, "0; as grade does where a platform's file is written")
    word.add_argument(
        "--clock",
        choices=("auto", "sim", "wall"),
        default="auto",
        help="simulated time where it can be believed (auto), always (sim), or never (wall)",
    )
    word.add_argument(
        "--seed", metavar="N", type=int, help="repeat the random choices of a verdict"
    )
    word.add_argument(
        "--port",
        metavar="DEVICE",
        type=Path,
        help="use the real board on this serial port, for example /dev/ttyACM0",
    )
    word.add_argument(
        "--room",
        metavar="SEED",
        action="append",
        help="drive in this room, in a lab that drives in rooms; may be given up to three times",
    )
    word.add_argument(
        "--timings", action="store_true", help="show where the seconds of the check went"
    )
    word.add_argument(
        "--hint",
        metavar="STEP",
        type=int,
        choices=(1, 2, 3),
        nargs="?",
        const=1,
        help="a hint for what your last check found: 1 where, 2 which idea, 3 other code",
    )


def run(options: argparse.Namespace) -> int:
    """Run what the student built, and say what to do next; a hint needs no new run."""
    from roslings.grading.platforms import refusal_written, shapes_asked

    lab = _lab(options)
    if options.hint and not options.solution and kept(lab).is_file():
        return _hint(lab, options)
    if not shapes_asked(options):
        return _check(lab, options)
    with refusal_written(lab.name, options, [options.path or workspace_root()]):
        return _check(lab, options)


def _lab(options: argparse.Namespace) -> Lab:
    """By the student's own card; the course's solution is one of everybody's."""
    from roslings.workspace.own_card import own_lab

    if options.solution or (options.as_stranger and not options.whose):
        return course.lab(options.lab, options.hidden)
    return own_lab(options.lab, options.hidden, options.whose)


def _hint(lab: Lab, options: argparse.Namespace) -> int:
    """A hint for what the last check found. Raises NothingToSave."""
    if options.evidence or options.html:
        from roslings.grading.saving import NothingToSave

        raise NothingToSave
    return show(read(kept(lab)), options)


def _check(lab: Lab, options: argparse.Namespace) -> int:
    from roslings.grading.platforms import for_others, handed_in

    if options.solution:
        return _check_package(lab, _solution(lab), options)
    with handed_in(lab, options.path, options.as_stranger or for_others(options)) as package:
        return _check_package(lab, package, options)


def _check_package(lab: Lab, package: Path, options: argparse.Namespace) -> int:
    from roslings.experiment import MeasuringOptions, insist_on_wall
    from roslings.grading.checking import any_seed, ready
    from roslings.grading.platforms import for_others
    from roslings.grading.saving import place_for_bags

    quiet = is_stdout(options.json)
    others = for_others(options)
    strangers = is_strangers(options, others)
    if strangers:
        insist_on_wall(lab)
    elif line := told_of_no_wall(package, options):
        print(line, file=sys.stderr)
    _try_port(lab, options.port)
    _choose_rooms(lab, options.room)
    with place_for_bags(options.evidence, package) as bags:
        seed = any_seed() if options.seed is None else options.seed
        choices = MeasuringOptions(
            seed,
            options.clock,
            bags,
            options.port,
            options.hidden,
            strangers=strangers,
            for_others=others,
            soak_s=_soak_s(lab, options, others),
        )
        with ready(lab, choices) as begun:
            graded = begun.grade(package, began_ns(os.environ), quiet)
        before = None if options.solution else replace_kept(lab, graded.verdict, package)
        code = show(graded.verdict, options, before)
        if options.timings:
            _show_timings(graded, options)
        _save(graded, options, bags)
    return code


def began_ns(environment: Mapping[str, str]) -> int:
    """When the check began, on the monotonic clock: with its process, or when all was installed.

    `./roslings` tells in seconds since the computer's start when it had installed what was missing.
    """
    from roslings.seen.timeline import NS_PER_S, process_began_ns

    try:
        age_s = time.clock_gettime(time.CLOCK_BOOTTIME) - float(environment.get(READY, ""))
        ready_ns = time.monotonic_ns() - round(age_s * NS_PER_S)
    except (ValueError, OverflowError):  # nobody has installed anything, or says so in no number
        return process_began_ns()
    return max(process_began_ns(), ready_ns)


def _show_timings(graded: Graded, options: argparse.Namespace) -> None:
    from rich.console import Console

    from roslings.report.timings import print_timings

    console = Console(stderr=is_stdout(options.json))
    print_timings(graded.evidence.timeline, graded.verdict.seconds, console)


def _soak_s(lab: Lab, options: argparse.Namespace, others: bool) -> float:
    """A student's own check is to be quick; where the result counts, nodes are left running."""
    from roslings.course.soak import soak_seconds

    return soak_seconds(lab.card, options.soak if others else options.soak or 0.0)


def _solution(lab: Lab) -> Path:
    """The course's own package. Raises NoSolution in the students' edition."""
    if not lab.solution.is_dir():
        raise NoSolution(lab.name)
    return lab.solution


def _choose_rooms(lab: Lab, seeds: list[str] | None) -> None:
    """Those that are asked for are looked at before anything is built."""
    if seeds:
        from roslings.capabilities.rooms.chosen import choose_rooms

        choose_rooms(lab, seeds)


def _try_port(lab: Lab, port: Path | None) -> None:
    """A real board is tried before anything is built."""
    if port is None:
        return
    from roslings.capabilities.serial.contract import SerialWords
    from roslings_rover.board.attached import LabHasNoBoard, try_port

    if not lab.card.of(SerialWords).board:
        raise LabHasNoBoard(lab.name)
    try_port(port)
    stand = "The wheels will turn: put the rover on a stand, wheels in the air."
    print(said("check.stand", stand), file=sys.stderr)


def _save(graded: Graded, options: argparse.Namespace, bags: Path | None) -> None:
    """Save what was asked for, and say where it is."""
    from roslings.grading.saving import save

    if options.html:
        graded.write_page(options.html, _own_page(options))
    _show_in_window(graded, options)
    if options.evidence:
        save(graded, options.evidence, bags)
        text = "The evidence is in {folder}. Look at it in a browser:"
        told = said("check.evidence", text, folder=from_here(options.evidence))
        page = from_here(options.evidence / "report.html")
        stream = sys.stderr if is_stdout(options.json) else sys.stdout
        print("", *wrapped(told), page, sep="\n", file=stream)


def _show_in_window(graded: Graded, options: argparse.Namespace) -> None:
    """Its links cannot lead to the site's files: the window is a page of a server."""
    from roslings.report.html import Own
    from roslings.report.whole_file import CannotWriteFile

    if page := os.environ.get(WINDOW_PAGE):
        with suppress(CannotWriteFile):  # the verdict stands in the terminal all the same
            graded.write_page(Path(page), Own(command_line(options)))


def _own_page(options: argparse.Namespace) -> Own:
    """For the page of a student's own check: the same words, and the site that lies here."""
    from roslings.commands.built_site import site_here
    from roslings.report.html import Own

    site = site_here()
    return Own(command_line(options), site.as_uri() if site else "")
