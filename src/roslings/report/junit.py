"""A verdict as JUnit XML: every continuous integration server shows it."""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from roslings.report.safe_text import harmless
from roslings.report.whole_file import write_whole
from roslings.verdict import CheckResult, Verdict

# What XML 1.0 may not hold even as a reference.
_NO_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def write_junit(verdict: Verdict, path: Path) -> None:
    """Write `verdict` to `path`. Raises CannotWrite."""
    write_whole(path, junit_of(verdict))


def junit_of(verdict: Verdict) -> bytes:
    """One test suite; a check is a test case, an inconclusive one is an error."""
    counts = {word: sum(c.outcome == word for c in verdict.checks) for word in ELEMENTS}
    suite = Element(
        "testsuite", name=f"roslings.{verdict.lab}", tests=str(len(verdict.checks)),
        failures=str(counts["fail"]), errors=str(counts["inconclusive"]),
        skipped=str(counts["skip"]), time=f"{verdict.seconds.total:.3f}",
    )  # fmt: skip
    for check in verdict.checks:
        _add(suite, check, verdict)
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
        "expected": check.expected, "measured": check.measured, "why": check.why,
        "try": check.hint,
    }  # fmt: skip
    return [check.title, *(f"{label}: {text}" for label, text in rows.items() if text)]


def _plain(text: str) -> str:
    return _NO_XML.sub("\ufffd", harmless(text, keep_newlines=True))
