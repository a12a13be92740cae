"""The references of a card's words and of a grader's actions and demands: whole, and right."""

from __future__ import annotations

import ast
import copy
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml

from roslings.course import all_labs, root
from roslings.course.card import Card, NodeContract
from roslings.course.contract import Contract
from roslings.course.files import BadCourseFile, read_tree, read_yaml
from roslings.course.labs import example_root

sys.path.insert(0, str(root() / "site"))
from course_site import card_words, grader_words

WORDS = [word for words in card_words.card_models().values() for word in words]
OF_GRADERS = [
    *(word for words in grader_words.actions().values() for word in words),
    *(word for words in grader_words.demands().values() for word in words),
    *grader_words.views(),
]
PAGES = root() / "site/pages/teachers"


# --- a card's words ----------------------------------------------------------------------------


@pytest.mark.parametrize("word", WORDS, ids=lambda word: word.key)
def test_each_word_has_a_meaning_and_an_example(word: card_words.Word) -> None:
    """Read as YAML, a card with the example in its place is one that the grader reads."""
    assert word.meaning.strip() and word.type.strip()
    example = word.example
    for text in (example.line, example.block):
        assert yaml.safe_load(text) == {word.name: example.value}
        said = yaml.safe_load(text)[word.name]
        Card.model_validate(with_word(word, example, said))


def with_word(word: card_words.Word, example: card_words.Example, said: Any) -> Any:
    """The lab's card with the word in its place; of an example of no lab, a card that fits it."""
    if example.lab:
        tree, part = part_of_lab(example.lab, example.place)
    else:
        tree, part = part_for(word)
    part[word.name] = said
    return tree


def part_of_lab(lab: str, place: card_words.Steps) -> tuple[Any, Any]:
    """A lab's card, and the part of it in which this word stands."""
    tree = copy.deepcopy(read_tree(root() / "labs" / lab / "card.yaml"))
    part = tree
    for step in place[:-1]:
        part = part[step]
    return tree, part


def part_for(word: card_words.Word) -> tuple[Any, Any]:
    """Beside another word of the same part in some lab; else inside the word that holds the part.

    Where no lab has that word either, its own example makes the part.
    """
    beside = (
        each
        for (model, _), found in card_words.examples().items()
        if model is word.model
        for each in found
    )
    if other := next(beside, None):
        return part_of_lab(other.lab, other.place)
    holder = card_words.holders_of(word.model)[0]
    tree, part = part_for(holder)
    part[holder.name] = copy.deepcopy(holder.example.value)
    return tree, part[holder.name]


def test_an_example_that_is_wrong_is_not_accepted() -> None:
    """What the test above would find."""
    word = next(each for each in WORDS if each.key == "Rate.hz")
    with pytest.raises(ValueError, match="greater than 0"):
        Card.model_validate(with_word(word, word.example, -1.0))


def test_nor_is_one_deep_inside() -> None:
    """Its number is read inside of all that holds it, whether or not a lab has that part."""
    word = next(each for each in WORDS if each.key == "Wall.at_m")
    with pytest.raises(ValueError, match=r"rooms\.wall\.at_m"):
        Card.model_validate(with_word(word, word.example, -1.0))


def test_the_page_shows_what_is_told_of_a_wrong_card(tmp_path: Path) -> None:
    """The message of its example, for the card that new labs begin with."""
    text = (example_root() / "labs/example/card.yaml").read_text("utf-8")
    file = tmp_path / "card.yaml"
    file.write_text(text.replace("hz: 1.0", "hz: 0"), "utf-8")
    with pytest.raises(BadCourseFile) as told:
        read_yaml(file, Card)
    said = str(told.value).removeprefix(f"{tmp_path}/")
    assert f"```text\n{said}\n```" in (PAGES / "card-words.md").read_text("utf-8")


def test_nothing_is_said_of_a_word_twice_or_in_vain() -> None:
    """What a model says of a word stands there alone; examples of labs come first."""
    keys = {word.key: word for word in WORDS}
    assert set(card_words.meanings()) <= set(keys)
    for key, said in card_words.meanings().items():
        word = keys[key]
        assert bool(said.means) is not bool(word.field.description), key
        assert (said.example is not None) is not (
            (word.model, word.name) in card_words.examples()
        ), key


def test_every_part_of_a_card_is_there() -> None:
    """Of what stands in `card.py` and in the capabilities; others are files of their own."""
    brought = {
        each
        for each in parts_of(Contract)
        if each.__module__ == Card.__module__ or each.__module__.endswith(".contract")
    }
    parts = {each for each in brought if not each.__subclasses__() and each.model_fields}
    left = {
        each.__name__
        for each in parts - set(card_words.card_models())
        if each.__module__.startswith("roslings.")
    }
    assert left == {"Hint"}  # a part of hints.yaml


def parts_of(model: type[Contract]) -> Iterator[type[Contract]]:
    """A model's kinds, and theirs."""
    for each in model.__subclasses__():
        yield each
        yield from parts_of(each)


