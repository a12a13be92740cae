"""A save is told once; what tools and editors write is not."""

from __future__ import annotations

import os
import queue
import shutil
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from hardship import Run

from roslings.workspace.watch import changes

LONG_S = 60.0
"""A bound, not a measure: every wait ends when its condition holds."""


class Watcher:
    """A watch in a thread; its sets of paths come through a queue."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder.resolve()
        self.sets: queue.Queue[frozenset[Path]] = queue.Queue()
        self.ended = threading.Event()
        self.thread = threading.Thread(target=self._run, daemon=True)

    def _run(self) -> None:
        for found in changes(self.folder, self.ended.is_set, begin=True):
            self.sets.put(found)

    def names(self) -> set[str]:
        """The names in the next set."""
        found = self.sets.get(timeout=LONG_S)
        return {path.relative_to(self.folder).as_posix() for path in found}

    def until(self, name: str) -> set[str]:
        """All names that were told until `name` was."""
        told: set[str] = set()
        while name not in told:
            told |= self.names()
        return told


@pytest.fixture
def watcher(package: Path) -> Iterator[Watcher]:
    """A watch of the package that has begun."""
    watching = Watcher(package)
    watching.thread.start()
    assert watching.sets.get(timeout=LONG_S) == frozenset()
    yield watching
    watching.ended.set()
    watching.thread.join(LONG_S)
    assert not watching.thread.is_alive()


def save_as_vim(path: Path, text: str) -> None:
    """Vim tests the folder, writes a swap file, moves the old file aside, writes the new one."""
    (path.parent / "4913").touch()
    (path.parent / "4913").unlink()
    swap = path.with_name(f".{path.name}.swp")
    swap.write_text(text)
    path.rename(f"{path}~")
    path.write_text(text)
    Path(f"{path}~").unlink()
    swap.unlink()


def save_as_gedit(path: Path, text: str) -> None:
    """gedit writes a new file and renames it over the old one."""
    new = path.with_name(".goutputstream-ABCDEF")
    new.write_text(text)
    new.replace(path)


@pytest.mark.parametrize("save", [Path.write_text, save_as_vim, save_as_gedit])
def test_a_save_is_told_by_its_name_alone(watcher: Watcher, save: object) -> None:
    """However the editor does it."""
    assert callable(save)
    save(watcher.folder / "chatter" / "talker.py", "x = (")
    assert watcher.until("chatter/talker.py") == {"chatter/talker.py"}


def test_what_tools_write_is_not_told(watcher: Watcher) -> None:
    """Only the last of these is a save."""
    for name in (
        "build/x",
        "install/x",
        "log/x",
        ".git/index",
        "chatter/__pycache__/talker.cpython-312.pyc",
        "chatter/.talker.py.swp",
        "chatter/talker.py~",
        "chatter/#talker.py#",
        "chatter/talker.py___jb_tmp___",
        "chatter/talker.py.tmp",
        "chatter/talker.py.tmp.4711.1700000000",
        "chatter/.talker.py.swo",
        "chatter/talker.py.bck",
        "chatter/talker.py.aB3dEf",
        "chatter/talker.py.sb-1f2e3d4c-Xy12ab",
        "chatter/.#talker.py",
        "chatter/flycheck_talker.py",
        "chatter/talker_flymake.py",
        "chatter/sedQx81Zz",
        "chatter/talker.py.yours2",
    ):
        (watcher.folder / name).parent.mkdir(parents=True, exist_ok=True)
        (watcher.folder / name).write_text("made")
    (watcher.folder / "setup.py").write_text("x")
    assert watcher.until("setup.py") == {"setup.py"}


@pytest.mark.parametrize(
    "name", ["rover.launch.py", "rover.urdf.xacro", "template.py", "sediment.py", "old.py"]
)
def test_a_name_that_looks_like_an_editors_is_told(watcher: Watcher, name: str) -> None:
    """It is the student's own."""
    (watcher.folder / name).write_text("x")
    assert name in watcher.until(name)


def test_new_and_removed_files_are_told(watcher: Watcher) -> None:
    """In new folders too."""
    (watcher.folder / "chatter" / "new").mkdir()
    (watcher.folder / "chatter" / "new" / "more.py").touch()
    watcher.until("chatter/new")
    (watcher.folder / "setup.cfg").unlink()
    watcher.until("setup.cfg")


