"""What a stranger's build left is copied as far as there is room, or not at all."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from roslings.arena import ArenaPlace, choose_isolation
from roslings.course import lab
from roslings.workspace import shared_build as building
from roslings.workspace.foreign import Allowance, NoRoom, copy_foreign
from skips import needs

MB = 1024 * 1024
PLENTY = Allowance(most_bytes=1 << 60, reserve_bytes=0)
TOPICS = lab("topics")
HOLES = """
import os
here = os.getcwd()
while not os.path.isdir(os.path.join(here, "src")):
    here = os.path.dirname(here)
place = os.path.join(here, "install", "chatter", "holes")
os.makedirs(place, exist_ok=True)
for number in range(3):
    with open(os.path.join(place, str(number)), "wb") as file:
        file.truncate(200 << 20)
"""


def sparse(folder: Path, count: int, bytes_each: int) -> Path:
    """Files that are all holes: they take nothing of the disk."""
    folder.mkdir()
    for number in range(count):
        with (folder / str(number)).open("wb") as file:
            file.truncate(bytes_each)
    return folder


def taken_bytes(folder: Path) -> int:
    """Of the disk."""
    return sum(path.lstat().st_blocks * 512 for path in (folder, *folder.rglob("*")))


def test_holes_count_as_what_is_written(tmp_path: Path) -> None:
    """The same files are copied where that wall is taken away: it is what held them."""
    holes = sparse(tmp_path / "holes", 5, 3 * MB)
    assert taken_bytes(holes) < MB
    with pytest.raises(NoRoom):
        copy_foreign(holes, tmp_path / "copy", Allowance(most_bytes=10 * MB, reserve_bytes=0))
    assert not (tmp_path / "copy").exists()
    copy_foreign(holes, tmp_path / "copy", PLENTY)
    assert taken_bytes(tmp_path / "copy") >= 15 * MB


def test_one_file_of_many_names_counts_as_often(tmp_path: Path) -> None:
    """Each name is a copy of its own afterwards."""
    folder = sparse(tmp_path / "names", 1, 3 * MB)
    for number in range(1, 5):
        (folder / str(number)).hardlink_to(folder / "0")
    with pytest.raises(NoRoom):
        copy_foreign(folder, tmp_path / "copy", Allowance(most_bytes=10 * MB, reserve_bytes=0))
    assert not (tmp_path / "copy").exists()


def test_empty_files_and_folders_count(tmp_path: Path) -> None:
    """Each takes a block, and the disk has so many names only."""
    folder = sparse(tmp_path / "empty", 300, 0)
    with pytest.raises(NoRoom):
        copy_foreign(folder, tmp_path / "copy", Allowance(most_bytes=MB, reserve_bytes=0))
    assert not (tmp_path / "copy").exists()


def test_the_last_of_the_disk_is_left(tmp_path: Path) -> None:
    """The others need it: they have a grade."""
    holes = sparse(tmp_path / "holes", 5, 3 * MB)
    keeps = shutil.disk_usage(tmp_path).free * 2
    with pytest.raises(NoRoom):
        copy_foreign(holes, tmp_path / "copy", Allowance(reserve_bytes=keeps))
    assert not (tmp_path / "copy").exists()


def test_plain_files_folders_and_links_are_copied(tmp_path: Path) -> None:
    """Nothing runs as its owner, and what is none of these is left out."""
    folder = tmp_path / "built"
    (folder / "lib/deep").mkdir(parents=True)
    (folder / "lib/deep/text").write_text("x")
    (folder / "lib/runs").write_text("y")
    (folder / "lib/runs").chmod(0o4755)
    (folder / "link").symlink_to("lib/runs")
    (folder / "away").symlink_to("/nonexistent")
    os.mkfifo(folder / "pipe")
    copy_foreign(folder, tmp_path / "copy")
    copied = {
        path.relative_to(tmp_path / "copy").as_posix(): path.lstat().st_mode & 0o7777
        for path in (tmp_path / "copy").rglob("*")
        if not path.is_symlink()
    }
    assert copied == {"lib": 0o755, "lib/deep": 0o755, "lib/deep/text": 0o644, "lib/runs": 0o755}
    assert (tmp_path / "copy/link").readlink() == Path("lib/runs")
    assert (tmp_path / "copy/away").readlink() == Path("/nonexistent")


@pytest.mark.slow
@needs("namespaces", "bubblewrap", "bounded processes")
def test_a_build_full_of_holes_is_used_and_not_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is the package's own; of the disk it takes nothing, unless that wall is taken away."""
    source = tmp_path / "chatter"
    shutil.copytree(TOPICS.solution, source)
    (source / "setup.py").write_text(HOLES + (source / "setup.py").read_text())
    taken: list[int] = []
    for allowance in (Allowance(most_bytes=500 * MB), PLENTY):
        monkeypatch.setattr(
            building,
            "copy_foreign",
            lambda folder, to, it=allowance: copy_foreign(
                folder, to, Allowance(it.most_bytes, it.reserve_bytes)
            ),
        )
        person = tmp_path / f"person-{len(taken)}"
        for folder in ("room", "home"):
            (person / folder).mkdir(parents=True)
        place = ArenaPlace("domain", person / "home", person, choose_isolation().sandbox)
        seen, installed = building.shared_build(
            person / "builds", source, person / "room", place, 180.0
        )
        assert seen.succeeded and installed and installed.programs.parent.is_dir()
        taken.append(taken_bytes(person / "builds"))
        shutil.rmtree(person)
    assert taken[0] < MB < 600 * MB <= taken[1]
