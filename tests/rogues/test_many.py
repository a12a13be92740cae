"""Many submissions in one folder, solutions, mutants and rogues mixed; the command is killed.

    ./roslings test tests/rogues/test_many.py -m slow                       24 of them
    ROSLINGS_MANY=200 ./roslings test tests/rogues/test_many.py -m slow    as many as a large class

The same number gives the same submissions.
"""

from __future__ import annotations

import os
import random
import shutil
import signal
import sqlite3
import subprocess
import time
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

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
    children,
    known,
    quiet,
    stage,
)

from roslings.course import Mutant
from skips import needs, skip_without
from until_told import checked

MANY = int(os.environ.get("ROSLINGS_MANY", "24"))
SAMPLE = max(4, MANY // 20)
SEED = 20_261_121
LONG = frozenset({"endless_loop-build"})
"""Takes all the time that a build may take; once, in the gallery, is enough."""

pytestmark = [
    pytest.mark.slow,
    pytest.mark.alone,
    needs(*SANDBOX),
]


@dataclass(frozen=True)
class Handed:
    """One submission, and what is to be said of it."""

    name: str
    source: Mutant | Attempt | Parcel | None
    """None for the solution."""

    @property
    def truth(self) -> Truth:
        """A mutant names its failed checks itself."""
        if self.source is None:
            return Truth(score=100)
        if isinstance(self.source, Mutant):
            return Truth(fails=self.source.fails, may_fail=self.source.skips)
        return self.source.truth

    def hand_in(self, made: Stage) -> None:
        """Put it among the submissions."""
        place = made.submissions / self.name
        package = place / LAB.card.package
        if self.source is None:
            shutil.copytree(LAB.solution, package)
        elif isinstance(self.source, Mutant):
            place.mkdir()
            self.source.make(LAB.solution, package)
        elif isinstance(self.source, Attempt):
            self.source.make(package, known(made, f"{made.mark}.{self.name}", 9, 0))
        else:
            self.source.make(place.with_name(self.name + self.source.ending))

    @property
    def is_exact(self) -> bool:
        """There is just one true verdict, and `check` can be asked for it."""
        truth = self.truth
        if truth.may_be_unclear or truth.refused:
            return False
        return not (truth.may_fail and isinstance(self.source, Attempt))


def mixed(count: int) -> list[Handed]:
    """So many submissions: two in five are good, two have a mistake, one attacks."""
    chance = random.Random(SEED)
    mutants = list(LAB.mutants())
    hostile: list[Attempt | Parcel] = [
        *(each for each in attempts() if each.name not in LONG),
        *PARCELS,
    ]
    handed = []
    for number in range(count):
        kind = chance.choice("ssmmr")
        source = None if kind == "s" else chance.choice(mutants if kind == "m" else hostile)
        handed.append(Handed(f"{number:04}-{source.name if source else 'solution'}", source))
    return handed


def rows(made: Stage) -> Counter[tuple[str, str, int]]:
    """Submission, outcome and attempt of every result so far."""
    file = made.out / "gradebook.sqlite"
    if not file.is_file():
        return Counter()
    connection = sqlite3.connect(file)
    try:
        return Counter(connection.execute("SELECT submission, word, attempt FROM results"))
    except sqlite3.OperationalError:  # not yet made
        return Counter()
    finally:
        connection.close()


def kill_command(command: subprocess.Popen[str]) -> None:
    """Only the command: what it began has to notice."""
    command.kill()


def kill_all(command: subprocess.Popen[str]) -> None:
    """All at once, as when the memory is gone."""
    for pid in children():
        with suppress(ProcessLookupError):  # the first may have ended the others
            os.kill(pid, signal.SIGKILL)


def press_ctrl_c(command: subprocess.Popen[str]) -> None:
    """As a person does."""
    command.send_signal(signal.SIGINT)


ENDINGS: tuple[Callable[[subprocess.Popen[str]], None], ...] = (
    kill_command,
    kill_all,
    press_ctrl_c,
)


@pytest.mark.parametrize(
    "ordinary", [False, pytest.param(True, marks=pytest.mark.twice)], ids=["as_we_are", "ordinary"]
)
def test_killed_and_resumed_nothing_is_lost_doubled_or_left(ordinary: bool) -> None:
    """Three ends in the middle; then each has its verdict, and nothing else is there."""
    if ordinary:
        skip_without("root")
    skip_without(TIME)
    handed = mixed(MANY)
    with stage(ordinary) as made, adopting() as left:
        for each in handed:
            each.hand_in(made)
        made.give_away()
        groups = abandoned_groups()
        for number, end in enumerate(ENDINGS, start=1):
            end_in_the_middle(made, len(handed) * number // (len(ENDINGS) + 1), end)
            assert quiet(left) == {}
        command = made.begin()
        words, _ = command.communicate(timeout=LONG_S)
        assert command.returncode in (0, 3), words
        assert quiet(left) == {}
        assert list(made.scratch.iterdir()) == []
        assert abandoned_groups() - groups == set()
        insist_on_each(handed, made)
        insist_on_check(handed, made)


def end_in_the_middle(
    made: Stage, results: int, end: Callable[[subprocess.Popen[str]], None]
) -> None:
    """Begin, wait until so many results are there, end it; those that were there stay."""
    command = made.begin()
    end_s = time.monotonic() + LONG_S
    while rows(made).total() < results and command.poll() is None:
        assert time.monotonic() < end_s
        time.sleep(0.2)
    before = rows(made)
    end(command)
    command.communicate()
    assert before <= rows(made)


def insist_on_each(handed: list[Handed], made: Stage) -> None:
    """Each has one result that counts, and that one is true."""
    clear = Counter(name for name, word, _ in rows(made).elements() if word != "inconclusive")
    free = {each.name for each in handed if each.truth.may_be_unclear or each.truth.unclear}
    assert max(clear.values()) == 1
    assert {each.name for each in handed} - set(clear) <= free
    results = made.results()
    wrong = {each.name: untrue(each.truth, seen_of(results[each.name], made)) for each in handed}
    assert {name: why for name, why in wrong.items() if why} == {}


def insist_on_check(handed: list[Handed], made: Stage) -> None:
    """`check` says the same of a sample: the score, and which checks failed."""
    exact = [each for each in handed if each.is_exact]
    results = made.results()
    for each in random.Random(SEED).sample(exact, min(SAMPLE, len(exact))):
        graded = seen_of(results[each.name], made)
        checked = check(made.submissions / each.name / LAB.card.package, made)
        assert (each.name, graded.score, failed(graded)) == (each.name, *checked)


def failed(seen: Seen) -> set[str]:
    """The checks that failed."""
    return {check for check, outcome in seen.outcomes.items() if outcome == "fail"}


def check(package: Path, made: Stage) -> tuple[float, set[str]]:
    """Score and failed checks of the command that students type."""
    (made.folder / "verdict.json").unlink(missing_ok=True)
    found = checked(LAB.name, package, folder=made.folder, env=made.environment())
    return found.verdict["score"], set(found.outcomes("fail"))
