"""Kept proofs: one line a package in `tests/proofs/LAB.jsonl`, its evidence packed in `LAB/`.

A line says what the package was, what measured it, and what was judged from the evidence. It is
believed only as far as it fits its files: whoever changes one of them changes the other.
"""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ConfigDict, TypeAdapter

from roslings.course import Lab, root
from roslings.verdict import Verdict
from roslings.workspace.normal import digest_of_files
from roslings.workspace.sources import files
from roslings_prove.proofs.archives import PART, Archives, replace_file
from roslings_prove.proofs.kills import kept_packages
from roslings_prove.prove import ProvenPackage

FOLDER = "tests/proofs"
STATES = "measuring.jsonl"
MOST_BYTES = 10_000_000
"""Of all that is kept."""

Line = TypeVar("Line", bound=BaseModel)


Words = dict[str, str]
"""Check to its outcome, its points and its fault: `fail 0 TooSlow`."""


class KeptProof(BaseModel):
    """One line: a package that was measured once."""

    model_config = ConfigDict(frozen=True)

    package: str
    """`solution`, `starter`, `mutant NAME` or `kill NAME`."""
    content: str
    """Digest of its files; the evidence carries the same one."""
    card: str
    experiments: str
    core: str
    """Digests of what it was measured by."""
    evidence: str
    """Digest of the evidence as its archive holds it: thin JSON."""
    checks: Words


class State(BaseModel):
    """One line of `measuring.jsonl`: a state of what measures, in the order in which they came."""

    model_config = ConfigDict(frozen=True)

    core: str


def words_of(verdict: Verdict) -> Words:
    """What a line keeps of a verdict."""
    return {
        each.id: " ".join(filter(None, [each.outcome, f"{each.points:g}", each.fault]))
        for each in verdict.checks
    }


def name_in(lab: Lab, package: ProvenPackage) -> str:
    """What a line calls a package of its lab."""
    return package.name.removeprefix(f"{lab.name}: ")


def content_of(package: ProvenPackage) -> str:
    """The digest of its files, as the evidence of it has them."""
    scratch = Path(tempfile.mkdtemp(prefix="roslings-"))
    try:
        place, own = package.make(scratch), package.lab.card.package
        return digest_of_files(files(place if place.name == own else place / own).items())
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


@dataclass(frozen=True)
class Folder:
    """Where proofs are kept."""

    path: Path

    def packages(self, lab: Lab) -> list[ProvenPackage]:
        """All of a lab that has a line here: what proves the lab, and its known kills."""
        return kept_packages(lab, self.path)

    def lines(self, lab: Lab) -> dict[str, KeptProof]:
        """Package's name to its line."""
        found = _read(self.path / f"{lab.name}.jsonl", KeptProof)
        return {line.package: line for line in found}

    @property
    def states(self) -> tuple[str, ...]:
        """The cores that measured, the oldest first."""
        return tuple(state.core for state in _read(self.path / STATES, State))

    def archives(self, lab: Lab) -> Archives:
        """The evidence of a lab's packages, as it is now."""
        return Archives(self.path / lab.name)

    def write(self, lab: Lab, lines: Mapping[str, KeptProof], order: Sequence[str]) -> None:
        """The lines of a lab, in the order of its packages; evidence without a line goes."""
        kept = [lines[name] for name in order if name in lines]
        _write(self.path / f"{lab.name}.jsonl", kept)
        self.archives(lab).keep_only([line.package for line in kept])

    def note_state(self, core: str) -> None:
        """The newest state of what measures comes last; one that is known already stays."""
        if core not in self.states:
            _write(self.path / STATES, [State(core=each) for each in (*self.states, core)])

    @property
    def bytes(self) -> int:
        """Of all that is kept."""
        found = (file for file in self.path.rglob("*") if file.suffix != PART and file.is_file())
        return sum(file.stat().st_size for file in found)


def kept_here() -> Folder:
    """The proofs of this course."""
    return Folder(root() / FOLDER)


def _read(file: Path, kind: type[Line]) -> Iterator[Line]:
    if file.exists():
        yield from (kind.model_validate_json(line) for line in file.read_bytes().splitlines())


def _write(file: Path, lines: Iterable[BaseModel]) -> None:
    found = [TypeAdapter(type(line)).dump_json(line, exclude_none=True) for line in lines]
    replace_file(file, b"".join(line + b"\n" for line in found))
