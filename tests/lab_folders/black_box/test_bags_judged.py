"""What is said of a program that reads bags, and of a diagnosis: on real bags, without a build."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from bag_readings import Bags

from graders.black_box import diagnosis
from graders.black_box.lines import Template
from roslings.course import lab
from roslings.verdict import Verdict
from roslings_rover.models.drives.sick_rover import Planted, sick_rover
from ways_to_write import WAYS

LAB = lab("black-box")
SOLUTION = LAB.solution
ENDLESS = {"never_ends"}
"""Not for this process: `prove` runs them."""
MUTANTS = {mutant.name: mutant for mutant in LAB.mutants() if mutant.name not in ENDLESS}


@pytest.fixture(scope="module")
def bags(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Bags]:
    """The bags of one grading."""
    yield Bags(LAB, tmp_path_factory.mktemp("bags"))


def failed(verdict: Verdict) -> set[str]:
    """The checks that failed."""
    return {check.id for check in verdict.checks if check.outcome == "fail"}


def test_the_solution_passes(bags: Bags) -> None:
    """With every check."""
    assert {check.outcome for check in bags.verdict_on(SOLUTION).checks} == {"pass"}


@pytest.mark.parametrize("way", WAYS)
def test_the_solution_passes_however_it_writes_its_lines(way: str, bags: Bags) -> None:
    """By print() or by get_logger(): each line counts once."""
    assert not failed(bags.verdict_on(SOLUTION, way=way))


@pytest.mark.slow
@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", ["duration_twice", "no_bag_code_zero", "rate_is_a_mean"])
def test_a_mutant_is_caught_however_it_writes_its_lines(
    name: str, way: str, bags: Bags, tmp_path: Path
) -> None:
    """A line that stands there twice counts twice."""
    mutant = MUTANTS[name]
    package = mutant.make(SOLUTION, tmp_path / LAB.card.package)
    assert failed(bags.verdict_on(package, way=way)) == set(mutant.fails)


@pytest.mark.slow
@pytest.mark.parametrize("name", MUTANTS)
def test_each_mutant_is_caught_where_it_says(name: str, bags: Bags, tmp_path: Path) -> None:
    """And nowhere else."""
    mutant = MUTANTS[name]
    package = mutant.make(SOLUTION, tmp_path / LAB.card.package)
    assert failed(bags.verdict_on(package)) == set(mutant.fails)


def test_whose_rover_it_is_follows_from_the_submission(bags: Bags) -> None:
    """The same package is right for one, and for nobody else."""
    assert not failed(bags.verdict_on(SOLUTION, "hopper_grace_77"))
    assert failed(bags.verdict_on(SOLUTION, "ada_lovelace")) == {"diagnosis"}


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("", "no keys"),
        ("- a\n- b", "no keys"),
        ("name:\nfaults: []", "`name` is empty"),
        ("name: Ada\nfaults: none", "no list"),
        ("name: Ada\nfaults:\n  - flood", "entry 1"),
        ("name: Ada\nfaults:\n  - {fault: floods, topic: /a, number: 1}", "none of the ten"),
        ("name: Ada\nfaults:\n  - {fault: flood, topic: a, number: 1}", "slash"),
        ("name: Ada\nfaults:\n  - {fault: flood, topic: /a, number: 1 Hz}", "no number"),
        ("name: Ada\nfaults:\n  - {fault: [flood], topic: /a, number: 1}", "none of the ten"),
        ("name: Ada\n faults: x: y", "line"),
        ("&a [*a" + "[" * 5000, "YAML"),
    ],
)
def test_what_is_no_diagnosis_is_told(text: str, problem: str) -> None:
    """In words that lead to the place."""
    with pytest.raises(diagnosis.Unreadable, match=problem):
        diagnosis.read(text)


def entries(*planted: Planted) -> tuple[diagnosis.Entry, ...]:
    """The right ones."""
    return tuple(diagnosis.Entry(each.fault, each.topic, each.number) for each in planted)


def test_a_wrong_entry_costs_what_a_right_one_gives() -> None:
    """And one whose number alone is wrong counts nothing."""
    truth = sick_rover("Ada").planted
    guess = diagnosis.Entry("flood", "/nowhere", 1.0)
    assert diagnosis.tally(entries(*truth), truth, 0.05).net == 5
    assert diagnosis.tally((*entries(*truth), guess), truth, 0.05).net == 4
    off = diagnosis.Entry(truth[0].fault, truth[0].topic, truth[0].number * 1.08)
    assert diagnosis.tally((off, *entries(*truth[1:])), truth, 0.05).net == 4
    assert diagnosis.tally((*entries(*truth), *entries(truth[0])), truth, 0.05).net == 4


def test_a_line_is_read_by_its_template() -> None:
    """Letter by letter, but for the numbers."""
    line = Template("gap {topic}: {seconds} s, from {start} s")
    told = list(line.told_in(["gap /odom: 1.25 s, from 3 s", "Gap /odom: 1 s, from 3 s"]))
    assert told == [{"topic": "/odom", "seconds": "1.25", "start": "3"}]
    assert line.like(["Gap  of /odom"]) == ["Gap  of /odom"]
