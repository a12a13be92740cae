"""The wall for somebody else's submission to a lab: it hides what the submission must not read."""

from __future__ import annotations

import stat
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from roslings.arena import Isolation, Lack, isolation_for_strangers
from roslings.course import Lab, root
from roslings.course.labs import MUTANTS
from roslings.errors import RoslingsError

OTHERS = stat.S_IROTH | stat.S_IXOTH


class NoWall(RoslingsError):
    """Strangers' code would run with all rights of whoever runs the command."""

    def __init__(self, lack: Lack) -> None:
        self.problem = f"Submissions are strangers' code, and nothing would hold it: {lack.reason}."
        self.next_step = f"{lack.next_step}\nOr trust every submission with this machine: --trust"
        super().__init__(f"{self.problem}\n{self.next_step}")


def wall_for(lab: Lab, *others_work: Path) -> Isolation:
    """The best wall there is for submissions to `lab`; its `lack` says where none holds them.

    Another user sees the disk as everybody does: what shows the answers must be closed, and so
    must the folders with other submissions and their grades.
    """
    wall = isolation_for_strangers()
    if wall.wall != "user" or wall.lack:
        return wall
    places = (*_answers(lab), *(path.resolve() for path in others_work if path.exists()))
    seen = [path for path in places if _is_open(path)]
    if not seen:
        return wall
    names = " ".join(map(str, seen))
    reason = f"another user can read {seen[0]}, and copy from there"
    return replace(wall, lack=Lack(reason, f"Close it to others: chmod o-rwx {names}"))


def insist_on_wall(lab: Lab, *others_work: Path) -> Isolation:
    """As `wall_for`. Raises NoWall."""
    wall = wall_for(lab, *others_work)
    if wall.lack:
        raise NoWall(wall.lack)
    return wall


def _answers(lab: Lab) -> Iterator[Path]:
    """Solutions, mutants and what tells of them; the students' edition has none of these."""
    if lab.solution.is_dir():
        places = (lab.solution.parent, lab.folder / MUTANTS, root() / "tests", root() / ".git")
        yield from (path.resolve() for path in places if path.exists())
    if lab.hidden:
        yield lab.hidden.resolve()


def _is_open(path: Path) -> bool:
    reached = all(folder.stat().st_mode & stat.S_IXOTH for folder in path.parents)
    return reached and bool(path.stat().st_mode & OTHERS)
