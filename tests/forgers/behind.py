"""Grade forgers behind one wall, between honest packages, and write down what came of it."""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from forger import Forger, slow_talker
from pydantic import BaseModel
from rogue import LAB
from stage import LONG_S, Stage, adopting, files_in, known, living, quiet, readable_to_all, said

from roslings.course import root

Wall = Literal["namespaces_as_root", "namespaces_as_user", "user"]
WALLS: tuple[Wall, ...] = ("namespaces_as_root", "namespaces_as_user", "user")
HONEST = ("aa_honest", "mm_honest", "zz_honest")
SLOW = "ab_slow"
FREE_PORT = 9


class Seen(BaseModel):
    """What came of one submission."""

    word: str
    score: float | None
    wall: str | None
    reached: list[str]
    failed: list[str]


class Graded(BaseModel):
    """What came of all behind one wall."""

    seen: dict[str, Seen]
    changed: list[str]
    """Of the course, the home, the submissions and the environment."""
    running: dict[int, str]
    words: str
    """Of the command."""


@dataclass
class Behind(Stage):
    """A stage behind one wall. As root without namespaces, every user can read Python."""

    wall: Wall = "user"
    kept: dict[str, str] = field(default_factory=dict)

    def command(self, *more: str) -> list[str]:
        """`./roslings grade` of all submissions."""
        words = super().command(*more)
        return [*with_users(), *words] if self.wall == "user" else words

    def environment(self) -> dict[str, str]:
        """The second wall is asked for: a machine that has it alone is seldom at hand."""
        choice = {"ROSLINGS_ISOLATION": "user"} if self.wall == "user" else {}
        return {**super().environment(), **choice}

    def close_answers(self) -> None:
        """As the second wall asks for."""
        self.course.chmod(0o755)
        for answers in (*self.course.glob("labs/*/solution"), *self.course.glob("labs/*/mutants")):
            answers.chmod(0o700)
        self.home.chmod(0o700)
        self.submissions.chmod(0o700)


def with_users() -> list[str]:
    """The beginning of a command of root that can have the wall of users.

    The course that these tests stand in is another one than the course that grades, with the same
    answers: nobody sees its labs there.
    """
    return readable_to_all(0, f"--hide={root() / 'labs'}")


NEEDED: dict[Wall, tuple[str, ...]] = {
    "user": ("root", "other users"),
    "namespaces_as_user": ("namespaces", "bubblewrap", "bounded processes"),
    "namespaces_as_root": ("root", "namespaces", "bubblewrap", "bounded processes"),
}
"""Of a machine, by the names of `machine.py`."""


@contextmanager
def stage_behind(wall: Wall) -> Iterator[Behind]:
    """A furnished stage."""
    place = Path(tempfile.mkdtemp(prefix="forgers-"))
    place.chmod(0o755)
    made = Behind(place, wall == "namespaces_as_user" and os.geteuid() == 0, wall=wall)
    try:
        made.furnish()
        made.close_answers()
        yield made
    finally:
        made.end_all()
        shutil.rmtree(place, ignore_errors=True)


def grade(entries: Sequence[Forger], wall: Wall, jobs: int) -> Graded:
    """Grade all of them in one go."""
    with stage_behind(wall) as made:
        for entry in entries:
            token = f"{made.mark}.{entry.name}"
            entry.make(
                made.submissions / entry.name / LAB.card.package, known(made, token, FREE_PORT, 0)
            )
        for name in HONEST:
            shutil.copytree(LAB.solution, made.submissions / name / LAB.card.package)
        slow_talker(made.submissions / SLOW / LAB.card.package)
        made.give_away()
        return _graded(made, jobs)


def _graded(made: Behind, jobs: int) -> Graded:
    before = _files(made)
    with adopting() as children:
        command = made.begin("--jobs", str(jobs), "--hidden", str(made.hidden))
        words, _ = command.communicate(timeout=LONG_S)
        running = quiet(lambda: {**children(), **living(made.mark)})
    changed = sorted(_files(made) ^ before)
    assert (made.out / "gradebook.sqlite").exists(), words
    seen = {name: _seen(made, name) for name in made.results()}
    return Graded(seen=seen, changed=changed, running=running, words=words)


def _files(made: Behind) -> set[str]:
    """All that no submission may change."""
    packages = Path(os.__file__).parent, Path(sys.prefix) / "bin", *map(Path, _site_packages())
    listed = {f"{folder}/{each.name}" for folder in packages for each in os.scandir(folder)}
    own = {str(made.home), str(made.course), str(made.submissions)}
    return {f"{path}" for path in listed if not path.endswith("__pycache__")}.union(
        *(files_in(Path(folder)) for folder in own)
    )


def _site_packages() -> list[str]:
    return [path for path in sys.path if path.endswith("site-packages")]


def _seen(made: Behind, name: str) -> Seen:
    result = made.results()[name]
    evidence = made.evidence(result)
    lines = list(said(evidence)) if evidence else []
    verdict = result.verdict
    return Seen(
        word=result.word,
        score=result.score,
        wall=verdict.environment.wall if verdict else None,
        reached=sorted({line for line in lines if line.startswith("GOT")}),
        failed=[check.id for check in verdict.failed()] if verdict else [],
    )
