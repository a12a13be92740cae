"""What `.ci/run` says at its end: time of each stage, the slowest tests, and what was graded.

    python .ci/summary.py STAGES COSTS DUE

STAGES has a line `SECONDS CPU_SECONDS STATUS NAME` for each stage, COSTS a line of JSON for each
test (`tests/costs.py`), DUE one for each package that was due (`prove --due --told`). A mutant is
proven where it was measured live, or where its kept evidence was judged. A test that was left out
(`.ci/needs.py`) is kept where it passed before with all that it needs as it is; that is counted
apart from what ran. The last line says what is proven and no more: what was skipped is not, and it
says for want of what (`tests/machine.py`); nor is that on which no lot fell.
Ends with 1 where a stage failed, where nothing asked for a mutant or a rogue that lies in this
clone, where something was due and not measured, where fewer than `FEWEST` of a kind were graded or
left out by rule, where all was skipped, or where something was skipped for no known reason.
"""

from __future__ import annotations

import json
import re
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[1]
UNSTEADY = ROOT / "tests/unsteady.yaml"
sys.path[:0] = [
    str(ROOT / "tests/rogues"),
    str(ROOT / "tests"),
    *map(str, ROOT.glob("packages/*/src")),
]

from needed.left_out import KEPT, UNDRAWN, told  # noqa: E402

SLOWEST = 20
KEPT_MUTANTS = re.compile(
    r"test_authoring_proofs\.py::test_what_is_kept_shows_what_it_must\[(.+)\]$"
)
ROGUE = re.compile(r"test_rogues\.py::test_a_(?:wild_)?rogue_is_contained\[(.+)\]$")
USERS = ("ordinary", "root")
VERDICTS = ("passed", "failed")
MUTANTS, ROGUES = "mutants", "rogues"
FEWEST = {MUTANTS: 120, ROGUES: 30}
"""A run that shows fewer of them has shown too little, whatever the machine kept it from."""


@dataclass(frozen=True)
class Test:
    """One line of COSTS."""

    test: str
    outcome: str
    wall_s: float
    cpu_s: float
    lack: str = ""
    """Of a skipped one: a name in `tests/machine.py`."""


@dataclass(frozen=True)
class Count:
    """Things of one kind: what lies in this clone, and the outcome of each that was looked at."""

    kind: str
    there: frozenset[str]
    outcomes: dict[str, str]
    name: str
    """With whom, where the same kind is graded for more than one."""

    def number(self, *words: str) -> int:
        """How many came to one of these outcomes."""
        return sum(found in words for found in self.outcomes.values())

    @property
    def graded(self) -> int:
        """Those with a verdict, right or wrong."""
        return self.number("passed", "failed")

    @property
    def kept(self) -> int:
        """Those that passed before, with all that they need as it is."""
        return self.number(KEPT)

    @property
    def undrawn(self) -> int:
        """Those that were left to a lot, which fell on others."""
        return self.number(UNDRAWN)

    @property
    def unproven(self) -> int:
        """Those that no verdict was told of: not now, and not with all that they need as it is."""
        return len(self.there) - self.graded - self.kept

    @property
    def missing(self) -> list[str]:
        """Those that nothing asked for."""
        return sorted(self.there - set(self.outcomes))

    def lines(self) -> Iterator[str]:
        """How many were graded, and what became of the others."""
        wrong, skipped = self.number("failed"), self.number("skipped")
        yield f"{self.name}: {self.graded} of {len(self.there)} proven, {wrong} wrong"
        if self.kept:
            yield f"  {self.kept} kept by needs: proven before, with all that they need as it is."
        if self.undrawn:
            why = "of what they need, only the core or a list of names is another"
            yield f"  {self.undrawn} not drawn: {why}."
        if skipped:
            yield f"  {skipped} skipped: no room or no time on this machine; the tests say which."
        if self.missing:
            yield f"  MISSING {len(self.missing)}: {', '.join(self.missing)}"


def mutants() -> frozenset[str]:
    """LAB-MUTANT of each file."""
    files = (ROOT / "labs").glob("*/mutants/*.yaml")
    return frozenset(f"{file.parents[1].name}-{file.stem}" for file in files)


def kept_mutants(tests: Sequence[Test]) -> dict[str, str]:
    """LAB-MUTANT of each that evidence is kept of, to what came of judging that of its lab."""
    labs = outcomes(tests, KEPT_MUTANTS)
    return {
        f"{file.stem}-{name.removeprefix('mutant ')}": labs[file.stem]
        for file in (ROOT / "tests/proofs").glob("*.jsonl")
        if file.stem in labs
        for line in file.read_text("utf-8").splitlines()
        if (name := json.loads(line)["package"]).startswith("mutant ")
    }


