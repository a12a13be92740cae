"""What of a package is copied, and what is not."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest
from hardship import Run

from roslings.workspace import errors as trouble
from roslings.workspace.copying import HALF_MADE
from roslings.workspace.sources import PackageLimits, files
from roslings.workspace.student import stage


def contents(folder: Path) -> dict[str, bytes]:
    """Every file under a folder, by name, hidden ones too."""
    found = (path for path in folder.rglob("*") if path.is_file())
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in found}


def test_a_stage_has_every_source_and_no_more(package: Path, tmp_path: Path) -> None:
    """What tools make stays behind; the student's files are as they were."""
    wanted = contents(package)
    for name in ("build/x", "install/x", "log/x", ".git/x", "chatter/__pycache__/talker.pyc"):
        (package / name).parent.mkdir(parents=True)
        (package / name).write_text("made")
    (package / "venv").mkdir()
    (package / "venv" / "pyvenv.cfg").touch()
    (package / "chatter.egg-info").mkdir()
    before = contents(package)
    assert contents(stage(package, tmp_path / "new" / "src" / "chatter")) == wanted
    assert contents(package) == before


def test_folders_of_the_students_own_are_copied(package: Path, tmp_path: Path) -> None:
    """A module called log, and an empty folder, are not colcon's."""
    (package / "chatter" / "log").mkdir()
    (package / "chatter" / "log" / "__init__.py").touch()
    (package / "empty").mkdir()
    staged = stage(package, tmp_path / "staged")
    assert (staged / "chatter" / "log" / "__init__.py").is_file()
    assert (staged / "empty").is_dir()


def test_bytes_stay_as_they_are(package: Path, tmp_path: Path) -> None:
    """CRLF and what is no UTF-8 are copied as they stand, and so is the right to run."""
    script = package / "start me ünïcode.sh"
    script.write_bytes(b"#!/bin/sh\r\n\xff\xfe\0")
    script.chmod(0o555)
    staged = stage(package, tmp_path / "staged") / script.name
    assert staged.read_bytes() == script.read_bytes()
    assert os.access(staged, os.X_OK | os.W_OK)


def test_a_link_that_stays_inside_stays_a_link(package: Path, tmp_path: Path) -> None:
    """It then leads to the copy, not to the student's file, even where it was absolute."""
    (package / "here.py").symlink_to(package / "chatter" / "talker.py")
    staged = stage(package, tmp_path / "staged")
    assert (staged / "here.py").resolve() == (staged / "chatter" / "talker.py").resolve()


@pytest.mark.parametrize("outside", ["/etc", "/etc/passwd", "../../.."])
def test_a_link_that_leads_outside_is_refused(package: Path, tmp_path: Path, outside: str) -> None:
    """Nothing of the machine gets into the copy."""
    (package / "chatter" / "secret").symlink_to(outside)
    with pytest.raises(trouble.LinkLeadsOutside, match="chatter/secret"):
        stage(package, tmp_path / "staged")
    assert not (tmp_path / "staged").exists()


def test_links_that_lead_nowhere_are_left_out(package: Path, tmp_path: Path) -> None:
    """Emacs locks a file with one; a loop is one as well; a link to itself has no end."""
    (package / ".#setup.py").symlink_to("someone@somewhere.123:456")
    (package / "loop").symlink_to("loop")
    (package / "chatter" / "up").symlink_to("..")
    assert contents(stage(package, tmp_path / "staged")) == contents(package)


def test_pipes_are_left_out(package: Path, tmp_path: Path) -> None:
    """To read one would wait for ever."""
    os.mkfifo(package / "pipe")
    assert not (stage(package, tmp_path / "staged") / "pipe").exists()


def test_too_much_is_refused_with_the_largest_part(package: Path, tmp_path: Path) -> None:
    """A bag or a video in the package; nothing is half made."""
    with (package / "bag.mcap").open("wb") as bag:
        bag.truncate(201_000_000)
    with pytest.raises(trouble.TooLarge, match=r"bag\.mcap"):
        stage(package, tmp_path / "staged")
    (package / "bag.mcap").unlink()
    with pytest.raises(trouble.TooLarge, match="5 files"):
        stage(package, tmp_path / "staged", PackageLimits(files=5))
    assert [path.name for path in tmp_path.iterdir()] == [package.parents[2].name]


def test_nothing_is_written_over(package: Path, tmp_path: Path) -> None:
    """Not over a file, not into a folder that holds something."""
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "work.py").touch()
    (tmp_path / "file").write_text("mine")
    (tmp_path / "link").symlink_to("nowhere")
    for name in ("full", "file", "link"):
        with pytest.raises(trouble.TargetAlreadyThere):
            stage(package, tmp_path / name)
    assert contents(tmp_path / "full") == {"work.py": b""}
    assert (tmp_path / "file").read_text() == "mine"
    assert not list(tmp_path.glob(f"{HALF_MADE}*"))


def test_a_file_where_a_folder_would_be_is_told(package: Path, tmp_path: Path) -> None:
    """`src` is a file, say."""
    (tmp_path / "src").touch()
    with pytest.raises(trouble.NotAFolder, match="src is a file"):
        stage(package, tmp_path / "src" / "chatter")


def test_what_may_not_be_read_or_written_is_told(package: Path, without_rights: Run) -> None:
    """By name, and nothing is half made."""
    source = """
        import sys
        from pathlib import Path
        from roslings.workspace.student import stage
        from roslings.workspace.errors import WorkspaceError
        try:
            print(stage(Path(sys.argv[1]), Path(sys.argv[2])))
        except WorkspaceError as error:
            print(type(error).__name__, error)
    """
    into = package.parents[2] / "read only"
    into.mkdir(mode=0o555)
    assert without_rights(source, package, into / "a" / "b").startswith("CannotWrite")
    assert list(into.iterdir()) == []
    into.chmod(0o755)
    talker = package / "chatter" / "talker.py"
    talker.chmod(0)
    said = without_rights(source, package, into / "a" / "b")
    assert said.startswith("CannotRead")
    assert "talker.py" in said
    assert list(into.iterdir()) == []


def test_a_full_disk_leaves_nothing(package: Path, with_little_room: Run) -> None:
    """64 kB of room, and a package that has more."""
    (package / "figures" / "big.png").write_bytes(bytes(100_000))
    source = """
        import sys
        from pathlib import Path
        from roslings.workspace.student import stage
        from roslings.workspace.errors import DiskFull
        little = Path(sys.argv[1])
        try:
            stage(Path(sys.argv[2]), little / "src" / "chatter")
        except DiskFull as error:
            print(error, list(little.iterdir()))
    """
    said = with_little_room(source, package)
    assert said.startswith("The disk is full")
    assert said.endswith("[]")


def test_names_are_told_in_order(package: Path) -> None:
    """The same package gives the same list on every machine."""
    names = list(files(package))
    shutil.rmtree(package / "chatter")
    assert sorted(names) == sorted(set(names))
    assert set(names) > set(files(package))