def test_a_folder_that_vanishes_is_waited_for(watcher: Watcher, tmp_path: Path) -> None:
    """When it is back, the folder itself is told, and then each save in it."""
    shutil.copytree(watcher.folder, tmp_path / "copy")
    shutil.rmtree(watcher.folder)
    (tmp_path / "copy").rename(watcher.folder)
    watcher.until(".")
    (watcher.folder / "setup.py").write_text("x")
    watcher.until("setup.py")


def test_a_folder_that_is_moved_away_is_waited_for(watcher: Watcher, tmp_path: Path) -> None:
    """The old one, in its new place, is no longer watched."""
    watcher.folder.rename(tmp_path / "away")
    (tmp_path / "away" / "setup.py").write_text("x")
    shutil.copytree(tmp_path / "away", watcher.folder)
    watcher.until(".")
    told: set[str] = set()
    while "setup.cfg" not in told:  # where it was told that it is gone, it is told once more: back
        (watcher.folder / "setup.cfg").write_text("x")
        told |= watcher.names()
    assert "setup.py" not in told


def away(folder: Path, aside: Path) -> None:
    """Renamed out of its parent."""
    folder.rename(aside)


def gone(folder: Path, aside: Path) -> None:
    """Deleted, and a copy kept for later."""
    shutil.copytree(folder, aside)
    shutil.rmtree(folder)


def a_file_instead(folder: Path, aside: Path) -> None:
    """Replaced by a file."""
    folder.rename(aside)
    folder.touch()


@pytest.mark.parametrize("spoil", [away, gone, a_file_instead])
def test_that_a_folder_vanishes_is_told_at_once(
    package: Path, tmp_path: Path, spoil: Callable[[Path, Path], None]
) -> None:
    """Before it is back; whoever wakes the watch is heard meanwhile."""
    woken = threading.Event()
    found = changes(package, begin=True, wake=woken.is_set)
    assert next(found) == frozenset()
    spoil(package, tmp_path / "aside")
    told = frozenset[Path]()
    while package not in told:
        told = next(found)
    assert not package.is_dir()
    woken.set()
    assert next(found) == frozenset()
    woken.clear()
    if package.exists():
        package.unlink()
    (tmp_path / "aside").rename(package)
    woken.set()
    assert next(found) == frozenset({package})
    found.close()  # type: ignore[attr-defined]  # a generator


def test_a_folder_that_is_closed_is_told_as_gone(package: Path, without_rights: Run) -> None:
    """And waited for; a closed folder within the package does not matter."""
    watch = """
        import sys
        from pathlib import Path
        from roslings.workspace.watch import changes
        folder = Path(sys.argv[1])
        (folder / "resource").chmod(0)
        found = changes(folder, begin=True)
        print(len(next(found)))
        folder.chmod(0)
        closed = next(found)
        while not closed:
            closed = next(found)
        print(*(path.name for path in closed))
        folder.chmod(0o755)
        print(*(path.name for path in next(found)))
        (folder / "resource").chmod(0o755)
    """
    assert without_rights(watch, package).split() == ["0", "chatter", "chatter"]


def test_ctrl_c_ends_the_watch_quietly(package: Path) -> None:
    """No traceback, and the caller goes on after its loop."""
    source = """
import os, signal, sys, threading, time
from pathlib import Path
from roslings.workspace.watch import changes

def press_ctrl_c_while_it_waits(thread):
    waits = False
    while not waits:
        time.sleep(0.01)
        frame = sys._current_frames().get(thread)
        while frame and not waits:
            waits = frame.f_code.co_name == "_changes"
            frame = frame.f_back
    os.kill(os.getpid(), signal.SIGINT)

signal.signal(signal.SIGINT, signal.default_int_handler)
main = threading.get_ident()
for found in changes(Path(sys.argv[1]), begin=True):
    threading.Thread(target=press_ctrl_c_while_it_waits, args=[main], daemon=True).start()
print("after")
"""
    ended = subprocess.run(
        [sys.executable, "-c", source, str(package)],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        capture_output=True,
        text=True,
        check=False,
        timeout=LONG_S,
    )
    assert (ended.stdout, ended.stderr, ended.returncode) == ("after\n", "", 0)
