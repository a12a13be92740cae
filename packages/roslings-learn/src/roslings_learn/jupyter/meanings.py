"""What a word means, shown where it is pointed at: a lesson's links to words get a title.

On the site a word opens its meaning. JupyterLab has no such place to go to, but it shows titles.
"""

from __future__ import annotations

import json
import re
from typing import Any

from roslings_learn.lessons import Glossary
from roslings_learn.lessons.glossary import LINK, Term


def with_meanings(notebook: bytes, glossary: Glossary) -> bytes:
    """The notebook's text, each link to a word with the word's meaning; else as it is.

    What is no notebook is left as it is, too: to tell of it is not this function's work.
    """
    try:
        content = json.loads(notebook)
        cells = [cell for cell in content["cells"] if cell["cell_type"] == "markdown"]
    except (ValueError, KeyError, TypeError):
        return notebook
    for cell in cells:
        cell["source"] = _told(cell["source"], glossary)
    end = notebook[len(notebook.rstrip()) :]
    return json.dumps(content, indent=1, ensure_ascii=False).encode() + end


def _told(source: Any, glossary: Glossary) -> Any:
    if isinstance(source, list):
        return [_told(line, glossary) for line in source]
    return LINK.sub(lambda found: _link(found, glossary), source)


def _link(found: re.Match[str], glossary: Glossary) -> str:
    term = glossary.by_id.get(found[2])
    return f'[{found[1]}](#word-{found[2]} "{title_of(term)}")' if term else found[0]


def title_of(term: Term) -> str:
    """Its meaning as a title can hold it: one line, no marks, no sign that ends it."""
    plain = LINK.sub(r"\1", f"{term.title}: {term.definition}").replace("`", "")
    plain = plain.replace('"', "'").replace("|", "/").replace("\\", "/")
    return " ".join(plain.split())
