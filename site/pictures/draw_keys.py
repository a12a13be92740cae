"""Draw a recorded terminal: `python site/pictures/draw_keys.py FILE.svg`.

The first 15 minutes show it as `days/01-install/pictures/keys.svg`: what `./roslings rover --keys`
shows while somebody drives to the red ball. Keys, rover and screen are the program's own; only ROS
between them is left out, so that it looks the same each time.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape
from pathlib import Path

from ros2_on_pip.keyboard import Hands
from roslings_rover.models.differential_drive import Motion
from roslings_rover.rover.driven import DrivenRover
from roslings_rover.rover.rover import Rover
from roslings_rover.rover.running import REMEMBERED
from roslings_rover.rover.text_map import ASCII, cells
from roslings_rover.rover.words import below, beside

WIDE, HIGH = 46, 20
"""Letters of the map in a terminal of 80 columns."""
DRIVE = (
    ("", 1.0),
    ("arrow up", 1.0),
    ("arrow up", 1.0),
    ("arrow left", 0.5),
    ("k", 0.5),
    ("arrow up", 1.0),
    ("arrow up", 1.0),
    ("arrow up", 1.0),
    ("", 3.0),
)
"""Each key, and for how many seconds no other one is pressed."""
CODES = {"arrow up": "\x1b[A", "arrow left": "\x1b[D"}
STEP_S, FRAME_S = 0.02, 0.5
COLUMNS, LINE_PX, LETTER_PX, EDGE_PX = 80, 18.0, 7.83, 12.0
"""A letter of 13 pixels is as wide as this."""
TOLD = (
    "A terminal with a map in letters: walls, a ball, and an arrow that is the rover. A key is"
    " pressed again and again: arrow up, arrow left, k. The rover drives to the ball. At the end"
    " stands: The rover touches the red ball. Well done!"
)
STYLE = """
text { font: 13px ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; fill: #e6e9ee; }
.title { fill: #c9d1dc; } .key { fill: #ffd166; font-weight: bold; }
.frame { visibility: hidden; animation: frame TIMEs step-end infinite; }
.last { visibility: visible; }
@keyframes frame { 0% { visibility: visible } SHARE% { visibility: hidden } }
@media (prefers-reduced-motion: reduce) { * { animation: none !important } }
"""


@dataclass(frozen=True)
class Frame:
    """What the terminal shows, and the key that was pressed last."""

    lines: tuple[str, ...]
    key: str


class SpeakingRover(DrivenRover):
    """It says all that it says with ROS."""

    @property
    def publishes_tf(self) -> bool:
        """Its type comes with the course."""
        return True


def frames() -> Iterator[Frame]:
    """One each half second of the drive."""
    node, hands = SpeakingRover(Rover(seed=0), by_keys=True), Hands()
    for key, for_s in DRIVE:
        if key:
            hands = hands.press(CODES.get(key, key))
            steering = hands.steering
            node.rover.drive(Motion(steering.forward_m_s, steering.turn_rad_s))
        for step in range(round(for_s / STEP_S)):
            if step % round(FRAME_S / STEP_S) == 0:
                yield Frame(tuple(_screen(node)), key)
            _go_on(node)


def _go_on(node: DrivenRover) -> None:
    node.rover.step(STEP_S)
    node.look_for_balls()
    if node.reached:
        node.next_step = REMEMBERED
        node.rover.drive(Motion(0.0, 0.0))


def _screen(node: DrivenRover) -> Iterator[str]:
    rows = ["".join(cell.letter for cell in row) for row in cells(node.rover, WIDE, HIGH, ASCII)]
    words = beside(node)
    words += [""] * (len(rows) - len(words))
    yield from (f"{row}  {said}".rstrip() for row, said in zip(rows, words, strict=False))
    yield ""
    yield from below(node)


def svg() -> str:
    """The recording; its last frame is what stands still."""
    shown = list(frames())
    high = LINE_PX * len(shown[0].lines)
    wide = COLUMNS * LETTER_PX + 2 * EDGE_PX
    time_s = len(shown) * FRAME_S
    style = STYLE.replace("TIME", f"{time_s:g}").replace("SHARE", f"{100 / len(shown):.4g}")
    return "\n".join(
        [
            '<svg class="terminal" xmlns="http://www.w3.org/2000/svg"'
            f' viewBox="0 0 {wide:g} {high + 62:g}" role="img">',
            "<title>A drive by keys, recorded in a terminal</title>",
            f"<desc>{TOLD}</desc>",
            f"<style>{style}</style>",
            f'<rect width="{wide:g}" height="{high + 62:g}" rx="8" fill="#1b1f27"/>',
            f'<path d="M0 28V8Q0 0 8 0H{wide - 8:g}Q{wide:g} 0 {wide:g} 8V28Z" fill="#343b48"/>',
            '<text class="title" x="12" y="19">Terminal 1: ./roslings rover --keys</text>',
            *_drawn(shown, wide, time_s),
            "</svg>\n",
        ]
    )


def _drawn(shown: list[Frame], wide: float, time_s: float) -> Iterator[str]:
    for number, frame in enumerate(shown):
        last = " last" if number == len(shown) - 1 else ""
        later_s = number * FRAME_S - time_s
        yield f'<g class="frame{last}" style="animation-delay:{later_s:g}s">'
        key = f"key: {frame.key}" if frame.key else ""
        yield f'<text class="key" x="{wide - EDGE_PX:g}" y="19" text-anchor="end">{key}</text>'
        for place, line in enumerate(frame.lines):
            y = 50 + LINE_PX * place
            if line:
                yield f'<text x="{EDGE_PX:g}" y="{y:g}" xml:space="preserve">{escape(line)}</text>'
        yield "</g>"


def main(picture: Path) -> None:
    """Write it."""
    picture.write_text(svg(), "utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
