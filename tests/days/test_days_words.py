"""Each word that students read is an everyday one, or has an entry in the glossary."""

from __future__ import annotations

from pathlib import Path

import pytest
from words_used import (
    everyday_words,
    forms,
    prose,
    sentences_of,
    strings_of,
    texts_of,
    unexplained,
)

from lesson_runs import lessons
from roslings.course import root
from roslings_learn.lessons import Category, Glossary, Term, read_glossary

LAMP = Term(id="lamp", name="lamp", definition="A lamp shines.", note="At night.")
QUEUE = Term(id="queue-depth", name="queue depth", definition="How many wait.", note="Ten.")
SMALL = Glossary((Category(category="Light", about="Lamps.", terms=(LAMP, QUEUE)),))


def found(text: str, everyday: str = "the a shine on") -> list[str]:
    """The words of a text that nothing explains."""
    return list(unexplained({"here": [text]}, SMALL, set(everyday.split())))


def test_no_word_is_without_an_entry() -> None:
    """Of lessons, quizzes, drills, labs, verdicts and the doctor."""
    missing = unexplained(texts_of(root(), lessons()), read_glossary(root()), everyday_words())
    assert not missing, (
        "These words have no entry in glossary/*.yaml. Write one; or, where everybody knows the"
        " word, put it into tests/days/everyday_words.txt.\n"
        + "\n".join(f"  {word}: {', '.join(places)}" for word, places in missing.items())
    )


def test_a_word_with_an_entry_is_no_everyday_word() -> None:
    """Else nobody would notice that its entry is gone."""
    assert everyday_words() & set(read_glossary(root()).senses_of) == set()


@pytest.mark.parametrize(
    "word",
    [
        "daemon",
        "kernel",
        "YAML",
        "XML",
        "regex",
        "exit code",
        "port",
        "firewall",
        "thread",
        "process",
        "signal",
        "log",
        "traceback",
        "queue",
        "hue",
        "JPEG",
        "covariance",
        "jitter",
        "standard deviation",
        "graph",
        "JSON",
        "CSV",
        "checksum",
        "apt",
    ],
)
def test_words_that_were_missed_have_an_entry(word: str) -> None:
    """By a reader who had only the text."""
    assert word.lower() in read_glossary(root()).senses_of


def test_what_has_no_entry_is_listed_with_its_places() -> None:
    """A new word is named, and so is each page that uses it."""
    texts = {"day 1": ["The frobnicator shines."], "day 2": ["A lamp.", "Frobnicators shone."]}
    assert unexplained(texts, SMALL, {"the", "a", "shine"}) == {
        "frobnicator": ["day 1"],
        "frobnicators": ["day 2"],
        "shone": ["day 2"],
    }


@pytest.mark.parametrize(
    ("text", "missing"),
    [
        ("The lamps shine on", []),
        ("A queue shines", ["queue"]),  # `queue depth` explains another word
        ("The queue depth", []),
        ("`kernel` /kernel kernel/x my_kernel kernel() KernelPanic", []),  # code, whatever it says
        ("[on](https://a.example/kernel) <kernel> {kernel}", []),
        ("The KERNEL", ["kernel"]),
        ("the kernel's", ["kernel's"]),
    ],
)
def test_what_is_a_word(text: str, missing: list[str]) -> None:
    """Code and addresses are none; a form of a known word is known."""
    assert found(text) == missing


@pytest.mark.parametrize(
    ("form", "word"),
    [("stopped", "stop"), ("tries", "try"), ("using", "use"), ("robot's", "robot"), ("hue", "hue")],
)
def test_forms_of_a_word(form: str, word: str) -> None:
    """Endings of English."""
    assert word in forms(form)


def test_only_what_is_read_counts() -> None:
    """Docstrings, code and short values of files are for others."""
    assert strings_of('"""A docstring here."""\nx = "Try it."\ny = f"{x} says so"\nz = "id"\n') == [
        "Try it.",
        " says so",
    ]
    assert list(sentences_of({"a": ["one", "two words"], "b": 3, "c": "three more words"})) == [
        "two words",
        "three more words",
    ]
    assert prose("Look here:\n    self.code()\n\n```\ncode\n```\n") == ["Look here:"]


def test_a_broken_list_is_told(tmp_path: Path) -> None:
    """A file that is not there is no empty list."""
    with pytest.raises(FileNotFoundError):
        everyday_words(tmp_path / "none.txt")
    (tmp_path / "few.txt").write_text("# a comment\n\none two\nthree\n", "utf-8")
    assert everyday_words(tmp_path / "few.txt") == {"one", "two", "three"}
