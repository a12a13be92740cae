"""Draw the front page's room: `python site/pictures/draw_room.py FILE.svg`.

The front page shows it as `site/static/rover.svg`: the rover of all drawings drives along its way,
again and again. It stands still for who asks for less motion.
"""

from __future__ import annotations

import sys
from pathlib import Path

from rover import FLOOR, GREY, TEAL, ball, flag, placed, rover, waves
from sheet import CALM

WIDE, HIGH = 304, 400
WAY = "M70 300C60 200 70 130 110 96S224 60 238 130S150 190 160 240S262 262 250 316S80 372 70 300Z"
LAP_S = 16
STYLE = f"""
.rover {{ offset-path: path("{WAY}"); offset-rotate: auto; offset-distance: 12%;
animation: drive {LAP_S}s linear infinite }}
.wave {{ opacity: 0.6; animation: ping 1.4s ease-out infinite }}
@keyframes drive {{ 0% {{ offset-distance: 0% }} 100% {{ offset-distance: 100% }} }}
@keyframes ping {{ 0% {{ opacity: 0.9 }} 100% {{ opacity: 0 }} }}
{CALM}
"""


def room() -> str:
    """All of it."""
    around = f'x="3" y="3" width="{WIDE - 6}" height="{HIGH - 6}" rx="14"'
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDE} {HIGH}" width="{WIDE}"'
            f' height="{HIGH}" role="img" aria-label="A rover drives round a room">',
            f"<style>{STYLE}</style>",
            f'<rect {around} fill="{FLOOR}" stroke="{TEAL}" stroke-width="5"/>',
            f'<path d="M3 180H44M301 210H250" stroke="{TEAL}" stroke-width="6"'
            ' stroke-linecap="round"/>',
            f'<rect x="140" y="118" width="52" height="36" rx="6" fill="{GREY}"/>',
            f'<circle cx="115" cy="212" r="16" fill="{GREY}"/>',
            f'<path d="{WAY}" fill="none" stroke="#3f8d86" stroke-width="3" stroke-dasharray="3 9"'
            ' stroke-linecap="round"/>',
            placed(190, 324, ball()),
            placed(30, 112, flag()),
            f'<g class="rover"><g class="wave">{placed(22, 0, waves())}</g>{rover(scale=1.2)}</g>',
            "</svg>\n",
        ]
    )


def main(picture: Path) -> None:
    """Write it."""
    picture.write_text(room(), "utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
