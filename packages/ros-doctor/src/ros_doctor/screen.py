"""The examination as a person reads it: 80 columns, worst first, a summary that tells the truth."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from ros_doctor import usage
from ros_doctor.examine import Examination, ExaminedCheck
from ros_doctor.finding import Finding, MendStep, Status
from ros_doctor.machine import ExaminedMachine
from ros_doctor.registry import DoctorCheck
from ros_doctor.surroundings import in_short
from ros_doctor.texts import DoctorText, counted, said

WIDTH = 79
INDENT = "  "
LABEL = 11

COLOURS = {
    Status.FAULT: "1;31",
    Status.WARNING: "1;33",
    Status.ADVICE: "1;36",
    Status.UNKNOWN: "1;35",
    Status.OK: "32",
    Status.NOT_APPLICABLE: "2",
}
THEMES = {
    "computer": DoctorText("doctor.theme.computer", "Computer"),
    "install": DoctorText("doctor.theme.install", "ROS itself"),
    "shell": DoctorText("doctor.theme.shell", "Terminal"),
    "network": DoctorText("doctor.theme.network", "Network"),
    "live": DoctorText("doctor.theme.live", "Live"),
    "workspace": DoctorText("doctor.theme.workspace", "Workspace"),
    "hardware": DoctorText("doctor.theme.hardware", "Hardware"),
    "desktop": DoctorText("doctor.theme.desktop", "Screen"),
    "notebook": DoctorText("doctor.theme.notebook", "Notebook"),
}
MARKS = {
    Status.FAULT: DoctorText("doctor.mark.fault", "FAULT"),
    Status.WARNING: DoctorText("doctor.mark.warning", "WARNING"),
    Status.ADVICE: DoctorText("doctor.mark.advice", "ADVICE"),
    Status.UNKNOWN: DoctorText("doctor.mark.unknown", "UNKNOWN"),
    Status.OK: DoctorText("doctor.mark.ok", "OK"),
    Status.NOT_APPLICABLE: DoctorText("doctor.mark.not_applicable", "NOT APPLICABLE"),
}
YOU_SEE, MEND = DoctorText("doctor.label.see", "You see"), DoctorText("doctor.label.mend", "Mend")
MORE = DoctorText("doctor.label.more", "More")
LOOKS_AT = DoctorText("doctor.label.looks_at", "Looks at")
FOUND = DoctorText("doctor.label.found", "Found")
LABELS = (YOU_SEE, MEND, MORE, LOOKS_AT, FOUND, *THEMES.values())
"""All that stand before a text: the longest one sets the column for all."""


@dataclass(frozen=True)
class Paint:
    """Colours, or none."""

    on: bool

    def __call__(self, text: str, status: Status) -> str:
        """Return the text in the colour of a status."""
        return f"\033[{COLOURS[status]}m{text}\033[0m" if self.on else text


def lines_of(examination: Examination, paint: Paint, detailed: bool) -> Iterator[str]:
    """Yield the lines of the whole report; `detailed` also tells of what is well."""
    yield "roslings doctor" if examination.machine.has_course else "ros-doctor"
    yield from _wrapped(in_short(examination.machine))
    yield ""
    for result in examination.worst_first():
        if result.finding.status.needs_a_mend or detailed:
            yield from _block(examination.machine, result, paint)
            yield ""
    if not detailed:
        yield from _well(examination, paint)
    yield from _not_looked_at(examination, paint)
    yield from _summary(examination, paint)


def _block(machine: ExaminedMachine, result: ExaminedCheck, paint: Paint) -> Iterator[str]:
    check, finding = result.check, result.finding
    mark = str(MARKS[finding.status])
    first, *others = textwrap.wrap(
        finding.found, WIDTH, initial_indent=" " * (len(mark) + 2), subsequent_indent=INDENT
    )
    yield paint(mark, finding.status) + first[len(mark) :]
    yield from others
    if finding.status.needs_a_mend:
        yield from _labelled(YOU_SEE, check.told("symptom"))
        yield from mend_lines(finding)
    yield from _labelled(MORE, f"{usage.doctor(machine)} --explain {check.id}")


def mend_lines(finding: Finding) -> Iterator[str]:
    """Yield the steps of a mend; a command stands on its own line, whole, to be copied."""
    label: DoctorText | str = MEND
    for step in finding.mend:
        if step.text:
            yield from _labelled(label, step.text)
            label = ""
        yield from _command(step, label)
        label = ""


def _command(step: MendStep, label: DoctorText | str) -> Iterator[str]:
    if not step.command:
        return
    if label:
        yield from _labelled(label, said("doctor.type_this", "Type this:"))
    for line in step.command.splitlines():
        yield f"{INDENT * 3}{line}"


def _labelled(label: DoctorText | str, text: str) -> list[str]:
    column = max(LABEL, *(len(str(each)) + 1 for each in LABELS))
    start = f"{INDENT}{label!s:<{column}}"
    return textwrap.wrap(
        text,
        WIDTH,
        initial_indent=start,
        subsequent_indent=" " * len(start),
        break_long_words=False,
        break_on_hyphens=False,
    )


def _wrapped(text: str, indent: str = "") -> list[str]:
    return textwrap.wrap(
        text, WIDTH, initial_indent=indent, subsequent_indent=indent, break_on_hyphens=False
    )


def _well(examination: Examination, paint: Paint) -> Iterator[str]:
    well = [one.check for one in examination.results if one.finding.status == Status.OK]
    if not well:
        return
    yield paint(said("doctor.well", "WELL"), Status.OK)
    for theme, name in THEMES.items():
        ids = [check.id for check in well if check.theme == theme]
        if ids:
            yield from _labelled(name, ", ".join(ids))
    yield ""


def _not_looked_at(examination: Examination, paint: Paint) -> Iterator[str]:
    unknown = [one for one in examination.results if one.finding.status == Status.UNKNOWN]
    if not unknown:
        return
    yield paint(said("doctor.not_looked_at", "NOT LOOKED AT"), Status.UNKNOWN)
    for one in unknown:
        text = f"{one.check.id}: {one.finding.found}."
        yield from textwrap.wrap(
            re.sub(r"\.\.$", ".", text), WIDTH, initial_indent=INDENT, subsequent_indent=INDENT * 2
        )
    yield ""


def _summary(examination: Examination, paint: Paint) -> Iterator[str]:
    parts = ", ".join(_parts(examination))
    one, other = "{count} check: {parts}.", "{count} checks: {parts}."
    number = len(examination.results)
    checks = counted("doctor.summary", number, one=one, other=other, parts=parts)
    for line in _wrapped(f"{checks} {_verdict(examination)}"):
        yield paint(line, examination.worst)


def _parts(examination: Examination) -> Iterator[str]:
    """Yield how many checks ended with each status; nothing for none."""
    if number := examination.count(Status.FAULT):
        yield counted("doctor.faults", number, one="{count} fault", other="{count} faults")
    if number := examination.count(Status.WARNING):
        yield counted("doctor.warnings", number, one="{count} warning", other="{count} warnings")
    if number := examination.count(Status.ADVICE):
        one, other = "{count} piece of advice", "{count} pieces of advice"
        yield counted("doctor.pieces", number, one=one, other=other)
    if number := examination.count(Status.OK):
        yield counted("doctor.are_well", number, one="{count} well", other="{count} well")
    if number := examination.count(Status.NOT_APPLICABLE):
        one, other = "{count} does not apply here", "{count} do not apply here"
        yield counted("doctor.do_not_apply", number, one=one, other=other)
    if number := examination.count(Status.UNKNOWN):
        one = other = "{count} could not be looked at"
        yield counted("doctor.unseen", number, one=one, other=other)


def _verdict(examination: Examination) -> str:
    worst = [one for one in examination.worst_first() if one.finding.status.needs_a_mend]
    if not worst and examination.count(Status.UNKNOWN):
        return said("doctor.nothing_seen", "Nothing to mend in what was looked at.")
    if not worst:
        return said("doctor.nothing", "Nothing to mend.")
    if examination.worst == Status.FAULT:
        text = "Mend the first fault ({check}), then run {command} again."
        command = usage.doctor(examination.machine)
        return said("doctor.first_fault", text, check=worst[0].check.id, command=command)
    if examination.worst == Status.WARNING:
        return said("doctor.warnings_first", "The labs can start. Read the warnings first.")
    return said("doctor.advice_waits", "The labs can start. The advice can wait.")


def list_lines(checks: Iterable[DoctorCheck]) -> Iterator[str]:
    """Yield one line a check, by theme, for `--list`."""
    theme = ""
    for check in checks:
        if check.theme != theme:
            theme = check.theme
            yield str(THEMES[theme])
        start = f"  {check.id:<18}"
        yield from textwrap.wrap(
            check.told("title"),
            WIDTH,
            initial_indent=start,
            subsequent_indent=" " * len(start),
            break_on_hyphens=False,
        )


def explain_lines(result: ExaminedCheck, page: str, paint: Paint) -> Iterator[str]:
    """Yield everything about one check: what it is, why it matters, how it stands here."""
    check = result.check
    yield from _wrapped(f"{check.id}: {check.told('title')}")
    yield ""
    yield from _labelled(LOOKS_AT, check.told("looks_at"))
    yield from _labelled(YOU_SEE, check.told("symptom"))
    yield ""
    for paragraph in page.strip().split("\n\n"):
        yield from _wrapped(" ".join(paragraph.split()))
        yield ""
    here = paint(str(MARKS[result.finding.status]), result.finding.status)
    yield said("doctor.on_this_machine", "On this machine: {status}", status=here)
    yield from _labelled(FOUND, result.finding.found)
    yield from mend_lines(result.finding)
    yield ""
    yield said("doctor.read_more", "Read more: {lesson}", lesson=check.lesson)
