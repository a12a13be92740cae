"""One palette: its contrasts, and that lessons, pictures, verdicts and site keep to it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from roslings.course import root
from roslings.report.html.document import STYLE
from roslings_learn.notebook.picture import svg_picture
from roslings_rover.palette import PALETTE, Scheme, colour_of, filled_in, variables

TEXT = ("ink", "soft", "good", "bad", "open", "link")
GROUNDS = ("ground", "sheet", "node", "topic", "service", "action")
KINDS = ("node", "topic", "service", "action")
DRAWINGS = sorted(root().glob("days/*/pictures/*.svg"))
COLOUR = re.compile(r"#[0-9a-fA-F]{3,6}\b")


def luminance(colour: str) -> float:
    """Relative luminance as WCAG 2.2 defines it, 0 to 1."""
    parts = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    red, green, blue = (p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one: str, other: str) -> float:
    """1 to 21, as WCAG 2.2 defines it."""
    dark, light = sorted((luminance(one), luminance(other)))
    return (light + 0.05) / (dark + 0.05)


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("ground", GROUNDS)
def test_text_can_be_read_on_every_ground(scheme: Scheme, ground: str) -> None:
    """4.5 to 1 for text, 3 to 1 for the edge of a shape."""
    below = colour_of(ground, scheme)
    assert min(contrast(colour_of(name, scheme), below) for name in TEXT) >= 4.5
    edges = [colour_of(f"{kind}-edge", scheme) for kind in KINDS]
    assert min(contrast(edge, below) for edge in edges) >= 3


def test_the_verdicts_style_has_no_colour_of_its_own() -> None:
    """Every colour is a variable, and every variable is known."""
    css = STYLE.read_text("utf-8")
    assert COLOUR.findall(css) == []
    asked = set(re.findall(r"var\(--([\w-]+)\)", css))
    assert asked
    assert asked <= set(PALETTE)
    assert all(f"--{name}:{PALETTE[name].dark};" in variables() for name in asked)


def test_a_picture_of_a_notebook_has_the_same_colours() -> None:
    """It is an image, so the variables are filled in."""
    drawn = svg_picture("<svg ></svg>", "").content.decode()
    assert "var(" not in drawn
    assert colour_of("topic") in drawn
    assert filled_in("a{fill:var(--node)}") == f"a{{fill:{colour_of('node')}}}"


@pytest.mark.parametrize("kind", KINDS[:3])
def test_the_lessons_drawings_use_it(kind: str) -> None:
    """Many shapes have a kind's fill and edge, and none its fill with the edge of another."""
    shapes = [shape for drawing in DRAWINGS for shape in _filled(drawing, colour_of(kind))]
    assert sum(colour_of(f"{kind}-edge") in shape for shape in shapes) > 5
    others = {colour_of(f"{other}-edge") for other in KINDS if other != kind}
    assert [shape for shape in shapes if any(edge in shape for edge in others)] == []


def _filled(drawing: Path, fill: str) -> list[str]:
    return re.findall(rf'<(?:ellipse|rect)[^>]*fill="{fill}"[^>]*>', drawing.read_text("utf-8"))
