"""Texts by their ids: in English, in a language with a catalogue, and in the false language."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ros2_on_pip import language as languages
from ros2_on_pip.false_language import KEPT, false, is_name, plain_words
from ros2_on_pip.language import (
    ENGLISH,
    FALSE,
    VARIABLE,
    BadCatalogue,
    Text,
    counted,
    fields_of,
    language,
    named,
    said,
    speaking,
)
from ros2_on_pip.markup import tag, told

SCORE = "{score} of 100"
POLISH = """
language.plural:
  en: "one other: n != 1"
  says: "one few many: n==1 ? 0 : n%10>=2 && n%10<=4 && (n%100<10 || n%100>=20) ? 1 : 2"
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The only folder of languages, for this test."""
    monkeypatch.setattr(languages, "folders", lambda: iter([tmp_path]))
    languages.catalogue.cache_clear()
    languages._plural.cache_clear()
    yield tmp_path
    languages.catalogue.cache_clear()
    languages._plural.cache_clear()


def write(folder: Path, text: str, name: str = "de/verdict.yaml") -> Path:
    """A file of translations."""
    file = folder / name
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, "utf-8")
    return file


# --- which language ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("asked", "found"),
    [
        ("", ENGLISH),
        ("de", "de"),
        ("pt-br", "pt_BR"),
        ("pt_BR.UTF-8", "pt_BR"),
        ("en-XA", FALSE),
        ("C", ENGLISH),
        ("../../etc", ENGLISH),
        ("deutsch", ENGLISH),
    ],
)
def test_the_environment_asks_for_a_language(
    asked: str, found: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As a terminal names it, or as a page does. What is no name is English, and no path."""
    monkeypatch.setenv(VARIABLE, asked)
    assert named(asked) == language() == found


def test_a_block_speaks_a_language_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever the environment says, and no longer than it lasts."""
    monkeypatch.setenv(VARIABLE, "de")
    with speaking(FALSE):
        assert language() == FALSE
    assert language() == "de"


# --- catalogues ----------------------------------------------------------------------------------


def test_english_needs_no_file() -> None:
    """Its text stands where it is asked for."""
    assert said("verdict.score", SCORE, score=80) == "80 of 100"
    assert str(Text("verdict.next", "Next")) == "Next"


def test_a_translation_is_found_by_its_id(folder: Path) -> None:
    """Its fields are filled in, in its own order; an element in a field stays one."""
    write(folder, "verdict.score: {en: '{score} of 100', says: 'von 100: {score}'}")
    with speaking("de"):
        assert said("verdict.score", SCORE, score=80) == "von 100: 80"
        page = told("verdict.score", SCORE, score=tag("b", "80"))
    assert page == "von 100: <b>80</b>"


@pytest.mark.parametrize(
    "entry",
    [
        "verdict.other: {en: '{score} of 100', says: 'von 100: {score}'}",
        "verdict.score: {en: '{score} of 100', says: ''}",
        "verdict.score: {en: '{score} points', says: '{score} Punkte'}",
    ],
    ids=["another id", "not yet translated", "another English"],
)
def test_what_has_no_translation_is_said_in_english(folder: Path, entry: str) -> None:
    """Also what is translated from an English that was changed since: it may be wrong by now."""
    write(folder, entry)
    with speaking("de"):
        assert said("verdict.score", SCORE, score=80) == "80 of 100"


@pytest.mark.parametrize(
    ("says", "complains"),
    [
        ("von 100", r"has the fields none; its English has \{score\}"),
        ("{points} von 100", r"has the fields \{points\}; its English has \{score\}"),
        ("{score} von 100 {name}", r"has the fields \{name\}, \{score\}"),
        ("{score von 100", "its braces do not close"),
    ],
)
def test_a_translation_has_the_fields_of_its_english(
    folder: Path, says: str, complains: str
) -> None:
    """What has not is refused when it is read, with its file and line."""
    file = write(
        folder, f"a.first: {{en: x, says: y}}\nverdict.score: {{en: '{SCORE}', says: '{says}'}}"
    )
    with speaking("de"), pytest.raises(BadCatalogue, match=complains) as refused:
        said("verdict.score", SCORE, score=80)
    assert str(refused.value).startswith(f"{file}:2: ")
    assert "\nNext: " in str(refused.value)


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("a.b: {en: x, says: y}\na.b: {en: x, says: z}", 2),
        ("a.b: {en: x}", 1),
        ("a.b: {en: x, says: y, note: z}", 1),
        ("a.b: y", 1),
        ("a.b:\n  en: 'x", 2),
        ("- a.b", 1),
    ],
)
def test_a_file_that_is_no_catalogue_is_refused(folder: Path, text: str, line: int) -> None:
    """With its line, too."""
    file = write(folder, text)
    with pytest.raises(BadCatalogue) as refused:
        languages.catalogue("de")
    assert (refused.value.file, refused.value.line) == (file, line)


def test_an_id_stands_in_one_file_only(folder: Path) -> None:
    """Else it would depend on the order of files what is said."""
    write(folder, "a.b: {en: x, says: y}", "de/one.yaml")
    write(folder, "a.b: {en: x, says: z}", "de/two.yaml")
    with pytest.raises(BadCatalogue, match=r"two\.yaml:1: 'a\.b' is there twice(.|\n)*one\.yaml:1"):
        languages.catalogue("de")


@pytest.mark.parametrize(
    ("count", "word"), [(1, "plik"), (2, "pliki"), (5, "plików"), (22, "pliki")]
)
def test_a_language_has_its_own_forms_of_the_plural(folder: Path, count: int, word: str) -> None:
    """As many as it says, by the rule that its gettext has."""
    entries = """
