"""The page of all words: one entry and one anchor each, with filters by letter and category."""

from __future__ import annotations

import re
from html import escape

from docutils import nodes
from sphinx.application import Sphinx

from course_site.course import MarkdownDirective, html, lessons_of, name_of, not_in_the_page
from ros2_on_pip.language import said, template
from roslings_learn.lessons import Category, Glossary, Term
from roslings_learn.lessons.translated import A_SENTENCE

FILTER = "Filter the words"


class AllWords(MarkdownDirective):
    """`{all-words}`: filters, then each word as a section."""

    def run(self) -> list[nodes.Node]:
        """Filters and entries."""
        glossary = lessons_of(self.config).glossary
        terms = sorted(glossary.by_id.values(), key=lambda term: (term.name.lower(), term.sense))
        entries = [self._entry(term, glossary.category_of(term)) for term in terms]
        for entry in entries:
            not_in_the_page(entry)
        return [html(_filters(glossary, terms)), *entries]

    def _entry(self, term: Term, category: Category) -> nodes.section:
        section = nodes.section(ids=[term.anchor], names=[], classes=["entry"])
        section["entry"], section["senses"] = term.id, list(category.senses)
        section["classes"] += [f"letter-{term.letter.lower()}", f"category-{slug(category)}"]
        title = nodes.title(term.name, term.name)
        if term.sense:
            title += nodes.inline("", f" ({term.sense})", classes=["sense"])
        section += title
        for part in self._parts(term, category):
            section += part
        return section

    def _parts(self, term: Term, category: Category) -> list[nodes.Node]:
        definition = self.parsed(term.definition)
        definition[0]["classes"].append("definition")
        parts = [*definition, *self.parsed(term.note)]
        if term.example:
            parts.append(_example(term.example))
        return [*parts, *self._see(term), _footnote(term, category, self)]

    def parsed(self, text: str) -> list[nodes.Element]:
        """Paragraphs of Markdown."""
        holder = nodes.container()
        holder.document = self.state.document
        self.state.nested_parse([text], self.content_offset, holder)
        return [node for node in holder.children if isinstance(node, nodes.Element)]

    def _see(self, term: Term) -> list[nodes.Element]:
        if not term.see:
            return []
        known = lessons_of(self.config).glossary.by_id
        links = ", ".join(f"[{known[each].title}](#word-{each})" for each in term.see)
        paragraph = self.parsed(said("site.words.see", "See also: {links}.", links=links))
        paragraph[0]["classes"].append("see")
        return paragraph


def _example(example: str) -> nodes.Element:
    """Code is shown as code, a sentence as a sentence."""
    label = said("site.words.example", "Example: ")
    if A_SENTENCE.fullmatch(example):
        return nodes.paragraph("", f"{label}{example}", classes=["example"])
    paragraph = nodes.paragraph("", "", nodes.Text(label), classes=["example"])
    paragraph += nodes.literal(example, example)
    return paragraph


def _footnote(term: Term, category: Category, directive: AllWords) -> nodes.Element:
    lessons = lessons_of(directive.config)
    beyond = said("site.words.beyond", "Beyond the days of this course")
    where = name_of(lessons.day(term.day)) if term.day else beyond
    parts = [where, _named(category), *([f"ROS 1: {term.ros1}"] if term.ros1 else [])]
    return nodes.paragraph("", " · ".join(parts), classes=["where", "unlinked"])


def slug(category: Category) -> str:
    """A category as a class name."""
    return re.sub(r"[^a-z]+", "-", category.category.lower())


def _named(category: Category) -> str:
    return template(category_id(category), category.category)


def category_id(category: Category) -> str:
    """The id of its name."""
    return f"glossary.categories.{slug(category)}"


def _filters(glossary: Glossary, terms: list[Term]) -> str:
    letters = dict.fromkeys(term.letter for term in sorted(terms, key=lambda term: term.letter))
    by_letter = "".join(_option("letter", each.lower(), each) for each in letters)
    by_category = "".join(
        _option("category", slug(each), _named(each)) for each in glossary.categories
    )
    return (
        f'<form class="word-filter" hidden aria-label="{said("site.words.filter", FILTER)}">'
        f"<fieldset><legend>{said('site.words.letter', 'Letter')}</legend>"
        f"{_option('letter', '', said('site.words.all', 'All'), True)}{by_letter}"
        f"</fieldset><fieldset><legend>{said('site.words.category', 'Category')}</legend>"
        f"{_option('category', '', said('site.words.all', 'All'), True)}{by_category}"
        '</fieldset><p role="status" class="word-count"></p></form>'
    )


def _option(name: str, value: str, text: str, checked: bool = False) -> str:
    return (
        f'<label class="chip"><input type="radio" name="{name}" value="{value}"'
        f"{' checked' if checked else ''}><span>{escape(text)}</span></label>"
    )


class Ros1Words(MarkdownDirective):
    """`{ros1-words}`: the table from ROS 1 to ROS 2, drawn from the glossary."""

    by_id = True

    def markdown(self) -> str:
        """A table, sorted by the ROS 1 name."""
        terms = [term for term in lessons_of(self.config).glossary.by_id.values() if term.ros1]
        rows = [
            f"| {term.ros1} | [{term.title}](#word-{term.id}) | {term.definition} |"
            for term in sorted(terms, key=lambda term: term.ros1.lower())
        ]
        what = said("site.words.what", "what it is")
        return "\n".join([f"| ROS 1 | ROS 2 | {what} |", "| --- | --- | --- |", *rows])


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.add_directive("all-words", AllWords)
    app.add_directive("ros1-words", Ros1Words)
