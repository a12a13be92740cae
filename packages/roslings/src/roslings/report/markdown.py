"""Text for platforms that read Markdown: a student's words stay words, whatever they look like."""

from __future__ import annotations

import re

from ros2_on_pip.language import said
from ros2_on_pip.safe_text import harmless
from roslings.verdict import CheckResult

_SIGNS = re.compile(r"([\\`*_{}\[\]()<>#+\-.!|~&$^])")
_TICKS = re.compile(r"`+")


def escaped(text: str) -> str:
    """One line in which no sign has a meaning in Markdown or HTML."""
    return _SIGNS.sub(r"\\\1", harmless(text))


def block(text: str) -> str:
    """Lines as they are, inside a fence that is longer than any in them."""
    plain = harmless(text, keep_newlines=True)
    fence = "`" * max(3, 1 + max((len(ticks) for ticks in _TICKS.findall(plain)), default=0))
    return f"{fence}text\n{plain}\n{fence}"


def markdown_of(check: CheckResult) -> str:
    """What a check found: what was expected, what was seen, why, what to try, the node's lines."""
    if check.outcome != "fail":
        return escaped(check.why or "")
    rows = {
        said("export.expected", "Expected"): check.expected,
        said("export.measured", "Measured"): check.measured,
        said("export.why", "Why"): check.why,
        said("export.try", "Try"): check.hint,
    }
    parts = [f"**{escaped(label)}:** {escaped(text)}" for label, text in rows.items() if text]
    return "\n\n".join([*parts, *([block("\n".join(check.log))] if check.log else [])])
