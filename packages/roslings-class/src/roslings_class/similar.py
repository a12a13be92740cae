"""Submissions that are nearly the same, for a person to look at: never a verdict.

Marks that many share are the task's, not a student's: a lab says what every node must do.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations

from roslings_class.result import GradingResult

SHARED_BY_PART, SHARED_BY_LEAST = 0.25, 5
"""A mark that more than a quarter of the class has, but at least five, counts for nobody."""
FEWEST_MARKS = 8
LIKE = 0.6
MOST_PAIRS = 50


@dataclass(frozen=True)
class Pair:
    """Two submissions that share most of the marks that few have."""

    one: str
    other: str
    likeness: float
    """The shared part of the smaller one's rare marks, 0 to 1."""
    marks: int
    """How many they share."""


def equal_groups(results: Iterable[GradingResult]) -> list[list[str]]:
    """Submissions whose code is the same word for word."""
    groups: defaultdict[str, list[str]] = defaultdict(list)
    for result in results:
        if result.source and result.marks:
            groups[result.source].append(result.submission)
    return sorted(sorted(names) for names in groups.values() if len(names) > 1)


def alike(results: Sequence[GradingResult], common: Iterable[int] = ()) -> list[Pair]:
    """Pairs that are nearly the same, most alike first; `common` are the starter's own marks."""
    rare = _rare_marks(results, frozenset(common))
    sources = {result.submission: result.source for result in results}
    pairs = [
        pair
        for one, other in combinations(sorted(rare), 2)
        if sources[one] != sources[other] and (pair := _pair(one, other, rare))
    ]
    return sorted(pairs, key=lambda pair: (-pair.likeness, -pair.marks))[:MOST_PAIRS]


def _pair(one: str, other: str, rare: dict[str, frozenset[int]]) -> Pair | None:
    shared = len(rare[one] & rare[other])
    smaller = min(len(rare[one]), len(rare[other]))
    if shared < FEWEST_MARKS or shared < LIKE * smaller:
        return None
    return Pair(one, other, shared / smaller, shared)


def _rare_marks(
    results: Sequence[GradingResult], common: frozenset[int]
) -> dict[str, frozenset[int]]:
    counts = Counter(mark for marks in _one_of_each(results) for mark in marks)
    most = max(SHARED_BY_LEAST, SHARED_BY_PART * len(results))
    many = {mark for mark, count in counts.items() if count > most} | common
    return {result.submission: frozenset(result.marks) - many for result in results}


def _one_of_each(results: Sequence[GradingResult]) -> Iterable[tuple[int, ...]]:
    """Equal code counts once, or thirty copies would make themselves common."""
    return {result.source: result.marks for result in results}.values()