@dataclass(frozen=True)
class WasDue:
    """What came of the packages that were due."""

    outcomes: dict[str, str]
    """A package's name to passed, failed, unclear (it could not be told) or unmeasured."""

    def number(self, word: str) -> int:
        """How many came to this."""
        return sum(found == word for found in self.outcomes.values())

    @property
    def mutants(self) -> dict[str, str]:
        """LAB-MUTANT of each, to passed, failed or skipped."""
        return {
            name.replace(": mutant ", "-"): outcome if outcome in VERDICTS else "skipped"
            for name, outcome in self.outcomes.items()
            if ": mutant " in name
        }

    @property
    def measured(self) -> dict[str, str]:
        """The mutants of which a verdict was told."""
        return {name: word for name, word in self.mutants.items() if word in VERDICTS}

    def wrong(self) -> Iterator[str]:
        """What did not show what it must, and what was let through unmeasured."""
        if named := [name for name, outcome in self.outcomes.items() if outcome == "failed"]:
            yield f"these did not show what they must: {', '.join(named)}"
        if left := self.number("unmeasured"):
            yield (
                f"no time was left for {left} of {len(self.outcomes)} packages that were due;"
                " at home, ./roslings prove --record --due measures and keeps them"
            )

    def unclear(self) -> Iterator[str]:
        """What could not be told proves nothing."""
        if left := self.number("unclear"):
            yield f"{left} of {len(self.outcomes)} packages that were due could not be told"


def was_due(file: Path) -> WasDue:
    """As `prove --due --told` wrote it."""
    lines = file.read_text("utf-8").splitlines() if file.exists() else []
    return WasDue({each["package"]: each["outcome"] for each in map(json.loads, lines)})


@cache
def rogues(user: str) -> frozenset[str]:
    """Each place of each file, and each parcel; as root those for which that makes a difference."""
    from parcels import PARCELS
    from rogue import attempts

    if user == "root":
        return frozenset(each.name for each in attempts() if each.rogue.as_root)
    return frozenset(each.name for each in (*attempts(), *PARCELS))


def outcomes(tests: Sequence[Test], name: re.Pattern[str]) -> dict[str, str]:
    """What the name in brackets is, to the outcome of its test."""
    return {found[1]: each.outcome for each in tests if (found := name.search(each.test))}


def counts(tests: Sequence[Test], due: WasDue) -> Iterator[Count]:
    """Of mutants, and of rogues by user. What could not be told leaves what is kept as it is."""
    there = mutants()
    known = due.mutants | kept_mutants(tests) | due.measured
    found = {name: word for name, word in known.items() if name in there}
    yield Count(MUTANTS, there, found, "Mutants")
    of_users = outcomes(tests, ROGUE)
    for user in USERS:
        own = {
            rogue: of_users[name]
            for rogue in rogues(user)
            if (name := f"{user}-{rogue}") in of_users
        }
        yield Count(ROGUES, rogues(user), own, f"Rogues as {user}")


Stages = Sequence[tuple[float, float, int, str]]


def stages(file: Path) -> Stages:
    """Seconds, CPU seconds, status and name."""
    rows = (line.split(maxsplit=3) for line in file.read_text("utf-8").splitlines())
    return [(float(wall), float(cpu), int(status), name) for wall, cpu, status, name in rows]


def main(stages_file: Path, costs_file: Path, due_file: Path) -> int:
    """Print all of it; 0 where the run has passed."""
    lines = costs_file.read_text("utf-8").splitlines() if costs_file.exists() else []
    tests = [Test(**json.loads(line)) for line in lines]
    print(f"== The {SLOWEST} slowest tests ==\n   wall s   CPU s")
    for each in sorted(tests, key=lambda each: -each.wall_s)[:SLOWEST]:
        print(f"{each.wall_s:9.1f} {each.cpu_s:7.1f}  {each.test}")
    print("== The stages ==\n   wall s   CPU s")
    run = stages(stages_file)
    for wall_s, cpu_s, status, name in run:
        print(f"{wall_s:9.0f} {cpu_s:7.0f}  {name}{'' if status == 0 else '  FAILED'}")
    print(f"{sum(r[0] for r in run):9.0f} {sum(r[1] for r in run):7.0f}  all")
    print("== What was graded ==")
    due = was_due(due_file)
    found = list(counts(tests, due))
    for count in found:
        print("\n".join(count.lines()))
    print(f"Mutants measured live at this landing: {len(due.measured)}")
    for line in told(each.outcome for each in tests):
        print(f"Left out: {line}.")
    unsteady = unsteady_in(stages_file.with_name("unsteady"))
    print(told_of_unsteady(unsteady))
    for test in sorted(each.test for each in tests if each.outcome == "failed"):
        if test not in unsteady:
            print(f"FAILED {test}")
    wrong = [*broken(run, found), *due.wrong(), *unfounded(tests)]
    print(f"FAILED: {'; '.join(wrong)}" if wrong else proven(tests, found, due))
    return int(bool(wrong))


