"""What a learner types, from the first day to the file to hand in."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from roslings import course
from roslings.commands.holding import is_strangers, told_of_no_wall
from roslings.commands.showing import is_stdout, kept, read, replace_kept, show
from roslings.course import Lab, NoSolution
from roslings.errors import OK
from roslings.typed import own_page, program
from roslings.workspace.errors import from_here, shown
from roslings.workspace.student import package_of, workspace_root

if TYPE_CHECKING:
    from roslings.saving import Graded


def check(options: argparse.Namespace) -> int:
    """Run what the student built, and say what to do next; a hint needs no new run."""
    from roslings.platforms import refusal_written, shapes_asked

    lab = course.lab(options.lab, options.hidden)
    if options.hint and not options.solution and kept(lab).is_file():
        return _hint(lab, options)
    if not shapes_asked(options):
        return _check(lab, options)
    with refusal_written(lab.name, options, [options.path or workspace_root()]):
        return _check(lab, options)


def _hint(lab: Lab, options: argparse.Namespace) -> int:
    """A hint for what the last check found. Raises NothingToSave."""
    if options.evidence or options.html:
        from roslings.saving import NothingToSave

        raise NothingToSave
    return show(read(kept(lab)), options)


def _check(lab: Lab, options: argparse.Namespace) -> int:
    from roslings.platforms import for_others, handed_in

    if options.solution:
        return _check_package(lab, _solution(lab), options)
    with handed_in(lab, options.path, options.as_stranger or for_others(options)) as package:
        return _check_package(lab, package, options)


def _check_package(lab: Lab, package: Path, options: argparse.Namespace) -> int:
    from roslings.checking import any_seed, ready
    from roslings.experiment import Choices, insist_on_wall
    from roslings.platforms import for_others
    from roslings.saving import place_for_bags
    from roslings.timeline import process_began_ns

    quiet = is_stdout(options.json)
    others = for_others(options)
    strangers = is_strangers(options, others)
    if strangers:
        insist_on_wall(lab)
    elif line := told_of_no_wall(package, options):
        print(line, file=sys.stderr)
    _try_port(lab, options.port)
    with place_for_bags(options.evidence, package) as bags:
        seed = any_seed() if options.seed is None else options.seed
        choices = Choices(
            seed, options.clock, bags, options.port, options.hidden, strangers=strangers,
            for_others=others, soak_s=_soak_s(lab, options, others),
        )  # fmt: skip
        with ready(lab, choices) as begun:
            graded = begun.grade(package, process_began_ns(), quiet)
        before = None if options.solution else replace_kept(lab, graded.verdict)
        code = show(graded.verdict, options, before)
        if options.timings:
            _show_timings(graded, options)
        _save(graded, options, bags)
    return code


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


def _try_port(lab: Lab, port: Path | None) -> None:
    """A real board is tried before anything is built."""
    if port is None:
        return
    from roslings.devices.board.attached import LabHasNoBoard, try_port

    if not lab.card.board:
        raise LabHasNoBoard(lab.name)
    try_port(port)
    print("The wheels will turn: put the rover on a stand, wheels in the air.", file=sys.stderr)


def _save(graded: Graded, options: argparse.Namespace, bags: Path | None) -> None:
    """Save what was asked for, and say where it is."""
    from roslings.saving import save

    if options.html:
        graded.write_page(options.html, own_page(options))
    if options.evidence:
        save(graded, options.evidence, bags)
        say = f"\nThe evidence is in {from_here(options.evidence)}. Look at it in a browser:"
        page = from_here(options.evidence / "report.html")
        print(f"{say}\n{page}", file=sys.stderr if is_stdout(options.json) else sys.stdout)


def start(options: argparse.Namespace) -> int:
    """Put a lab's starter into the workspace."""
    from roslings.workspace.student import start as put

    lab = course.lab(options.lab)
    started = put(lab)
    print(f"The starter of {lab.name!r} is in {shown(started.package)} ({started.files} files).")
    print(f"Read the task: {from_here(lab.task)}")
    print(f"Then check what you built: {program()} check {lab.name}")
    return OK


def diff(options: argparse.Namespace) -> int:
    """Show what changed since the starter."""
    from roslings.report.safe_text import harmless
    from roslings.workspace.student import diff as changes

    lines = changes(course.lab(options.lab))
    for line in lines:
        print(harmless(line.rstrip("\n")))
    if not lines:
        print("Nothing is changed: this is the starter.")
    return OK


def pack(options: argparse.Namespace) -> int:
    """Make the zip to hand in."""
    from roslings.workspace.student import pack as zip_it

    lab = course.lab(options.lab)
    packed = zip_it(lab, options.out, options.path)
    verb = "Replaced" if packed.replaced else "Made"
    print(f"{verb} {shown(packed.path)}: {len(packed.files)} files, {packed.size_bytes:,} bytes.")
    print("Hand in this one file.", flush=True)
    _let_run(lab, options)
    return OK


def _let_run(lab: Lab, options: argparse.Namespace) -> None:
    """Let the nodes run as they will where they are graded; the file is there, whatever comes."""
    from roslings.course.soak import soak_seconds
    from roslings.handing_in import left_running
    from roslings.report import Progress

    if for_s := soak_seconds(lab.card, options.soak):
        try:
            with Progress() as progress:
                lines = left_running(lab, package_of(lab, options.path), for_s, progress.step)
        except KeyboardInterrupt:
            lines = ["Your nodes were not watched to the end. The file is whole."]
        print("\n".join(lines))


def lab(options: argparse.Namespace) -> int:
    """Open the day's lesson in JupyterLab, until Ctrl-C."""
    from roslings.jupyter.choosing import place_for
    from roslings.jupyter.copies import Copies
    from roslings.jupyter.server import open_lab
    from roslings.lessons import read_lessons

    lessons = read_lessons(course.root())
    days = lessons.days
    copies = Copies(course.root(), workspace_root(), lessons.glossary)
    place = place_for(options.day, days, copies, options.port, not options.no_browser)
    place = replace(place, ip=options.ip)
    for told in copies.copy_all(days):
        print(told)
    return open_lab(place)
