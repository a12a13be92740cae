"""Start a lab, see what changed, pack it: nothing of the student's is ever lost."""

from __future__ import annotations

import signal
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from hardship import Run

from roslings.course import Lab
from roslings.workspace import errors as trouble
from roslings.workspace.copying import HALF_MADE
from roslings.workspace.sources import files
from roslings.workspace.student import (
    diff,
    pack,
    package_of,
    stage,
    start,
    started_package,
    workspace_root,
)


def texts(folder: Path) -> dict[str, bytes]:
    """Name to content."""
    return {name: path.read_bytes() for name, path in files(folder).items()}


# --- where ------------------------------------------------------------------------------------


def test_the_workspace_is_in_the_home_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    """Unless ROSLINGS_WS names another one."""
    monkeypatch.delenv("ROSLINGS_WS", raising=False)
    monkeypatch.setenv("HOME", "/home/zoë")
    assert workspace_root() == Path("/home/zoë/roslings_ws")
    monkeypatch.setenv("ROSLINGS_WS", "~/my ws")
    assert workspace_root() == Path("/home/zoë/my ws")
    monkeypatch.setenv("ROSLINGS_WS", "here")
    assert workspace_root() == Path.cwd() / "here"


def test_without_a_workspace_the_next_step_is_start(topics: Lab, workspace: Path) -> None:
    """The first command of a student who reads nothing is `check`."""
    assert not workspace.exists()
    with pytest.raises(trouble.NoWorkspace, match="roslings start topics"):
        package_of(topics)


# --- start ------------------------------------------------------------------------------------


def test_start_puts_the_starter_into_src(topics: Lab, workspace: Path) -> None:
    """Under a path with a space, an apostrophe and a letter that is not ASCII."""
    started = start(topics)
    assert started.package == workspace / "src" / "chatter"
    assert texts(started.package) == texts(topics.starter)
    assert started.files == len(texts(topics.starter))
    assert package_of(topics) == started.package


def test_start_never_writes_over_work(topics: Lab, package: Path) -> None:
    """It says what stands there, how to compare, and a free name to move it to."""
    (package.parents[2] / "chatter_old").touch()
    before = texts(package)
    stands = r"your package already \(last changed"
    with pytest.raises(trouble.TargetAlreadyThere, match=stands) as refusal:
        start(topics)
    assert texts(package) == before
    assert "./roslings diff topics" in refusal.value.next_step
    assert "chatter_old2" in refusal.value.next_step


def test_start_twice_says_that_nothing_was_changed_yet(topics: Lab, workspace: Path) -> None:
    """The starter as it came is no work to fear for."""
    start(topics)
    with pytest.raises(trouble.TargetAlreadyThere, match="the starter already, without any change"):
        start(topics)


@pytest.mark.parametrize("kind", ["file", "folder", "link"])
def test_start_leaves_what_is_no_package_too(topics: Lab, workspace: Path, kind: str) -> None:
    """A file, an empty folder, a link that leads nowhere."""
    at = workspace / "src" / "chatter"
    at.parent.mkdir(parents=True)
    if kind == "file":
        at.touch()
    elif kind == "folder":
        at.mkdir()
    else:
        at.symlink_to("nowhere")
    with pytest.raises(trouble.TargetAlreadyThere, match="It stays as it is"):
        start(topics)
    assert [path.name for path in at.parent.iterdir()] == ["chatter"]


def test_start_sees_the_package_elsewhere_in_src(topics: Lab, package: Path) -> None:
    """Two packages of one name would stop colcon."""
    moved = package.parent / "day 3" / "chatter"
    moved.parent.mkdir()
    package.rename(moved)
    with pytest.raises(trouble.TargetAlreadyThere, match="day 3"):
        start(topics)
    assert started_package(topics) == moved


