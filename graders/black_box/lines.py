"""Read the lines that a program writes about a bag, by the templates of the card."""

from __future__ import annotations

import re
import string
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

NUMBER = r"[-+]?\d+(?:\.\d+)?"
FIELDS = {"topic": r"\S+?", "count": r"\d+"}
"""All other fields are numbers."""
Told = Mapping[str, str]
"""What a line says: field to text."""


@dataclass(frozen=True)
class Template:
    """A line of the card, as a pattern of what a program writes."""

    text: str

    def told_in(self, lines: Iterable[str]) -> Iterator[Told]:
        """What each line says that is like this one."""
        pattern = re.compile(self._pattern())
        for line in lines:
            if found := pattern.fullmatch(line.strip()):
                yield found.groupdict()

    def like(self, lines: Iterable[str]) -> list[str]:
        """Lines that begin in the same way, however they go on: nearly right ones."""
        start = self.text.partition("{")[0].strip(" :").lower()
        return [line for line in lines if line.strip().lower().startswith(start)]

    def filled(self, told: Told) -> str:
        """The line that says this."""
        return self.text.format(**told)

    def _pattern(self) -> str:
        parts = []
        for before, field, _, _ in string.Formatter().parse(self.text):
            parts.append(re.escape(before))
            if field:
                parts.append(f"(?P<{field}>{FIELDS.get(field, NUMBER)})")
        return "".join(parts)
