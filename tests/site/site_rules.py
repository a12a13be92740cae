"""What every page of the site must keep: accessibility, the width of the screen, no other host."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from two_days_site import Visit


@dataclass(frozen=True)
class Look:
    """How a page is looked at."""

    width: int
    scheme: str

    @property
    def options(self) -> dict[str, list[str]]:
        """For axe: colours are all that darkness changes; asking for them alone saves time."""
        if self.scheme == "dark":
            return {"runOnly": ["color-contrast"]}
        return {"resultTypes": ["violations"]}


def pages_of(site: Path) -> list[str]:
    """Every page that was built."""
    files = (page.relative_to(site).with_suffix("") for page in site.rglob("*.html"))
    return sorted(str(page) for page in files if page.parts[0] != "_static")


LOADED = re.compile(r'(?:src|href)="([^"?]+\.(?:js|css))')
PICTURE = re.compile(rb'data:image/[^"]+|<svg.*?</svg>', re.DOTALL)
HEAVIEST_BYTES = 200_000


def weight(page: Path) -> tuple[int, int, int]:
    """Bytes of a page without its pictures, of its styles, and of its scripts; not compressed."""
    names = LOADED.findall(page.read_text("utf-8"))
    files = {(page.parent / name).resolve() for name in names}
    styles = sum(file.stat().st_size for file in files if file.suffix == ".css")
    scripts = sum(file.stat().st_size for file in files if file.suffix == ".js")
    return len(PICTURE.sub(b"", page.read_bytes())), styles, scripts


def weight_bytes(page: Path) -> int:
    """All that loads before a page can be read."""
    return sum(weight(page))


def breaches(browser: Any, site: Path, names: Sequence[str], look: Look) -> list[str]:
    """Every rule that one of the pages breaks, said in a line each."""
    context = browser.new_context(
        viewport={"width": look.width, "height": 900}, color_scheme=look.scheme
    )
    context.set_default_timeout(60_000)
    visit = Visit(context, site.as_uri())
    found = [line for name in names for line in _on_page(visit, name, look)]
    context.close()
    found += visit.errors
    return found + [url for url in visit.requests if not url.startswith((visit.base, "data:"))]


def _on_page(visit: Visit, name: str, look: Look) -> Iterator[str]:
    from axe_playwright_python.sync_playwright import Axe

    page = visit.go(f"{name}.html")
    if name.endswith("quiz"):
        page.locator("button.button").first.click()
    snapshot = Axe().run(page, options=look.options).generate_snapshot()
    yield from (f"{name}: {line}" for line in snapshot.splitlines())
    if page.evaluate("document.documentElement.scrollWidth") > look.width:
        yield f"{name} is wider than the screen"
