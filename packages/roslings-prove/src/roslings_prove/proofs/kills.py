"""Known kills: generated wrong packages that something caught once, and that are proven as mutants.

`tests/proofs/LAB.kills.json` says how each is made of the solution. One whose line the solution has
no longer is no package any more; `prove --record` leaves it out, and says so.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from pydantic import BaseModel, ConfigDict, RootModel

from roslings.course import Lab
from roslings.course.grader import Clock
from roslings.course.mutants import Edit, Mutant
from roslings_class.result import GradingResult
from roslings_prove.prove import ProvenPackage, failing, injured, packages_of

ENDING = ".kills.json"


class Kill(BaseModel):
    """One place of a solution made wrong, and a check that must fail of it."""

    model_config = ConfigDict(frozen=True)

    name: str
    """Of no other kill of its lab: what was done, where, and a digest of it."""
    check: str
    edit: Edit

    def applies(self, lab: Lab) -> bool:
        """Whether the solution still has that place, once."""
        file = lab.solution / self.edit.file
        return file.is_file() and file.read_text("utf-8").count(self.edit.find) == 1


class Kills(RootModel[tuple[Kill, ...]]):
    """All that are known of a lab."""


@dataclass(frozen=True)
class KnownKill:
    """A known kill as a package: a check that failed once fails again."""

    lab: Lab
    kill: Kill
    clock: Clock = "auto"
    course: None = None

    @property
    def name(self) -> str:
        """With what was done, and where."""
        return f"{self.lab.name}: kill {self.kill.name}"

    @property
    def about(self) -> str:
        """Which check must catch it."""
        return f"{self.name} fails {self.kill.check}"

    def make(self, folder: Path) -> Path:
        """The solution, injured."""
        wrong = Mutant(
            name=self.kill.name,
            what=self.kill.name,
            fails=(self.kill.check,),
            edits=(self.kill.edit,),
        )
        return injured(self.lab, wrong, folder / self.name.replace("/", "-"))

    def problem(self, result: GradingResult) -> str:
        """That the check does not fail; others may fail beside it."""
        checks = result.verdict.checks if result.verdict else ()
        caught = any(each.id == self.kill.check and each.outcome == "fail" for each in checks)
        return "" if caught else failing(result)


def kills_in(folder: Path, lab: Lab) -> tuple[Kill, ...]:
    """All that the file of a lab names."""
    file = folder / f"{lab.name}{ENDING}"
    return Kills.model_validate_json(file.read_bytes()).root if file.is_file() else ()


def write_kills(folder: Path, lab: Lab, kills: Sequence[Kill]) -> None:
    """Name these, and no others."""
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / f"{lab.name}{ENDING}"
    file.write_text(f"{Kills(tuple(kills)).model_dump_json(indent=1)}\n", "utf-8")


def kept_packages(lab: Lab, folder: Path) -> list[ProvenPackage]:
    """All of a lab that has a line: what proves the lab, and the known kills."""
    known: Iterable[Kill] = (each for each in kills_in(folder, lab) if each.applies(lab))
    return [*packages_of(lab), *(KnownKill(lab, each) for each in known)]


def edit_between(file: str, before: str, after: str) -> Edit:
    """The change of a text as one edit: whole lines, as few as stand once in what was before."""
    old, new = before.splitlines(keepends=True), after.splitlines(keepends=True)
    first = next(
        (at for at, (one, other) in enumerate(zip(old, new, strict=False)) if one != other),
        min(len(old), len(new)),
    )
    last = 0
    while last < min(len(old), len(new)) - first and old[-1 - last] == new[-1 - last]:
        last += 1
    while _text(old, first, last) == "" or before.count(_text(old, first, last)) != 1:
        if first == 0 and last == 0:
            break
        first, last = max(first - 1, 0), max(last - 1, 0)
    return Edit(file=file, find=_text(old, first, last), replace=_text(new, first, last))


def _text(lines: Sequence[str], first: int, but_last: int) -> str:
    return "".join(lines[first : len(lines) - but_last])
