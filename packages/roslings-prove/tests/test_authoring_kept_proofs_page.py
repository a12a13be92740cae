"""The page on kept proofs tells the numbers that the rules make, and commands that work."""

from __future__ import annotations

import math
import re
import subprocess
import sys
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest

from roslings.course import all_labs, lab, root
from roslings_prove.proofs.archives import ARCHIVES, LARGEST_BYTES
from roslings_prove.proofs.digests import MeasuringCode, measuring
from roslings_prove.proofs.due import AT_EACH_LANDING, PART, Proofs, ProofStanding
from roslings_prove.proofs.kept import MOST_BYTES, Folder, KeptProof, kept_here
from roslings_prove.prove import ProvenPackage, Solution, StarterPackage

PAGE = (root() / "site/pages/teachers/kept-proofs.md").read_text("utf-8")
WORDS = " ".join(PAGE.split())
LABS = all_labs()
PACKAGES = [package for each in LABS for package in kept_here().packages(each)]
MUTANTS = [package for package in PACKAGES if not isinstance(package, Solution | StarterPackage)]
ALWAYS = len(PACKAGES) - len(MUTANTS)
MANY, MANY_MUTANTS = round(len(PACKAGES), -1), round(len(MUTANTS), -1)
"""As the page tells them, and reckons with them: one more mutant changes no number of it."""
FIFTH = MANY / PART
NAMES_OF_PARTS = {4: "a quarter", 5: "a fifth", 6: "a sixth"}
NAMES = {5: "five", 10: "ten", 20: "twenty", 30: "thirty"}


def of_100(chance: float) -> int:
    """Never more than there is."""
    return math.floor(100 * chance)


def found_after(landings: int) -> float:
    """The chance that one mutant was among those that the commits drew."""
    return 1 - (1 - AT_EACH_LANDING / MANY_MUTANTS) ** landings


def measured_with_a_new_core() -> float:
    """The chance of one mutant, where all proofs are of one age: by the part, else by lot."""
    by_part = FIFTH / MANY
    left = MANY - FIFTH - ALWAYS * (1 - by_part)
    return by_part + (1 - by_part) * AT_EACH_LANDING / left


def test_the_sizes_are_those_of_the_course() -> None:
    """To the nearest ten."""
    assert f"about {MANY} packages" in WORDS
    assert f"about {MANY_MUTANTS} of them are mutants and kills" in WORDS


def test_the_rules_are_told_with_their_numbers() -> None:
    """How many by lot, which part, how large."""
    part = NAMES_OF_PARTS[PART]
    assert f"**{NAMES[AT_EACH_LANDING].capitalize()} more, at each landing.**" in WORDS
    assert f"After a change of the core, {part} of all, the oldest first." in WORDS
    assert f"so {NAMES[PART]} recorded changes measure all" in WORDS
    assert f"`0.tar.xz` to `{ARCHIVES - 1}.tar.xz`" in WORDS
    assert (
        f"at most {LARGEST_BYTES:,} bytes, and all kept files together have at most {MOST_BYTES:,}"
        in WORDS
    )


def test_the_chances_that_invented_evidence_is_found() -> None:
    """At a landing, at half, and after many."""
    assert f"with a chance of {of_100(found_after(1))} in 100." in WORDS
    half = next(count for count in range(1, 1000) if found_after(count) >= 0.5)
    assert f"After {half} landings the chance that it was found is one half" in WORDS
    assert f"after 100 landings it is {of_100(found_after(100))} in 100" in WORDS


def test_the_chances_that_a_wrong_core_is_found() -> None:
    """Of one mutant, and of some: the whole table."""
    one = measured_with_a_new_core()
    assert f"a chance of {of_100(one)} in 100 for each mutant" in WORDS
    rows = re.findall(r"^\| (\d+) \| (\d+) in 100 \|$", PAGE, re.M)
    assert len(rows) == 5 and all(int(a) < int(b) for (a, _), (b, _) in pairwise(rows))
    assert rows == [(n, str(of_100(1 - (1 - one) ** int(n)))) for n, _ in rows]


# --- the rules themselves, on all packages -----------------------------------------------------


@pytest.fixture(scope="module")
def now() -> MeasuringCode:
    """What measures this course."""
    return measuring()


def proofs(folder: Path, now: MeasuringCode, core: str) -> Proofs:
    """All packages kept, none stale, all of one age: `known` measured them."""
    other = replace(now, labs=now.labs)
    other.__dict__["core"] = core
    found = Proofs(LABS, Folder(folder), other)
    line = KeptProof(
        package="", content="", card="", experiments="", core="known", evidence="", checks={}
    )
    found.__dict__["standings"] = [ProofStanding(package, line, 0, "") for package in PACKAGES]
    return found


def share(found: Proofs, commit: str) -> float:
    """The part of the mutants that is due."""
    due: list[ProvenPackage] = [each.package for each in found.due(commit)]
    return sum(not isinstance(each, Solution | StarterPackage) for each in due) / len(MUTANTS)


def test_the_rules_draw_as_often_as_the_page_says(tmp_path: Path, now: MeasuringCode) -> None:
    """At each landing exactly the lot; with a new core the part besides, over many cores."""
    settled = proofs(tmp_path, now, "known")
    assert share(settled, "a") == share(settled, "b") == AT_EACH_LANDING / len(MUTANTS)
    shares = [share(proofs(tmp_path, now, f"core {n}"), f"{n}") for n in range(40)]
    assert sum(shares) / len(shares) == pytest.approx(measured_with_a_new_core(), abs=0.005)


def test_so_many_recorded_changes_measure_all(tmp_path: Path, now: MeasuringCode) -> None:
    """Each takes the oldest, and what it measured is the newest then."""
    left = {package.name for package in PACKAGES}
    found = proofs(tmp_path, now, "")
    for core in map(str, range(PART)):
        found.measuring.__dict__["core"] = core
        drawn = {each.package.name for each in found._for_the_core()}
        left -= drawn
        found.__dict__["standings"] = [
            replace(each, age=0, line=each.line.model_copy(update={"core": core}))
            if each.line and each.package.name in drawn
            else replace(each, age=each.age + 1)
            for each in found.standings
        ]
    assert left == set()


# --- the commands ------------------------------------------------------------------------------


def test_the_page_tells_the_commands_that_there_are() -> None:
    """Those with which something is measured are tried by the gate itself."""
    told = set(re.findall(r"^\./roslings prove (.+)$", PAGE, re.M))
    assert told == {"--kept", "--kept nodes", "--record topics", "--record --due"}


def test_kept_judges_one_lab(tmp_path: Path) -> None:
    """Each line of it, and it says of each package without one that it was never measured."""
    words = [sys.executable, "-m", "roslings", "prove", "--kept", "nodes", "--all"]
    done = subprocess.run(words, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    lines = kept_here().lines(lab("nodes"))
    assert len(re.findall(r"^ok     nodes: ", done.stdout, re.M)) == len(lines)
    never = len(kept_here().packages(lab("nodes"))) - len(lines)
    assert (f"nodes: {never} to be measured anew: it was never" in done.stdout) == bool(never)
