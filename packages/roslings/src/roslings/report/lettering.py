"""Text in a picture: measured before it is drawn, in fonts that have its letters.

Importing this module imports matplotlib only when a `Lettering` is made.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

from ros2_on_pip.graph.line import TextLine

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.font_manager import FontProperties
    from matplotlib.ft2font import FT2Font

# matplotlib brings the first one itself; the others are for letters that it lacks.
FAMILIES = (
    "DejaVu Sans",
    "Noto Sans CJK JP",
    "Noto Sans CJK SC",
    "WenQuanYi Zen Hei",
    "Droid Sans Fallback",
    "Noto Sans Devanagari",
    "FreeSans",
)
MEASURING_DPI = 72.0  # a pixel is a point


class Lettering:
    """Measures and writes lines of text. Raises ModuleNotFoundError without matplotlib."""

    def __init__(self) -> None:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure

        canvas: Any = FigureCanvasAgg(Figure(dpi=MEASURING_DPI))  # matplotlib has no types for it
        self._renderer = canvas.get_renderer()

    def width(self, line: TextLine) -> float:
        """Points that the line takes from left to right."""
        text = _with_known_letters(line.text)
        width, _, _ = self._renderer.get_text_width_height_descent(text, _font(line), False)
        return float(width)

    def write(
        self, axes: Axes, line: TextLine, x: float, top: float, align: str = "center"
    ) -> float:
        """Write the line at `x`, its top at `top`; returns where the next line's top is."""
        axes.text(
            x,
            top + line.size,
            _with_known_letters(line.text),
            fontproperties=_font(line),
            color=line.colour,
            horizontalalignment=align,
            verticalalignment="baseline",
            parse_math=False,
        )
        return top + line.height


def _font(line: TextLine) -> FontProperties:
    from matplotlib.font_manager import FontProperties

    weight = "bold" if line.bold else "normal"
    return FontProperties(family=list(_families()), size=line.size, weight=weight)


@cache
def _families() -> tuple[str, ...]:
    """Those of FAMILIES that this machine has."""
    from matplotlib.font_manager import fontManager

    installed = {font.name for font in fontManager.ttflist}
    return tuple(family for family in FAMILIES if family in installed)


@cache
def _fonts() -> tuple[FT2Font, ...]:
    from matplotlib.font_manager import FontProperties, findfont, get_font

    return tuple(get_font(findfont(FontProperties(family=family))) for family in _families())


def _with_known_letters(text: str) -> str:
    """`text` with the letters that no font here has as escapes, not as empty boxes."""
    return "".join(char if _known(char) else ascii(char)[1:-1] for char in text)


def _known(char: str) -> bool:
    return char.isascii() or any(font.get_char_index(ord(char)) for font in _fonts())
