"""Drawings on a page: no letter is below 11 pixels, and nothing moves where that is not wanted.

On a phone a drawing is not made smaller than its smallest letters bear: it is moved sideways. A
page cannot look into a picture, and a picture in an `img` is not told what its reader wants: both
are settled here, when the page is made.
"""

from __future__ import annotations

import math
import re
from base64 import b64decode
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import unquote
from xml.etree import ElementTree as Xml

from sphinx.application import Sphinx

LEAST_TEXT_PX = 11.0
"""Of a letter, as wide as a page shows the drawing."""
REM_PX = 16.0
IMAGE = re.compile(r'<img\b[^>]*?\bsrc="([^"]+)"[^>]*>')
SIZE = re.compile(r"font-size\s*[:=]\s*[\"']?\s*([\d.]+)|font:[^;}\"]*?([\d.]+)px")
DATA = "data:image/svg+xml;base64,"
MOVES = "@keyframes"
STILL = "-still.svg"
STOP = "<style>* { animation: none !important }</style></svg>"


def smallest_text(svg: str) -> float:
    """The smallest letters of a drawing, in its own units; infinite where it has none.

    Drawings within the drawing count as large as they are shown. Raises ParseError.
    """
    root = Xml.fromstring(svg)
    own = [float(size or short) for size, short in SIZE.findall(_without_data(svg))]
    return min([*own, *_of_drawings_in(root)], default=math.inf)


def _without_data(svg: str) -> str:
    return re.sub(r'"data:[^"]*"', '""', svg)


def _of_drawings_in(root: Xml.Element) -> Iterator[float]:
    for image in (each for each in root.iter() if each.tag.endswith("}image")):
        address = next((v for name, v in image.items() if name.endswith("href")), "")
        if address.startswith(DATA):
            inner = b64decode(address.removeprefix(DATA)).decode()
            scale = float(image.attrib["width"]) / width_of(inner)
            yield smallest_text(inner) * scale


def width_of(svg: str) -> float:
    """In its own units. Raises ParseError, and ValueError for a drawing without a width."""
    root = Xml.fromstring(svg)
    box = root.get("viewBox", "").replace(",", " ").split()
    return float(box[2]) if len(box) == 4 else float(root.get("width", "").removesuffix("px"))


def least_width_px(svg: str) -> int:
    """How wide a page must show it, so that its smallest letters have `LEAST_TEXT_PX`."""
    smallest = smallest_text(svg)
    return 0 if math.isinf(smallest) else math.ceil(width_of(svg) * LEAST_TEXT_PX / smallest)


def still(svg: str) -> str:
    """The same without motion."""
    head, end, _ = svg.rpartition("</svg>")
    return f"{head}{STOP}\n" if end else svg


@dataclass
class Pictures:
    """Drawings of this build that move: each gets a still one beside it."""

    moving: dict[str, str] = field(default_factory=dict)
    """Name of the still one in the site, and its text."""

    def settle(
        self, app: Sphinx, page: str, template: str, context: dict[str, Any], doctree: Any
    ) -> None:
        """Give each drawing of a page its least width, and a still one for who asks for it."""
        find = _finder(app)
        context["body"] = IMAGE.sub(
            lambda tag: self._settled(tag, find(tag[1])), context.get("body", "")
        )

    def _settled(self, tag: re.Match[str], svg: str) -> str:
        address = tag[1]
        if not svg:
            return tag[0]
        least = _least_or_none(svg)
        wide = _styled(tag[0], f"--least:{least / REM_PX:.4g}rem") if least else tag[0]
        if MOVES not in svg or address.startswith("data:"):
            return wide
        calm = address.removesuffix(".svg") + STILL
        self.moving[calm.lstrip("./")] = still(svg)
        return (
            '<picture><source media="(prefers-reduced-motion: reduce)"'
            f' srcset="{calm}">{wide}</picture>'
        )

    def write(self, app: Sphinx, error: Exception | None) -> None:
        """Write the still ones."""
        for name, svg in self.moving.items() if not error else ():
            Path(app.outdir, name).write_text(svg, encoding="utf-8")


def _finder(app: Sphinx) -> Callable[[str], str]:
    """The text of a drawing by its address on a page; empty for another picture."""
    sources = {name: uri for uri, name in app.builder.images.items()}
    folders = {"_images": Path(app.srcdir), "_static": Path(app.confdir, "static")}

    def find(address: str) -> str:
        if address.startswith(DATA):
            return b64decode(address.removeprefix(DATA)).decode()
        *_, folder, name = ("", *unquote(address).split("/"))[-2:]
        if not name.endswith(".svg") or folder not in folders:
            return ""
        file = folders[folder] / (sources.get(name, "") if folder == "_images" else name)
        return file.read_text("utf-8") if file.is_file() else ""

    return find


def _least_or_none(svg: str) -> int:
    """Nothing for a drawing that is no XML: of that the rules of lessons tell."""
    try:
        return least_width_px(svg)
    except (Xml.ParseError, ValueError, KeyError):
        return 0


def _styled(tag: str, style: str) -> str:
    if ' style="' in tag:
        return tag.replace(' style="', f' style="{style};', 1)
    return tag.replace("<img", f'<img style="{style}"', 1)


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    pictures = Pictures()
    app.connect("html-page-context", pictures.settle)
    app.connect("build-finished", pictures.write, priority=700)
