"""The course's colours under the names that the theme and our own sheet have for them."""

from __future__ import annotations

from roslings_rover.palette import PALETTE, Scheme, colour_of

THEME = {
    "color-brand-primary": "link",
    "color-brand-content": "link",
    "color-foreground-secondary": "soft",
    "color-foreground-muted": "soft",
    "color-background-primary": "ground",
    "course-right": "good",
    "course-wrong": "bad",
    "course-soft": "sheet",
    "course-line": "edge",
    "course-button": "link",
    "course-on-button": "on-link",
}
KINDS = ("node", "topic", "service", "action")


def theme_colours(scheme: Scheme) -> dict[str, str]:
    """The variables of a light or a dark page, without their dashes."""
    own = {name: colour_of(known, scheme) for name, known in THEME.items()}
    kinds = [name for name in PALETTE if name.removesuffix("-edge") in KINDS]
    return own | {f"course-{name}": colour_of(name, scheme) for name in kinds}
