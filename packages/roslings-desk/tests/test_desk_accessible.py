"""Each tab keeps the rules of accessibility: three widths, light and dark, forced colours, keys."""

from __future__ import annotations

from typing import Any

import pytest
from desk_program import Desk

from roslings_desk.tab import BUILT_IN
from skips import imported

Axe = imported("axe_playwright_python.sync_playwright").Axe
pytestmark = pytest.mark.slow

WIDE = 1280
LOOKS = [(width, scheme) for width in (WIDE, WIDE // 2, 390) for scheme in ("light", "dark")]
"""Half of the width is a page at 200 % (WCAG 2.2, 1.4.4); 390 is a telephone."""
CONTROLS = "a[href], button, input, select, textarea, [tabindex='0']"
REACHED = """() => {
    const at = document.activeElement, style = getComputedStyle(at);
    const marked = style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) >= 2;
    return at === document.body ? null : [CONTROLS.indexOf(at), marked, at.outerHTML.slice(0, 120)];
}"""
NO_WEBGL = """
    const made = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
        return /^(experimental-)?webgl|webgpu/.test(kind) ? null : made.call(this, kind, ...more);
    };
"""


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


def test_no_tab_breaks_a_rule_in_forced_colours(context: Any, opened: Desk) -> None:
    """The colours of the system stand in place of all of ours, those of the graph too."""
    page = context.new_page()
    page.emulate_media(forced_colors="active", color_scheme="dark")
    for name in BUILT_IN:
        page.goto(f"{opened.base}/{name}")
        page.get_by_role("heading", level=2).wait_for()
        found = Axe().run(page).response["violations"]
        assert [(each["id"], each["nodes"]) for each in found] == [], name


@pytest.mark.parametrize("name", BUILT_IN)
def test_each_control_of_a_tab_is_reached_by_the_tab_key(
    context: Any, opened: Desk, name: str
) -> None:
    """In the order in which they stand, each with a mark that is seen; none holds the focus."""
    page = context.new_page()
    page.goto(f"{opened.base}/{name}")
    page.get_by_role("heading", level=2).wait_for()
    page.evaluate(f"""() => {{
        const isSeen = (each) => each.checkVisibility() && !each.disabled;
        window.CONTROLS = [...document.querySelectorAll("{CONTROLS}")].filter(isSeen);
    }}""")
    count = page.evaluate("CONTROLS.length")
    reached = []
    for _ in range(count):
        page.keyboard.press("Tab")
        reached.append(page.evaluate(REACHED))
    assert [each and each[0] for each in reached] == list(range(count)), reached
    assert [each for each in reached if not each[1]] == []
    page.keyboard.press("Tab")
    after = page.evaluate(REACHED)
    assert after is None or after[0] == 0, "the focus leaves the page, or begins anew"


def test_no_tab_needs_webgl(context: Any, opened: Desk) -> None:
    """As on a computer whose browser has none."""
    page = context.new_page()
    page.add_init_script(NO_WEBGL)
    errors: list[Any] = []
    page.on("pageerror", lambda error: errors.append(error))
    for name in BUILT_IN:
        page.goto(f"{opened.base}/{name}")
        page.get_by_role("heading", level=2).wait_for()
    assert errors == []
