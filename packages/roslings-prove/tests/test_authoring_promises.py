"""`promises.yaml`: each sentence of a task is judged, or somebody says why not."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
import yaml

from roslings.course import Lab, all_labs, lab
from roslings.course.files import BadCourseFile
from roslings.course.labs import example_root
from roslings.course.promises import NAME, promises_in
from roslings.course.sentences import passages_of
from roslings_changes.card_words import words_of
from roslings_prove.contract.changes import changes_of
from roslings_prove.contract.coverage import mutants_by_word
from roslings_prove.contract.promises import PromiseAccount, prove_promises
from roslings_prove.prove import Proof
from roslings_prove.telling import WIDTH, told

LABS = [*all_labs(), lab("example")]
every_lab = pytest.mark.parametrize("one", LABS, ids=lambda one: one.name)

TASK = """# A title. It must not count.

**Goal.** You write a node. It tells
its age. Does it sleep?

**Level:** beginner. **Time:** it must not count.

<!-- card: contract -->
| it must | not count |
<!-- /card -->

| who | says |
| --- | --- |
| it | hello |

- One thing. Another thing
  of the list.

```text
It must not count.
```

## The steps

Type this. It must answer within a second. See what comes.
"""


@every_lab
def test_each_sentence_is_accounted_for(one: Lab) -> None:
    """A new one in a task or on a card is told here; so is a mutant that is no longer there."""
    found = list(prove_promises(one))
    assert [each.line for each in found if isinstance(each, Proof) and not each.holds] == []
    (account,) = (each for each in found if isinstance(each, PromiseAccount))
    assert account.accounted == account.sentences > 0


@every_lab
def test_each_word_of_the_card_can_be_judged(one: Lab) -> None:
    """By another card, by a mutant, or the task says that it is not."""
    free, by_mutants = promises_in(one.folder).words, mutants_by_word(one)
    for word in words_of(one.folder / "card.yaml"):
        assert changes_of(word) or word.place in by_mutants or word.place in free, word.place


def test_what_asks_for_something() -> None:
    """Above the steps all but titles, questions, code and what the card says; below, few."""
    asking = [
        (passage.line, passage.text[each.start : each.end])
        for passage in passages_of(TASK)
        for each in passage.sentences
        if each.asks
    ]
    assert asking == [
        (3, "You write a node."),
        (3, "It tells its age."),
        (14, "| it | hello |"),
        (16, "- One thing."),
        (16, "Another thing of the list."),
        (25, "It must answer within a second."),
    ]


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A lab that a test may change; its folder."""
    for folder in ("labs", "graders"):
        shutil.copytree(example_root() / folder, tmp_path / folder)
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    return tmp_path / "labs" / "example"


def wrong(folder: Path) -> list[str]:
    """What does not hold of it."""
    found = prove_promises(lab(folder.name))
    return [each.line for each in found if isinstance(each, Proof) and not each.holds]


def say(folder: Path, sentence: str) -> int:
    """Put a sentence before the steps; its line."""
    task = folder / "task.md"
    text = task.read_text("utf-8").replace("## The steps", f"{sentence}\n\n## The steps")
    task.write_text(text, "utf-8")
    return text[: text.index(sentence)].count("\n") + 1


def rewrite(folder: Path, *entries: dict[str, object], words: dict[str, str] | None = None) -> None:
    """Write entries behind those that are there."""
    file = folder / NAME
    tree = yaml.safe_load(file.read_text("utf-8"))
    tree["sentences"] += entries
    file.write_text(yaml.safe_dump({**tree, "words": words or {}}, sort_keys=False), "utf-8")


def test_a_sentence_that_nothing_judges_is_told_with_its_line(course: Path) -> None:
    """And what is left of one of which half is accounted for."""
    assert wrong(course) == []
    line = say(course, "It counts up, and starts anew after ten.")
    assert f"task.md:{line}: " in wrong(course)[0]
    rewrite(
        course, {"says": "It counts up,", "checks": ["text"], "broken_by": ["counter_stands_still"]}
    )
    assert "nothing judges 'and starts anew after ten.'" in wrong(course)[0]
    rewrite(course, {"says": "starts anew after ten.", "explains": "it is free"})
    assert wrong(course) == []


