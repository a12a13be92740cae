"""All words of a lab's card, read from the models that read cards, with examples from the labs.

What a word means stands in its `Field(description=...)`, or in `card_words.yaml` beside this file:
a changed description would make every kept proof due. Examples are what the course's own labs say;
words that no lab uses have theirs in that file, too.
"""

from __future__ import annotations

import math
import types
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Literal, Union, get_args, get_origin

import yaml
from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined
from sphinx.application import Sphinx

from course_site.course import MarkdownDirective
from roslings.course.card import Card
from roslings.course.contract import CardWords as WordsOfPackage
from roslings.course.contract import Contract, NodeWords
from roslings.course.files import read_tree
from roslings.course.kinds import Kind, kind_of
from roslings.course.labs import engine_root

MEANINGS = Path(__file__).with_name("card_words.yaml")
UNITS = {
    "_s": "seconds",
    "_ms": "milliseconds",
    "hz": "Hz, times a second",
    "_px": "pixels",
    "_m": "metres",
    "within": "a part: 0.05 is 5 %",
    "loss": "a part: 0.1 is 10 %",
    "number_within": "a part: 0.1 is 10 %",
    "gap_periods": "usual periods",
    "decimals": "digits",
    "keeps": "messages",
    "points": "points",
}
"""End of a word to what its number counts; a longer end goes first."""
PLAIN = {str: "text", float: "number", int: "whole number", bool: "`true` or `false`"}
JUDGED = {
    Kind.EXPECTED: "the package must meet it",
    Kind.TOLERANCE: "how far off still counts: just outside fails, just inside passes",
    Kind.MOST: "nothing may take longer",
    Kind.LEAST: "nothing may be smaller",
    Kind.EDGE: "the program itself refuses what is beyond",
    Kind.KEY: "expected, and the grader finds the thing by it",
    Kind.STIMULUS: "the check says, sets or tries it: a mutant shows that it does",
    Kind.PROMISE: "in words: `promises.yaml` names the check that judges it",
    Kind.PROSE: "for people, or for the grader itself: nothing can be judged by it",
}
"""How `./roslings prove LAB --contract` shows that a word is judged."""
LONGEST_CELL = 48

Steps = tuple[str | int, ...]


@dataclass(frozen=True)
class Example:
    """What a card says, and where in it."""

    lab: str
    """Empty: the example is one of `card_words.yaml`."""
    place: Steps
    value: Any

    @property
    def name(self) -> str:
        """The word itself."""
        return str(self.place[-1])

    @property
    def line(self) -> str:
        """On one line of YAML, as it may stand in a card."""
        value = _in_one_line(self.value)
        return f"{self.name}: {value}"

    @property
    def block(self) -> str:
        """On lines of YAML, as cards are mostly written."""
        return yaml.safe_dump({self.name: self.value}, sort_keys=False, allow_unicode=True).rstrip()


def _in_one_line(value: Any) -> str:
    text = yaml.safe_dump(
        value, default_flow_style=True, sort_keys=False, allow_unicode=True, width=math.inf
    )
    return text.removesuffix("\n").removesuffix("\n...")


@dataclass(frozen=True)
class Word:
    """One word that a card may say."""

    model: type[Contract]
    name: str
    field: FieldInfo

    @property
    def key(self) -> str:
        """As `card_words.yaml` calls it."""
        return f"{self.model.__name__.removesuffix('Contract')}.{self.name}"

    @property
    def type(self) -> str:
        """In words."""
        return _type(self.field.annotation)

    @property
    def bounds(self) -> str:
        """What a number or a text must keep to; empty where it is free."""
        return ", ".join(_bounds(self.field.metadata))

    @property
    def unit(self) -> str:
        """What its number counts; empty where it counts nothing."""
        fits = [end for end in UNITS if self.name.endswith(end)]
        counts = _leaves(self.field.annotation) & {int, float}
        return UNITS[max(fits, key=len)] if fits and counts else ""

    @property
    def default(self) -> str:
        """What holds where a card does not say it."""
        if self.field.is_required():
            return "must be said"
        value = self.field.default
        if value is PydanticUndefined or value is None or value in ((), ""):
            return "none"
        if isinstance(value, Contract):
            return f"`{_in_one_line(value.model_dump())}`"
        return f"`{_in_one_line(value)}`"

    @property
    def meaning(self) -> str:
        """One sentence or less."""
        return self.field.description or meanings()[self.key].means

    @property
    def judged(self) -> str:
        """How `prove` shows that it is; empty where it only holds other words."""
        kind = kind_of(self.field)
        return kind.value if kind else ""

    @property
    def holds(self) -> tuple[type[Contract], ...]:
        """The models of the words inside of it."""
        return tuple(_models(self.field.annotation))

    @property
    def example(self) -> Example:
        """The shortest that a lab of the course has, else that of `card_words.yaml`. KeyError."""
        used = examples().get((self.model, self.name), ())
        return min(used, key=lambda each: len(each.line)) if used else _own_example(self)


