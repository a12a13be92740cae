"""Programs of drills with something changed, and the verdict on them."""

from __future__ import annotations

from pathlib import Path

from fresh import in_fresh_process

from roslings_learn.drills import Drill, drill, running
from roslings_learn.drills.judging import DrillVerdict


def check(one: Drill, file: Path) -> DrillVerdict:
    """The verdict on the program in `file`."""
    return in_fresh_process(running.check, one, file)


def changed(tmp_path: Path, name: str, before: str, after: str, of: str = "starter") -> Path:
    """A program of a drill with one thing changed."""
    source = getattr(drill(name), of)
    file = tmp_path / source.name
    text = source.read_text("utf-8")
    assert text.count(before) == 1
    file.write_text(text.replace(before, after), "utf-8")
    return file
