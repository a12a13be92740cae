"""Which wall holds a submission: what another user could copy from must be closed first."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from roslings.arena import Isolation, reach
from roslings.course import Lab, lab
from roslings.experiment import NoWall, insist_on_wall, walls

SHOWN = 0o755
CLOSED = 0o700


@pytest.fixture
def open_folder() -> Iterator[Path]:
    """One that everybody can enter; pytest's own are closed."""
    with tempfile.TemporaryDirectory() as name:
        Path(name).chmod(SHOWN)
        yield Path(name).resolve()


@pytest.fixture
def task(monkeypatch: pytest.MonkeyPatch) -> Lab:
    """A lab behind the second wall, in a course without answers, as students have it."""
    monkeypatch.setattr(walls, "isolation_for_strangers", lambda: Isolation("user"))
    monkeypatch.setattr(walls, "_answers", lambda lab: iter(()))
    monkeypatch.setattr(walls, "closed_places", tuple)  # whatever lies in this machine's /tmp
    return lab("topics")


def test_others_work_that_everybody_can_read_is_no_wall(task: Lab, open_folder: Path) -> None:
    """The refusal names it, and the command that closes it."""
    work = open_folder / "submissions"
    work.mkdir()
    work.chmod(SHOWN)
    with pytest.raises(NoWall) as told:
        insist_on_wall(task, work)
    assert str(work) in told.value.problem
    assert told.value.next_step.startswith(f"Close it to others: chmod o-rwx {work}")
    work.chmod(CLOSED)
    assert insist_on_wall(task, work).wall == "user"


def test_a_folder_that_is_not_there_yet_is_closed(task: Lab, tmp_path: Path) -> None:
    """The gradebook's, before the first grading."""
    assert insist_on_wall(task, tmp_path / "grades").wall == "user"


@pytest.fixture
def open_clone(open_folder: Path) -> Path:
    """Another copy of the course, which everybody may read."""
    (open_folder / "labs/actions/solution").mkdir(parents=True)
    return open_folder


def test_where_nothing_can_close_it_another_copy_with_answers_is_no_wall(
    open_clone: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An older kernel: the refusal names what lies open, of other labs too."""
    monkeypatch.setattr(walls, "isolation_for_strangers", lambda: Isolation("user"))
    for module in (walls, reach):
        monkeypatch.setattr(module, "landlock_version", lambda: 0)
    monkeypatch.setattr(walls, "WHOLE_DISK", (str(open_clone.parent),))
    answers = open_clone / "labs/actions/solution"

    def refusal() -> str:
        try:
            insist_on_wall(lab("topics"))
        except NoWall as told:
            return told.next_step
        return ""

    assert str(answers) in refusal()
    answers.chmod(CLOSED)
    assert str(answers) not in refusal()


def test_a_place_with_an_open_copy_is_closed(
    open_clone: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As long as everybody can read its answers: then nobody is refused."""
    monkeypatch.setattr(walls, "OPEN_TO_ALL", (str(open_clone),))
    monkeypatch.setattr(walls, "landlock_version", lambda: 1)
    assert walls.closed_places() == (str(open_clone),)
    (open_clone / "labs/actions/solution").chmod(CLOSED)
    assert walls.closed_places() == ()


def test_the_answers_of_every_lab_are_looked_at(
    open_clone: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where the kernel cannot keep a user from them."""
    monkeypatch.setattr(walls, "root", lambda: open_clone)
    monkeypatch.setattr(walls, "copies_of_the_course", lambda: iter(()))
    (open_clone / "labs/topics/mutants").mkdir(parents=True)
    found = {*walls._answers(lab("topics"))}
    assert found == {open_clone / "labs/actions/solution", open_clone / "labs/topics/mutants"}
