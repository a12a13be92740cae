"""What a translator gets: every text once, with an id of its own; and what is refused."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from ros2_on_pip import language as languages
from ros2_on_pip.language import BadCatalogue, Translation, fields_of, folders, said, speaking
from roslings.course import all_labs, root

sys.path.append(str(root() / "site"))
from course_site import translators
from course_site.catalogue import (
    BadTexts,
    Entry,
    entries,
    folder_of,
    home_of,
    merged,
    texts_in,
    unknown,
)

SCORE = Entry("verdict.score", "{score} of 100", "terminal.py:1", "course")


@pytest.fixture(scope="module")
def texts() -> dict[str, Entry]:
    """All of the course."""
    return entries(root())


def test_every_room_has_its_texts(texts: dict[str, Entry]) -> None:
    """Each check, fault, hint, question, word and script, and a verdict's own words."""
    checks = {f"hints.{lab.name}.{name}.3" for lab in all_labs() for name in lab.hints}
    assert checks <= set(texts)
    rooms = {name.partition(".")[0] for name in texts}
    assert rooms >= {
        *("verdict", "page", "graph", "faults", "graders", "checks", "hints", "cards"),
        *("quizzes", "glossary", "days", "site", "script", "qos", "language"),
        *("today", "status", "drill", "drills", "watch", "quiz", "doctor", "start", "diff", "pack"),
        *("check", "export"),
    }
    assert texts["graders.nodes.rate"].english == "It publishes at {STATUS.rate.hz:g} Hz, evenly."
    assert texts["faults.WrongText.expected"].english == "texts like {wanted!r}"
    assert texts["script.copy"].english == "Copy"
    assert texts["doctor.display.title"].english == "Programs can open a window"
    assert texts["drills.no_spin.title"].english == "The lamp that goes out at once"


def test_what_is_translated_fits_the_texts_of_today(texts: dict[str, Entry]) -> None:
    """In each language that the course has: the same fields, and no id that is unknown."""
    for folder in {place for each in folders() for place in each.glob("*") if place.is_dir()}:
        assert unknown(languages.catalogue(folder.name), texts) == []


def written(folder: Path, text: str) -> Path:
    """A Python file."""
    (file := folder / "code.py").write_text(text, "utf-8")
    return file


def test_texts_are_found_where_they_stand(tmp_path: Path) -> None:
    """Beside their ids, or in a name of the function or of the module, and in an f-string."""
    file = written(
        tmp_path,
        'AGAIN = "Check again"\n'
        'NEXT = Text("a.next", "Next")\n'
        "def say(n):\n"
        '    mend = "Mend {check}"\n'
        '    print(f"{said(\'a.again\', AGAIN)}", said("a.mend", mend, check=n))\n'
        '    return counted("a.files", n, one="{count} file", other="{count} files")\n',
    )
    assert sorted(texts_in(file)) == [
        (2, "a.next", "Next"),
        (5, "a.again", "Check again"),
        (5, "a.mend", "Mend {check}"),
        (6, "a.files.one", "{count} file"),
        (6, "a.files.other", "{count} files"),
    ]


def test_a_name_means_what_it_meant_there(tmp_path: Path) -> None:
    """One name may stand for several texts of a function, and several names for one line."""
    file = written(
        tmp_path,
        'text = "of all"\n'
        "def say(n):\n"
        '    text, other = "first", "files"\n'
        '    print(said("a.first", text), counted("a.files", n, one=other, other=other))\n'
        '    text = "second"\n'
        '    return said("a.second", text)\n'
        'print(said("a.all", text))\n',
    )
    assert {name: english for _, name, english in texts_in(file)} == {
        "a.first": "first",
        "a.files.one": "files",
        "a.files.other": "files",
        "a.second": "second",
        "a.all": "of all",
    }


@pytest.mark.parametrize("text", ['said("a.b", name)', 'said("a.b", f"{x} y")', 'said("a.b", x.y)'])
def test_a_text_that_nobody_could_translate_is_refused(tmp_path: Path, text: str) -> None:
    """Its English is made while the program runs: no catalogue has it."""
    with pytest.raises(BadTexts, match=r"code\.py:1: write the English of 'a\.b' out"):
        list(texts_in(written(tmp_path, f"{text}\n")))


