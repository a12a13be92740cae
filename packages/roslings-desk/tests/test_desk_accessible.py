"""Each tab keeps the rules of accessibility: two widths, light and dark, and forced colours."""

from __future__ import annotations

from typing import Any

import pytest
from desk_program import Desk

from roslings_desk.tab import BUILT_IN
from skips import imported

Axe = imported("axe_playwright_python.sync_playwright").Axe
pytestmark = pytest.mark.slow

LOOKS = [(width, scheme) for width in (1280, 390) for scheme in ("light", "dark")]


@pytest.mark.parametrize(("width", "scheme"), LOOKS)
def test_no_tab_breaks_a_rule(context: Any, opened: Desk, width: int, scheme: str) -> None:
    """And none is wider than the screen."""
    page = context.new_page()
    page.set_viewport_size({"width": width, "height": 900})
    page.emulate_media(color_scheme=scheme)
    for name in BUILT_IN:
        page.goto(f"{opened.base}/{name}")
        page.get_by_role("heading", level=2).wait_for()
        found = Axe().run(page).response["violations"]
        assert [(each["id"], each["nodes"]) for each in found] == [], name
        assert page.evaluate("document.documentElement.scrollWidth") <= width, name
