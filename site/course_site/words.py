"""Words of the glossary in the text of pages.

A page links a word by its id: `[nodes](#word-node)`, or the role `{word}`nodes <node>``. Besides,
the first use of a word on a page is linked alone, but only where the word has one sense or the
page names the one it means, and never in headings, code, links or captions. How it is spelt alone
is no proof: "workspace" is a folder to colcon, and the reach of an arm.

In the HTML a word is a link to its entry, which works without JavaScript. `words.js` makes a
button with a popover of it. The definitions stand at the end of the page, where a printed page and
a reader without JavaScript have them too.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from html import escape
from typing import Any

from docutils import nodes
from sphinx.addnodes import pending_xref
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.transforms import SphinxTransform
from sphinx.util import logging
from sphinx.util.docutils import SphinxRole

from course_site.course import html, inline_html, lessons_of
from ros2_on_pip.language import said
from roslings_learn.lessons import Glossary, Term

log = logging.getLogger(__name__)

PAGE = "glossary"
PREFIX = "#word-"
UNTOUCHED = (
    nodes.title,
    nodes.subtitle,
    nodes.rubric,
    nodes.caption,
    nodes.literal,
    nodes.literal_block,
    nodes.reference,
    nodes.raw,
    nodes.thead,
    nodes.term,
    nodes.comment,
    nodes.system_message,
    nodes.field_name,
    nodes.footnote,
    nodes.citation,
    nodes.legend,
    pending_xref,
)
OUTPUT = {"cell_input", "cell_output", "unlinked"}
"""Classes of what a notebook's cell shows, and of parts that want no links."""


class WordNode(nodes.inline):
    """A word that leads to its entry; `term` is the entry's id."""


class WordRole(SphinxRole):
    """`{word}`node`` or `{word}`nodes <node>``."""

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        """Make the link; an unknown id is told where the author wrote it."""
        found = re.fullmatch(r"(.*?)\s*<([^<>]+)>", self.text)
        text, term = found.groups() if found else (self.text, self.text)
        node = WordNode("", text, term=term)
        self.set_source_info(node)
        return [node], []


class LinkedWords(SphinxTransform):
    """Turns `[nodes](#word-node)` into a word, before MyST looks for such a heading."""

    default_priority = 500

    def apply(self, **_: Any) -> None:
        """Replace the links, and check every id."""
        for link in list(self.document.findall(nodes.reference)):
            if link.get("id_link") and link.get("refuri", "").startswith(PREFIX):
                node = WordNode("", term=link["refuri"].removeprefix(PREFIX))
                node.source, node.line = link.source, link.line
                node += link.children
                link.replace_self(node)
        known = lessons_of(self.config).glossary.by_id
        for node in list(self.document.findall(WordNode)):
            _check(node, known)


def _check(node: WordNode, known: dict[str, Term]) -> None:
    if node["term"] not in known:
        log.warning("There is no word '%s' in glossary/.", node["term"], location=node)
        node.replace_self(nodes.inline("", node.astext()))
    elif any(isinstance(each, nodes.title) for each in ancestors(node)):
        log.warning("A heading is no place for the word '%s'.", node["term"], location=node)
        node.replace_self(nodes.inline("", node.astext()))


def ancestors(node: nodes.Node) -> Iterator[nodes.Element]:
    """What a node stands in, from near to far."""
    while (node := node.parent) is not None:
        yield node


# --- linking the first use ---------------------------------------------------------------------


def link_first_uses(app: Sphinx, document: nodes.document) -> None:
    """Link what is certain."""
    glossary = lessons_of(app.config).glossary
    page = senses_of_page(app.env, app.env.docname)
    by_scope: dict[int, Linker] = {}
    for text in list(document.findall(nodes.Text)):
        above = list(ancestors(text))
        scope = next((each for each in above if "senses" in each), document)
        if id(scope) not in by_scope:
            senses = frozenset(scope.get("senses", page))
            by_scope[id(scope)] = Linker(glossary, senses, scope)
        if not any(map(_wants_no_links, above)):
            by_scope[id(scope)].link(text)


def _wants_no_links(node: nodes.Element) -> bool:
    return isinstance(node, (*UNTOUCHED, WordNode)) or bool(OUTPUT & set(node.get("classes", ())))


