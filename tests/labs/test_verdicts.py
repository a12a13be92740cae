"""Every lab, graded for real: solution, starter and mutants, each with the verdict it must get.

    ./roslings test tests/labs                              one solution and one starter
    ./roslings test tests/labs -m slow                      all, and every mutant of every lab
    ./roslings test tests/labs -m slow -k "topics and rate" some of them

What must hold of a mutant, `roslings prove` knows; nothing here judges it a second time.
"""

from __future__ import annotations

import json
import os
import random
import time
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, replace
from functools import cache
from pathlib import Path

import pytest
from nothing import Nothing

from asked_for import MADE_FOR_ALL, asked_for
from few import few_labs
from once import once
from roslings.course import Lab, Mutant, all_labs
from roslings_prove.proofs.command import newest_commit
from roslings_prove.prove import MutantPackage, Proof, ProvenPackage, gradings_fit
from skips import skip_without
from until_told import checked

UNTIL_S = float(os.environ.get("ROSLINGS_MUTANTS_UNTIL", "inf"))
"""After this moment of time.time() no package is begun, and the tests of those left are skipped."""
TIMES_ALONE, MOST_UNSTEADY = 2, 12
"""One that was wrong beside others must hold so often alone; of so many it is no accident."""
CLOCKED = "topics"
"""The lab whose experiments run by either clock."""
LABS = {lab.name: lab for lab in all_labs()}
each_lab = few_labs("lab", twice=True)
"""`prove --due` measures every solution and every starter at each landing."""


# --- by the command that a student types -------------------------------------------------------


@each_lab
def test_the_solution_gets_the_full_score(lab: Lab, tmp_path: Path) -> None:
    """Nothing in the card asks for more than the solution does."""
    found = checked(lab.name, lab.solution, folder=tmp_path)
    assert [each for each in found.verdict["checks"] if each["outcome"] != "pass"] == []
    assert (found.status, found.verdict["score"]) == (0, 100)


@each_lab
def test_the_starter_does_not_pass(lab: Lab, tmp_path: Path) -> None:
    """Who has done nothing has not done the lab."""
    found = checked(lab.name, lab.starter, folder=tmp_path)
    assert (found.status, found.verdict["outcome"]) == (1, "fail")


# --- the mutants, all at once ------------------------------------------------------------------


def mutants() -> Iterator[MutantPackage]:
    """Every mutant of every lab."""
    for lab in LABS.values():
        for mutant in lab.mutants():
            yield MutantPackage(lab, mutant)


def in_real_time() -> Iterator[MutantPackage]:
    """Those about rates, and one more for each check that is judged from the same experiment."""
    seen: set[tuple[str, ...]] = set()
    for mutant in LABS[CLOCKED].mutants():
        if _is_timed(mutant) and ("rate" in mutant.fails or mutant.fails not in seen):
            seen.add(mutant.fails)
            yield MutantPackage(LABS[CLOCKED], mutant, clock="wall")


def _is_timed(mutant: Mutant) -> bool:
    """Its talker is run: nothing ended the grading before, and the talker is what is wrong."""
    of_the_talker = {"rate", "text", "counting"}
    return any(check.startswith("talker_") or check in of_the_talker for check in mutant.fails)


FILES = frozenset({"well_formed", "depends"})
END = frozenset({"builds", "ends", "clean_exit"})
NODES = {
    "nodes": {"runs", "stays", "name"},
    "topics": {"talker_runs", "talker_stays", "talker_name", "listener_runs", "listener_name"},
    "distance-sensor": {
        "sensor_runs",
        "sensor_name",
        "subscriber_runs",
        "subscriber_name",
        "launch",
    },
    "services": {"server_runs", "server_name"},
    "actions": {"server_runs", "server_name"},
    "serial-bridge": {"runs", "name"},
    "e-stop": {"button_runs", "button_name", "guard_runs", "guard_name"},
    "pi-camera": {"camera_runs", "camera_name", "finder_runs", "finder_name"},
    "bring-up": {
        "limiter_runs",
        "limiter_name",
        "beacon_runs",
        "beacon_name",
        "launch",
        "alike",
        "arguments",
        "one_rover",
        "respawn",
        "launch_ends",
    },
    "black-box": set(),
    "wander": {"runs", "name"},
    "frames": {"runs", "name"},
}
"""Lab to the checks that nodes pass which are there, and do nothing."""
ALSO = {
    "topics": {"figure"},
    "black-box": {"diagnosis", "fault_1", "fault_2", "fault_3", "fault_4", "fault_5"},
}
"""Checks on files that no program makes."""
WRITTEN = {"bring-up": FILES}
"""What the starter's own files are right about; else that they belong together."""