@dataclass(frozen=True)
class Said:
    """What `card_words.yaml` says of a word."""

    means: str = ""
    example: Any = None


@cache
def meanings() -> Mapping[str, Said]:
    """Word's key to what is said of it."""
    tree = yaml.safe_load(MEANINGS.read_text("utf-8"))
    return {
        key: Said(**said) if isinstance(said, dict) else Said(said) for key, said in tree.items()
    }


def _own_example(word: Word) -> Example:
    return Example("", (word.name,), meanings()[word.key].example)


@cache
def card_models() -> Mapping[type[Contract], tuple[Word, ...]]:
    """Each model that a card is made of to its words, from the outside to the inside."""
    found: dict[type[Contract], tuple[Word, ...]] = {}
    todo: list[type[Contract]] = [Card]
    while todo:
        model = todo.pop(0)
        if model not in found:
            words = tuple(Word(model, *each) for each in model.model_fields.items())
            found[model] = words
            todo += [each for word in words for each in word.holds]
    return found


@cache
def examples() -> Mapping[tuple[type[Contract], str], tuple[Example, ...]]:
    """What the cards of all labs that lie beside the engine say of each word."""
    found: dict[tuple[type[Contract], str], list[Example]] = {}
    for file in sorted((engine_root() / "labs").glob("*/card.yaml")):
        for model, example in _said(Card, read_tree(file), file.parent.name, ()):
            found.setdefault((model, example.name), []).append(example)
    return {key: tuple(each) for key, each in found.items()}


def _said(
    model: type[Contract], tree: Any, lab: str, place: Steps
) -> Iterator[tuple[type[Contract], Example]]:
    """Every word in a part of a card, with what it says.

    Of a lab whose own words this course does not have, the others are told.
    """
    for name, value in tree.items():
        if name not in model.model_fields:
            continue
        if value not in ([], {}):
            yield model, Example(lab, (*place, name), value)
        for inner in _models(model.model_fields[name].annotation):
            for steps, part in _parts(inner, value, (*place, name)):
                yield from _said(inner, part, lab, steps)


def _parts(model: type[Contract], value: Any, place: Steps) -> Iterator[tuple[Steps, Any]]:
    """The parts of a value that the model reads: it alone, each of a list, each of a table."""
    if isinstance(value, list):
        yield from (((*place, number), each) for number, each in enumerate(value))
    elif isinstance(value, dict) and set(value) <= set(model.model_fields):
        yield place, value
    elif isinstance(value, dict):
        yield from (((*place, name), each) for name, each in value.items())


# --- types in words ----------------------------------------------------------------------------


def _models(annotation: Any) -> Iterator[type[Contract]]:
    if isinstance(annotation, type) and issubclass(annotation, Contract):
        yield annotation
    for each in get_args(annotation):
        yield from _models(each)


def _leaves(annotation: Any) -> set[Any]:
    inner = [each for each in get_args(annotation) if isinstance(each, type) or get_args(each)]
    return {leaf for each in inner for leaf in _leaves(each)} if inner else {annotation}


def _type(annotation: Any) -> str:
    origin, inside = get_origin(annotation), get_args(annotation)
    if annotation in PLAIN:
        return PLAIN[annotation]
    if origin is Literal:
        return " or ".join(f"`{each}`" for each in inside)
    if origin in (Union, types.UnionType):
        return _either([each for each in inside if each is not type(None)])
    if origin is tuple:
        return f"list of {_plural(_type(inside[0]))}"
    if origin is dict:
        return f"table: {_type(inside[0])} to {_type(inside[1])}"
    if next(_models(annotation), None):
        return f"[{title_of(next(_models(annotation)))}](#{anchor_of(next(_models(annotation)))})"
    return _type(inside[0])  # Annotated: what it annotates


def _either(inside: list[Any]) -> str:
    if set(inside) == {bool, int, float, str}:
        return "`true`, `false`, number or text"
    return " or ".join(map(_type, inside))


def _plural(words: str) -> str:
    return f"{words}s" if words in PLAIN.values() else words


