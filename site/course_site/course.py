"""The course as the extension sees it, read once a build."""

from __future__ import annotations

import hashlib
from functools import lru_cache
from html import escape
from pathlib import Path

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.config import Config
from sphinx.util.docutils import SphinxDirective

import roslings
from roslings_learn.lessons import Lessons, read_lessons
from roslings_learn.lessons.glossary import LINK

WATCHED = (
    "days/path.yaml",
    "days/*/quiz.yaml",
    "glossary/*.yaml",
    "labs/*/card.yaml",
    "graders/**/*.py",
)


def lessons_of(config: Config) -> Lessons:
    """The lessons of this build."""
    return _read(Path(config.course_root))


@lru_cache(maxsize=1)
def _read(root: Path) -> Lessons:
    return read_lessons(root)


def course_digest(root: Path) -> str:
    """Changes when a page must be made anew although its own file is the same."""
    files = [path for pattern in WATCHED for path in root.glob(pattern)]
    own = Path(__file__).parent
    files += [*own.glob("*.py"), *own.glob("*.yaml"), *Path(roslings.__file__).parent.rglob("*.py")]
    files += Path(roslings.__file__).parent.rglob("*.md")
    digest = hashlib.sha256()
    for path in sorted(files):
        digest.update(path.read_bytes())
    return digest.hexdigest()


class MarkdownDirective(SphinxDirective):
    """A directive whose content is Markdown that the course's own files give."""

    def markdown(self) -> str:
        """What to show."""
        raise NotImplementedError

    def run(self) -> list[nodes.Node]:
        """Parse the Markdown in this place, headings included."""
        lines = StringList(self.markdown().splitlines(), source=self.get_source_info()[0])
        holder = nodes.container()
        holder.document = self.state.document
        self.state.nested_parse(lines, self.content_offset, holder, match_titles=True)
        return holder.children


def inline_html(text: str) -> str:
    """A short text of the course as HTML: `code` is kept, a link to a word becomes its words."""
    parts = escape(LINK.sub(r"\1", text), quote=False).split("`")
    inside = [f"<code>{part}</code>" if index % 2 else part for index, part in enumerate(parts)]
    return "".join(inside).replace("\n", " ").strip()


def html(text: str) -> nodes.raw:
    """HTML as it is."""
    return nodes.raw("", text, format="html")
