"""The colours of the course, said once: lessons, verdicts, pictures and site have the same.

The lessons' drawings (`days/*/pictures`) are files; the tests see that they keep to it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Scheme = Literal["light", "dark"]


@dataclass(frozen=True)
class Colour:
    """One colour on a light page, and what stands for it on a dark one; both as #rrggbb."""

    light: str
    dark: str


PALETTE = {
    "ground": Colour("#ffffff", "#131416"),
    "sheet": Colour("#eef6f5", "#17262a"),
    "edge": Colour("#c3d5d3", "#35504f"),
    "ink": Colour("#14181f", "#e9edf2"),
    "soft": Colour("#4c555e", "#b4bdc6"),
    "good": Colour("#1d6b2c", "#7ddb8f"),
    "bad": Colour("#a3261b", "#ff9d92"),
    "open": Colour("#7a3ba8", "#d5a8ff"),
    "link": Colour("#0a5a55", "#6fd3c9"),
    "on-link": Colour("#ffffff", "#06201e"),
    "node": Colour("#eaf2ff", "#1e335c"),
    "node-edge": Colour("#1f6feb", "#9dbdff"),
    "topic": Colour("#e9f7ec", "#143d22"),
    "topic-edge": Colour("#1a7f37", "#7ddb8f"),
    "service": Colour("#fff8e5", "#463a12"),
    "service-edge": Colour("#9a6700", "#f0cf7a"),
    "action": Colour("#f7effd", "#3a2558"),
    "action-edge": Colour("#7a3ba8", "#d5a8ff"),
    "arrow": Colour("#444444", "#b4bdc6"),
    "dot": Colour("#1f6feb", "#9dbdff"),
    "band": Colour("#cdeed6", "#1d4a2b"),
    "grid": Colour("#e4e7ec", "#2b323c"),
}
"""Each text colour has a contrast of at least 4.5 to 1 (WCAG 2.2, 1.4.3). It has it on `ground`, on
`sheet`, and on the fill of a node, a topic, a service and an action."""


def colour_of(name: str, scheme: Scheme = "light") -> str:
    """The colour `name` as #rrggbb. Raises KeyError."""
    colour = PALETTE[name]
    return colour.light if scheme == "light" else colour.dark


def declared(scheme: Scheme) -> str:
    """The colours as declarations of CSS variables: `--node:#eaf2ff;...`."""
    return "".join(f"--{name}:{colour_of(name, scheme)};" for name in PALETTE)


def variables() -> str:
    """Rules of CSS that set the variables: dark where the reader asks for it, and never in print.

    `color-scheme` tells the browser's own parts (scroll bars, buttons) the same.
    """
    return (
        f":root{{color-scheme:light dark;{declared('light')}}}"
        f"@media screen and (prefers-color-scheme:dark){{:root{{{declared('dark')}}}}}"
        "@media print{:root{color-scheme:light}}"
    )


def filled_in(css: str) -> str:
    """The style with each `var(--NAME)` as the light colour: for a picture, which has no page."""
    for name in PALETTE:
        css = css.replace(f"var(--{name})", colour_of(name))
    return css
