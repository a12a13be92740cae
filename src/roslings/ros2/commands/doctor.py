"""`ros2 doctor`: the doctor of roslings, and the report that the real one prints."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Collection
from typing import TYPE_CHECKING

from roslings.ros2.words import FAILED, OK, WRONG_USE, Parser

if TYPE_CHECKING:
    from roslings.doctor.examine import Examination
    from roslings.ros2.report import Part


def parser_for(command: str) -> Parser:
    """The options of the real one; every other word is for the doctor of roslings."""
    parser = Parser(
        prog=f"ros2 {command}", add_help=False, allow_abbrev=False, usage=argparse.SUPPRESS
    )
    group = parser.add_argument_group("as the real ros2 doctor")
    one = group.add_mutually_exclusive_group()
    one.add_argument(
        "-r", "--report", action="store_true",
        help="Print all reports, as bug templates ask for them (with --redact: without addresses).",
    )  # fmt: skip
    one.add_argument(
        "-rf", "--report-failed", action="store_true",
        help="Print reports of failed checks only.",
    )  # fmt: skip
    group.add_argument(
        "-ep", "--exclude-packages", action="store_true",
        help="Exclude the report on packages.",
    )  # fmt: skip
    group.add_argument(
        "-iw", "--include-warnings", action="store_true",
        help="Include warnings as failed checks. Warnings are ignored by default.",
    )  # fmt: skip
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


def _help(parser: Parser) -> int:
    from roslings.doctor.cli import words_parser

    print(words_parser(parser.prog).format_help())
    print(parser.format_help())
    print(f"{parser.prog} hello  Check network connectivity between multiple hosts")
    return OK


def _report(parser: Parser, options: argparse.Namespace, others: list[str]) -> int:
    if unknown := [word for word in others if word != "--redact"]:
        parser.error(f"{' '.join(unknown)} does not go with --report")
    from roslings.ros2.report import PARTS

    _print(_wanted(PARTS, options), redact="--redact" in others)
    return OK


def _wanted(parts: Collection[Part], options: argparse.Namespace) -> list[Part]:
    return [part for part in parts if not (part.of_packages and options.exclude_packages)]


def _print(parts: list[Part], redact: bool) -> None:
    from roslings.doctor.machine import this_machine
    from roslings.doctor.redact import secrets_of
    from roslings.ros2.report import sections

    secrets = secrets_of(this_machine()) if redact else None
    for section in sections(parts):
        text = "\n".join(section.lines())
        print(secrets.hidden(text) if secrets else text)


def _examine(options: argparse.Namespace, others: list[str]) -> int:
    """The doctor's own words; then the sections on what failed, where they were asked for."""
    from roslings.doctor import cli

    only_reads = {"--list", "--explain"} & set(others)
    if only_reads or not (options.report_failed or options.include_warnings):
        return cli.main(others)
    try:
        seen = cli.look(others)
    except cli.WrongUse as problem:
        print(f"ros2 doctor: {problem}", file=sys.stderr)
        return WRONG_USE
    failed = failed_themes(seen, options.include_warnings)
    if options.report_failed and failed:
        _report_failed(options, failed, redact="--redact" in others)
    return FAILED if failed else OK


def failed_themes(seen: Examination, warnings_too: bool) -> list[str]:
    """The themes of the checks that failed, the worst first."""
    from roslings.doctor.finding import Status

    count = (Status.FAULT, Status.WARNING) if warnings_too else (Status.FAULT,)
    failed = [one.check.theme for one in seen.worst_first() if one.finding.status in count]
    return list(dict.fromkeys(failed))


def _report_failed(options: argparse.Namespace, failed: list[str], redact: bool) -> None:
    from roslings.ros2.report import PARTS

    parts = [part for part in _wanted(PARTS, options) if set(part.themes) & set(failed)]
    if parts:
        _print(parts, redact)
    else:
        print(f"\nNo report is about {', '.join(failed)}: what is said above is all.")
