"""A tree of frames as words for a terminal, as a picture, and as a file for Graphviz."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from xml.sax.saxutils import escape

from ros2_on_pip.frames_heard import NANOSECONDS, FrameHeard, FramesHeard

COLUMN, ROW, MARGIN = 190, 110, 20
BOX_HEIGHT, LETTER = 34, 8.4
"""Of the picture, in pixels; a letter's width."""
LINES, PLAIN = ("├─ ", "└─ ", "│  "), ("|- ", "`- ", "|  ")
"""A branch, the last one, and what goes on beside its own."""


def about(heard: FrameHeard, now_ns: int) -> str:
    """How often a step is said, and how old the last word is."""
    if not heard.moves:
        return "static"
    age_s = (now_ns - heard.newest_ns) / NANOSECONDS
    rate = "once" if heard.rate_hz is None else f"{heard.rate_hz:.1f} Hz"
    return f"{rate}, {age_s:.2f} s old"


# --- words -------------------------------------------------------------------------------------


def words(frames: FramesHeard, now_ns: int, encoding: str = "utf-8") -> str:
    """The trees, each frame below its parent; with lines where the terminal can show them."""
    signs = LINES if "utf" in encoding.lower() else PLAIN
    lines: list[str] = []
    for root in frames.roots:
        lines += [root, *_branches(frames, root, now_ns, signs)]
    return "\n".join(lines)


def _branches(
    frames: FramesHeard, parent: str, now_ns: int, signs: tuple[str, str, str], indent: str = ""
) -> Iterator[str]:
    branch, last, beside = signs
    children = frames.children(parent)
    for child in children:
        ends = child is children[-1]
        name = f"{indent}{last if ends else branch}{child.name}"
        yield f"{name:<32} {about(child, now_ns)}"
        below = indent + ("   " if ends else beside)
        yield from _branches(frames, child.name, now_ns, signs, below)


# --- for Graphviz ------------------------------------------------------------------------------


def graphviz(frames: FramesHeard, now_ns: int) -> str:
    """The text that `dot` reads."""
    edges = [
        f'"{_safe(heard.last_parent)}" -> "{_safe(heard.name)}"[label=" {about(heard, now_ns)}"];'
        for heard in frames.frames.values()
    ]
    return "\n".join(["digraph G {", *edges, "}", ""])


def _safe(name: str) -> str:
    return name.replace("\\", "\\\\").replace('"', '\\"')


# --- a picture ---------------------------------------------------------------------------------


@dataclass(frozen=True)
class Placed:
    """A frame in the picture, in columns and rows."""

    name: str
    column_px: float
    """How wide each column is."""
    column: float
    row: int
    above: Placed | None = None
    label: str = ""

    @property
    def x(self) -> float:
        """Its middle."""
        return MARGIN + (self.column + 0.5) * self.column_px

    @property
    def y(self) -> float:
        """Its middle."""
        return MARGIN + self.row * ROW + BOX_HEIGHT / 2


def svg(frames: FramesHeard, now_ns: int) -> str:
    """A picture that each browser shows."""
    placed = _placed(frames, now_ns)
    width = 2 * MARGIN + placed[0].column_px * (1 + max(each.column for each in placed))
    height = 2 * MARGIN + ROW * max(each.row for each in placed) + BOX_HEIGHT
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}"'
            ' font-family="sans-serif" font-size="14">',
            '<rect width="100%" height="100%" fill="white"/>',
            *(_edge(each, each.above) for each in placed if each.above),
            *map(_box, placed),
            "</svg>",
            "",
        ]
    )


def _placed(frames: FramesHeard, now_ns: int) -> list[Placed]:
    found: list[Placed] = []
    column_px = max(COLUMN, *(_wide(name) + MARGIN for name in (*frames.frames, *frames.roots)))
    column = 0.0
    for root in frames.roots:
        top = Placed(root, column_px, column + (_columns(frames, root) - 1) / 2, 0)
        found += [top, *_below(frames, top, column, now_ns)]
        column += _columns(frames, root)
    return found


def _below(frames: FramesHeard, above: Placed, column: float, now_ns: int) -> Iterator[Placed]:
    for child in frames.children(above.name):
        wide = _columns(frames, child.name)
        middle, label = column + (wide - 1) / 2, about(child, now_ns)
        placed = Placed(child.name, above.column_px, middle, above.row + 1, above, label)
        yield placed
        yield from _below(frames, placed, column, now_ns)
        column += wide


def _columns(frames: FramesHeard, name: str) -> int:
    """As many as it has frames below it that have none."""
    return sum(_columns(frames, child.name) for child in frames.children(name)) or 1


def _wide(name: str) -> float:
    """The box of a name, in pixels."""
    return max(70.0, len(name) * LETTER + 16)


def _box(frame: Placed) -> str:
    wide = _wide(frame.name)
    return (
        f'<rect x="{frame.x - wide / 2:.0f}" y="{frame.y - BOX_HEIGHT / 2:.0f}" width="{wide:.0f}"'
        f' height="{BOX_HEIGHT}" rx="8" fill="#eaf2fb" stroke="#1f5f99"/>'
        f'<text x="{frame.x:.0f}" y="{frame.y + 5:.0f}" text-anchor="middle">'
        f"{escape(frame.name)}</text>"
    )


def _edge(frame: Placed, above: Placed) -> str:
    middle_x, middle_y = (frame.x + above.x) / 2, (frame.y + above.y) / 2
    return (
        f'<line x1="{above.x:.0f}" y1="{above.y:.0f}" x2="{frame.x:.0f}" y2="{frame.y:.0f}"'
        ' stroke="#555"/>'
        f'<rect x="{middle_x - len(frame.label) * 3.5:.0f}" y="{middle_y - 9:.0f}"'
        f' width="{len(frame.label) * 7:.0f}" height="18" fill="white"/>'
        f'<text x="{middle_x:.0f}" y="{middle_y + 4:.0f}" text-anchor="middle" font-size="12"'
        f' fill="#444">{escape(frame.label)}</text>'
    )
