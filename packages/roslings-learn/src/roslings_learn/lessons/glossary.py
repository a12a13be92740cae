"""The words of the course. A word with two meanings is two terms, each with its sense."""

from __future__ import annotations

import re
from collections import defaultdict
from dataclasses import dataclass
from functools import cached_property

from pydantic import Field

from roslings_learn.lessons.document import DocumentPart

LINK = re.compile(r"\[([^\]]*)\]\(#word-([^)\s]*)\)")
"""How a text names a term: `[words on the page](#word-ID)`."""


class Term(DocumentPart):
    """One word in one sense."""

    id: str = Field(pattern=r"^[a-z][a-z0-9-]*$", description="Stable: links and anchors use it")
    name: str = Field(min_length=1)
    sense: str = Field(default="", description="Which of several meanings, e.g. `of an arm`")
    definition: str = Field(min_length=1, description="One sentence")
    note: str = Field(min_length=1, description="What else a beginner should know")
    example: str = Field(default="", description="A command, a line of code, or a sentence")
    see: tuple[str, ...] = Field(default=(), description="Ids of other terms")
    day: int | None = Field(default=None, description="Where it is taught; none: beyond the days")
    ros1: str = Field(default="", description="What ROS 1 calls it, where it has a name there")
    also: tuple[str, ...] = Field(default=(), description="Other spellings that mean it")
    link: bool = Field(default=True, description="False: an everyday word, linked by hand only")

    @property
    def title(self) -> str:
        """The name with its sense: `workspace (of an arm)`."""
        return f"{self.name} ({self.sense})" if self.sense else self.name

    @property
    def anchor(self) -> str:
        """Its place on the page of all words."""
        return f"word-{self.id}"

    @property
    def letter(self) -> str:
        """The letter under which it is filed."""
        return next(sign for sign in self.name.upper() if sign.isalnum())

    @property
    def spellings(self) -> tuple[str, ...]:
        """Every way in which a text may write it."""
        plural = () if " " in self.name or self.name.endswith("s") else (f"{self.name}s",)
        return (self.name, *plural, *self.also)


class Category(DocumentPart):
    """One file of `glossary/`: the words of one field."""

    category: str
    about: str
    senses: tuple[str, ...] = Field(default=(), description="What this file's own texts mean")
    terms: tuple[Term, ...] = Field(min_length=1)


@dataclass(frozen=True)
class Glossary:
    """All words of the course."""

    categories: tuple[Category, ...]

    @cached_property
    def by_id(self) -> dict[str, Term]:
        """Id to term."""
        return {term.id: term for each in self.categories for term in each.terms}

    @cached_property
    def senses_of(self) -> dict[str, tuple[Term, ...]]:
        """A spelling in lower case to every term that may be written so."""
        found = defaultdict[str, list[Term]](list)
        for term in self.by_id.values():
            for spelling in dict.fromkeys(each.lower() for each in term.spellings):
                found[spelling].append(term)
        return {spelling: tuple(terms) for spelling, terms in found.items()}

    def meant(self, spelling: str, senses: frozenset[str]) -> Term | None:
        """The one term that a page means by a word, or None where that is not certain.

        `senses` are the ids that the page names. A word with one sense needs none.
        """
        terms = self.senses_of.get(spelling.lower(), ())
        if len(terms) > 1:
            terms = tuple(term for term in terms if term.id in senses)
        return terms[0] if len(terms) == 1 and terms[0].link else None

    def category_of(self, term: Term) -> Category:
        """The file that a term stands in."""
        return next(each for each in self.categories if term in each.terms)
