"""What `prove` prints: what does not hold, whole; of the rest, how much it is."""

from __future__ import annotations

import textwrap
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from typing import Protocol

from roslings_prove.prove import Proof

WIDTH = 80
INDENT = " " * 7


class ProofLine(Protocol):
    """A proof, or a number of a lab."""

    @property
    def line(self) -> str:
        """It in words."""


def told(found: Sequence[ProofLine], *, all_of_them: bool = False) -> Iterator[str]:
    """Lines for a terminal: what is wrong stands last, above the numbers."""
    proofs = [each for each in found if isinstance(each, Proof)]
    for proof in sorted(proofs, key=lambda each: not each.holds):
        if all_of_them or not proof.holds:
            yield from wrapped(proof.line)
    yield from _counts(proofs)
    for each in found:
        if not isinstance(each, Proof):
            yield from wrapped(each.line, INDENT[:2])


def _counts(proofs: Iterable[Proof]) -> Iterator[str]:
    """How many proofs of each lab hold."""
    whose = Counter((each.about.partition(":")[0], each.holds) for each in proofs)
    for lab in dict.fromkeys(lab for lab, _ in whose):
        held = whose[lab, True]
        yield f"{lab}: {held} of {held + whose[lab, False]} proofs hold"


def wrapped(text: str, indent: str = INDENT) -> list[str]:
    """Lines of at most 80 letters, where words allow it."""
    lines = []
    for line in text.splitlines():
        own = line[: len(line) - len(line.lstrip())] or indent
        lines += textwrap.wrap(
            line, WIDTH, subsequent_indent=own, break_long_words=False, break_on_hyphens=False
        )
    return lines
