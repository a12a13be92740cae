"""Which processes a drive's nodes are: by a mark on a command line, and by who began whom."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from roslings.capabilities.rooms.processes import executables_below, marked

MARK = "_roslings_drive_5f"


def process(proc: Path, pid: int, parent: int, *words: str, name: str = "python") -> None:
    """As the kernel tells of it."""
    folder = proc / str(pid)
    folder.mkdir()
    folder.joinpath("cmdline").write_bytes("\0".join([*words, ""]).encode())
    folder.joinpath("stat").write_text(f"{pid} ({name}) S {parent} 1 1 0 -1 4194304\n")


@pytest.fixture
def proc(tmp_path: Path) -> Path:
    """A launch within a sandbox: two nodes of the package, one of another, and a node's child."""
    process(tmp_path, 1, 0, "init")
    process(tmp_path, 10, 1, "bwrap", "--", "start.py", f"/{MARK}.launch.py")
    process(tmp_path, 11, 10, "python", "start.py", "launch", f"/{MARK}.launch.py")
    process(tmp_path, 12, 11, "/usr/bin/python", "/ws/lib/wanderer/look", "--ros-args")
    process(tmp_path, 13, 11, "/ws/lib/wanderer/drive", name="a) R 1 (b")
    process(tmp_path, 14, 11, "/ros/lib/others/relay")
    process(tmp_path, 15, 12, "/usr/bin/python", "/ws/lib/wanderer/look", "--ros-args")
    process(tmp_path, 20, 1, "/usr/bin/python", "/ws/lib/wanderer/look")
    (tmp_path / "self").mkdir()
    (tmp_path / "99").mkdir()
    return tmp_path


def test_the_first_of_those_with_the_mark_is_it(proc: Path) -> None:
    """What it has begun belongs to it."""
    assert marked(MARK, proc) == (10,)
    assert marked("_roslings_drive_00", proc) == ()


def test_a_launch_leads_to_its_nodes(proc: Path) -> None:
    """Those of the package, whatever their names; not the same program of somebody else."""
    assert executables_below((10,), "wanderer", proc) == (12, 13)
    assert executables_below((10,), "others", proc) == (14,)
    assert executables_below((), "wanderer", proc) == ()


def test_where_nothing_is_told_nobody_is_there(tmp_path: Path) -> None:
    """As on macOS."""
    assert marked(MARK, tmp_path / "none") == ()
    assert executables_below((1,), "wanderer", tmp_path / "none") == ()


def test_a_real_process_is_found() -> None:
    """By this kernel's own words."""
    words = [sys.executable, "-c", "import sys; sys.stdin.readline()", f"{MARK}:={MARK}"]
    with subprocess.Popen(words, stdin=subprocess.PIPE) as begun:
        assert begun.pid in marked(MARK)
        assert begun.stdin
        begun.stdin.close()
    assert begun.pid not in marked(MARK)
