"""Which kills are kept: `./roslings prove LAB --generated --keep-kills`.

For each check that catches something, those with the smallest evidence. They become packages
that are proven like mutants: `./roslings prove --record LAB` measures them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path

from roslings.course import Lab
from roslings_class.gradebook import Gradebook
from roslings_class.result import GradingResult
from roslings_prove.generated.choice import Generated
from roslings_prove.proofs.kills import Kill, edit_between, write_kills

KEPT = 25
KEPT_BYTES = 130_000
"""At most so many of a lab, of checks as different as can be, and so many bytes of evidence."""

Sized = tuple[Kill, int]
"""A kill and the bytes of its evidence."""


def keep_kills(
    lab: Lab, results: Iterable[tuple[Generated, GradingResult]], book: Gradebook, folder: Path
) -> int:
    """Name a few of these in the folder of kept proofs; how many. None: as it was."""
    kept = list(islice(_in_bytes(_smallest(_with_sizes(results, book))), KEPT))
    if kept:
        write_kills(folder, lab, kept)
    return len(kept)


def kill_of(change: Generated, check: str) -> Kill:
    """A generated change that a check has caught."""
    name = change.name.removeprefix(f"{change.lab.name}-")
    edit = edit_between(change.file, change.before, change.after)
    return Kill(name=name, check=check, edit=edit)


def _with_sizes(
    results: Iterable[tuple[Generated, GradingResult]], book: Gradebook
) -> Iterator[Sized]:
    for change, result in results:
        content = book.evidence(result)
        checks = result.verdict.checks if result.verdict else ()
        failed = [each.id for each in checks if each.outcome == "fail"]
        if content and failed:
            yield kill_of(change, failed[0]), len(content)


def _in_bytes(found: Iterable[Sized]) -> Iterator[Kill]:
    """Those that fit into the room that is left."""
    room = KEPT_BYTES
    for kill, size in found:
        if size <= room:
            room -= size
            yield kill


def _smallest(found: Iterable[Sized]) -> Iterator[Sized]:
    """The smallest for each check, then the second smallest of each, and so on."""
    of_check: dict[str, list[Sized]] = {}
    for each in sorted(found, key=lambda each: (each[1], each[0].name)):
        of_check.setdefault(each[0].check, []).append(each)
    while any(of_check.values()):
        for waiting in filter(None, of_check.values()):
            yield waiting.pop(0)