def test_no_id_means_two_texts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Else one of them could not be translated."""
    twin = Entry(SCORE.id, "Score", "page.py:2", "engine")
    monkeypatch.setattr("course_site.catalogue._of_code", lambda: iter([SCORE, twin]))
    with pytest.raises(BadTexts, match=r"page\.py:2: 'verdict\.score' is another text in terminal"):
        entries(root())


def test_each_english_text_can_be_filled_in(texts: dict[str, Entry]) -> None:
    """Of those that stand in code: hints and words hold braces that are code."""
    rooms = ("verdict", "page", "graph", "faults", "graders", "checks", "site", "open", "skip")
    assert [
        each
        for each in texts.values()
        if each.id.startswith(rooms) and fields_of(each.english) is None
    ] == []


# --- a translator at work ------------------------------------------------------------------------


@pytest.fixture
def at_work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A course of one text, into which a translator writes."""
    monkeypatch.setattr(translators, "entries", lambda course: {SCORE.id: SCORE})
    monkeypatch.setattr(translators, "folder_of", lambda entry, course: tmp_path)
    monkeypatch.setattr(languages, "folders", lambda: iter([tmp_path]))
    languages.catalogue.cache_clear()
    yield tmp_path
    languages.catalogue.cache_clear()


def test_a_catalogue_is_filled_in_and_read(at_work: Path) -> None:
    """As it is written first, nothing is translated, and nothing is refused."""
    file = at_work / "de" / "verdict.yaml"
    assert list(translators.write_texts(at_work, "de")) == [f"{file}: 0 of 1"]
    file.write_text(
        file.read_text("utf-8").replace("says: ''", "says: 'von 100: {score}'"), "utf-8"
    )
    translators.require_known(at_work, "de")
    with speaking("de"):
        assert said(SCORE.id, SCORE.english, score=80) == "von 100: 80"
    assert list(translators.write_texts(at_work, "de")) == [f"{file}: 1 of 1"]
    assert "von 100: {score}" in file.read_text("utf-8")


def test_an_id_that_no_text_has_is_refused(at_work: Path) -> None:
    """With its place, and the id that was meant."""
    file = at_work / "de" / "verdict.yaml"
    file.parent.mkdir()
    file.write_text("verdict.scor: {en: '{score} of 100', says: 'von 100: {score}'}\n", "utf-8")
    with pytest.raises(BadCatalogue) as refused:
        translators.require_known(at_work, "de")
    assert str(refused.value).startswith(f"{file}:1: There is no text 'verdict.scor'.")
    assert "Did you mean verdict.score?" in str(refused.value)


def test_no_translators_work_is_lost(at_work: Path) -> None:
    """An English that changed empties its translation; what it said stands above, as a comment."""
    file = at_work / "de" / "verdict.yaml"
    file.parent.mkdir()
    file.write_text("verdict.score: {en: '{score} points', says: '{score} Punkte'}\n", "utf-8")
    told = list(translators.write_texts(at_work, "de"))
    assert told[0] == f"{file}: 0 of 1"
    assert "# before: {score} Punkte\n" in file.read_text("utf-8")


def test_a_text_that_moves_keeps_its_translation() -> None:
    """Under a new id, with the same English."""
    old = Translation("verdict.old", SCORE.english, "von 100: {score}", Path("de.yaml"), 1)
    found, left_over = merged([SCORE], {old.id: old})
    assert found == {SCORE.id: (SCORE.english, old.says)}
    assert left_over == []


def test_forms_of_the_plural_may_be_more_than_the_english_ones() -> None:
    """They are known by the ones that English has; an id beside them is not."""
    file = Entry("a.files.other", "{count} files", "code.py:1", "engine")
    few, wrong = (
        Translation(name, file.english, "{count}", Path("pl.yaml"), 1)
        for name in ("a.files.few", "a.filez.few")
    )
    assert unknown({each.id: each for each in (few, wrong)}, {file.id: file}) == [wrong]


def test_texts_lie_with_those_who_need_them(texts: dict[str, Entry]) -> None:
    """The lowest package has its own: it is used without the course, too."""
    places = {name: folder_of(texts[name], root()) for name in ("graph.nothing", "verdict.next")}
    assert "ros2-on-pip" in places["graph.nothing"].parts
    assert places["verdict.next"].parent.name == "roslings"
    assert folder_of(texts["cards.nodes.title"], root()) == root() / "site" / "languages"


def test_what_is_written_for_translators_is_read(texts: dict[str, Entry]) -> None:
    """Each folder into which a text of some package is written is one that programs look into."""
    read = {each.resolve() for each in folders()}
    packages = sorted(each.name for each in (root() / "packages").iterdir() if each.is_dir())
    homes = {home_of(name) for name in packages} | {each.home for each in texts.values()}
    written_to = {folder_of(Entry("a.b", "", "", home), root()).resolve() for home in homes}
    assert written_to == read
    for name in packages:  # where a package has the folder itself, its own texts lie there
        folder = folder_of(Entry("a.b", "", "", home_of(name)), root())
        assert name in folder.parts or home_of(name) == "engine"
