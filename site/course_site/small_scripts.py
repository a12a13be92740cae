"""The course's own scripts without their comments and indents, for those who pay by the byte.

A script has its texts in English, each beside its id. In a site in another language the first of
them, which brings the texts to the others, gets what they are there.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from rjsmin import jsmin
from sphinx.application import Sphinx

from ros2_on_pip.language import ENGLISH, FALSE, catalogue, language, template

STATIC = Path(__file__).parents[1] / "static"
TABLE = "const TEXTS = {};"
"""Stands in the script that has the texts of all."""
LITERAL = r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\''
NAMED = re.compile(rf"const english = ({LITERAL});")
ASKED = re.compile(rf'\btext\(\s*"(script\.[\w.]+)",\s*({LITERAL}|english)')
COUNTED = re.compile(rf'\bcounted\(\s*"(script\.[\w.]+)",\s*\w+,\s*({LITERAL}),\s*({LITERAL})')


def write(app: Sphinx, error: Exception | None) -> None:
    """Write them again where Sphinx copied them to."""
    if error or app.builder.format != "html":
        return
    for script in Path(app.confdir, "static").glob("*.js"):
        small = jsmin(in_language(script.read_text("utf-8")))
        Path(app.outdir, "_static", script.name).write_text(small, encoding="utf-8")


def in_language(script: str) -> str:
    """The script; where it has the table of texts, filled in."""
    if language() == ENGLISH or TABLE not in script:
        return script
    table = {name: template(name, english) for name, english in texts_of_scripts()}
    filled_in = json.dumps({**table, **_forms(table)}, ensure_ascii=False)
    return script.replace(TABLE, f"const TEXTS = {filled_in};")


def _forms(table: Mapping[str, str]) -> dict[str, str]:
    """Forms of the plural that English does not have."""
    if language() == FALSE:
        return {}
    counted = {name.removesuffix(".other") for name in table if name.endswith(".other")}
    entries = catalogue(language()).values()
    return {each.id: each.says for each in entries if each.id.rpartition(".")[0] in counted}


def texts_of_scripts() -> Iterator[tuple[str, str]]:
    """The id and the English of each text of the scripts; of one that counts, of each form."""
    for script in sorted(STATIC.glob("*.js")):
        yield from _texts_in(script.read_text("utf-8"))


def _texts_in(script: str) -> Iterator[tuple[str, str]]:
    for found in ASKED.finditer(script):
        if found[2] == "english":  # the last line before it that says what that is
            yield found[1], _read([*NAMED.finditer(script, 0, found.start())][-1][1])
        else:
            yield found[1], _read(found[2])
    for found in COUNTED.finditer(script):
        yield f"{found[1]}.one", _read(found[2])
        yield f"{found[1]}.other", _read(found[3])


def _read(literal: str) -> str:
    """The text that a literal of JavaScript stands for."""
    inside = literal[1:-1]
    return str(json.loads(f'"{inside}"' if literal[0] == '"' else json.dumps(inside)))


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.connect("build-finished", write, priority=800)  # before the sheet looks at their words
