"""A class of twelve, a download from Moodle: nine who attack, and three who did their work.

./roslings test tests/rogues/test_class_of_twelve.py -m slow
"""

from __future__ import annotations

import re
import shutil
from dataclasses import dataclass
from html import unescape

import pytest
from gallery import Seen, seen_of, untrue
from parcels import PARCELS, Parcel
from rogue import LAB, Attempt, Truth, attempts
from stage import (
    LONG_S,
    SANDBOX,
    TIME,
    Stage,
    abandoned_groups,
    adopting,
    known,
    quiet,
    signs_of,
    stage,
)

from skips import needs, skip_without

HONEST = ("Ada Adler", "Ben Baum", "Cem Can")
SILENT = "root_outside-run"
"""All that it tries is held off, and nothing of it can be seen from outside."""
NAMED = {
    "keyrings-run": "made calls that no lab needs, and they were refused: ",
    "refused_calls-run": "made calls that no lab needs, and they were refused: ",
    "fork_bomb-run": r"wanted more processes and threads than a sandbox has|left \d+ processes",
    "memory_hog-run": "wanted more memory than a sandbox has",
    "prints_for_ever-run": "printed without end",
    "own_session-run": "left a process running",
    "sparse_files-build": "The build filled the disk that a sandbox has",
}
"""A rogue, and what the page says of it; a limit that is no control group's tells nobody."""
REFUSED = "file_of_numbers"
"""Its hand-in has a name that books it on somebody else, where names are believed."""

pytestmark = [pytest.mark.slow, pytest.mark.alone, needs(*SANDBOX)]


@dataclass(frozen=True, eq=False)
class Student:
    """One of the class, and what was handed in."""

    number: int
    name: str
    source: Attempt | Parcel | None
    """None where it is the student's own work."""

    @property
    def folder(self) -> str:
        """As Moodle names it in the download."""
        return f"{self.name}_{1000 + self.number}_assignsubmission_file_"

    @property
    def truth(self) -> Truth:
        """What is to be said of it."""
        return self.source.truth if self.source else Truth(score=100)

    def hand_in(self, made: Stage) -> None:
        """Put it among the submissions."""
        place = made.submissions / self.folder
        place.mkdir()
        if self.source is None:
            shutil.copytree(LAB.solution, place / LAB.card.package)
        elif isinstance(self.source, Parcel):
            self.source.make(place / f"{HONEST[0]}_1000_assignsubmission_file_chatter.zip")
        else:
            package = place / LAB.card.package
            self.source.make(package, known(made, f"{made.mark}.{self.number}", 9, 0))


def the_class() -> list[Student]:
    """Honest ones first, last, and in the middle."""
    by_name: dict[str, Attempt | Parcel] = {each.name: each for each in (*attempts(), *PARCELS)}
    hostile = [by_name[name] for name in (SILENT, *NAMED, REFUSED)]
    mixed = [None, *hostile[:5], None, *hostile[5:], None]
    honest = iter(HONEST)
    return [
        Student(number, f"Mallory {source.name}" if source else next(honest), source)
        for number, source in enumerate(mixed)
    ]


@pytest.fixture(
    scope="module",
    params=[False, pytest.param(True, marks=pytest.mark.twice)],
    ids=["as_we_are", "ordinary"],
)
def graded(request: pytest.FixtureRequest) -> Graded:
    """The class, graded, and the machine afterwards."""
    if request.param:
        skip_without("root")
    skip_without(TIME)
    with stage(request.param) as made, adopting() as left:
        students = the_class()
        for each in students:
            each.hand_in(made)
        made.give_away()
        groups = abandoned_groups()
        words, _ = made.begin().communicate(timeout=LONG_S)
        results = made.results()
        return Graded(
            words,
            {each: seen_of(results[each.folder], made) for each in students},
            unescape(next(made.out.rglob("class.html")).read_text("utf-8")),
            quiet(left),
            [
                *map(str, made.scratch.iterdir()),
                *signs_of(made.mark),
                *sorted(abandoned_groups() - groups),
            ],
        )


@dataclass(frozen=True)
class Graded:
    """What came of it."""

    words: str
    seen: dict[Student, Seen]
    page: str
    running: dict[int, str]
    left: list[str]

    @property
    def section(self) -> str:
        """Of the page: what was not ordinary."""
        return self.page.partition("What was not ordinary")[2].partition("</section>")[0]


def test_each_has_its_own_verdict(graded: Graded) -> None:
    """The honest ones too: nobody's grade is another one because of a neighbour."""
    wrong = {each.name: untrue(each.truth, seen) for each, seen in graded.seen.items()}
    assert {name: why for name, why in wrong.items() if why} == {}, graded.words


def test_nothing_is_left(graded: Graded) -> None:
    """No process, no byte, no control group."""
    assert (graded.running, graded.left) == ({}, [])


def test_the_page_names_who_did_what(graded: Graded) -> None:
    """Each by what it did, and nobody who did nothing."""
    rows = graded.section.split("<tr")
    unnamed = {
        name: [row for row in rows if f"Mallory {name}" in row]
        for name, words in NAMED.items()
        if not any(f"Mallory {name}" in row and re.search(words, row) for row in rows)
    }
    assert unnamed == {}
    assert not [each for each in HONEST if each in graded.section]
    assert f"Mallory {REFUSED}" in graded.page and "takes more than 256 MB" in graded.page
