"""`./roslings prove --drills`: each starter fails for the reason that it teaches, each solution
passes, and the first line of a starter's verdict names its own cause. All are run for real.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from roslings_learn.drills import Drill, all_drills, drill
from roslings_learn.drills.course import of_day, problems
from roslings_learn.drills.judging import DrillVerdict
from roslings_learn.drills.running import check_many, load
from roslings_prove.prove import Proof

MOST_TRIES = 3
"""What this computer could not tell is run again. What was wrong beside others is run again alone.
A drill is judged in a second, and a student runs one at a time."""


def chosen(words: Sequence[str]) -> list[Drill]:
    """The drills of days, or by name; without a word, all. Raises NoSuchDrill."""
    every = all_drills()
    found = [each for word in words for each in of_day(every, word) or [drill(word)]]
    return found if words else every


@dataclass(frozen=True)
class DrillProgram:
    """One program of a drill, and what must come of it."""

    drill: Drill
    name: str
    file: Path

    @property
    def about(self) -> str:
        """What must hold."""
        passes = self.name == "solution"
        must = "passes" if passes else f"fails {self._wanted[0]} by {self._wanted[1]}"
        return f"drills of day {int(self.drill.day[:2])}: {self.drill.name}, {self.name} {must}"

    @property
    def _wanted(self) -> tuple[str, str, str]:
        starter = self.drill.card.starter
        if self.name == "wrong answer":
            return "foretold", "WrongPrediction", ""
        return starter.check, starter.fault, starter.names

    def problem(self, verdict: DrillVerdict) -> str:
        """What is wrong with a verdict; empty where nothing is."""
        first = verdict.first
        if self.name == "solution":
            return "" if first is None else f"it fails {first.id}: {verdict.headline}"
        if first is None:
            return "it passes"
        check, fault, names = self._wanted
        if (first.id, first.fault) != (check, fault):
            return f"it fails {first.id} by {first.fault}: {verdict.headline}"
        return "" if names in verdict.headline else f"{names!r} is not in: {verdict.headline}"


def programs_of(one: Drill, scratch: Path) -> Iterator[DrillProgram]:
    """All that is run to prove a drill."""
    yield DrillProgram(one, "starter", one.starter)
    yield DrillProgram(one, "solution", one.solution)
    if answer := one.card.answer:
        file = scratch / f"{one.name}{one.suffix}"
        text = one.starter.read_text("utf-8")
        file.write_text(re.sub(r"(?m)^ANSWER = .*$", f"ANSWER = {answer.wrong!r}", text), "utf-8")
        yield DrillProgram(one, "wrong answer", file)


def prove_drills(drills: Sequence[Drill], jobs: int | None = None) -> Iterator[Proof]:
    """All that must hold of drills: what their files tell first, then what the runs tell."""
    sound: list[Drill] = []
    for one in drills:
        found = [str(each) for each in problems(one)]
        yield Proof(f"drills of day {int(one.day[:2])}: {one.name}, its files", "\n".join(found))
        sound += [] if found else [one]
    with TemporaryDirectory() as scratch:
        programs = [each for one in sound for each in programs_of(one, Path(scratch))]
        yield from _proofs(programs, jobs or min(4, (os.cpu_count() or 1) + 1))


def _proofs(programs: Sequence[DrillProgram], at_once: int) -> Iterator[Proof]:
    for one in {each.drill for each in programs}:
        load(one)  # before the first fork: what is loaded in one drill serves the others, too
    left = list(programs)
    for attempt in range(MOST_TRIES):
        again: list[DrillProgram] = []
        runs = [(each.drill, each.file) for each in left]
        for number, verdict in check_many(runs, at_once if attempt == 0 else 1):
            program, is_open = left[number], verdict.outcome == "inconclusive"
            problem = program.problem(verdict)
            beside_others = attempt == 0 and at_once > 1
            if (is_open and attempt + 1 < MOST_TRIES) or (problem and beside_others):
                again.append(program)
            else:
                yield Proof(program.about, problem, is_open=is_open)
        left = again
