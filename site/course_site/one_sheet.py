"""One style sheet for all pages, without the rules that no page can use.

The theme and myst-nb bring rules for many extensions, widgets and terminal colours. A rule stays if
every class and id that it needs stands on some page, or in some script: scripts add them later.
What is inside brackets, such as `:not(.wide)`, is not looked at, but for the choices of `:is()`: so
rather too much stays than too little. Of the variables, those stay that something asks for.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Set
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from rcssmin import cssmin
from sphinx.application import Sphinx

SHEET = "all.css"
PIECE = re.compile(r"""(?:"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*'|url\([^"')]*\)|[^{};"'])*[{};]?""")
HOLDS_RULES = ("@media", "@supports", "@layer", "@container")
NAME = re.compile(r"[.#](-?[A-Za-z_][\w-]*)")
CHOICES = re.compile(r":(?:is|where)\(([^()]*)\)")
ON_PAGES = re.compile(r'\b(?:class|id)="([^"]*)"')
INLINE_SCRIPT = re.compile(r"<script[^>]*>(.+?)</script>", re.DOTALL)
VARIABLE = re.compile(
    r"""(?<=[{;\s])(--[\w-]+)\s*:(?:"[^"]*"|'[^']*'|url\([^"')]*\)|[^;{}"'])*(?:;|(?=}))"""
)
ASKED = re.compile(r"--[\w-]+(?=\s*[,)])")
WORD = re.compile(r"[A-Za-z_][\w-]{2,}")  # shorter ones are variables of a packed script


def without_unused(css: str, known: Set[str]) -> str:
    """The same sheet: no comments, no blanks, and no rule that needs a name outside of `known`."""
    pieces = [found[0] for found in PIECE.finditer(cssmin(css)) if found[0].strip()]
    return "".join(_rules(iter(pieces), known))


def _rules(pieces: Iterator[str], known: Set[str]) -> Iterator[str]:
    """What stands until the closing brace of this level, or the end."""
    for piece in pieces:
        if piece.endswith("}"):
            return
        if not piece.endswith("{"):
            yield piece
            continue
        head = piece.removesuffix("{")
        if head.startswith(HOLDS_RULES):
            inside = "".join(_rules(pieces, known))
        else:
            inside = "".join(_block(pieces))
            head = head if head.startswith("@") else ",".join(_useful(head, known))
        if head and inside:
            yield f"{head}{{{inside}}}"


def _block(pieces: Iterator[str]) -> Iterator[str]:
    """Everything of one block, as it is; also of blocks inside it, such as steps of keyframes."""
    depth = 1
    for piece in pieces:
        depth += piece.endswith("{") - piece.endswith("}")
        if not depth:
            yield piece.removesuffix("}")
            return
        yield piece


def _useful(selectors: str, known: Set[str]) -> Iterator[str]:
    for selector in _parts(selectors):
        if "\\" in selector or _possible(selector, known):
            yield selector.strip()


def _possible(selector: str, known: Set[str]) -> bool:
    needed = set(NAME.findall(_without_brackets(selector)))
    choices = CHOICES.findall(selector)
    return needed <= known and all(any(_useful(choice, known)) for choice in choices)


def _parts(selectors: str) -> Iterator[str]:
    """The selectors between the commas that stand in no bracket."""
    depth, part = 0, ""
    for letter in selectors:
        depth += (letter in "([") - (letter in ")]")
        if letter == "," and not depth:
            yield part
            part = ""
        else:
            part += letter
    yield part


def _without_brackets(selector: str) -> str:
    inner = re.compile(r"\([^()]*\)|\[[^\[\]]*\]")
    while inner.search(selector):
        selector = inner.sub("", selector)
    return selector


def without_unasked(css: str, elsewhere: Set[str]) -> str:
    """The same sheet without variables that neither it nor the pages use (`elsewhere`)."""
    asked = elsewhere.union(ASKED.findall(css))
    less = VARIABLE.sub(lambda found: found[0] if found[1] in asked else "", css)
    return less if less == css else without_unasked(less, elsewhere)  # one may have asked another


def variables_asked(site: Path) -> set[str]:
    """The variables that pages and scripts use themselves."""
    files = [*site.rglob("*.html"), *(site / "_static").rglob("*.js")]
    return {name for file in files for name in ASKED.findall(file.read_text("utf-8"))}


def known_names(site: Path) -> set[str]:
    """Every class and id on the pages, and every word in a script, which may be one."""
    pages = [page.read_text("utf-8") for page in site.rglob("*.html")]
    scripts = [script.read_text("utf-8") for script in (site / "_static").rglob("*.js")]
    scripts += [text for page in pages for text in INLINE_SCRIPT.findall(page)]
    found = {name for page in pages for names in ON_PAGES.findall(page) for name in names.split()}
    return found.union(*(WORD.findall(script) for script in scripts))


@dataclass
class OneSheet:
    """The sheets that pages ask for, until there is one in their place."""

    names: dict[str, None] = field(default_factory=dict)

    def forget(self, app: Sphinx) -> None:
        """Take the last build's sheet away: else pages would ask for it by its old checksum."""
        Path(app.outdir, "_static", SHEET).unlink(missing_ok=True)

    def ask_for_one(
        self, app: Sphinx, page: str, template: str, context: dict[str, Any], doctree: Any
    ) -> None:
        """The page links the one sheet only."""
        sheets = context["css_files"]
        ours = [sheet for sheet in sheets if sheet.filename.endswith(SHEET)]
        self.names.update(dict.fromkeys(sheet.filename for sheet in sheets if sheet not in ours))
        context["css_files"] = ours

    def write(self, app: Sphinx, error: Exception | None) -> None:
        """Write it when all pages are there: then it is known what they use."""
        if error or app.builder.format != "html":
            return
        site = Path(app.outdir)
        known = known_names(site)
        sheets = [(site / name).read_text("utf-8") for name in self.names]
        text = "".join(without_unused(sheet, known) for sheet in sheets)
        less = without_unasked(text, variables_asked(site))
        (site / "_static" / SHEET).write_text(less, encoding="utf-8")


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    sheet = OneSheet()
    app.add_css_file(SHEET, priority=900)
    app.connect("builder-inited", sheet.forget)
    app.connect("html-page-context", sheet.ask_for_one, priority=950)  # after the theme looked
    app.connect("build-finished", sheet.write, priority=900)  # after the theme wrote its colours
