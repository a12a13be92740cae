"""Each student's own card: what the course's labs let be chosen, and what becomes of it."""

from __future__ import annotations

import re
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from roslings.course import Lab, all_labs, root, variants
from roslings.course.contract import as_typed
from roslings.course.files import BadCourseFile, read_yaml
from roslings.course.task import is_current
from roslings.course.variants import LabVariant, Variants, VariantWord, chosen, variants_of
from roslings_prove.variants import InOwnWords, SolutionEdits, all_values

LABS = [lab for lab in all_labs() if variants_of(lab)]
NAMES = [f"s{number}" for number in range(1000, 1200)]


def words(lab: Lab) -> Variants:
    """What may be chosen."""
    found = variants_of(lab)
    assert found
    return found


def made(lab: Lab, said: dict[str, variants.Plain], folder: Path) -> Lab:
    """The lab, in a course with these words."""
    where = LabVariant(lab, words(lab), said).make(folder)
    return Lab(lab.name, where / "labs" / lab.name, where / "graders" / lab.grader.name)


CHOICES = [
    pytest.param(lab, said, id=f"{lab.name}-{number}")
    for lab in LABS
    for number, said in enumerate(all_values(words(lab)))
]


def test_two_labs_have_cards_of_students_own() -> None:
    """A rate of messages, a name, a limit and a text are among their words."""
    assert [lab.name for lab in LABS] == ["topics", "services"]
    assert {name for lab in LABS for name in words(lab).words} >= {
        "rate",
        "service",
        "limit",
        "text",
    }


@pytest.mark.parametrize(("lab", "said"), CHOICES)
def test_card_task_hints_and_starter_say_the_same(
    lab: Lab, said: dict[str, variants.Plain], tmp_path: Path
) -> None:
    """The new words where the card's own stood, and those nowhere any more."""
    own = made(lab, said, tmp_path / "course")
    assert own.card.points == lab.card.points and is_current(own)
    task, hints = own.task.read_text("utf-8"), (own.folder / "hints.yaml").read_text("utf-8")
    assert own.hints.keys() == lab.hints.keys()
    for name, value in said.items():
        word = words(lab).words[name]
        at = LabVariant(lab, words(lab), said)
        before = at.value_before(name)
        if isinstance(value, str) and "{" not in value:
            gone = rf"(?<![\w/]){re.escape(before)}(?![\w/])"
            assert re.search(gone, task + hints) is None
            assert value in task
        for edit in word.starter:
            text = (own.starter / edit.file).read_text("utf-8")
            assert as_typed(value) in text and edit.find not in text


@pytest.mark.parametrize(("lab", "said"), CHOICES)
def test_no_sentence_says_a_number_of_the_card(lab: Lab, said: dict[str, variants.Plain]) -> None:
    """It would be another student's."""
    sections = re.compile(r"<!-- card: (\w+) -->\n.*?<!-- /card -->", re.DOTALL)
    prose = sections.sub("", lab.task.read_text("utf-8"))
    prose += (lab.folder / "hints.yaml").read_text("utf-8")
    for name, value in said.items():
        before = LabVariant(lab, words(lab), said).value_before(name)
        if not isinstance(value, str):
            assert not re.search(rf"(?<![\w.]){before:g} ?(Hz|m/s)", prose), name


@pytest.mark.parametrize(("lab", "said"), CHOICES)
def test_the_solution_can_be_written_in_these_words(
    lab: Lab, said: dict[str, variants.Plain], tmp_path: Path
) -> None:
    """Each word stands somewhere in it, once."""
    edits = read_yaml(lab.folder / "variants_solution.yaml", SolutionEdits)
    assert edits.root.keys() == said.keys()
    package = InOwnWords(lab, said, tmp_path, edits).make(tmp_path)
    texts = "".join(file.read_text("utf-8") for file in package.rglob("*.py"))
    compile(texts.replace("from __future__", "#"), "all of it", "exec")
    assert all(as_typed(value) in texts for value in said.values())


