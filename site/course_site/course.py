"""The course as the extension sees it, read once a build."""

from __future__ import annotations

import hashlib
from functools import lru_cache
from html import escape
from pathlib import Path
from typing import ClassVar

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.config import Config
from sphinx.util.docutils import SphinxDirective

import roslings
from ros2_on_pip.language import said
from roslings_learn.lessons import Day, Lessons, read_lessons
from roslings_learn.lessons.glossary import LINK

WATCHED = (
    "days/path.yaml",
    "days/*/quiz.yaml",
    "glossary/*.yaml",
    "labs/*/card.yaml",
    "graders/**/*.py",
    "site/languages/**/*",
)
BEFORE_TRANSLATION = 15
"""The priority of what looks at a page as its author wrote it: Sphinx translates at 20."""


def lessons_of(config: Config) -> Lessons:
    """The lessons of this build."""
    return _read(Path(config.course_root))


@lru_cache(maxsize=1)
def _read(root: Path) -> Lessons:
    return read_lessons(root)


def course_digest(root: Path) -> str:
    """Changes when a page must be made anew although its own file is the same."""
    files = [path for pattern in WATCHED for path in root.glob(pattern) if path.is_file()]
    own = Path(__file__).parent
    files += [*own.glob("*.py"), *own.glob("*.yaml"), *Path(roslings.__file__).parent.rglob("*.py")]
    files += Path(roslings.__file__).parent.rglob("*.md")
    digest = hashlib.sha256()
    for path in sorted(files):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def name_of(day: Day) -> str:
    """As a person says it: `Day 3: Topics`."""
    return said("site.day.name", "Day {day}: {title}", day=day.number, title=day.title)


class MarkdownDirective(SphinxDirective):
    """A directive whose content is Markdown that the course's own files give."""

    by_id: ClassVar[bool] = False
    """Its texts have ids, so no translator finds them in the page, too."""

    def markdown(self) -> str:
        """What to show."""
        raise NotImplementedError

    def run(self) -> list[nodes.Node]:
        """Parse the Markdown in this place, headings included."""
        lines = StringList(self.markdown().splitlines(), source=self.get_source_info()[0])
        holder = nodes.container()
        holder.document = self.state.document
        self.state.nested_parse(lines, self.content_offset, holder, match_titles=True)
        if self.by_id:
            not_in_the_page(holder)
        return holder.children


def not_in_the_page(part: nodes.Element) -> None:
    """Have Sphinx leave the texts of this part to their ids."""
    for each in part.findall(nodes.TextElement):
        if not isinstance(each, nodes.Inline):
            each["translatable"] = False


def inline_html(text: str) -> str:
    """A short text of the course as HTML: `code` is kept, a link to a word becomes its words."""
    parts = escape(LINK.sub(r"\1", text), quote=False).split("`")
    inside = [f"<code>{part}</code>" if index % 2 else part for index, part in enumerate(parts)]
    return "".join(inside).replace("\n", " ").strip()


def html(text: str) -> nodes.raw:
    """HTML as it is."""
    return nodes.raw("", text, format="html")
