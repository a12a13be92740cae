"""What authors wrote in pages, in gettext's files: `.pot` as Sphinx takes it out, `.po`, `.mo`.

A page is one file. What the theme and our templates say is `sphinx.po`, as Sphinx calls it; what
Sphinx itself has in a language need not be in it.
"""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path

import furo
import sphinx
from babel.messages.catalog import Catalog
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po, write_po
from jinja2 import Environment

from ros2_on_pip.false_language import false
from ros2_on_pip.language import FALSE

MESSAGES = "LC_MESSAGES"
THEME = "sphinx"
"""The domain of what stands on every page."""
MADE = ("*/quiz.pot", "*/answers.pot")
"""Pages that are made of texts with ids."""
TEMPLATES = Path(__file__).parents[1] / "templates"
WIDTH = 90
NUMBERED = re.compile(r"^(\d+)([.)] )")
"""A heading such as `1. Get the starter`; alone it would be read as a list."""


def pages_in(pots: Path) -> Iterator[tuple[str, Catalog]]:
    """Each page's name, and what was taken out of it; of the theme, too."""
    for pot in sorted(pots.rglob("*.pot")):
        if not any(pot.match(each) for each in MADE):
            with pot.open("rb") as file:
                yield pot.relative_to(pots).with_suffix("").as_posix(), read_po(file)
    yield THEME, _of_theme()


def _of_theme() -> Catalog:
    """What stands in templates, and what Sphinx says on pages."""
    found = Catalog()
    own = Path(sphinx.__file__).parent / "locale" / "sphinx.pot"
    with own.open("rb") as file:
        for message in read_po(file):
            if message.id:
                found.add(message.id, locations=message.locations)
    environment = Environment(extensions=["jinja2.ext.i18n"])
    for folder in (Path(furo.__file__).parent / "theme" / "furo", TEMPLATES):
        for template in sorted(folder.rglob("*.html")):
            for line, _, message in environment.extract_translations(template.read_text("utf-8")):
                if isinstance(message, str):
                    found.add(message, locations=[(template.name, line)])
    return found


def write_false(pots: Path, folder: Path) -> int:
    """Make the `.mo` files of the false language; 0, as Sphinx says that all is well."""
    for name, catalog in pages_in(pots):
        for message in catalog:
            if isinstance(message.id, str) and message.id:
                message.string = false(message.id)
        _compile(catalog, _place(folder, FALSE, name, ".mo"))
    return 0


def compile_all(languages: Path, folder: Path, language: str) -> None:
    """Make the `.mo` files of what was translated; none of them lies in the course."""
    shutil.rmtree(folder / language, ignore_errors=True)
    source = languages / language / MESSAGES
    for po in sorted(source.rglob("*.po")):
        with po.open("rb") as file:
            catalog = read_po(file)
        name = po.relative_to(source).with_suffix("").as_posix()
        _compile(catalog, _place(folder, language, name, ".mo"))


def merge(pots: Path, languages: Path, language: str) -> None:
    """Bring a translator's `.po` files up to date: what is new is empty, what is gone is kept."""
    for name, template in pages_in(pots):
        po = _place(languages, language, name, ".po")
        catalog = template
        if po.is_file():
            with po.open("rb") as file:
                catalog = read_po(file)
            catalog.update(template)
        written = BytesIO()
        write_po(written, catalog, width=WIDTH, sort_by_file=False, omit_header=False)
        po.parent.mkdir(parents=True, exist_ok=True)
        po.write_bytes(written.getvalue())


def _compile(catalog: Catalog, place: Path) -> None:
    for message in catalog:
        if message.id and isinstance(message.string, str):
            message.string = NUMBERED.sub(r"\1\\\2", message.string)
    place.parent.mkdir(parents=True, exist_ok=True)
    with place.open("wb") as file:
        write_mo(file, catalog)


def _place(folder: Path, language: str, name: str, ending: str) -> Path:
    return folder / language / MESSAGES / f"{name}{ending}"