def senses_of_page(env: BuildEnvironment, page: str) -> frozenset[str]:
    """The senses that a page names: in its first lines, or in the path of days."""
    lessons = lessons_of(env.config)
    named = env.metadata[page].get("senses", "[]")
    of_day = {day.id: day.senses for day in lessons.days}
    senses = json.loads(named) if isinstance(named, str) else named
    for sense in senses:
        if sense not in lessons.glossary.by_id:
            log.warning("There is no word '%s' in glossary/.", sense, location=page)
    return frozenset([*senses, *of_day.get(page.split("/")[1] if "/" in page else "", ())])


class Linker:
    """Links each word once within a page, or within one entry of the glossary."""

    def __init__(self, glossary: Glossary, senses: frozenset[str], scope: nodes.Element) -> None:
        self._meant = {
            form: term
            for spelling in glossary.senses_of
            if (term := glossary.meant(spelling, senses))
            for form in _forms(spelling, term)
        }
        self._seen = {node["term"] for node in scope.findall(WordNode)} | {scope.get("entry")}
        longest_first = sorted(self._meant, key=len, reverse=True)
        choice = "|".join(re.escape(form) for form in longest_first) or r"(?!)"
        self._pattern = re.compile(rf"(?<![\w/.~$-])(?:{choice})(?![\w-]|[/.:]\w|/)")

    def link(self, text: nodes.Text) -> None:
        """Replace a text by its parts, the words in it linked."""
        whole, parts, done = text.astext(), list[nodes.Node](), 0
        for found in self._pattern.finditer(whole):
            term = self._meant[found.group()]
            if term.id in self._seen:
                continue
            self._seen.add(term.id)
            parts += [
                nodes.Text(whole[done : found.start()]),
                WordNode("", found.group(), term=term.id),
            ]
            done = found.end()
        if parts:
            text.parent.replace(text, [*parts, nodes.Text(whole[done:])])


def _forms(spelling: str, term: Term) -> set[str]:
    """How a spelling is written in a text: `node` also begins a sentence, `ROS` is never `ros`."""
    written = {each for each in term.spellings if each.lower() == spelling}
    return written | {each[0].upper() + each[1:] for each in written if each.islower()}


# --- HTML --------------------------------------------------------------------------------------


def add_definitions(app: Sphinx, document: nodes.document, page: str) -> None:
    """Put the definitions of a page's words at its end."""
    used = list(dict.fromkeys(node["term"] for node in document.findall(WordNode)))
    if page == PAGE or not used or app.builder.format != "html":
        return
    glossary = lessons_of(app.config).glossary
    to = app.builder.get_relative_uri(page, PAGE)
    entries = "".join(_definition(glossary.by_id[each], to) for each in used)
    document += html(
        '<section class="page-words" aria-labelledby="page-words"><details>'
        f'<summary><h2 id="page-words">{_title(len(used))}</h2></summary>'
        f"<dl>{entries}</dl></details></section>"
    )


def _title(count: int) -> str:
    return said("site.words.on_page", "Words on this page ({count})", count=count)


def _definition(term: Term, to: str) -> str:
    sense = f' <span class="sense">({escape(term.sense)})</span>' if term.sense else ""
    return (
        f'<div data-entry="{term.id}"><dt><a href="{to}#{term.anchor}">{escape(term.name)}</a>'
        f"{sense}</dt><dd>{inline_html(term.definition)}</dd></div>"
    )


def visit_word(translator: Any, node: WordNode) -> None:
    """Open the link."""
    builder = translator.builder
    to = builder.get_relative_uri(builder.current_docname, PAGE)
    translator.body.append(
        f'<a class="word" data-word="{node["term"]}" href="{to}{PREFIX}{node["term"]}">'
    )


def depart_word(translator: Any, node: WordNode) -> None:
    """Close the link."""
    translator.body.append("</a>")


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.add_node(WordNode, html=(visit_word, depart_word))
    app.add_role("word", WordRole())
    app.add_transform(LinkedWords)
    app.connect("doctree-read", link_first_uses, priority=800)  # the page's first lines are read
    app.connect("doctree-resolved", add_definitions)