def test_a_text_of_the_card_is_a_sentence(course: Path) -> None:
    """It stands in the task's table."""
    card = course / "card.yaml"
    card.write_text(
        card.read_text("utf-8").replace(
            "        type: std_msgs", "        about: never a word twice\n        type: std_msgs"
        )
    )
    assert "card.yaml:13: nodes.beacon.publishes./alive.about" in wrong(course)[0]
    rewrite(
        course,
        {
            "at": "nodes.0.publishes.0.about",
            "checks": ["text"],
            "broken_by": ["counter_stands_still"],
        },
    )
    assert wrong(course) == []


WRONG_ENTRIES: dict[str, tuple[dict[str, object], str]] = {
    "words that are not there": ({"says": "It flies.", "explains": "it"}, "task.md says this 0"),
    "words that are there twice": ({"says": "the", "explains": "it"}, "it must say it once"),
    "no such text": ({"at": "nodes.0.log_about", "explains": "it"}, "no text at nodes.0.log_about"),
    "no such check": (
        {"says": "number here", "checks": ["flies"], "broken_by": ["rate_2_hz"]},
        "no check flies",
    ),
    "no such mutant": (
        {"says": "number here", "checks": ["rate"], "broken_by": ["flies"]},
        "no mutant flies",
    ),
    "a mutant of another check": (
        {"says": "number here", "checks": ["rate"], "broken_by": ["wrong_topic"]},
        "none of its mutants fails in rate",
    ),
    "one mutant too many": (
        {"says": "number here", "checks": ["rate"], "broken_by": ["rate_2_hz", "wrong_topic"]},
        "these mutants fail in other checks: wrong_topic",
    ),
    "no such word": ({"says": "number here", "repeats": ["nodes.9.node"]}, "no place of the card"),
    "not told to students": (
        {"says": "number here", "not_judged": "how it flies"},
        "does not say so under not_judged",
    ),
}


@pytest.mark.parametrize(("entry", "words"), WRONG_ENTRIES.values(), ids=WRONG_ENTRIES)
def test_a_wrong_entry_is_told_with_its_line(
    course: Path, entry: dict[str, object], words: str
) -> None:
    """Of promises.yaml."""
    rewrite(course, entry)
    (line,) = wrong(course)
    last = (course / NAME).read_text("utf-8").splitlines().index(f"- {_first(entry)}") + 1
    assert f"promises.yaml:{last}" in line and words in line


def _first(entry: dict[str, object]) -> str:
    return yaml.safe_dump(entry, sort_keys=False).splitlines()[0]


@pytest.mark.parametrize(
    "entry",
    [
        {"says": "number here"},
        {"checks": ["rate"], "broken_by": ["rate_2_hz"]},
        {"says": "number here", "checks": ["rate"]},
        {"says": "number here", "explains": "it", "not_judged": "it"},
    ],
)
def test_an_entry_says_one_thing(course: Path, entry: dict[str, object]) -> None:
    """The words, and one way; a check comes with its mutant."""
    rewrite(course, entry)
    with pytest.raises(BadCourseFile, match=r"promises\.yaml:\d+: sentences"):
        promises_in(course)


def test_a_word_that_is_not_judged_on_purpose_is_told_to_students(course: Path) -> None:
    """In a line under not_judged, and by a place that there is."""
    (said, *_) = lab("example").card.not_judged
    rewrite(course, words={"nodes.0.publishes.0.text": said})
    assert wrong(course) == []
    rewrite(course, words={"nodes.0.publishes.0.text": "how it flies", "nodes.9": said})
    assert "how it flies" in wrong(course)[0] and "nodes.9" in wrong(course)[1]


def test_a_terminal_has_room_for_what_is_told(course: Path) -> None:
    """What is wrong whole, what holds as a number; all of it with --all."""
    say(course, "It counts up, and starts anew after ten, and it says so in words.")
    found = list(prove_promises(lab("example")))
    lines = list(told(found))
    assert max(map(len, lines)) <= WIDTH
    assert [line for line in lines if line.startswith(("ok", "WRONG"))] == lines[:1]
    assert "example: 4 of 5 proofs hold" in lines
    assert sum(line.startswith("ok") for line in told(found, all_of_them=True)) == 4
