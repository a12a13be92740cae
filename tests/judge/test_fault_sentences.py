"""The sentences of faults are templates in their classes; each finds what it needs."""

from __future__ import annotations

import io
import re
from dataclasses import dataclass

import pytest
from rich.console import Console

import roslings_learn.drills
from roslings.capabilities.templates import every_template, told_classes
from roslings.capabilities.topics.faults.relay import (
    EndedWhileHearing,
    WrongAtFirst,
    WrongField,
    WrongReaction,
)
from roslings.judge.faults.base import Fault
from roslings.judge.outcome import words_for
from roslings.judge.values import Looks
from roslings.report.command_line import CommandLine
from roslings.report.hint_page import put_hint
from roslings.report.page import Page
from roslings.verdict import CheckResult, Environment, Timings, Verdict

TEMPLATES = every_template(roslings_learn.drills)
FAULTS = [kind for kind in told_classes(roslings_learn.drills) if issubclass(kind, Fault)]


def test_a_fault_of_drills_has_a_name_of_its_own() -> None:
    """What labs find, too, is one fault, in one place."""
    names: dict[bool, set[str]] = {True: set(), False: set()}
    for kind in FAULTS:
        names[kind.__module__.startswith("roslings_learn.")].add(kind.__name__)
    assert names[True] and not names[True] & names[False]


def test_a_headline_names_what_was_measured() -> None:
    """It holds all that is measured: a drill shows it in its place."""
    kinds = [kind for kind in FAULTS if "headline" in vars(kind)]
    assert len(kinds) > 2
    field = WrongField("/air", "relative_humidity", "0.45", "45")
    assert (field.headline, field.measured) == ("relative_humidity is 45", "it is 45")
    said = ("/out", "data", "data 2 on /in", "4", "2", Looks("half"))
    assert WrongReaction(*said).headline == "after data 2 on /in: data 2 on /out, half of it"
    assert WrongAtFirst(*said).headline.startswith("before anything was heard: data 2 on /out")
    ended = EndedWhileHearing(*said)
    assert ended.headline == f"after data 2 on /in: {ended.measured}"


@dataclass(eq=False)
class Late(Fault):
    """A fault of the tests."""

    name: str
    late_s: float
    hint: str = "no template: {name}"
    expected = "{spoken} in time; set(){{}}"
    measured = "{late_s:.1f} s late"

    @property
    def spoken(self) -> str:
        """Its name, as it is told."""
        return f"/{self.name}"


def test_a_sentence_is_filled_in() -> None:
    """By fields with their formats, and by properties; a field of a sentence's name stays one."""
    late = Late("arm", 2.25)
    assert str(late) == "expected /arm in time; set(){}; measured 2.2 s late"
    assert late.hint == "no template: {name}"
    assert Late.measured == "{late_s:.1f} s late"


def test_a_name_that_is_not_there_is_an_error() -> None:
    """Nobody reads a sentence with a hole."""

    class Wrong(Late):
        measured = "{lat_s} s"

    with pytest.raises(AttributeError, match="lat_s"):
        _ = Wrong("arm", 1.0).measured


MENDS = re.compile(
    r"^(Act|Add|Begin|Call|Catch|Copy|Count from|Create|Declare|Divide|Do not|Draw|End|Fill|Give"
    r"|Keep|Leave|Let (?!it drive)|Make|Never|Note|Publish|Put|Raise|Remember|Repeat|Send|Set|Start"
    r"|Take (?!one|this one)|Use|Write)\b"
    r"|[a-z_]\(timeout|\w+ = \w+|\w=[A-Z]\w|\breturn (response|result)\b"
)
"""What a sentence begins with, or has in it, that says what to type."""
FORMS = {
    "DidNotComeUp",
    "EndedInTheSoak",
    "TooFewFound",
    "UnlistedDependency",
    "NoAnswerYet",
    "NoExecutable",
    "MissingFile",
    "NotAnAmentPackage",
    "OtherRover",
    "BadPicture",
    "InvalidPackageXml",
}
"""No puzzle is in these: a file, a name, a line or a command is asked for, and that is told."""


def test_the_first_word_is_no_mend() -> None:
    """`try` says where to look; what to type stands in `mend`, which comes with the last hint."""
    told = {each.id: each.english for each in TEMPLATES if each.sentence.endswith(".hint")}
    assert len(told) > 150
    handed_over = {name: text for name, text in told.items() if MENDS.search(text)}
    forms = {name for name in handed_over if name.split(".")[1] in FORMS}
    assert handed_over.keys() == forms, handed_over


def test_a_mend_belongs_to_its_own_hint() -> None:
    """Who inherits a fault and has another hint does not inherit the mend."""

    class Mended(Late):
        hint = "Where is it?"
        mend = "Add 1 to {name}."

    class Other(Mended):
        hint = "And where is this?"

    assert Mended("arm", 1.0).mend == "Add 1 to arm."
    assert Other("arm", 1.0).mend == "" and Late("arm", 1.0).mend == ""


@dataclass(eq=False)
class Inconsistent(Fault):
    """A fault of the tests."""

    expected = "one"
    measured = "two"
    hint = "Which of both?"
    mend = "Take one."


def test_the_mend_comes_with_the_last_hint() -> None:
    """Of a check of a lab, it is in the verdict, and on the page of the third hint alone."""
    words = words_for(Inconsistent(), "It is one.")
    assert (words["hint"], words["mend"]) == ("Which of both?", "Take one.")
    hints = ("Here.", "This idea.", "Other code.")
    check = CheckResult(id="one", title="It is one.", points=0, max_points=1, hints=hints, **words)
    pages = [hint_page(check, step) for step in (1, 2, 3)]
    assert ["Take one." in page for page in pages] == [False, False, True]
    assert "Take one." in hint_page(check.model_copy(update={"hints": ()}), 1)


def hint_page(check: CheckResult, step: int) -> str:
    """What `--hint STEP` shows."""
    verdict = Verdict(
        lab="topics",
        package="chatter",
        outcome="fail",
        score=0,
        checks=(check,),
        seconds=Timings(),
        environment=Environment(
            roslings="",
            ros_distro="",
            rmw="",
            python="",
            platform="",
            isolation="",
            clock="",
            seed=0,
        ),
    )
    console = Console(width=80, file=io.StringIO(), record=True)
    page = Page(console, CommandLine("topics"))
    put_hint(page, verdict, check, step)
    page.print()
    return console.export_text()
