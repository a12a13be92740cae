"""`watch` on a terminal: one key for each thing that a learner wants next."""

from __future__ import annotations

import os
import pty
import re
import select
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from roslings.commands.editing import Place, editor_for, first_to_do
from roslings.course import lab, root
from roslings.drills import all_drills

PATIENCE_S = 120.0
"""Only a test that fails waits so long."""
ESCAPES = re.compile(r"\x1b(\[[0-9;?]*[a-zA-Z]|[=>]|\][^\x07]*\x07)")
EDITOR = """#!/bin/sh
echo "# edited" >> "$1"
"""


@dataclass
class Watched:
    """The command on a terminal of 80 columns."""

    process: subprocess.Popen[bytes]
    screen: int
    _said: bytearray = field(default_factory=bytearray)

    def press(self, key: str) -> None:
        """Press a key; what stood there before no longer counts."""
        self._said.clear()
        os.write(self.screen, key.encode())

    def shows(self, pattern: str) -> str:
        """Wait until the screen has shown it; all that it has shown since the last key."""
        end_s = time.monotonic() + PATIENCE_S
        while not re.search(pattern, self.said()):
            assert time.monotonic() < end_s, f"{pattern!r} does not come:\n{self.said()}"
            if select.select([self.screen], [], [], 0.1)[0]:
                self._said += os.read(self.screen, 65536)
        return self.said()

    def said(self) -> str:
        """Without colours and movements of the cursor."""
        return ESCAPES.sub("", self._said.decode("utf-8", "replace")).replace("\r", "")


@contextmanager
def watching(home: Path, *words: str) -> Iterator[Watched]:
    """`./roslings watch WORDS` of a student with an empty home; it ends well, by itself."""
    screen, other_end = pty.openpty()
    own = {
        "HOME": str(home), "ROSLINGS_WS": str(home / "roslings_ws"), "TERM": "xterm",
        "COLUMNS": "80", "LINES": "24", "EDITOR": str(home / "editor"), "VISUAL": "",
    }  # fmt: skip
    process = subprocess.Popen(
        [sys.executable, "-m", "roslings", "watch", *words], cwd=root(),
        env={**os.environ, **own}, stdin=other_end, stdout=other_end, stderr=other_end,
        start_new_session=True,
    )  # fmt: skip
    os.close(other_end)
    try:
        yield Watched(process, screen)
        assert process.wait(PATIENCE_S) == 0
    finally:
        if process.poll() is None:
            process.kill()
            process.wait()
        os.close(screen)


def in_the_readme() -> list[str]:
    """The lines that the README shows; `...` stands for what it leaves out."""
    readme = (root() / "README.md").read_text("utf-8")
    (block,) = re.findall(r"^```text\n(Day 02-.*?)^```$", readme, re.M | re.S)
    return [line for line in block.splitlines() if line not in ("", "...")]


def with_editor(home: Path) -> Path:
    """A home whose editor writes a line and ends."""
    editor = home / "editor"
    editor.write_text(EDITOR)
    editor.chmod(0o755)
    return home


def test_without_a_name_todays_drill_is_opened_and_then_the_next(tmp_path: Path) -> None:
    """The program that is mended makes place for the next one, by itself."""
    first, second = all_drills()[:2]
    with watching(with_editor(tmp_path)) as watch:
        watch.shows(rf"(?s)Drill 1 of .*drill {first.name}.*Save a file")
        watch.press("h")
        watch.shows(f"Hint 1 of 3 for {first.name}")
        watch.press("r")
        watch.shows(rf"(?s){re.escape(first.card.starter.names)}.*Save a file")
        watch.press("n")
        watch.shows("is not done yet")
        file = tmp_path / "roslings_ws" / "drills" / first.day / first.file_name
        shutil.copyfile(first.solution, file)
        watch.shows(rf"(?s)it does all that is asked.*Drill 2 of .*drill {second.name}.*Save a")
        assert (file.parent / second.file_name).is_file()
        watch.press("q")


def test_a_labs_starter_is_put_there(tmp_path: Path) -> None:
    """The keys tell more, and the editor's save is checked."""
    with watching(with_editor(tmp_path), "nodes") as watch:
        said = watch.shows("h hint .* q quit")
        assert "The starter of 'nodes' is in" in said
        assert [line for line in in_the_readme() if line not in said.splitlines()] == []
        watch.press("h")
        watch.shows("Hint 1 of 3")
        watch.press("h")
        watch.shows("Hint 2 of 3")
        watch.press("l")
        watch.shows(r"\./roslings lab 2 ")
        watch.press("g")
        watch.shows("No node has run yet")
        watch.press("n")
        watch.shows("is not done yet")
        watch.press("?")
        watch.shows("h hint .* q quit")
        watch.press("e")
        said = watch.shows(r"(?s)Saved: .*Save a file to check again")
        assert max(map(len, said.partition("Lab nodes,")[2].splitlines())) <= 80
        watch.press("q")
    package = tmp_path / "roslings_ws" / "src" / "rover_status"
    assert "# edited" in (package / "rover_status" / "minimal_publisher.py").read_text("utf-8")


def test_who_is_done_goes_on_with_what_is_next(tmp_path: Path) -> None:
    """The graph is that of the check; then comes what was left out: here the day's drills."""
    nodes = lab("nodes")
    shutil.copytree(nodes.solution, tmp_path / "roslings_ws" / "src" / nodes.card.package)
    with watching(with_editor(tmp_path), "nodes") as watch:
        watch.shows(r"(?s)100 of 100.*Done\. To hand it in: \./roslings pack nodes.*Save a file")
        watch.press("g")
        watch.shows("/minimal_publisher")
        watch.press("r")
        watch.shows(r"(?s)1 of 7.*100 of 100.*Save a file")
        watch.press("n")
        watch.shows(r"(?s)Drill 1 of .*Save a file to check again")
        watch.press("q")


def test_the_first_thing_to_do_is_where_the_editor_opens(tmp_path: Path) -> None:
    """In the package's own code; else its first file."""
    package = tmp_path / "chatter"
    (package / "chatter").mkdir(parents=True)
    (package / "setup.py").write_text("# TODO 1\n")
    (package / "chatter" / "listener.py").write_text("import rclpy\n")
    assert first_to_do(package) == Place(package / "chatter" / "listener.py")
    (package / "chatter" / "talker.py").write_text("import rclpy\n# TODO 2: a timer\n")
    assert first_to_do(package) == Place(package / "chatter" / "talker.py", 2)


def test_an_editor_that_is_set_wins_but_in_vs_code(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """`code` is asked for the line; another one gets the file; with none the place is told."""
    place, words = Place(tmp_path / "talker.py", 7), ("VISUAL", "EDITOR", "TERM_PROGRAM")
    for name in ("code", "nano"):
        (tmp_path / name).write_text("#!/bin/sh\n")
        (tmp_path / name).chmod(0o755)
    for word in words:
        monkeypatch.delenv(word, raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    code = [str(tmp_path / "code"), str(tmp_path), "--goto", f"{place.file}:7"]
    assert editor_for(place, tmp_path) == code
    monkeypatch.setenv("EDITOR", "nano -w")
    assert editor_for(place, tmp_path) == ["nano", "-w", str(place.file)]
    monkeypatch.setenv("TERM_PROGRAM", "vscode")
    assert editor_for(place, tmp_path) == code
    monkeypatch.setenv("PATH", "")
    assert editor_for(place, tmp_path) is None
