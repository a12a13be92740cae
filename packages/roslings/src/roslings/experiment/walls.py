"""The wall for somebody else's submission to a lab: it hides what the submission must not read."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from ros2_on_pip.errors import RoslingsError
from roslings.arena import Isolation, Lack, isolation_for_strangers
from roslings.arena.reach import OPEN_TO_ALL, landlock_version, within_reach
from roslings.course import Lab, root
from roslings.course.labs import MUTANTS

OTHERS = stat.S_IROTH | stat.S_IXOTH
SOLUTION = "solution"
ANSWERS = f"labs/*/{SOLUTION}"
CLONES_LIE_SO_DEEP = 5
"""As in /home/NAME/Documents/courses/roslings."""
WHOLE_DISK = ("/",)
NO_CLONE_IN = ("/proc", "/sys", "/dev", "/usr", "/etc", "/boot", "/lib", "/lib64", "/bin", "/sbin")


class NoWall(RoslingsError):
    """Strangers' code would run with all rights of whoever runs the command."""

    def __init__(self, lack: Lack) -> None:
        self.problem = f"Submissions are strangers' code, and nothing would hold it: {lack.reason}."
        self.next_step = f"{lack.next_step}\nOr trust every submission with this machine: --trust"
        super().__init__(f"{self.problem}\n{self.next_step}")


def wall_for(lab: Lab, *others_work: Path) -> Isolation:
    """The best wall there is for submissions to `lab`; its `lack` says where none holds them.

    Another user sees the disk as everybody does, or what the kernel lets it reach. What shows the
    answers there must be closed, in other copies of the course too. So must the folders with other
    submissions and their grades.
    """
    wall = isolation_for_strangers()
    if wall.wall != "user" or wall.lack:
        return wall
    places = (*_answers(lab), *(path.resolve() for path in others_work if path.exists()))
    closed = closed_places()
    seen = [path for path in places if within_reach(path, closed) and _is_open(path)]
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
    """Solutions and mutants of every lab, and what tells of them; students' editions have none."""
    for course in dict.fromkeys((root().resolve(), *copies_of_the_course())):
        yield from _answers_in(course)
    if lab.hidden:
        yield lab.hidden.resolve()


def _answers_in(course: Path) -> Iterator[Path]:
    if not any(course.glob(ANSWERS)):
        return
    labs = (course / "labs").iterdir()
    places = [*(lab / name for lab in labs for name in (SOLUTION, MUTANTS))]
    yield from filter(Path.exists, (*places, course / "tests", course / ".git"))


def closed_places() -> tuple[str, ...]:
    """Places like /tmp in which a copy of the course lies open: no leased user may go there."""
    if not landlock_version():
        return ()
    return tuple(place for place in OPEN_TO_ALL if any(_open_copies_in(place)))


def _open_copies_in(place: str) -> Iterator[Path]:
    for course in _copies_below(Path(place), CLONES_LIE_SO_DEEP):
        yield from filter(_is_open, _answers_in(course))


def copies_of_the_course() -> Iterator[Path]:
    """Clones where another user could look, as far as they lie open.

    Where the kernel confines such a user, that is where every user may leave files. Else it is the
    whole disk, down to where clones lie, and the system's own folders excepted.
    """
    places = OPEN_TO_ALL if landlock_version() else WHOLE_DISK
    for place in places:
        yield from _copies_below(Path(place), CLONES_LIE_SO_DEEP)


def _copies_below(folder: Path, levels: int) -> Iterator[Path]:
    try:
        inside = [each for each in os.scandir(folder) if each.is_dir(follow_symlinks=False)]
    except OSError:
        return
    if "labs" in {each.name for each in inside} and any(folder.glob(ANSWERS)):
        yield folder
        return
    for each in inside if levels else ():
        if each.path not in NO_CLONE_IN and _lets_in(each):
            yield from _copies_below(Path(each.path), levels - 1)


def _lets_in(folder: os.DirEntry[str]) -> bool:
    try:
        return bool(folder.stat(follow_symlinks=False).st_mode & stat.S_IXOTH)
    except OSError:  # it is gone meanwhile
        return False


def _is_open(path: Path) -> bool:
    reached = all(folder.stat().st_mode & stat.S_IXOTH for folder in path.parents)
    return reached and bool(path.stat().st_mode & OTHERS)
