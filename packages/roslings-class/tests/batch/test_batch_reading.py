"""What costs too much to read is refused once: conclusive, in words for its author."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from roslings.course import lab
from roslings.workspace.bounded import Bookmark, ReadingBounds, read_in_child
from roslings_class.fingerprints import LARGEST_FILE_BYTES, fingerprint
from roslings_class.grading import grade
from roslings_class.result import GradingOrder
from written_png import head_of, png_of

TOPICS = lab("topics")
FIGURE = "figures/day3_rqt_graph.png"
PICTURE = png_of(head_of(7000, 7000))
HOSTILE = {
    "package.xml": (b"<!--" * 100_000, "package.xml", "The limit is 64,000 bytes"),
    "setup.cfg": (b"[a]\n" + b"y\n" * 50_000, "setup.cfg", "The limit is 64,000 bytes"),
    "colcon.pkg": (b"type: &a [1]\nname: *a", "colcon.pkg", "it says type '(list)'"),
    "chatter/more.py": (b"0\n" * 490_000, "chatter/more.py", "256 MB of memory"),
    FIGURE: (PICTURE, FIGURE, "The limit is 20 million"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_it_is_refused_once(name: str, tmp_path: Path) -> None:
    """It is not tried again, and nobody says that the machine could not tell."""
    content, file, bound = HOSTILE[name]
    package = tmp_path / "in/anna/chatter"
    shutil.copytree(TOPICS.solution, package)
    (package / name).write_bytes(content)
    room = tmp_path / "room"
    room.mkdir()
    order = GradingOrder.model_validate(
        {
            "lab": "topics",
            "submission": "anna",
            "digest": "d",
            "attempt": 1,
            "room": room,
            "path": package.parent,
            "seed": 1,
            "clock": "auto",
            "builds": tmp_path / "builds",
            "keeps_evidence": False,
            "strangers": True,
            "soak_s": 0.0,
        }
    )
    result, evidence = grade(order)
    assert (result.word, result.is_conclusive, evidence) == ("refused", True, None)
    assert result.reason.startswith("submission/chatter")
    assert file in result.reason and bound in result.reason
    assert result.next_step and str(tmp_path) not in result.reason + result.next_step


@pytest.mark.parametrize("word", ["'", "f'", "\\", "0x", "1e", "(", "a "])
def test_a_line_without_end_has_a_fingerprint(word: str, tmp_path: Path) -> None:
    """In three seconds of a processor; Python 3.11 would need the square of the line."""
    package = tmp_path / "chatter"
    shutil.copytree(TOPICS.solution, package)
    text = word * (LARGEST_FILE_BYTES // len(word))
    (package / "chatter/more.py").write_text(text)

    def read(_: Bookmark) -> str:
        return fingerprint(package).whole

    assert read_in_child(read, ReadingBounds(cpu_s=3))