@pytest.mark.parametrize(("model", "thing"), [(Card, "CARD"), (NodeContract, "NODE")])
def test_the_page_tells_how_a_grader_says_a_word(model: type[Contract], thing: str) -> None:
    """By the class of its capability, and never of another one's; the engine's need none."""
    lines = card_words._by_class(model).splitlines()
    brought = {name for each in card_words.brought_to(model) for name in each.model_fields}
    own = next(each for each in model.__mro__[1:] if each.__name__ == model.__name__)
    assert set(model.model_fields) == brought | set(own.model_fields) and brought
    for words in card_words.brought_to(model):
        said = card_words.said_by_class(words)
        (line,) = (line for line in lines if f"`{said}`" in line)
        assert said.startswith(f"{thing}.of({words.__name__}).") and f"`{words.__module__}`" in line
        assert all(f"`{name}`" in line for name in words.model_fields)


@pytest.mark.parametrize(
    ("key", "kind", "unit", "default", "judged"),
    [
        ("Rate.hz", "number", "Hz, times a second", "must be said", "expected"),
        ("Card.ends_within_s", "number", "seconds", "`2.0`", "at most"),
        ("Qos.reliability", "`reliable` or `best_effort`", "", "`reliable`", "expected"),
        ("Node.publishes", "list of [Topic](#card-topic)", "", "none", ""),
        ("Topic.rate", "[Rate](#card-rate)", "", "none", ""),
        ("Parameter.default", "`true`, `false`, number or text", "", "must be said", "expected"),
        ("Node.outcomes", "table: text to [Outcome](#card-outcome)", "", "none", ""),
        ("Card.board", "`true` or `false`", "", "`false`", "prose"),
    ],
)
def test_a_word_is_told_in_words(key: str, kind: str, unit: str, default: str, judged: str) -> None:
    """Type, unit, default, and how it is judged, as a reader sees them."""
    (word,) = (each for each in WORDS if each.key == key)
    assert (word.type, word.unit, word.default, word.judged) == (kind, unit, default, judged)


def test_a_number_with_a_unit_in_its_name_has_a_unit() -> None:
    """The end of the name is the unit, everywhere in the course."""
    for word in WORDS:
        if word.name.endswith(("_s", "_ms", "_px")):
            assert word.unit, word.key


def test_a_lab_cannot_use_a_word_that_the_page_has_not() -> None:
    """Each word of each card, where it stands."""
    listed = {(word.model, word.name) for word in WORDS}
    assert set(card_words.examples()) <= listed
    assert len(all_labs()) > 5


# --- a grader's words --------------------------------------------------------------------------


@pytest.mark.parametrize("word", OF_GRADERS, ids=lambda word: f"{word.module}.{word.key}")
def test_each_action_and_demand_has_an_example(word: grader_words.Word) -> None:
    """Python that uses it, and a sentence of what it does."""
    assert word.about.endswith((".", ":", "."))
    code = word.example
    assert code, "write one behind >>> in its docstring"
    tree = ast.parse(f"{code}\n    pass" if code.endswith(":") else code)
    used = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    used |= {node.attr for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
    assert word.name in used


def graders() -> list[ast.Module]:
    """All of the course; what only one of them needs beside it is no word of others."""
    files = sorted((root() / "graders").glob("grade_*.py"))
    return [ast.parse(file.read_bytes()) for file in files]


def test_all_that_graders_do_is_there() -> None:
    """What they import of the capabilities to act with."""
    listed = {(word.module, word.name) for word in OF_GRADERS}
    for tree in graders():
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom) and node.module in grader_words.actions():
                taken = {(node.module, each.name) for each in node.names}
                assert {each for each in taken - listed if not each[1].isupper()} <= GIVEN


GIVEN = {
    ("roslings.capabilities.camera.act", "Filming"),
    ("roslings.capabilities.parameters.setting", "Setter"),
}
"""Named for the type checker: a block of `with` gives one, and its methods are listed."""


def test_all_that_graders_demand_is_there() -> None:
    """Each name behind `must`, where it is imported from the engine."""
    listed = {word.name for words in grader_words.demands().values() for word in words}
    asked = set[str]()
    for tree in graders():
        taken = {
            each.name
            for node in ast.walk(tree)
            if isinstance(node, ast.ImportFrom)
            for each in node.names
            if (node.module or "").startswith("roslings.")
        }
        asked |= {name for name in demanded_in(tree) if name in taken}
    assert asked <= listed
    assert len(asked) > 80


def demanded_in(tree: ast.Module) -> Iterator[str]:
    """`have_rate` of `must(have_rate(BEAT))`, and `come_up` of `must(come_up)`."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and ast.unparse(node.func).endswith(".must"):
            for each in node.args:
                inner = each.func if isinstance(each, ast.Call) else each
                if isinstance(inner, ast.Name):
                    yield inner.id


@pytest.mark.parametrize(
    ("key", "signature"),
    [
        ("Scene.watch", "(contract: TopicContract)"),
        ("Scene.until", "(condition: Callable[[], bool], within_s: float) -> bool"),
        ("Asker", "(scene: Scene, process: Process, node: NodeContract)"),
        ("have_rate", "(contract: TopicContract) -> Demand[TopicView]"),
        ("come_up", "(process: ProcessView)"),
    ],
)
def test_a_signature_has_types(key: str, signature: str) -> None:
    """As a grader writes it: without `self`."""
    (word,) = (each for each in OF_GRADERS if each.key == key)
    assert word.signature == signature


def test_the_pages_have_all_parts() -> None:
    """The directives stand on them."""
    assert "```{card-words}" in (PAGES / "card-words.md").read_text("utf-8")
    text = (PAGES / "grader-words.md").read_text("utf-8")
    for part in ("actions", "views", "demands"):
        assert f"```{{grader-words}} {part}" in text
