"""The rover of the course as all drawings have it, seen from above, its nose to the right.

The front page, each lesson and each lab show this one.
"""

from __future__ import annotations

from collections.abc import Callable
from html import escape

from sheet import AMBER, BLUE, GREEN, RED

TEAL, DARK, LAMP, FLOOR, GREY = "#0a5a55", "#263238", "#ffd166", "#eef6f5", "#c3d5d3"
LARGE = 4.0
"""Scale of the rover that shows its parts; they are drawn in its pixels, from its middle."""


def rover(colour: str = TEAL, *, scale: float = 1.0) -> str:
    """Body, four wheels, a lamp and an arrow."""
    return (
        f'<g transform="scale({scale:g})">{_bare(colour)}'
        f'<circle cx="12" r="6" fill="{LAMP}"/><path d="M-12 -5L-2 0L-12 5Z" fill="#ffffff"/></g>'
    )


def _bare(colour: str) -> str:
    wheels = "".join(
        f'<rect x="{x}" y="{y}" width="13" height="7" rx="3" fill="{DARK}"/>'
        for x in (-20, 7)
        for y in (-20, 13)
    )
    return f'{wheels}<rect x="-24" y="-14" width="48" height="28" rx="8" fill="{colour}"/>'


def placed(x: float, y: float, *parts: str, name: str = "", turned: float = 0) -> str:
    """Parts moved to a place, and turned there by so many degrees, clockwise.

    `name` is a class, of a group within: what moves it in CSS does not take the place away.
    """
    turn = f" rotate({turned:g})" if turned else ""
    held = f' class="{name}"' if name else ""
    return f'<g transform="translate({x:g} {y:g}){turn}"><g{held}>{"".join(parts)}</g></g>'


def floor(x: float, y: float, width: float, height: float) -> str:
    """The room in which it drives."""
    return (
        f'<rect x="{x:g}" y="{y:g}" width="{width:g}" height="{height:g}" rx="12" fill="{FLOOR}"'
        f' stroke="{TEAL}" stroke-width="3"/>'
    )


def waves(colour: str = "#b57a00") -> str:
    """What goes out from here to the right: sound, or words by radio."""
    arcs = "".join(f"M{x} {-x}Q{x + 14} 0 {x} {x}" for x in (8, 16, 24))
    return (
        f'<path d="{arcs}" fill="none" stroke="{colour}" stroke-width="3" stroke-linecap="round"/>'
    )


def bubble(text: str, *, line: str = TEAL, size: int = 15) -> str:
    """Words over the rover; their middle is at 0, their lower edge at 0."""
    wide = len(text) * size * 0.6 + 22
    return (
        f'<rect x="{-wide / 2:g}" y="-30" width="{wide:g}" height="30" rx="9" fill="#ffffff"'
        f' stroke="{line}" stroke-width="2"/>'
        f'<text y="-9" font-size="{size}" text-anchor="middle" fill="#111">{escape(text)}</text>'
    )


def ball(radius: float = 13) -> str:
    """The red ball."""
    return f'<circle r="{radius:g}" fill="#c8372b"/>'


def flag() -> str:
    """A goal."""
    return (
        f'<path d="M0 0V-44" stroke="{DARK}" stroke-width="4" stroke-linecap="round"/>'
        f'<path d="M2 -44L34 -34L2 -22Z" fill="{RED}"/>'
    )


def laptop() -> str:
    """Somebody's computer, from above; its middle is at 0."""
    return (
        f'<rect x="-50" y="-36" width="100" height="64" rx="6" fill="#ffffff" stroke="{DARK}"'
        f' stroke-width="4"/><path d="M-64 38H64" stroke="{DARK}" stroke-width="8"'
        ' stroke-linecap="round"/>'
    )


def button(radius: float = 13) -> str:
    """An emergency stop: red on yellow."""
    return (
        f'<circle r="{radius:g}" fill="{LAMP}"/><circle r="{radius * 0.66:g}" fill="{RED}"'
        ' stroke="#7a1710" stroke-width="2"/>'
    )


# --- the parts of the large rover ----------------------------------------------------------------


