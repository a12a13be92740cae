"""What takes long says so; what colcon and guides look for is in the environment."""

from __future__ import annotations

import subprocess
import sys
import threading
from pathlib import Path

import pytest

from roslings_launcher import progress
from roslings_launcher.progress import DownloadLine, going_on
from roslings_launcher.virtual import COMMANDS, Virtual


class Told:
    """Says how far it is, and knows how often it was asked."""

    def __init__(self, times: int) -> None:
        self._left, self.enough = times, threading.Event()

    def __call__(self) -> str:
        """The words of one moment."""
        self._left -= 1
        if self._left < 0:
            self.enough.set()
        return "3 of 9 packages"


@pytest.mark.parametrize("moves", [True, False])
def test_something_long_is_told_again_and_again(
    moves: bool, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """One line that moves, and is gone at the end; in a file, a line now and then."""
    monkeypatch.setattr(progress, "_EVERY_S", 0.001)
    monkeypatch.setattr(progress, "_PLAIN_EVERY_S", 0.001)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: moves)
    told = Told(times=3)
    with going_on(told):
        assert told.enough.wait(60)
    said = capsys.readouterr().err
    assert said.count("  3 of 9 packages, 0 s") >= 2
    assert said.endswith("\r\033[K") is moves
    assert ("\n" in said) is not moves


def test_what_is_short_is_not_told(capsys: pytest.CaptureFixture[str]) -> None:
    """Nothing flickers."""
    with going_on(Told(times=3)):
        pass
    assert "packages" not in capsys.readouterr().err


def test_the_bar_stays_from_one_download_to_the_next(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """From nothing on; between two pips the terminal is not empty, and at the end it is."""
    monkeypatch.setattr(progress, "_EVERY_S", 0.0)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    with DownloadLine(4.0) as line:
        line.follow(["Progress 1000000 of 2000000", "Saved a.whl"])
        line.follow(["Progress 3000000 of 3000000", "Saved b.whl"])
    shown = capsys.readouterr().err.split("\r\033[K")
    assert [each.partition("] ")[2] for each in shown[1:-1]] == [
        "0 of 4 MB",
        "1 of 4 MB",
        "1 of 4 MB",
        "4 of 4 MB",
        "4 of 4 MB",
    ]
    assert shown[0] == shown[-1] == ""


def test_colcon_and_the_terminal_find_what_they_look_for(tmp_path: Path) -> None:
    """A file for each shell, which says nothing and sets nothing; each command of ours."""
    virtual = Virtual(tmp_path)
    (tmp_path / "lib/python3.12/site-packages").mkdir(parents=True)
    (tmp_path / "bin").mkdir()
    virtual.see(tmp_path / "course")
    for shell in ("bash", "sh", "zsh"):
        assert (tmp_path / f"local_setup.{shell}").is_file()
    words = f"set -eu; before=$(set); . '{tmp_path}/local_setup.sh'; echo done"
    done = subprocess.run(["sh", "-c", words], capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == ("done\n", "")
    assert {path.name for path in (tmp_path / "bin").iterdir()} == set(COMMANDS)