a.files.one: {en: "{count} file", says: "{count} plik"}
a.files.few: {en: "{count} files", says: "{count} pliki"}
a.files.many: {en: "{count} files", says: "{count} plików"}
"""
    write(folder, POLISH + entries, "pl/a.yaml")
    with speaking("pl"):
        found = counted("a.files", count, one="{count} file", other="{count} files")
    assert found == f"{count} {word}"


def test_a_rule_that_is_none_is_refused(folder: Path) -> None:
    """It is no program either: only numbers, `n` and signs."""
    rule = "language.plural: {en: 'one other: n != 1', says: 'one other: import os'}"
    write(folder, rule)
    with speaking("de"), pytest.raises(BadCatalogue, match=r"language\.plural"):
        counted("a.files", 2, one="{count} file", other="{count} files")


# --- the false language --------------------------------------------------------------------------

WORDS = st.text("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ", min_size=1, max_size=12)
FIELDS = st.sampled_from(["{name}", "{near.wanted}", "{hz:g}", "{text!r}", "{{n}}", "{x:.{y}f}"])
CODE = st.sampled_from(
    [
        "`ros2 topic list`",
        "``a `b` c``",
        "](#word-node)",
        "](../../labs/topics.md)",
        "https://docs.ros.org/en/jazzy/index.html",
        "<b>",
        '<a href="quiz.html">',
        "&nbsp;",
        "/robot_status",
        "~/heat",
        "std_msgs/msg/String",
        "package.xml",
        "rclpy.spin()",
        "x86_64",
        "%(copyright)s",
        "JupyterLab",
        "\n    self.lamp = lamp(0.5)\n",
    ]
)
PIECES = st.lists(st.one_of(WORDS, FIELDS, CODE, st.sampled_from(["**", "- ", "# ", ", ", "? "])))
TEXTS = PIECES.map(" ".join)


@settings(deadline=None)
@given(TEXTS)
def test_no_letter_of_prose_stays_plain(text: str) -> None:
    """What is left was never asked for."""
    assert plain_words(false(text)) == []


@settings(deadline=None)
@given(TEXTS)
def test_what_is_no_prose_stays_as_it_is(text: str) -> None:
    """Fields, code, links, addresses, tags and names: the same ones, in the same order."""
    assert KEPT.findall(false(text)) == KEPT.findall(text)
    assert fields_of(false(text)) == fields_of(text)


@settings(deadline=None)
@given(st.lists(st.text("abcdefghijklmnopqrstuvwxyz", min_size=1), min_size=1))
def test_prose_is_a_third_longer(words: list[str]) -> None:
    """Each word by itself, by at most a letter more than that."""
    longer = false(", ".join(words)).split(", ")
    for word, other in zip(words, longer, strict=True):
        if is_name(word):
            continue
        assert len(word) / 3 <= len(other) - len(word) < len(word) / 3 + 1


@settings(deadline=None)
@given(st.text())
def test_it_holds_for_any_text(text: str) -> None:
    """Said twice it is the same; lines and blanks stay where they are."""
    once = false(text)
    assert false(once) == once
    assert once.count("\n") == text.count("\n")
    assert [bool(line.strip()) for line in once.split("\n")] == [
        bool(line.strip()) for line in text.split("\n")
    ]


@settings(deadline=None)
@given(WORDS, WORDS)
def test_a_word_is_the_same_wherever_it_stands(one: str, other: str) -> None:
    """So the words of the glossary are found in false pages, too."""
    assert false(f"{one} {other}") == f"{false(one)} {false(other)}"