def test_a_students_course_is_the_course_with_one_lab_written_anew(tmp_path: Path) -> None:
    """Everything else is linked; nothing in it holds an answer or a second choice."""
    lab = LABS[0]
    where = chosen(lab, "Ada").make(tmp_path / "course")
    assert {each.name for each in (where / "labs").iterdir()} == {each.name for each in all_labs()}
    assert (where / "days").resolve() == root() / "days"
    there = {each.name for each in (where / "labs" / lab.name).iterdir()}
    assert there == {
        "card.yaml",
        "hints.yaml",
        "task.md",
        "starter",
        "pictures",
        "ruff.toml",
        "works.yaml",
    }
    assert not (where / "labs" / lab.name).is_symlink()


def test_each_value_is_somebodys() -> None:
    """And no value is of everybody: of 200 students each has about a third of those with three."""
    for lab in LABS:
        for name, word in words(lab).words.items():
            told = [words(lab).chosen(lab.name, each)[name] for each in NAMES]
            assert all(told.count(value) > 200 / len(word.values) / 2 for value in word.values)


def test_the_same_name_has_the_same_card_however_it_is_written() -> None:
    """Another name, another lab and another term have others."""
    lab = LABS[0]
    of = words(lab).chosen
    assert (
        of(lab.name, "Ada Lovelace")
        == of(lab.name, " ada-lovelace ")
        == of(lab.name, "ADA_LOVELACE")
    )
    assert of(lab.name, "Zoe\u0308") == of(lab.name, "Zo\u00eb")
    later = words(lab).model_copy(update={"term": "another"})
    changed = sum(later.chosen(lab.name, each) != of(lab.name, each) for each in NAMES)
    assert changed > 150


# --- what is written wrong ---------------------------------------------------------------------


@pytest.fixture
def copied(tmp_path: Path) -> Lab:
    """A lab whose choices may be changed."""
    lab = LABS[0]
    shutil.copytree(lab.folder, tmp_path / "labs" / lab.name)
    shutil.copytree(lab.grader.parent, tmp_path / "graders")
    folder = tmp_path / "labs" / lab.name
    return replace(lab, folder=folder, grader=tmp_path / "graders" / lab.grader.name)


@pytest.mark.parametrize(
    ("before", "after", "line", "words_of_it"),
    [
        ("nodes.1.log:", "nodes.7.log:", 13, "the card has nothing at nodes.7.log"),
        ("rate.hz:", "rate.herz:", 7, "the card has nothing at nodes.0.publishes.0.rate.herz"),
        ('rate.hz: "{value}"', 'rate.hz: "{hz}"', 7, "write {value} where the word stands"),
        ("nodes.1.log:", "points.rate:", 13, "points.rate: everybody has the same"),
        ("nodes.1.log:", "package:", 13, "package: everybody has the same"),
        ("[1.0, 4.0, 5.0]", "[1.0]", 8, "at least 2 items"),
        ("values: [1.0", "valves: [1.0", 7, "values: Field required"),
        ("words:\n", "words: {}\nmore:\n", 5, "at least 1 item"),
    ],
)
def test_what_is_written_wrong_is_told_with_its_line(
    copied: Lab, tmp_path: Path, before: str, after: str, line: int, words_of_it: str
) -> None:
    """In the words of who writes it."""
    file = copied.folder / variants.FILE
    text = file.read_text("utf-8")
    assert before in text
    file.write_text(text.replace(before, after), "utf-8")
    with pytest.raises(BadCourseFile) as told:
        chosen(copied, "Ada").make(tmp_path / "made")
    assert f"{file}:{line}: " in str(told.value)
    assert words_of_it in str(told.value)


def test_a_place_in_the_starter_must_fit(copied: Lab, tmp_path: Path) -> None:
    """As an edit of a mutant."""
    edit = {"file": "chatter/talker.py", "find": "no such line", "replace": "{value}"}
    word = VariantWord.model_validate(
        {"at": {"nodes.1.log": "{value}"}, "values": ["a", "b"], "starter": [edit]}
    )
    own = LabVariant(copied, Variants(words={"log": word}), {"log": "a"})
    with pytest.raises(BadCourseFile, match="stands 0 times in chatter"):
        own.make(tmp_path / "made")
