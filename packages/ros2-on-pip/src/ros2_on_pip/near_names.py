"""The name that was probably meant: the one nearest to what was asked for."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

How = Literal["exact", "namespace", "case", "spelling", "other"]
_ORDER: tuple[How, ...] = ("exact", "namespace", "case", "spelling", "other")
SIMILAR = 0.6


@dataclass(frozen=True)
class Near:
    """A name that is there, and how it differs from the one that was asked for."""

    wanted: str
    found: str
    how: How

    @property
    def missing(self) -> str:
        """Where two names differ in one place: the letters that are wanted there, and not there."""
        return self._slip[0]

    @property
    def extra(self) -> str:
        """The same: the letters that are there, and not wanted."""
        return self._slip[1]

    @property
    def _slip(self) -> tuple[str, str]:
        """Which letters, as /alve and /alive look alike; two empty texts for several places."""
        pieces = difflib.SequenceMatcher(None, self.wanted, self.found).get_opcodes()
        others = [piece for piece in pieces if piece[0] != "equal"]
        if len(others) != 1:
            return "", ""
        ((_, begin, end, at, to),) = others
        return self.wanted[begin:end], self.found[at:to]

    @property
    def exact(self) -> bool:
        """It is the very name."""
        return self.how == "exact"


def nearest(wanted: str, names: Iterable[str]) -> Near | None:
    """The name nearest to `wanted`; None where there is no name at all."""
    candidates = [Near(wanted, name, _how(wanted, name)) for name in sorted(set(names))]
    return min(candidates, key=_distance, default=None)


def _how(wanted: str, name: str) -> How:
    if name == wanted:
        return "exact"
    if name.rpartition("/")[2] == wanted.rpartition("/")[2]:
        return "namespace"
    if name.lower() == wanted.lower():
        return "case"
    return "spelling" if _likeness(wanted, name) >= SIMILAR else "other"


def _distance(near: Near) -> tuple[int, float]:
    return _ORDER.index(near.how), -_likeness(near.wanted, near.found)


def _likeness(one: str, other: str) -> float:
    return difflib.SequenceMatcher(None, one, other).ratio()
