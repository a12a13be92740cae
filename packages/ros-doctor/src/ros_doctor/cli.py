"""`ros-doctor`, or `./roslings doctor` in the course.

Exit codes: 0 no fault, 1 a fault, 2 wrong use.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NoReturn, TextIO

from ros_doctor import usage
from ros_doctor.document import document
from ros_doctor.examine import Examination, examine
from ros_doctor.finding import Status
from ros_doctor.machine import ExaminedMachine, exists, this_machine
from ros_doctor.pages import page_of
from ros_doctor.redact import redacted
from ros_doctor.registry import DoctorCheck, UnknownCheck, all_checks, find_check
from ros_doctor.screen import Paint, explain_lines, lines_of, list_lines
from ros_doctor.texts import either, said

NO_FAULT, FAULT, WRONG_USE = 0, 1, 2


class WrongUse(Exception):
    """The command was typed wrongly; the message says what to type."""


def main(argv: Sequence[str] | None = None) -> int:
    """Examine this machine as the words ask, print, and return the exit code."""
    words = list(sys.argv[1:] if argv is None else argv)
    if words[:1] == ["break"]:
        from ros_doctor.breaks.cli import main as exercises

        return exercises(words[1:])
    machine = this_machine()
    try:
        return _run(words_parser(_program(machine)).parse_args(words), machine)
    except WrongUse as problem:
        print(f"{_program(machine)}: {problem}", file=sys.stderr)
        return WRONG_USE
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:  # `| head` has read enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return NO_FAULT


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        text = "{message}. Type {command} to see all words."
        command = f"{_typed(self.prog)} --help"
        raise WrongUse(said("doctor.wrong_words", text, message=message, command=command))


def look(argv: Sequence[str]) -> Examination:
    """Examine this machine as the words ask, print, and return what was found. Raises WrongUse."""
    machine = this_machine()
    words = words_parser(_program(machine)).parse_args(argv)
    return _looked(words, _meant(words, machine))


def _program(machine: ExaminedMachine) -> str:
    return usage.doctor(machine).removeprefix("./")


def _typed(program: str) -> str:
    return f"./{program}" if program.startswith("roslings") else program


def words_parser(prog: str) -> argparse.ArgumentParser:
    """All words of the doctor, which is called `prog`."""
    parser = _Parser(
        prog=prog,
        description="Looks whether this machine is ready, and says what to type where it is not."
        " It changes nothing.",
        allow_abbrev=False,
    )
    parser.add_argument("--list", action="store_true", help="list all checks")
    parser.add_argument("--only", metavar="ID", nargs="+", help="run only these checks")
    parser.add_argument("--explain", metavar="ID", help="tell all about one check")
    parser.add_argument("--json", action="store_true", help="print JSON (see schema.json)")
    parser.add_argument(
        "--redact", action="store_true", help="leave out names and addresses, to ask for help"
    )
    parser.add_argument(
        "--workspace", metavar="PATH", type=Path, help="the workspace (else ~/roslings_ws)"
    )
    return parser


def _run(words: argparse.Namespace, machine: ExaminedMachine) -> int:
    if words.list:
        _print(list_lines(all_checks()))
        return NO_FAULT
    machine = _meant(words, machine)
    if words.explain:
        return _explain(words, machine)
    return _code(_looked(words, machine))


def _meant(words: argparse.Namespace, machine: ExaminedMachine) -> ExaminedMachine:
    """The machine with the workspace that the words name."""
    if words.workspace is None:
        return machine
    return replace(machine, workspace=workspace_root(words.workspace))


def _looked(words: argparse.Namespace, machine: ExaminedMachine) -> Examination:
    seen = examine(machine, _chosen(words.only, machine))
    shown = redacted(seen) if words.redact else seen
    if words.json:
        print(json.dumps(document(shown), indent=2))
    else:
        _print(lines_of(shown, Paint(colourful(sys.stdout, machine)), bool(words.only)))
    return seen


def _chosen(ids: list[str] | None, machine: ExaminedMachine) -> list[DoctorCheck]:
    if not ids:
        return list(all_checks())
    wanted = [_named(one, machine) for text in ids for one in text.split(",") if one]
    return [check for check in all_checks() if check in wanted]


def _named(id: str, machine: ExaminedMachine) -> DoctorCheck:
    try:
        return find_check(id)
    except UnknownCheck as problem:
        near = said("doctor.near", " Is it {names}?", names=either(problem.near))
        text = "there is no check '{name}'.{near} Type {command} to see them all."
        command = f"{usage.doctor(machine)} --list"
        near = near if problem.near else ""
        told = said("doctor.no_check", text, name=id, near=near, command=command)
        raise WrongUse(told) from problem


def _explain(words: argparse.Namespace, machine: ExaminedMachine) -> int:
    check = _named(words.explain, machine)
    seen = examine(machine, [check])
    shown = redacted(seen) if words.redact else seen
    paint = Paint(colourful(sys.stdout, machine))
    _print(explain_lines(shown.results[0], page_of(check), paint))
    return _code(seen)


def _code(seen: Examination) -> int:
    return FAULT if seen.count(Status.FAULT) else NO_FAULT


def workspace_root(path: Path) -> Path:
    """Return the workspace that a path means: its root, its src, or a package in its src.

    Raises:
        WrongUse: there is no such folder.
    """
    root = Path(os.path.abspath(path.expanduser()))  # noqa: PTH100  resolve() would follow links
    if not root.is_dir():
        text = "there is no folder {path}. Give the folder that holds src."
        raise WrongUse(said("doctor.no_folder", text, path=path))
    for folder in (root, *root.parents):
        if folder.name == "src" and (folder == root or exists(root / "package.xml")):
            return folder.parent
    return root


def colourful(stream: TextIO, machine: ExaminedMachine) -> bool:
    """Tell whether to use colours: on a terminal, and not where NO_COLOR is set."""
    plain = machine.env.get("NO_COLOR") or machine.env.get("TERM") == "dumb"
    return stream.isatty() and not plain


def _print(lines: Iterable[str]) -> None:
    encoding = sys.stdout.encoding or "ascii"
    for line in lines:
        print(line.encode(encoding, errors="replace").decode(encoding))
