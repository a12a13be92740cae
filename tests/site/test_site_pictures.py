"""The pictures of the first 15 minutes are what the course's own programs draw."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from roslings.course import root

PICTURES = root() / "days" / "01-install" / "pictures"
DRAW = root() / "site" / "pictures"
TITLE = "A verdict: one letter is missing in the name of a topic"


def drawn(script: str, *words: str | Path) -> None:
    """Run one of the scripts that draw."""
    subprocess.run([sys.executable, str(DRAW / script), *map(str, words)], check=True)


def test_the_map_is_that_of_the_rover(tmp_path: Path) -> None:
    """The same room, and the way of a real drive."""
    drawn("draw_map.py", tmp_path / "map.svg")
    assert (tmp_path / "map.svg").read_text("utf-8") == (PICTURES / "map.svg").read_text("utf-8")


def test_the_verdict_is_what_the_terminal_shows(tmp_path: Path) -> None:
    """From the kept verdict, which the front page shows, too."""
    drawn("draw_verdict.py", DRAW / "verdict.json", tmp_path / "one-letter.svg", TITLE)
    told = (tmp_path / "one-letter.svg").read_text("utf-8")
    assert told == (PICTURES / "one-letter.svg").read_text("utf-8")
    assert "/alve" in told
