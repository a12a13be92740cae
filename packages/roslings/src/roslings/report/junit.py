"""A verdict as JUnit XML: every continuous integration server shows it."""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from ros2_on_pip.safe_text import harmless
from roslings.report.often_said import EXPECTED, MEASURED, TRY, WHY
from roslings.report.refusal import Refusal
from roslings.report.wall_words import held
from roslings.report.whole_file import write_whole
from roslings.verdict import CheckResult, Verdict

# What XML 1.0 may not hold even as a reference.
_NO_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def write_junit(told: Verdict | Refusal, path: Path) -> None:
    """Write a verdict, or why there is none, to `path`. Raises CannotWriteFile."""
    write_whole(path, refused(told) if isinstance(told, Refusal) else junit_of(told))


def junit_of(verdict: Verdict) -> bytes:
    """One test suite; a check is a test case, an inconclusive one is an error."""
    shown = [check for check in verdict.checks if not check.hidden]
    counts = {word: sum(check.outcome == word for check in shown) for word in ELEMENTS}
    suite = Element(
        "testsuite",
        name=f"roslings.{verdict.lab}",
        tests=str(len(shown)),
        failures=str(counts["fail"]),
        errors=str(counts["inconclusive"]),
        skipped=str(counts["skip"]),
        time=f"{verdict.seconds.total:.3f}",
    )
    if words := held(verdict):
        properties = SubElement(suite, "properties")
        SubElement(properties, "property", name="wall", value=str(verdict.environment.wall))
        SubElement(properties, "property", name="wall_about", value=words)
    for check in shown:
        _add(suite, check, verdict)
    return _written(suite)


def refused(refusal: Refusal) -> bytes:
    """One test case that failed, or an error where the machine is at fault."""
    told = "failure" if refusal.is_students else "error"
    suite = Element(
        "testsuite",
        name=f"roslings.{refusal.lab}",
        tests="1",
        skipped="0",
        failures=str(int(told == "failure")),
        errors=str(int(told == "error")),
    )
    case = SubElement(suite, "testcase", classname=f"roslings.{refusal.lab}", name="submission")
    element = SubElement(case, told, message=_plain(refusal.reason), type="Refused")
    element.text = _plain(refusal.text)
    return _written(suite)


def _written(suite: Element) -> bytes:
    indent(suite)
    text = tostring(suite, encoding="unicode")
    return f'<?xml version="1.0" encoding="utf-8"?>\n{text}\n'.encode()


ELEMENTS = {"fail": "failure", "inconclusive": "error", "skip": "skipped"}


def _add(suite: Element, check: CheckResult, verdict: Verdict) -> None:
    words = {"classname": f"roslings.{verdict.lab}.{_plain(verdict.package)}", "name": check.id}
    case = SubElement(suite, "testcase", words)
    if element := ELEMENTS.get(check.outcome):
        told = SubElement(case, element, message=_plain(check.why or check.title))
        if check.outcome == "fail":
            told.set("type", check.fault or "fault")
            told.text = _plain("\n".join(lines_of(check)))


def lines_of(check: CheckResult) -> list[str]:
    """A failure as lines of text."""
    rows = {
        EXPECTED: check.expected,
        MEASURED: check.measured,
        WHY: check.why,
        TRY: check.hint,
    }
    return [check.title, *(f"{label}: {text}" for label, text in rows.items() if text)]


def _plain(text: str) -> str:
    return _NO_XML.sub("\ufffd", harmless(text, keep_newlines=True))
