"""A picture below a cell, with its text alternative.

As HTML with an `img`: JupyterLab and the site then both hand `alt` to who cannot see it. The
picture brings its own white sheet, so that it can be read in a dark theme too.
"""

from __future__ import annotations

import base64
import html
import re
import sys
from dataclasses import dataclass
from typing import Any, Literal

from ros2_on_pip.graph.drawing import STYLE as GRAPH_STYLE
from roslings_rover.palette import colour_of, filled_in

STYLE = (
    "max-width:100%;height:auto;background:#fff;border-radius:8px;padding:4px;"
    f"border:1px solid {colour_of('edge')}"
)
INK = filled_in(
    GRAPH_STYLE
    + """
text {
  fill: var(--ink);
  font-family: ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace;
}
.plot text { fill: var(--soft); font: 12px system-ui, sans-serif; }
.grid { stroke: var(--grid); } .axis { stroke: var(--soft); }
.trace { fill: none; stroke: var(--dot); stroke-width: 1; opacity: .45; }
.dots { stroke: var(--dot); stroke-width: 6; stroke-linecap: round; }
.columns { stroke: var(--dot); stroke-width: 1.2; }
.gap { stroke: var(--bad); stroke-dasharray: 2 4; } .beyond { fill: var(--bad); }
.lost { fill: none; stroke: var(--bad); stroke-width: 2.4; }
"""
)
"""The colours of the lessons' own drawings: nodes blue, topics green."""


@dataclass(frozen=True)
class NotebookPicture:
    """A drawing and the sentences that say the same."""

    content: bytes
    kind: Literal["image/svg+xml", "image/png"]
    alt: str
    width_px: int | None = None
    pixelated: bool = False
    still: bytes | None = None
    """The same without motion, for who asks for less of it: an `img` is not told of that."""

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        """What Jupyter shows: the picture, or the sentences where there are no pictures."""
        return {"text/html": self.html(), "text/plain": self.alt}

    def html(self) -> str:
        """An `img` that holds everything: it needs no file."""
        width = f' width="{self.width_px}"' if self.width_px else ""
        style = STYLE + (";image-rendering:pixelated" if self.pixelated else "")
        alt = html.escape(self.alt)
        image = f'<img src="{self._held(self.content)}" alt="{alt}"{width} style="{style}">'
        if self.still is None:
            return image
        less = f'media="(prefers-reduced-motion: reduce)" srcset="{self._held(self.still)}"'
        return f"<picture><source {less}>{image}</picture>"

    def _held(self, content: bytes) -> str:
        return f"data:{self.kind};base64,{base64.b64encode(content).decode('ascii')}"


def svg_picture(svg: str, alt: str) -> NotebookPicture:
    """A picture of an `svg` element that was written for a page with a style sheet."""
    inside = re.sub(r"^<svg ", '<svg xmlns="http://www.w3.org/2000/svg" ', svg, count=1)
    styled = inside.replace(">", f"><style>{INK}</style>", 1)
    return NotebookPicture(styled.encode("utf-8"), "image/svg+xml", alt)


def show(picture: NotebookPicture) -> None:
    """Show it below the cell; without a notebook, print its text alternative."""
    if not in_a_notebook():
        print(picture.alt)
        return
    from IPython.display import display

    display(picture)


def in_a_notebook() -> bool:
    """A cell runs this, and not a program or a test."""
    return notebook_shell() is not None


def notebook_shell() -> Any | None:
    """IPython's shell; None in a program, which then need not import IPython either."""
    ipython = sys.modules.get("IPython")
    return ipython.get_ipython() if ipython else None
