"""A few known kills with their evidence, small enough to lie beside the course's tests.

    ./roslings prove LAB --generated --keep-kills DIR

makes DIR/LAB/: for each check that catches something the smallest evidence for it, packed, and
`kills.json`, which says which check failed. Today's grader must find the same in it. Where the
evidence of a lab has another schema, or its experiments are others, the command makes them anew.
"""

from __future__ import annotations

import shutil
from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path

from pydantic import BaseModel, ConfigDict, RootModel

from roslings.authoring.anonymous import without_machine
from roslings.batch.gradebook import Gradebook
from roslings.batch.grading import THOROUGHLY, packed, unpacked
from roslings.batch.result import Result
from roslings.course import Lab
from roslings.evidence import Evidence

INDEX = "kills.json"
KEPT = 25
KEPT_BYTES = 130_000
"""At most so many of a lab, of checks as different as can be, and so many bytes."""


class Kill(BaseModel):
    """One wrong package that was caught."""

    model_config = ConfigDict(frozen=True)

    package: str
    check: str
    """The check that failed."""
    diff: str

    @property
    def file(self) -> str:
        """Where its packed evidence lies, beside the index."""
        return f"{self.package.replace(':', '-')}.evidence"


class Kills(RootModel[tuple[Kill, ...]]):
    """All that are kept of a lab."""


def keep_kills(
    lab: Lab, results: Iterable[tuple[str, str, Result]], book: Gradebook, folder: Path
) -> int:
    """Put evidence for kills (name, diff, result) into `folder`/LAB; how many. None: as it was."""
    kept = list(islice(_in_bytes(_smallest(_with_evidence(results, book))), KEPT))
    if not kept:
        return 0
    place = folder / lab.name
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    for kill, content in kept:
        (place / kill.file).write_bytes(content)
    index = Kills(tuple(kill for kill, _ in kept)).model_dump_json(indent=1)
    (place / INDEX).write_text(f"{index}\n", "utf-8")
    return len(kept)


def read_kills(folder: Path) -> Iterator[tuple[Kill, Evidence]]:
    """The kills that lie in the folder of a lab, each with its evidence."""
    for kill in Kills.model_validate_json((folder / INDEX).read_bytes()).root:
        yield kill, unpacked((folder / kill.file).read_bytes())


def _with_evidence(
    results: Iterable[tuple[str, str, Result]], book: Gradebook
) -> Iterator[tuple[Kill, bytes]]:
    for package, diff, result in results:
        content = book.evidence(result)
        failed = [each.id for each in result.verdict.checks if each.outcome == "fail"] if (
            result.verdict
        ) else []  # fmt: skip
        if content and failed:
            yield Kill(package=package, check=failed[0], diff=diff), _of_anywhere(content)


def _of_anywhere(content: bytes) -> bytes:
    """Packed evidence without words of this machine: tracebacks hold them."""
    return packed(without_machine(unpacked(content)), THOROUGHLY)


def _in_bytes(found: Iterable[tuple[Kill, bytes]]) -> Iterator[tuple[Kill, bytes]]:
    """Those that fit into the room that is left."""
    room = KEPT_BYTES
    for kill, content in found:
        if len(content) <= room:
            room -= len(content)
            yield kill, content


def _smallest(found: Iterable[tuple[Kill, bytes]]) -> Iterator[tuple[Kill, bytes]]:
    """The smallest for each check, then the second smallest of each, and so on."""
    of_check: dict[str, list[tuple[Kill, bytes]]] = {}
    for each in sorted(found, key=lambda each: (len(each[1]), each[0].package)):
        of_check.setdefault(each[0].check, []).append(each)
    while any(of_check.values()):
        for waiting in filter(None, of_check.values()):
            yield waiting.pop(0)
