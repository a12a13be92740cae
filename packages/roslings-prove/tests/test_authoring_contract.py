"""`prove --contract`: each word of a card has its kind and its proof; one without is told."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args

import pytest
import yaml

from roslings.course import Lab, all_labs, lab
from roslings.course.card import Card
from roslings.course.contract import Contract
from roslings.course.files import read_tree
from roslings.course.kinds import kind_of
from roslings.course.labs import example_root
from roslings.judge.values import same
from roslings.verdict import CheckOutcome, CheckResult, Environment, Timings, Verdict, outcome_of
from roslings_changes.card_words import CardWord, words_of
from roslings_class.result import GradingResult
from roslings_prove.contract.changes import CardChange, changes_of
from roslings_prove.contract.coverage import Reworded, _proof
from roslings_prove.prove import Proof

EXAMPLE = lab("example")
FILE = EXAMPLE.folder / "card.yaml"
WORDS = {word.name: word for word in words_of(FILE)}
HZ, WITHIN = (WORDS[f"nodes.beacon.publishes./alive.rate.{key}"] for key in ("hz", "within"))


def held_by(annotation: Any) -> Iterator[type[Contract]]:
    """The contracts that a field holds, one below the other."""
    if isinstance(annotation, type) and issubclass(annotation, Contract):
        yield annotation
        for field in annotation.model_fields.values():
            yield from held_by(field.annotation)
    for inner in get_args(annotation):
        yield from held_by(inner)


CONTRACTS = list(dict.fromkeys(held_by(Card)))
"""Also those of capabilities."""


@pytest.mark.parametrize("contract", CONTRACTS, ids=lambda each: each.__name__)
def test_each_word_has_its_kind_where_it_is_defined(contract: type[Contract]) -> None:
    """What has none holds contracts, whose words have theirs."""
    names = {each.__name__ for each in CONTRACTS}
    for key, field in contract.model_fields.items():
        held = str(field.annotation)
        assert kind_of(field) or any(name in held for name in names), key


def test_the_words_of_a_card_and_their_lines() -> None:
    """All that is not for people alone, in the file's order, called by what it belongs to."""
    assert list(WORDS) == [
        "package",
        "build_type",
        "nodes.beacon.node",
        "nodes.beacon.executable",
        *(
            f"nodes.beacon.publishes./alive.{key}"
            for key in (
                "topic",
                "type",
                "qos.reliability",
                "qos.durability",
                "rate.hz",
                "rate.within",
                "text",
            )
        ),
        "ends_within_s",
    ]
    lines = FILE.read_text("utf-8").splitlines()
    for word in WORDS.values():
        assert word.key in lines[word.line - 1]


@pytest.mark.parametrize("one", all_labs(), ids=lambda one: one.name)
def test_each_other_card_is_a_card(one: Lab) -> None:
    """A change is something that an instructor could write."""
    file = one.folder / "card.yaml"
    tree = read_tree(file)
    for word in words_of(file):
        for change in changes_of(word):
            changed = change.apply(tree)
            assert changed != tree
            Card.model_validate(changed)
    assert read_tree(file) == tree


def test_a_tolerance_moves_to_both_sides_of_what_was_measured() -> None:
    """Just outside and just inside, above and below."""
    found = [
        (change.must_fail, abs(1 / hz - 1) * hz / (HZ.value * WITHIN.value))
        for change in changes_of(WITHIN)
        for _, hz in change.places
    ]
    assert [must_fail for must_fail, _ in found] == [True, False, True, False]
    for change, (must_fail, _) in zip(changes_of(WITHIN), found, strict=True):
        (_, hz), *_ = change.places
        limits = hz * (1 - WITHIN.value), hz * (1 + WITHIN.value)
        assert (limits[0] <= HZ.value <= limits[1]) is not must_fail


def test_a_tolerance_of_numbers_moves_a_field() -> None:
    """The first number that each message holds; what the solution says stays as it is."""
    card = lab("distance-sensor").folder / "card.yaml"
    (word,) = (each for each in words_of(card) if each.key == "numbers_within")
    measured = word.around["fields"]["field_of_view"]
    for change, must_fail in zip(changes_of(word), [True, False] * 2, strict=True):
        ((path, moved),) = change.places
        assert path[-2:] == ("fields", "field_of_view") and change.must_fail is must_fail
        assert same(measured, moved, word.value) is not must_fail


