"""A drawing as those of the lessons: a white card with thick lines and large letters, as SVG."""

from __future__ import annotations

from html import escape

WIDTH = 720
"""Of each drawing, as in the lessons: a page shows it 34rem wide or wider."""
BLUE, GREEN, RED, BLACK, AMBER, GREY = (
    "#1f6feb",
    "#1a7f37",
    "#b42318",
    "#444",
    "#9a6700",
    "#d0d7de",
)
PALE = {BLUE: "#eaf2ff", GREEN: "#e9f7ec", AMBER: "#fff8c5", BLACK: "#f6f8fa", RED: "#ffebe9"}
"""The inside of a shape, for its line."""
SMALLEST = 15
"""Pixels of a letter: 11 where a phone shows the drawing 34rem wide."""
ARROW_HEAD = (
    '<marker id="a" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="6" markerHeight="6"'
    ' orient="auto"><path d="M0 0 10 5 0 10z" fill="#444"/></marker>'
)
CALM = "@media (prefers-reduced-motion: reduce) { * { animation: none !important } }"

Point = tuple[float, float]


class Sheet:
    """What is drawn so far; x goes right and y goes down, both in pixels."""

    def __init__(self, title: str, told: str, height: int) -> None:
        """`told` is for those who cannot see it: everything that the drawing shows."""
        self._parts: list[str] = []
        self._style = ""
        self._title, self._told, self._height = title, told, height

    def add(self, *parts: str) -> None:
        """Parts of SVG that another module draws."""
        self._parts += parts

    def moves(self, style: str) -> None:
        """What moves, in CSS: it stands still where a reader asks for less motion."""
        self._style = style

    def box(self, at: Point, size: Point, text: str = "", line: str = BLUE) -> None:
        """A thing of hardware, a computer or a topic; `at` is its upper left corner."""
        (x, y), (width, height) = at, size
        self._parts.append(
            f'<rect x="{x:g}" y="{y:g}" width="{width:g}" height="{height:g}" rx="6"'
            f' fill="{PALE[line]}" stroke="{line}" stroke-width="2"/>'
        )
        if text:
            self.text((x + width / 2, y + height / 2 + 6), text)

    def area(self, at: Point, size: Point, text: str) -> None:
        """A computer with all that runs on it: its name stands in its upper left corner."""
        self.box(at, size, line=BLACK)
        self.text((at[0] + 12, at[1] + 24), text, anchor="start", bold=True)

    def node(self, middle: Point, text: str, width: float = 130) -> None:
        """A node: an oval, as rqt_graph draws it."""
        self._parts.append(
            f'<ellipse cx="{middle[0]:g}" cy="{middle[1]:g}" rx="{width / 2:g}" ry="21"'
            f' fill="{PALE[BLUE]}" stroke="{BLUE}" stroke-width="2"/>'
        )
        self.text((middle[0], middle[1] + 5), text)

    def circle(self, middle: Point, radius: float, line: str = BLACK) -> None:
        """A motor, or an eye of a sensor."""
        self._parts.append(
            f'<circle cx="{middle[0]:g}" cy="{middle[1]:g}" r="{radius:g}" fill="{PALE[line]}"'
            f' stroke="{line}" stroke-width="2"/>'
        )

    def dot(self, middle: Point, colour: str = BLACK) -> None:
        """Where wires are joined."""
        self._parts.append(f'<circle cx="{middle[0]:g}" cy="{middle[1]:g}" r="5" fill="{colour}"/>')

    def wire(self, *points: Point, colour: str = BLACK) -> None:
        """A wire through these points."""
        self._parts.append(_line(points, colour, ""))

    def arrow(self, *points: Point, colour: str = BLACK) -> None:
        """What is said, from the first point to the last one."""
        self._parts.append(_line(points, colour, ' marker-end="url(#a)"'))

    def resistor(self, at: Point, size: Point) -> None:
        """A resistor, as European drawings have it: a box in the wire."""
        self._parts.append(
            f'<rect x="{at[0]:g}" y="{at[1]:g}" width="{size[0]:g}" height="{size[1]:g}"'
            f' fill="#ffffff" stroke="{BLACK}" stroke-width="2.5"/>'
        )

    def text(
        self,
        at: Point,
        text: str,
        *,
        anchor: str = "middle",
        bold: bool = False,
        size: int = 16,
        colour: str = "#111",
    ) -> None:
        """Words; `anchor` is start, middle or end of them."""
        weight = ' font-weight="bold"' if bold else ""
        self._parts.append(
            f'<text x="{at[0]:g}" y="{at[1]:g}" font-size="{max(size, SMALLEST)}"'
            f' text-anchor="{anchor}" fill="{colour}"{weight}>{escape(text)}</text>'
        )

    def svg(self) -> str:
        """The whole drawing."""
        around = f'x="1" y="1" width="{WIDTH - 2}" height="{self._height - 2}" rx="12"'
        return "\n".join(
            [
                f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {self._height}"'
                ' role="img" aria-labelledby="t d" font-family="sans-serif">',
                f'  <title id="t">{escape(self._title)}</title>',
                f'  <desc id="d">{escape(self._told)}</desc>',
                f"  <defs>{ARROW_HEAD}</defs>",
                *([f"  <style>{self._style} {CALM}</style>"] if self._style else []),
                f'  <rect {around} fill="#ffffff" stroke="{GREY}"/>',
                *(f"  {part}" for part in self._parts),
                "</svg>\n",
            ]
        )


def _line(points: tuple[Point, ...], colour: str, end: str) -> str:
    told = " ".join(f"{x:g},{y:g}" for x, y in points)
    return (
        f'<polyline points="{told}" fill="none" stroke="{colour}" stroke-width="2.5"'
        f' stroke-linejoin="round"{end}/>'
    )
