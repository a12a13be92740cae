"""A line of text in a picture of the graph."""

from __future__ import annotations

from dataclasses import dataclass

# Both have a contrast of at least 7:1 on every ground that we draw (WCAG 2.2, 1.4.6).
INK, WARNING = "#111827", "#7f0000"


@dataclass(frozen=True)
class TextLine:
    """One line of text; `size` in points."""

    text: str
    size: float = 11.0
    colour: str = INK
    bold: bool = False

    @property
    def height(self) -> float:
        """Points from this line's top to the next one's."""
        return self.size * 1.3
