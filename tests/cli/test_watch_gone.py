"""`watch` where what it follows is deleted, moved, replaced, closed: it says so, and goes on."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from watch_terminal import Watched, watching

from ros2_on_pip.errors import RoslingsError
from roslings.course import lab
from roslings.workspace.inspect import inspect_package
from roslings.workspace.student import package_of, stage
from roslings_launcher.cli import parser
from roslings_learn.commands.watch.drill import begun as drill_begun
from roslings_learn.commands.watch.keyboard import Keyboard
from roslings_learn.commands.watch.lab import begun
from roslings_learn.commands.watch.session import tell
from roslings_learn.drills import drill

CHILD = drill("child")
"""Its starter has a verdict before anything is run."""
VERDICT = "ANSWER is still None"
GONE, FOLDER = (
    r"is gone:\s+it was deleted, renamed or moved away",
    r"is a folder, and must be a file",
)


def delete(path: Path) -> None:
    """A file, or a folder with all that is in it."""
    shutil.rmtree(path) if path.is_dir() else path.unlink()


def move_away(path: Path) -> None:
    """Out of what is watched."""
    path.rename(path.parents[2] / f"{path.name}.away")


def rename(path: Path) -> None:
    """Under another name beside it."""
    path.rename(path.with_name(f"my_{path.name}"))


def make_a_folder_of_it(path: Path) -> None:
    """With something in it."""
    path.unlink()
    (path / "more").mkdir(parents=True)


def make_a_file_of_it(path: Path) -> None:
    """Where a folder was."""
    shutil.rmtree(path)
    path.touch()


SPOILED: list[tuple[Callable[[Path], None], bool, str]] = [
    (delete, False, GONE),
    (move_away, False, GONE),
    (rename, False, GONE),
    (make_a_folder_of_it, False, FOLDER),
    (delete, True, GONE),
    (move_away, True, GONE),
    (rename, True, GONE),
    (make_a_file_of_it, True, GONE),
]
"""What happens, whether to the folder of the file or to the file itself, and what is said of it."""


def put_back(file: Path) -> None:
    """The starter, at its place; what stands there or on the way makes room."""
    for path in (file.parent, file):
        if path.exists() and (path.is_dir() is (path == file)):
            delete(path)
    file.parent.mkdir(exist_ok=True)
    new = file.with_name(".new")  # as editors save
    shutil.copyfile(CHILD.starter, new)
    new.replace(file)


@pytest.mark.parametrize(("spoil", "of_folder", "told"), SPOILED)
def test_a_drill_that_vanishes_is_told(
    spoil: Callable[[Path], None],
    of_folder: bool,
    told: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """And is not done, though it was before."""
    monkeypatch.setenv("ROSLINGS_WS", str(tmp_path))
    session = drill_begun(CHILD.name, Keyboard())
    spoil(session.file.parent if of_folder else session.file)
    session._check()
    said = capsys.readouterr().err
    assert re.search(told, said) and not session.is_done()
    assert "./roslings drill child" in said or told == FOLDER


@pytest.mark.slow
def test_a_drill_that_vanishes_is_told_and_waited_for(tmp_path: Path) -> None:
    """Each way, one after the other, in one watch; its keys work while there is nothing."""
    file = tmp_path / "roslings_ws" / "drills" / CHILD.day / CHILD.file_name
    with watching(tmp_path, CHILD.name) as watch:
        watch.shows(rf"(?s){VERDICT}.*q quit\n")
        for spoil, of_folder, told in SPOILED:
            watch.forget()
            spoil(file.parent if of_folder else file)
            assert "Traceback" not in watch.shows(rf"(?s)(Gone|Saved).*{told}.*q quit\n")
            assert "./roslings drill child" in watch.said() or told == FOLDER
            watch.forget()
            put_back(file)
            watch.shows(rf"(?s)Saved.*{VERDICT}.*q quit\n")
            forget_moved(file)
        delete(file.parent)
        press_and_leave(watch)


def forget_moved(file: Path) -> None:
    """The next way needs the same names."""
    for path in (file.parent, file):
        for name in (path.parents[2] / f"{path.name}.away", path.with_name(f"my_{path.name}")):
            if name.exists():
                delete(name)


def press_and_leave(watch: Watched) -> None:
    """Keys are heard also while the folder is gone."""
    watch.shows(GONE)
    watch.press("l")
    watch.shows("in another terminal")
    watch.press("r")
    watch.shows(GONE)
    watch.press("q")


def test_a_package_that_is_moved_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Also where it is found elsewhere in the workspace: nobody follows it there."""
    monkeypatch.setenv("ROSLINGS_WS", str(tmp_path))
    session = begun(lab("topics"), parser().parse_args(["watch", "topics"]), Keyboard())
    (tmp_path / "src" / "more").mkdir()
    session.folder.rename(tmp_path / "src" / "more" / "chatter")
    session._check(None)  # type: ignore[arg-type]  # it is not asked for
    told = capsys.readouterr().err
    assert "is gone" in told and "./roslings start topics" in told
    assert not session.is_done()


@pytest.mark.parametrize("spoil", [delete, rename, make_a_folder_of_it])
@pytest.mark.parametrize(
    "name",
    sorted(
        path.relative_to(lab("topics").solution).as_posix()
        for path in lab("topics").solution.rglob("*")
        if path.is_file()
    ),
)
def test_each_file_of_a_package_may_vanish(
    name: str, spoil: Callable[[Path], None], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What cannot be read is told in words of ours, which `watch` shows; no traceback."""
    monkeypatch.setenv("ROSLINGS_WS", str(tmp_path))
    package = tmp_path / "src" / "chatter"
    shutil.copytree(lab("topics").solution, package)
    spoil(package / name)
    try:
        found = package_of(lab("topics"))
        inspect_package(found, lab("topics").card)
        stage(found, tmp_path / "staged")
    except RoslingsError as told:
        tell(told)


@pytest.mark.parametrize(
    "error", [FileNotFoundError, IsADirectoryError, NotADirectoryError, PermissionError]
)
def test_what_vanishes_between_two_looks_is_told(
    error: type[OSError], capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """A file may go while it is read."""
    tell(error(2, "it went", str(tmp_path / "talker.py")))
    told = capsys.readouterr().err
    assert "talker.py" in told and ("Save it once more" in told or "permission" in told)
    with pytest.raises(ZeroDivisionError):
        tell(ZeroDivisionError())