def test_the_grader_learns_another_name() -> None:
    """Where it calls the node by the card's word."""
    (change,) = changes_of(WORDS["nodes.beacon.executable"])
    assert 'CARD.node("beaconx")' in change.grader(EXAMPLE.grader.read_text("utf-8"))
    again = 'CARD = lab("beacon").card\nBEACON = CARD.node("beacon")'
    assert change.grader(again) == 'CARD = lab("beacon").card\nBEACON = CARD.node("beaconx")'
    (other,) = changes_of(HZ)
    assert other.grader("1.0") == "1.0"


def verdict_with(outcome: CheckOutcome) -> GradingResult:
    """A result whose one check has this outcome."""
    check = CheckResult(
        id="rate", title="rate", outcome=outcome, points=0, max_points=100, why="too busy"
    )
    verdict = Verdict(
        lab="example",
        package="beacon",
        outcome=outcome_of((check,)),
        score=None,
        checks=(check,),
        seconds=Timings(total=1.0),
        environment=Environment.model_construct(),
    )
    return GradingResult(submission="it", digest="0", attempt=1, state="graded", verdict=verdict)


def proof(
    word: CardWord, *results: tuple[CardChange, GradingResult], mutants: tuple[str, ...] = ()
) -> Proof:
    """What is made of the results of a word's changes."""
    own = [(Reworded(EXAMPLE, change, Path()), result) for change, result in results]
    return _proof(EXAMPLE, word, own, mutants)


def test_only_a_fault_is_notice_taken() -> None:
    """Not a pass, not a crash, and not what could not be told."""
    (change,) = changes_of(HZ)
    assert proof(HZ, (change, verdict_with("fail"))).holds
    unjudged = proof(HZ, (change, verdict_with("pass")))
    assert "passes as before" in unjudged.problem and f"card.yaml:{HZ.line}" in unjudged.about
    assert proof(HZ, (change, verdict_with("inconclusive"))).is_open
    broken = GradingResult(
        submission="it", digest="0", attempt=1, state="broken", reason="KeyError: 'beacon'"
    )
    assert "breaks the grader (KeyError: 'beacon')" in proof(HZ, (change, broken)).problem
    assert "proves: [" in proof(HZ).problem
    assert proof(HZ, mutants=("rate_2_hz",)).about.endswith("is judged: mutant rate_2_hz")


def test_all_sides_of_a_tolerance_count() -> None:
    """Failing just inside is as wrong as passing just outside."""
    changes = changes_of(WITHIN)
    right = [verdict_with("fail" if change.must_fail else "pass") for change in changes]
    assert proof(WITHIN, *zip(changes, right, strict=True)).holds
    strict = [verdict_with("fail") for _ in changes]
    assert "the solution fails: rate" in proof(WITHIN, *zip(changes, strict, strict=True)).problem
    blind = [verdict_with("pass") for _ in changes]
    assert "passes as before" in proof(WITHIN, *zip(changes, blind, strict=True)).problem


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A course with the example as its lab, that a test may change."""
    for folder in ("labs", "graders"):
        shutil.copytree(example_root() / folder, tmp_path / folder)
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    return tmp_path


def as_author(*words: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    """What an author of a lab types, to its end."""
    command = [sys.executable, "-m", *words]
    return subprocess.run(command, capture_output=True, text=True, check=False, cwd=cwd)


@pytest.mark.slow
def test_a_word_that_nothing_judges_is_told_with_its_line(course: Path) -> None:
    """A lab of one's own: one word more on the card, and no check that looks at it."""
    file = course / "labs" / "example" / "card.yaml"
    tree = read_tree(file)
    tree["nodes"][0]["log"] = "I am alive: '{text}'"
    file.write_text(yaml.safe_dump(tree, sort_keys=False), "utf-8")
    line = next(n for n, x in enumerate(file.read_text().splitlines(), 1) if "I am alive" in x)
    words = len(words_of(file))
    as_author("roslings.course.task", "example", cwd=course).check_returncode()
    done = as_author("roslings", "prove", "example", "--contract", cwd=course)
    assert done.returncode == 1, done.stderr
    wrong = [line for line in done.stdout.splitlines() if line.startswith("WRONG")]
    assert wrong == [f"WRONG  example: card.yaml:{line}: nodes.beacon.log is judged"]
    assert "passes as before" in done.stdout
    assert f"example: {words - 1} of {words} words of the card are judged (92%)" in done.stdout