def test_a_killed_start_leaves_no_half_package(
    topics: Lab, workspace: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Killed in the middle of the copy: src/ has no chatter, and the next start works."""
    source = """
import os, signal
from roslings.course import lab
from roslings.workspace import copying
from roslings.workspace.student import start
whole = copying._copy_file
def killed(path, to):
    whole(path, to)
    os.kill(os.getpid(), signal.SIGKILL)
copying._copy_file = killed
start(lab("topics"))
"""
    monkeypatch.setenv("PYTHONPATH", ":".join(sys.path))
    ended = subprocess.run([sys.executable, "-c", source], check=False)
    assert ended.returncode == -signal.SIGKILL
    [left] = (workspace / "src").iterdir()
    assert left.name.startswith(HALF_MADE)
    assert started_package(topics) is None
    assert texts(start(topics).package) == texts(topics.starter)


def test_an_interrupted_start_leaves_nothing(
    topics: Lab, workspace: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Ctrl-C in the middle of the copy: not even the new folders stay."""

    def interrupted(path: Path, to: Path) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("roslings.workspace.copying._copy_file", interrupted)
    with pytest.raises(KeyboardInterrupt):
        start(topics)
    assert not workspace.exists()


def test_start_on_a_full_disk_leaves_nothing(topics: Lab, with_little_room: Run) -> None:
    """What is left of 64 kB is taken first."""
    source = """
        import sys
        from pathlib import Path
        from roslings.course import lab
        from roslings.workspace.student import start
        from roslings.workspace.errors import DiskFull
        little = Path(sys.argv[1])
        try:
            (little / "mine").write_bytes(bytes(56_000))
            start(lab("topics"), little / "ws")
        except DiskFull as error:
            print(error, [path.name for path in little.iterdir()])
    """
    assert with_little_room(source).endswith("['mine']")


# --- diff -------------------------------------------------------------------------------------


def test_nothing_changed_is_an_empty_diff(topics: Lab, workspace: Path) -> None:
    """Built folders are no change."""
    start(topics)
    (workspace / "src" / "chatter" / "build").mkdir()
    (workspace / "src" / "chatter" / "build" / "made").touch()
    assert diff(topics) == []


def test_a_diff_shows_each_kind_of_change(topics: Lab, workspace: Path) -> None:
    """Changed lines, new files, removed ones, pictures, empty ones, CRLF."""
    package = start(topics).package
    setup = package / "setup.cfg"
    setup.write_text(setup.read_text().replace("[develop]", "[developer]"))
    (package / "resource" / "chatter").unlink()
    (package / "new.py").write_text("print('new')\n")
    (package / "empty.txt").touch()
    (package / "shot.png").write_bytes(b"\x89PNG\0" * 1000)
    (package / "latin.txt").write_bytes("Zo\xeb".encode("latin-1"))
    xml = package / "package.xml"
    xml.write_bytes(xml.read_bytes().replace(b"\n", b"\r\n"))
    lines = diff(topics)
    assert "-[develop]" in lines
    assert "+[developer]" in lines
    assert "+++ setup.cfg" in lines
    assert "+print('new')" in lines
    assert "removed: resource/chatter (empty)" in lines
    assert "added: empty.txt (empty)" in lines
    assert "added: shot.png (5.0 kB)" in lines
    assert "added: latin.txt (3 bytes)" in lines
    assert "only the ends of lines changed (CRLF and LF): package.xml" in lines


# --- pack -------------------------------------------------------------------------------------


def test_a_zip_has_the_sources_and_no_more(topics: Lab, package: Path, tmp_path: Path) -> None:
    """Unpacked, it is the package again."""
    wanted = texts(package)
    for name in ("build/x", ".git/x", "chatter/__pycache__/x.pyc"):
        (package / name).parent.mkdir(parents=True)
        (package / name).touch()
    packed = pack(topics, tmp_path / "out.zip")
    with zipfile.ZipFile(packed.path) as archive:
        archive.extractall(tmp_path / "unpacked")
    assert texts(tmp_path / "unpacked" / "chatter") == wanted
    assert sorted(packed.files) == sorted(f"chatter/{name}" for name in wanted)
    assert packed.size_bytes == packed.path.stat().st_size
    assert not packed.replaced


def test_equal_packages_make_equal_zips(topics: Lab, package: Path, tmp_path: Path) -> None:
    """Whatever the dates, the umask and the folder."""
    copy = stage(package, tmp_path / "copy" / "chatter")
    (copy / "setup.py").touch()
    (copy / "package.xml").chmod(0o600)
    one, two = pack(topics, tmp_path / "1.zip"), pack(topics, tmp_path / "2.zip", copy)
    assert one.path.read_bytes() == two.path.read_bytes()


def test_a_zip_goes_where_it_is_wanted(
    topics: Lab, package: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Into the current folder, into a folder, even into the package, but then not into itself."""
    monkeypatch.chdir(tmp_path)
    assert pack(topics).path == tmp_path / "topics.zip"
    first = pack(topics, package)
    assert first.path == package / "topics.zip"
    assert pack(topics, package).files == first.files


def test_an_older_zip_is_replaced_and_said(topics: Lab, package: Path, tmp_path: Path) -> None:
    """Only a zip of this package; anything else stays."""
    pack(topics, tmp_path / "a.zip")
    (package / "new.py").touch()
    again = pack(topics, tmp_path / "a.zip")
    assert again.replaced
    assert "chatter/new.py" in again.files
    (tmp_path / "thesis.zip").write_text("mine")
    with pytest.raises(trouble.TargetAlreadyThere, match=r"no zip of 'chatter'"):
        pack(topics, tmp_path / "thesis.zip")
    assert (tmp_path / "thesis.zip").read_text() == "mine"
    with pytest.raises(trouble.NoSuchPath, match="nowhere"):
        pack(topics, tmp_path / "nowhere" / "a.zip")


def test_a_full_disk_keeps_the_older_zip(topics: Lab, package: Path, with_little_room: Run) -> None:
    """The new one is whole before it takes the place of the old."""
    source = """
        import os, sys
        from pathlib import Path
        from roslings.course import lab
        from roslings.workspace.student import pack
        from roslings.workspace.errors import DiskFull
        out, package = Path(sys.argv[1]) / "a.zip", Path(sys.argv[2])
        pack(lab("topics"), out, package)
        old = out.read_bytes()
        (package / "noise").write_bytes(os.urandom(100_000))
        try:
            pack(lab("topics"), out, package)
        except DiskFull:
            print(out.read_bytes() == old, len(list(out.parent.iterdir())))
    """
    assert with_little_room(source, package) == "True 1"
