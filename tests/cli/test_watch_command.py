"""`watch`: a verdict at once, one more at each save, and nothing left at its end."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import pytest

from roslings.course import lab
from until_told import OPEN, until_told

pytestmark = pytest.mark.slow

TOPICS = lab("topics")
WAITS = "Watching. Save a file to check again; Ctrl-C ends it."


@contextmanager
def watching(package: Path, home: Path) -> Iterator[subprocess.Popen[str]]:
    """The command as a student runs it; ended by Ctrl-C, with the exit code of a good end."""
    (home / "tmp").mkdir()
    own = {"HOME": str(home), "ROSLINGS_WS": str(home / "ws"), "TMPDIR": str(home / "tmp")}
    with subprocess.Popen(
        [sys.executable, "-m", "roslings", "watch", "topics", str(package)],
        cwd=home,
        env={**os.environ, **own},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    ) as process:
        yield process
        process.send_signal(signal.SIGINT)
        assert process.wait() == 0


def until_it_waits(process: subprocess.Popen[str]) -> list[str]:
    """What it says until it waits for a save; all it says where it never does."""
    assert process.stdout
    said = list[str]()
    for line in process.stdout:
        said.append(line.rstrip())
        if WAITS in line:
            break
    return said


def after_save(process: subprocess.Popen[str], file: Path, text: str) -> list[str]:
    """What it says after a save of the file."""
    file.write_text(text, "utf-8")
    return until_it_waits(process)


def could_not_tell(said: list[str]) -> bool:
    """Another save asks again."""
    return any(OPEN in line for line in said)


def line_with(word: str, said: list[str]) -> str:
    """The first line with this word."""
    return next((line for line in said if word in line), "\n".join(said))


def test_each_save_has_its_verdict(tmp_path: Path) -> None:
    """The same file right, wrong, broken, and right again: each time what it is now."""
    package = tmp_path / "chatter"
    shutil.copytree(TOPICS.solution, package)
    talker = package / "chatter" / "talker.py"
    right = talker.read_text("utf-8")
    with watching(package, tmp_path) as process:
        said = until_it_waits(process)
        if could_not_tell(said):
            said = until_told(partial(after_save, process, talker, right), could_not_tell)
        assert "100 of 100" in line_with("Score", said)
        for text, said_of_it in (
            (right.replace("Hello robotics", "Hallo robotics"), "not pass"),
            ("def broken(:\n", "not pass"),
            (right, "100 of 100"),
        ):
            said = until_told(partial(after_save, process, talker, text), could_not_tell)
            assert line_with("Saved", said) == "Saved: chatter/talker.py"
            assert ("100 of 100" in line_with("Score", said)) is (said_of_it == "100 of 100"), said
    assert list((tmp_path / "tmp").iterdir()) == []