def without_much() -> Iterator[Nothing]:
    """An empty package, the starter, and nodes that do nothing."""
    for name, nodes in NODES.items():
        files = FILES | ALSO.get(name, set())
        yield Nothing(LABS[name], "empty", files)
        yield Nothing(LABS[name], "starter", WRITTEN.get(name, frozenset({"well_formed"})))
        yield Nothing(LABS[name], "idle", files | END & LABS[name].card.points.keys() | nodes)


ALL: dict[str, MutantPackage | Nothing] = {
    package.name: package for package in (*mutants(), *in_real_time(), *without_much())
}


def packages(clock: str) -> pytest.MarkDecorator:
    """One test for each mutant, named LAB-MUTANT."""
    wrong = (package for package in ALL.values() if isinstance(package, MutantPackage))
    chosen = [package for package in wrong if package.clock == clock]
    names = [f"{each.lab.name}-{each.mutant.name}" for each in chosen]
    return pytest.mark.parametrize("package", [each.name for each in chosen], ids=names)


@pytest.fixture(scope="session")
def proof_of(request: pytest.FixtureRequest, shared_folder: Path) -> Callable[[str], Proof]:
    """Package to what came of it; all that this test run asks for are graded in one go."""
    asked: dict[str, ProvenPackage] = {}
    for _, words in asked_for(request, __file__):
        if name := words.get("package"):
            asked[name] = ALL[name]

    def prove() -> str:
        return json.dumps([asdict(each) for each in _proofs(in_turn(asked))])

    @cache
    def proofs() -> dict[str, Proof]:
        found = json.loads(once(shared_folder / "proofs.json", prove))
        return {proof["package"]: Proof(**proof) for proof in found}

    def of(package: str) -> Proof:
        if package not in proofs():
            skip_without("time for packages")
        return proofs()[package]

    return of


def in_turn(asked: Mapping[str, ProvenPackage]) -> list[ProvenPackage]:
    """In an order of chance; those for which no time is left are others at the next commit."""
    names = sorted(asked)
    random.Random(newest_commit()).shuffle(names)
    return [asked[name] for name in names]


def _proofs(packages: Sequence[ProvenPackage]) -> list[Proof]:
    """What came of each; one that was wrong beside the others may hold `TIMES_ALONE` alone.

    An unsteady one is told: `pytest` lists the warnings at its end.
    """
    found = list(gradings_fit(packages, _nobody, still=_still))
    wrong = {each.package: each for each in found if not each.holds}
    if len(wrong) > MOST_UNSTEADY:
        return found
    doubtful = [each for each in packages if each.name in wrong]
    again = [list(gradings_fit(doubtful, _nobody, jobs=1)) for _ in range(TIMES_ALONE)]
    steady = {each.package: each for proofs in again for each in proofs if not each.holds}
    for name in sorted(set(wrong) - set(steady)):
        warnings.warn(f"only beside others: {wrong[name].line}", stacklevel=2)
    return [each if each.holds else steady.get(each.package, _mended(each)) for each in found]


def _mended(proof: Proof) -> Proof:
    return replace(proof, problem="", is_open=False)


def _nobody(_: object) -> None:
    """Watches how far it is."""


def _still() -> bool:
    return time.time() < UNTIL_S


def test_each_lab_has_its_nodes_here() -> None:
    """A new lab says which checks nodes pass that do nothing."""
    assert set(NODES) == set(LABS)


def insist_on(proof: Proof) -> None:
    """It holds; that it could never be told is no proof."""
    assert proof.holds, proof.line


@pytest.mark.slow
@pytest.mark.twice  # CI judges what is kept of each, and measures those that are due
@pytest.mark.xdist_group("mutants")
@MADE_FOR_ALL
@packages("auto")
def test_a_mutant_fails_where_it_says(package: str, proof_of: Callable[[str], Proof]) -> None:
    """The failed checks are exactly those that it names; the skipped ones are their dependants."""
    insist_on(proof_of(package))


@pytest.mark.slow
@pytest.mark.xdist_group("mutants")
@MADE_FOR_ALL
@packages("wall")
def test_a_mutant_gets_the_same_verdict_in_real_time(
    package: str, proof_of: Callable[[str], Proof]
) -> None:
    """`--clock wall` and the simulated clock agree."""
    insist_on(proof_of(package))


@pytest.mark.slow
@pytest.mark.xdist_group("mutants")
@MADE_FOR_ALL
@pytest.mark.parametrize("package", [each.name for each in without_much()])
def test_no_point_for_what_is_not_there(package: str, proof_of: Callable[[str], Proof]) -> None:
    """A check passes only on what it saw; what is missing is failed or skipped."""
    insist_on(proof_of(package))
