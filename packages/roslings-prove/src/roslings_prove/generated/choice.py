"""Which wrong packages are made of a lab's solution: the same ones each time, spread over it.

The seed is fixed, as the operators are. The order is that of hashes. So a new operator or a new
line of a solution moves few of the others, and no version of Python moves any.
"""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from roslings.course import Lab
from roslings_changes import candidates as changes
from roslings_changes.candidates import CodeChange

SEED = 20261123
WANTED = 100
"""So many packages of a lab; all, where fewer can be made."""


@dataclass(frozen=True)
class Generated(CodeChange):
    """A change of a lab's solution."""

    lab: Lab

    @cached_property
    def name(self) -> str:
        """Short, and the same as long as the place and the change are."""
        short = hashlib.sha256(self.changed.encode()).hexdigest()[:8]
        place = f"{self.file.rpartition('/')[2]}:{self.line}"
        return f"{self.lab.name}-{self.operator}-{place}-{short}"

    def put_into(self, package: Path) -> None:
        """Write the changed module."""
        (package / self.file).write_text(self.after, "utf-8")


def generated(lab: Lab) -> list[Generated]:
    """The wrong packages of a lab, as they were drawn: the first ones are spread over it, too."""
    return chosen(candidates(lab))


def candidates(lab: Lab) -> list[Generated]:
    """All that the operators make of a solution, each program once."""
    found = changes.candidates(lab, lab.solution)
    return [Generated(e.operator, e.file, e.line, e.before, e.after, lab) for e in found]


def chosen(found: Iterable[Generated]) -> list[Generated]:
    """As many as are wanted: the operators in turn, each time the line changed least so far."""
    by_operator: dict[str, list[Generated]] = {}
    for each in sorted(found, key=_drawn):
        by_operator.setdefault(each.operator, []).append(each)
    result: list[Generated] = []
    lines: Counter[tuple[str, int]] = Counter()
    while len(result) < WANTED and any(by_operator.values()):
        for waiting in filter(None, by_operator.values()):
            next_one = min(waiting, key=lambda each: lines[each.place])
            waiting.remove(next_one)
            lines[next_one.place] += 1
            result.append(next_one)
    return result[:WANTED]


def _drawn(each: Generated) -> str:
    return hashlib.sha256(f"{SEED} {each.name}".encode()).hexdigest()
