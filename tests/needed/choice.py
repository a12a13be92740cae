"""Which slow tests run at a landing, and why. The rules stand here, and only here.

- A test file without a record runs. So does one of which something that it needs is another now:
  another digest than when it was recorded, or gone. Its own text is such a need, and each package
  that is installed; a package that is new is none.
- One that was recorded where a machine lacked something runs where it is there, and one that was
  recorded with another Python, or with ROS from elsewhere, runs.
- Where all is as it was, a sixth runs all the same; the commit draws it.
- Where only modules of the core of measuring are another (what all labs are measured with), a third
  runs: the digest of the core draws it. So each state of the core has another third.
- Where only folders that were listed have other names in them, a third runs; the commit draws it.
  So it is where files were added: what was opened there is a need of its own, and is as it was.
- Lots are drawn among files; where the tests of a file are many, dear and independent, among these.

Tests that are not slow run always. No rule looks at the calendar, or at what git tells of the past.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from needed.left_out import KEPT, UNDRAWN, LeftOut, drawn
from needed.records import Record, made_with
from needed.tree import BYTES, MEANING, Need, Tree, few

PART_OF_KEPT = 6
"""One of so many files runs though all that it needs is as it was."""
PART_FOR_THE_CORE = 3
"""One of so many files runs where, of what it needs, only the core of measuring is another."""
PART_FOR_NAMES = 3
"""The same, where only names in folders that were listed are others."""
BY_TEST = frozenset({"tests/rogues/test_rogues.py", "tests/forgers/test_forgers.py"})
"""Files of which each part runs at each landing: strangers' code must be held off at every one."""

CERTAIN, SAME, CORE, NAMES_ONLY = "certain", "same", "core", "names"


@dataclass(frozen=True)
class Core:
    """What all labs are measured with."""

    files: frozenset[str]
    digest: str


@dataclass(frozen=True)
class Standing:
    """A test file beside its record."""

    file: str
    rule: str
    """`CERTAIN`: it runs; all others: a lot decides."""
    why: str


@dataclass
class Choice:
    """What is done with each recorded test file."""

    records: Mapping[str, Record]
    tree: Tree
    core_now: Callable[[], Core]
    """Asked only where something is another."""
    commit: str
    lack_of: Callable[[str], str]
    """Why the machine has not what a name of `machine.py` means; nothing where it has."""

    @cached_property
    def standings(self) -> dict[str, Standing]:
        """Of each test file that has a record."""
        return {file: self._standing(record) for file, record in sorted(self.records.items())}

    @cached_property
    def left_out(self) -> dict[str, LeftOut]:
        """Those that do not run, or of which only a part does."""
        return {each.file: each for each in self._left_out()}

    def why(self, file: str) -> str:
        """What is done with a file, in words."""
        standing, left = self.standings.get(file), self.left_out.get(file)
        if standing is None:
            return "runs: it has no record"
        if left is None:
            lot = "" if standing.rule == CERTAIN else ", and the lot fell on it"
            return f"runs: {standing.why}{lot}"
        but = f", but for one of {left.part} of its tests" if left.part else ""
        return f"left out{but}: {standing.why}"

    @cached_property
    def _digests(self) -> dict[Need, str]:
        """Each need is read once, however many need it."""
        needs = {need for record in self.records.values() for need in record.needs}
        return {need: self.tree.digest(need) for need in needs}

    @cached_property
    def _core(self) -> Core:
        return self.core_now()

    def other_needs(self, record: Record) -> list[Need]:
        """What is another now than when it was recorded."""
        return [need for need, digest in record.needs.items() if self._digests[need] != digest]

    def _standing(self, record: Record) -> Standing:
        if record.made_with != made_with():
            return Standing(record.file, CERTAIN, f"it was recorded with {record.made_with}")
        if there := [name for name in record.lacks if not self.lack_of(name)]:
            return Standing(record.file, CERTAIN, f"it was recorded without {', '.join(there)}")
        other = self.other_needs(record)
        if not other:
            return Standing(record.file, SAME, "all that it needs is as it was")
        named = few(each.path or "." for each in other)
        if all(self._is_of_the_core(each) for each in other):
            return Standing(record.file, CORE, f"only the core of measuring is another ({named})")
        if all(self._is_list_still(each) for each in other):
            return Standing(record.file, NAMES_ONLY, f"only names of files are others ({named})")
        return Standing(record.file, CERTAIN, f"another: {named}")

    def _is_list_still(self, need: Need) -> bool:
        """Of a folder that is there: what is gone may have been looked for."""
        return need.is_list and need.path in self.tree.folders

    def _is_of_the_core(self, need: Need) -> bool:
        """One that is gone is not: nothing tells which others took its place."""
        return need.kind in (BYTES, MEANING) and need.path in self._core.files

    def _left_out(self) -> Iterator[LeftOut]:
        yield from self._by_lot(SAME, KEPT, PART_OF_KEPT, lambda: self.commit)
        yield from self._by_lot(CORE, UNDRAWN, PART_FOR_THE_CORE, lambda: self._core.digest)
        yield from self._by_lot(NAMES_ONLY, UNDRAWN, PART_FOR_NAMES, lambda: self.commit)

    def _by_lot(
        self, rule: str, outcome: str, part: int, seed: Callable[[], str]
    ) -> Iterator[LeftOut]:
        files = {file for file, standing in self.standings.items() if standing.rule == rule}
        if not files:
            return
        for file in sorted(files & BY_TEST):
            yield LeftOut(file, outcome, part, seed(), self._skipped(file))
        others = files - BY_TEST
        for file in sorted(others - drawn(others, seed(), part)):
            yield LeftOut(file, outcome, skipped=self._skipped(file))

    def _skipped(self, file: str) -> tuple[str, ...]:
        return tuple(self.records[file].skipped)
