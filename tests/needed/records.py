"""What is kept of each test file: `tests/proofs/needs`.

    states.txt.xz     a line for each need in some state: KIND (a letter) DIGEST PATH
    records.jsonl.xz  a line for each test file: how it was run, and its needs by their lines there

Many test files need the same files in the same state, so each state is written once. Both are
packed: plain they would be a large part of what may be kept with the proofs.
"""

from __future__ import annotations

import json
import lzma
import os
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

from needed.tree import Kind, Need

STATES, RECORDS = "states.txt.xz", "records.jsonl.xz"


@dataclass(frozen=True)
class Record:
    """A test file whose slow tests have passed, and what they needed."""

    file: str
    made_with: str
    """The Python, and where ROS came from: with others it may need other files."""
    skipped: Mapping[str, str]
    """Tests that the machine lacked something for, each with its name in `machine.py`."""
    needs: Mapping[Need, str]
    """Each with its digest when the test ran."""

    @property
    def lacks(self) -> list[str]:
        """What the machine did not have."""
        return sorted(set(self.skipped.values()))


def made_with() -> str:
    """As this process is run."""
    ros = "apt" if "ROS_DISTRO" in os.environ else "pip"
    return f"Python {sys.version_info[0]}.{sys.version_info[1]}, ROS from {ros}"


State = tuple[Need, str]


@dataclass(frozen=True)
class Records:
    """The folder of all records."""

    folder: Path

    def read(self) -> dict[str, Record]:
        """Test file to its record."""
        states = [_state(line) for line in self._lines(STATES)]
        found = (_record(json.loads(line), states) for line in self._lines(RECORDS))
        return {record.file: record for record in found}

    def _lines(self, name: str) -> list[str]:
        file = self.folder / name
        return lzma.decompress(file.read_bytes()).decode().splitlines() if file.exists() else []

    def write(self, records: Iterable[Record]) -> None:
        """All of them, in place of what was there."""
        found = sorted(records, key=lambda record: record.file)
        states = sorted({state for record in found for state in record.needs.items()})
        places = {state: number for number, state in enumerate(states)}
        self.folder.mkdir(parents=True, exist_ok=True)
        self._replace(STATES, (f"{n.kind} {digest} {n.path}" for n, digest in states))
        self._replace(RECORDS, (json.dumps(_line(record, places)) for record in found))

    def _replace(self, name: str, lines: Iterable[str]) -> None:
        part = self.folder / f"{name}.part"
        part.write_bytes(lzma.compress("".join(f"{line}\n" for line in lines).encode()))
        part.replace(self.folder / name)

    def add(self, record: Record, there: Iterable[str]) -> None:
        """Keep one more; of a test file that is no longer there nothing is kept."""
        kept = self.read() | {record.file: record}
        names = {record.file, *there}
        self.write(each for file, each in kept.items() if file in names)


def _state(line: str) -> State:
    kind, digest, path = line.split(" ", 2)
    return Need(path, cast(Kind, kind)), digest


def _record(line: Mapping[str, Any], states: Sequence[State]) -> Record:
    needs = dict(states[number] for number in numbers(line["needs"]))
    return Record(line["file"], line["made_with"], line["skipped"], needs)


def _line(record: Record, places: Mapping[State, int]) -> dict[str, object]:
    needs = ranges(sorted(places[state] for state in record.needs.items()))
    return {
        "file": record.file,
        "made_with": record.made_with,
        "skipped": record.skipped,
        "needs": needs,
    }


def ranges(found: Sequence[int]) -> str:
    """`0-2 5` for 0, 1, 2, 5."""
    parts: list[list[int]] = []
    for number in found:
        if parts and parts[-1][1] == number - 1:
            parts[-1][1] = number
        else:
            parts.append([number, number])
    return " ".join(str(first) if first == last else f"{first}-{last}" for first, last in parts)


def numbers(text: str) -> Iterator[int]:
    """What `ranges` has written."""
    for part in text.split():
        first, _, last = part.partition("-")
        yield from range(int(first), int(last or first) + 1)
