"""The examination as a person reads it: 80 columns, worst first, a summary that tells the truth."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from ros_doctor import typed
from ros_doctor.examine import Examination, Result
from ros_doctor.finding import Finding, Status, Step
from ros_doctor.machine import Machine
from ros_doctor.registry import Check
from ros_doctor.surroundings import in_short

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
    "computer": "Computer",
    "install": "ROS itself",
    "shell": "Terminal",
    "network": "Network",
    "live": "Live",
    "workspace": "Workspace",
    "hardware": "Hardware",
    "desktop": "Screen",
    "notebook": "Notebook",
}
PLURALS = {
    Status.FAULT: ("fault", "faults"),
    Status.WARNING: ("warning", "warnings"),
    Status.ADVICE: ("piece of advice", "pieces of advice"),
    Status.OK: ("well", "well"),
    Status.NOT_APPLICABLE: ("does not apply here", "do not apply here"),
    Status.UNKNOWN: ("could not be looked at", "could not be looked at"),
}


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


def _block(machine: Machine, result: Result, paint: Paint) -> Iterator[str]:
    check, finding = result.check, result.finding
    mark = finding.status.value.upper()
    first, *others = textwrap.wrap(
        finding.found, WIDTH, initial_indent=" " * (len(mark) + 2), subsequent_indent=INDENT
    )
    yield paint(mark, finding.status) + first[len(mark) :]
    yield from others
    if finding.status.needs_a_mend:
        yield from _labelled("You see", check.symptom)
        yield from mend_lines(finding)
    yield from _labelled("More", f"{typed.doctor(machine)} --explain {check.id}")


def mend_lines(finding: Finding) -> Iterator[str]:
    """Yield the steps of a mend; a command stands on its own line, whole, to be copied."""
    label = "Mend"
    for step in finding.mend:
        if step.text:
            yield from _labelled(label, step.text)
            label = ""
        yield from _command(step, label)
        label = ""


def _command(step: Step, label: str) -> Iterator[str]:
    if not step.command:
        return
    if label:
        yield from _labelled(label, "Type this:")
    for line in step.command.splitlines():
        yield f"{INDENT * 3}{line}"


def _labelled(label: str, text: str) -> list[str]:
    start = f"{INDENT}{label:<{LABEL}}"
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
    yield paint("WELL", Status.OK)
    for theme, name in THEMES.items():
        ids = [check.id for check in well if check.theme == theme]
        if ids:
            yield from _labelled(name, ", ".join(ids))
    yield ""


def _not_looked_at(examination: Examination, paint: Paint) -> Iterator[str]:
    unknown = [one for one in examination.results if one.finding.status == Status.UNKNOWN]
    if not unknown:
        return
    yield paint("NOT LOOKED AT", Status.UNKNOWN)
    for one in unknown:
        text = f"{one.check.id}: {one.finding.found}."
        yield from textwrap.wrap(
            re.sub(r"\.\.$", ".", text), WIDTH, initial_indent=INDENT, subsequent_indent=INDENT * 2
        )
    yield ""


def _summary(examination: Examination, paint: Paint) -> Iterator[str]:
    counts = [_counted(examination.count(status), status) for status in PLURALS]
    said = ", ".join(text for text in counts if text)
    number = len(examination.results)
    word = "check" if number == 1 else "checks"
    text = f"{number} {word}: {said}. {_verdict(examination)}"
    for line in _wrapped(text):
        yield paint(line, examination.worst)


def _counted(number: int, status: Status) -> str:
    if not number:
        return ""
    one, many = PLURALS[status]
    return f"{number} {one if number == 1 else many}"


def _verdict(examination: Examination) -> str:
    worst = [one for one in examination.worst_first() if one.finding.status.needs_a_mend]
    again = f"then run {typed.doctor(examination.machine)} again."
    if not worst:
        alone = examination.count(Status.UNKNOWN)
        return "Nothing to mend in what was looked at." if alone else "Nothing to mend."
    if examination.worst == Status.FAULT:
        return f"Mend the first fault ({worst[0].check.id}), {again}"
    if examination.worst == Status.WARNING:
        return "The labs can start. Read the warnings first."
    return "The labs can start. The advice can wait."


def list_lines(checks: Iterable[Check]) -> Iterator[str]:
    """Yield one line a check, by theme, for `--list`."""
    theme = ""
    for check in checks:
        if check.theme != theme:
            theme = check.theme
            yield THEMES[theme]
        yield f"  {check.id:<18}{check.title}"


def explain_lines(result: Result, page: str, paint: Paint) -> Iterator[str]:
    """Yield everything about one check: what it is, why it matters, how it stands here."""
    check = result.check
    yield f"{check.id}: {check.title}"
    yield ""
    yield from _labelled("Looks at", check.looks_at)
    yield from _labelled("You see", check.symptom)
    yield ""
    for paragraph in page.strip().split("\n\n"):
        yield from _wrapped(" ".join(paragraph.split()))
        yield ""
    here = paint(result.finding.status.value.upper(), result.finding.status)
    yield f"On this machine: {here}"
    yield from _labelled("Found", result.finding.found)
    yield from mend_lines(result.finding)
    yield ""
    yield f"Read more: {check.lesson}"