def computer() -> str:
    """A Raspberry Pi: ROS runs on it."""
    pins = "".join(f"M{x} -20V-15" for x in range(-28, 18, 6))
    return (
        f'<rect x="-36" y="-24" width="58" height="48" rx="5" fill="#3f9a57" stroke="#e9f7ec"'
        f' stroke-width="2"/><path d="{pins}" stroke="{LAMP}" stroke-width="3"/>'
        '<text y="10" x="-7" font-size="17" text-anchor="middle" fill="#ffffff"'
        ' font-weight="bold">Pi</text>'
    )


def voice() -> str:
    """An antenna."""
    return f'<path d="M-78 -42L-104 -70" stroke="{DARK}" stroke-width="5"/>' + _knob(-78, -42, 9)


def sonar() -> str:
    """Two eyes for sound at the nose."""
    return _knob(92, -28, 12) + _knob(92, 28, 12)


def pace() -> str:
    """A dial: how fast the motors may turn."""
    return (
        '<circle cx="-70" cy="40" r="13" fill="#ffffff" stroke="#57606a" stroke-width="3"/>'
        f'<path d="M-70 40L-62 32" stroke="{RED}" stroke-width="3"/>'
    )


def pilot() -> str:
    """A needle that shows the way to the goal."""
    return (
        '<circle cx="48" cy="-38" r="13" fill="#ffffff" stroke="#57606a" stroke-width="3"/>'
        f'<path d="M40 -32L54 -46L50 -34Z" fill="{RED}"/>'
    )


def cable() -> str:
    """The board of the motors, and its cable."""
    return (
        f'<rect x="-90" y="-20" width="36" height="40" rx="4" fill="{BLUE}" stroke="#eaf2ff"'
        ' stroke-width="2"/><path d="M-54 6C-46 6 -46 -6 -36 -6" fill="none" stroke="#ffffff"'
        ' stroke-width="4"/>'
    )


def eyes() -> str:
    """A camera at the nose."""
    return (
        f'<circle cx="66" r="17" fill="{DARK}"/><circle cx="66" r="10" fill="#4a90c2"/>'
        '<circle cx="63" cy="-3" r="3" fill="#ffffff"/>'
    )


def box() -> str:
    """A black box, which is orange."""
    return (
        '<rect x="28" y="30" width="40" height="22" rx="3" fill="#e8793a" stroke="#ffffff"'
        ' stroke-width="2"/>'
    )


def stop() -> str:
    """The guard before the motors: who presses the button reaches it."""
    return f'<g transform="translate(-14 -41)">{button(13)}</g>'


def laser() -> str:
    """A lidar in the middle of the nose: it turns, and looks all around."""
    return (
        f'<circle cx="37" r="12" fill="{DARK}" stroke="#ffffff" stroke-width="2"/>'
        f'<path d="M37 0L46 -5" stroke="{RED}" stroke-width="3" stroke-linecap="round"/>'
    )


def _knob(x: float, y: float, radius: float) -> str:
    return (
        f'<circle cx="{x:g}" cy="{y:g}" r="{radius:g}" fill="#d0d7de" stroke="#57606a"'
        ' stroke-width="3"/>'
    )


PARTS: dict[int, tuple[Callable[[], str], tuple[float, float]]] = {
    1: (computer, (-7, 0)),
    2: (voice, (-78, -42)),
    3: (sonar, (92, 28)),
    4: (pace, (-70, 40)),
    5: (pilot, (48, -38)),
    6: (cable, (-72, 0)),
    7: (eyes, (66, 0)),
    9: (box, (48, 41)),
    10: (stop, (-14, -41)),
    11: (laser, (37, 0)),
}
"""Day to the part that it brings, and where that is; day 8 brings a second rover."""


def grown(day: int, colour: str = TEAL) -> str:
    """The large rover with all parts that there are at the end of this day."""
    body = f'<g transform="scale({LARGE:g})">{_bare(colour)}</g>'
    return body + "".join(part() for number, (part, _) in PARTS.items() if number <= day)


COLOURS = {"rover": TEAL, "red": "#b3382c", "blue": "#2b62b8", "says": GREEN, "told": AMBER}
