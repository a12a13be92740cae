"""`ros2 doctor`: the report that the real one prints, and the doctor that is installed here."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Collection, Sequence
from importlib.metadata import entry_points
from typing import TYPE_CHECKING, Protocol

from ros2_on_pip.problem import CommandProblem
from ros2_on_pip.words import FAILED, OK, WRONG_USE, CommandParser

if TYPE_CHECKING:
    from ros2_on_pip.report import ReportPart

GROUP = "ros2_on_pip.doctor"


def parser_for(command: str) -> CommandParser:
    """The options of the real one; every other word is for the doctor."""
    parser = CommandParser(
        prog=f"ros2 {command}", add_help=False, allow_abbrev=False, usage=argparse.SUPPRESS
    )
    group = parser.add_argument_group("as the real ros2 doctor")
    one = group.add_mutually_exclusive_group()
    one.add_argument(
        "-r",
        "--report",
        action="store_true",
        help="Print all reports, as bug templates ask for them (with --redact: without addresses).",
    )
    one.add_argument(
        "-rf",
        "--report-failed",
        action="store_true",
        help="Print reports of failed checks only.",
    )
    group.add_argument(
        "-ep",
        "--exclude-packages",
        action="store_true",
        help="Exclude the report on packages.",
    )
    group.add_argument(
        "-iw",
        "--include-warnings",
        action="store_true",
        help="Include warnings as failed checks. Warnings are ignored by default.",
    )
    group.add_argument("-h", "--help", action="store_true", help=argparse.SUPPRESS)
    return parser


def run(command: str, words: list[str]) -> int:
    """`ros2 COMMAND WORD...`."""
    parser = parser_for(command)
    options, others = parser.parse_known_args(words)
    if options.help:
        return _help(parser)
    if options.report:
        return _report(parser, options, others)
    if options.report_failed and "--json" in others:
        parser.error("--json does not go with --report-failed")
    return _examine(options, others)


def _help(parser: CommandParser) -> int:
    if found := doctor():
        print(found.words_parser(parser.prog).format_help())
    print(parser.format_help())
    print(f"{parser.prog} hello  Check network connectivity between multiple hosts")
    return OK


def _report(parser: CommandParser, options: argparse.Namespace, others: list[str]) -> int:
    if unknown := [word for word in others if word != "--redact"]:
        parser.error(f"{' '.join(unknown)} does not go with --report")
    from ros2_on_pip.report import PARTS

    _print(_wanted(PARTS, options), redact="--redact" in others)
    return OK


def _wanted(parts: Collection[ReportPart], options: argparse.Namespace) -> list[ReportPart]:
    return [part for part in parts if not (part.of_packages and options.exclude_packages)]


def _print(parts: list[ReportPart], redact: bool) -> None:
    from ros2_on_pip.report import sections

    hidden = needed().hidden if redact else str
    for section in sections(parts):
        print(hidden("\n".join(section.lines())))


def _examine(options: argparse.Namespace, others: list[str]) -> int:
    """The doctor's own words; then the sections on what failed, where they were asked for."""
    found = needed()
    only_reads = {"--list", "--explain"} & set(others)
    if only_reads or not (options.report_failed or options.include_warnings):
        return found.main(others)
    try:
        failed = found.failed_themes(others, options.include_warnings)
    except found.WrongUse as problem:
        print(f"ros2 doctor: {problem}", file=sys.stderr)
        return WRONG_USE
    if options.report_failed and failed:
        _report_failed(options, failed, redact="--redact" in others)
    return FAILED if failed else OK


def _report_failed(options: argparse.Namespace, failed: list[str], redact: bool) -> None:
    from ros2_on_pip.report import PARTS

    parts = [part for part in _wanted(PARTS, options) if set(part.themes) & set(failed)]
    if parts:
        _print(parts, redact)
    else:
        print(f"\nNo report is about {', '.join(failed)}: what is said above is all.")


# --- who examines ------------------------------------------------------------------------------


class Doctor(Protocol):
    """What examines a machine; another package brings it, by the entry point of `GROUP`."""

    WrongUse: type[Exception]

    def words_parser(self, prog: str) -> argparse.ArgumentParser:
        """Its own words."""

    def main(self, words: Sequence[str]) -> int:
        """Examine as the words ask, print, and return the exit code."""

    def failed_themes(self, words: Sequence[str], warnings_too: bool) -> list[str]:
        """The same, and return what failed."""

    def hidden(self, text: str) -> str:
        """The text without names and addresses of this machine."""


class NoDoctor(CommandProblem):
    """Nothing here examines a machine."""

    def __init__(self) -> None:
        super().__init__(
            "What examines this machine is a package of its own.\n"
            "Install it: pip install ros-doctor\n"
            "Without it there is the report: ros2 doctor --report"
        )


def needed() -> Doctor:
    """The doctor that is installed. Raises NoDoctor."""
    if found := doctor():
        return found
    raise NoDoctor


def doctor() -> Doctor | None:
    """The doctor that is installed; None where there is none."""
    for point in entry_points(group=GROUP):
        found: Doctor = point.load()
        return found
    return None
