"""The side bar: the theme calls its captions headings without a level, which no reader can use.

And it names its switches in English alone. Each page has the whole bar: what no style and no
script looks at is left out of it.
"""

from __future__ import annotations

import re
from typing import Any

from sphinx.application import Sphinx

from ros2_on_pip.language import said

SWITCH = re.compile('aria-label="Toggle navigation of ([^"]*)"')
UNUSED = re.compile(
    r' role="heading"| class="toctree-l2"| name="toctree-checkbox-\d+"|(?<=reference) internal(?=")'
)
"""The label of a switch finds it by its id, and not by its name."""


def mend_captions(app: Sphinx, page: str, template: str, context: Any, doctree: Any) -> None:
    """Leave the captions plain text: they name lists, and the page has headings of its own."""
    tree = context.get("furo_navigation_tree", "")
    context["furo_navigation_tree"] = SWITCH.sub(_named, UNUSED.sub("", tree))


def _named(switch: re.Match[str]) -> str:
    words = said("site.switch", "Toggle navigation of {page}", page=switch[1])
    return f'aria-label="{words}"'


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.connect("html-page-context", mend_captions, priority=900)  # after the theme's own