def _bounds(metadata: list[Any]) -> Iterator[str]:
    signs = {"gt": "more than", "ge": "at least", "lt": "less than", "le": "at most"}
    for each in metadata:
        for name, words in signs.items():
            if (limit := getattr(each, name, None)) is not None:
                yield f"{words} {limit:g}"
        if pattern := getattr(each, "pattern", None):
            yield f"fits `{pattern}`"


# --- the page ----------------------------------------------------------------------------------


def title_of(model: type[Contract]) -> str:
    """What a part of a card is called."""
    return model.__name__.removesuffix("Contract")


def anchor_of(model: type[Contract]) -> str:
    """Where the page tells of it."""
    return f"card-{title_of(model).lower()}"


class CardWords(MarkdownDirective):
    """`{card-words}`: a section for each part of a card, a row for each word."""

    def markdown(self) -> str:
        """How words are judged, then the parts, from the outside to the inside."""
        rows = [f"| {kind.value} | {about} |" for kind, about in JUDGED.items()]
        kinds = "\n".join(["| judged as | what that means |", "| --- | --- |", *rows])
        parts = (_section(model, words) for model, words in card_models().items())
        return "\n\n".join([kinds, *parts])


def _section(model: type[Contract], words: tuple[Word, ...]) -> str:
    about = (model.__doc__ or "").split("\n\n")[0]
    head = "| word | type | without it | what it means, and how it is judged | example |"
    rows = [head, "| --- | --- | --- | --- | --- |", *map(_row, words)]
    long = [each.example.block for each in words if not each.holds and not _fits(each)]
    title = f"({anchor_of(model)})=\n## {title_of(model)}"
    parts = [title, f"{about} {_where(model)}", _code(_holder_example(model)), "\n".join(rows)]
    return "\n\n".join(filter(None, [*parts, _by_class(model), *map(_code, long)]))


def brought_to(model: type[Contract]) -> list[type[NodeWords | WordsOfPackage]]:
    """The classes by which a grader reaches what capabilities let a card say of this."""
    return [
        each
        for each in model.__mro__
        if issubclass(each, NodeWords | WordsOfPackage)
        and each.model_fields
        and each.__name__ != model.__name__
    ]


def said_by_class(words: type[NodeWords | WordsOfPackage]) -> str:
    """How a grader says the first of its words."""
    thing = "NODE" if issubclass(words, NodeWords) else "CARD"
    return f"{thing}.of({words.__name__}).{next(iter(words.model_fields))}"


def _by_class(model: type[Contract]) -> str:
    """Where its words come from several places; empty for a part whose words are its own."""
    head = "| words | a grader says | and imports the class from |"
    rows = [
        f"| {', '.join(f'`{name}`' for name in each.model_fields)} | `{said_by_class(each)}`"
        f" | `{each.__module__}` |"
        for each in sorted(brought_to(model), key=lambda each: each.__name__)
    ]
    told = "In a grader, the words of a capability are reached by its class."
    return "\n".join([told, "", head, "| --- | --- | --- |", *rows]) if rows else ""


def _code(lines: str) -> str:
    return f"```yaml\n{lines}\n```" if lines else ""


def _fits(word: Word) -> bool:
    return len(word.example.line) <= LONGEST_CELL


def holders_of(model: type[Contract]) -> list[Word]:
    """The words that hold this part of a card."""
    return [word for words in card_models().values() for word in words if model in word.holds]


def _holder_example(model: type[Contract]) -> str:
    """The shortest that holds one of these; empty for the whole card."""
    blocks = [word.example.block for word in holders_of(model)]
    return min(blocks, key=len, default="")


def _where(model: type[Contract]) -> str:
    named = [
        f"`{word.name}` of [{title_of(word.model)}](#{anchor_of(word.model)})"
        for word in holders_of(model)
    ]
    return f"It stands under {', '.join(named)}." if named else "It is the file `card.yaml`."


def _row(word: Word) -> str:
    kind = ", ".join(filter(None, [word.type, word.unit, word.bounds]))
    means = f"{word.meaning} (*{word.judged}*)" if word.judged else word.meaning
    cells = [f"`{word.name}`", kind, word.default, means, _cell(word)]
    return f"| {' | '.join(each.replace('|', chr(92) + '|') for each in cells)} |"


def _cell(word: Word) -> str:
    """The example, where it is short; else where it stands."""
    if word.holds:
        return ", ".join(f"[{title_of(each)}](#{anchor_of(each)})" for each in word.holds)
    return f"`{word.example.line}`" if _fits(word) else "below"


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.add_directive("card-words", CardWords)