def unsteady_in(file: Path) -> set[str]:
    """The tests that `again.py` has found so in this run."""
    return set(file.read_text("utf-8").splitlines()) if file.exists() else set()


def told_of_unsteady(now: set[str]) -> str:
    """How many there are, and which are known."""
    known = {each["test"] for each in yaml.safe_load(UNSTEADY.read_text("utf-8"))}
    names = f": {', '.join(sorted(now))}" if now else ""
    return f"Unsteady tests: {len(now)} in this run, {len(now - known)} of them new{names}"


def broken(run: Stages, found: Sequence[Count]) -> Iterator[str]:
    """Each reason for which this run has not passed."""
    if failed := [name for _, _, status, name in run if status]:
        yield f"these stages failed: {', '.join(failed)}"
    if missing := sum(len(count.missing) for count in found):
        yield f"nothing asked for {missing} mutants and rogues"
    for kind, fewest in FEWEST.items():
        counts = [count for count in found if count.kind == kind]
        shown = sum(count.graded + count.kept + count.undrawn for count in counts)
        if shown < fewest:
            yield f"{shown} {kind} are proven, and {fewest} are the fewest that show something"


def unfounded(tests: Sequence[Test]) -> Iterator[str]:
    """Skips that are no reason to call anything proven."""
    skipped = [each for each in tests if each.outcome == "skipped"]
    if tests and len(skipped) == len(tests):
        yield f"all {len(tests)} tests were skipped: {_lacks(skipped)}"
    if unnamed := sum(_kind(each) is None for each in skipped):
        yield f"{unnamed} tests were skipped for no reason that tests/machine.py names"


def proven(tests: Sequence[Test], found: Sequence[Count], due: WasDue) -> str:
    """The last line of a run that passed: it says no more than was proven."""
    of_machine = [each for each in tests if each.outcome == "skipped" and _kind(each) == "machine"]
    but = f"proven, but for {len(of_machine)} of the machine: {_lacks(of_machine)}"
    before = _kept(tests)
    if parts := [*due.unclear(), *_unproven(tests, found)]:
        words = "; ".join([*parts, *([but] if of_machine else []), *before])
        return f"Passed, but NOT PROVEN: {words}."
    if of_machine:
        return f"P{'; '.join([but, *before])[1:]}."
    well = "All is well: every mutant and every rogue is proven, and no test was skipped"
    return f"{'; '.join([well, *before])}."


def _unproven(tests: Sequence[Test], found: Sequence[Count]) -> Iterator[str]:
    """What nobody may believe after this run, by the reason."""
    if any(count.unproven for count in found):
        yield ", ".join(f"{c.unproven} of {len(c.there)} {_named(c)}" for c in found)
    out_of_time = sum(each.outcome == "skipped" and _kind(each) == "time" for each in tests)
    if out_of_time:
        yield f"{out_of_time} of {len(tests)} tests left out for want of time"
    yield from told(each.outcome for each in tests if each.outcome == UNDRAWN)


def _kept(tests: Sequence[Test]) -> list[str]:
    """What did not run now and is proven all the same; in one line at most."""
    return told(each.outcome for each in tests if each.outcome == KEPT)


def _kind(test: Test) -> str | None:
    from machine import TABLE

    return TABLE[test.lack].kind if test.lack in TABLE else None


def _lacks(tests: Sequence[Test]) -> str:
    """How many for want of what; the most first."""
    counted = Counter(each.lack or "reason" for each in tests)
    return ", ".join(f"{number} no {lack}" for lack, number in counted.most_common())


def _named(count: Count) -> str:
    """In the middle of a sentence."""
    return count.name[0].lower() + count.name[1:]


if __name__ == "__main__":
    sys.exit(main(*map(Path, sys.argv[1:4])))
