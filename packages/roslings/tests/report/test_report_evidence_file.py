"""Saved evidence: what can be wrong with it, and the folder that it lies in."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from written_evidence import evidence, messages, process, steady, talking

from roslings.evidence import Evidence, LogLine
from roslings.report.evidence_file import BadEvidence, evidence_bytes, read_evidence
from roslings.report.evidence_folder import (
    CannotKeepThere,
    fill,
    in_the_making,
    log_files,
    require_free,
)
from roslings.report.whole_file import CannotWriteFile


def seen() -> Evidence:
    """A small grading."""
    return evidence(talking(messages(steady(0.5, 12))))


def test_it_is_read_back_as_it_was(tmp_path: Path) -> None:
    """By the folder's name and by the file's."""
    fill(tmp_path, seen())
    assert read_evidence(tmp_path, "topics") == seen()
    assert read_evidence(tmp_path / "evidence.json", "topics") == seen()


def changed(**parts: Any) -> bytes:
    """The evidence with some parts replaced; None takes a part away."""
    content = {**json.loads(evidence_bytes(seen())), **parts}
    return json.dumps({k: v for k, v in content.items() if v is not None}).encode()


OUT_OF_STEP = {
    "name": "talking",
    "clock": "sim",
    "segments": [{"first": 0, "last": 3, "step_ns": 1, "speed": 1}],
}


@pytest.mark.parametrize(
    ("content", "words", "step"),
    [
        (b"", "no evidence of roslings", "--evidence DIR"),
        (b"\x89PNG\xff\xfe", "no evidence of roslings", "--evidence DIR"),
        (b"[" * 100_000, "no evidence of roslings", "--evidence DIR"),
        (b'{"name": "another program"}', "no evidence of roslings", "--evidence DIR"),
        (evidence_bytes(seen())[:-900], "no evidence of roslings", "--evidence DIR"),
        (changed(experiments={"talking": {}}), "damaged: experiments.talking", "--evidence DIR"),
        (changed(attempts=[OUT_OF_STEP]), "damaged: talking: a segment", "--evidence DIR"),
        (changed(machine=None), "damaged: machine", "--evidence DIR"),
        (
            changed(timeline={"rows": 9, "fields": {"of": ["it"]}}),
            "1 values for 9 rows",
            "--evidence DIR",
        ),
        (changed(schema=4), "newer roslings (schema 4; this one reads 3)", "git pull"),
        (changed(lab="services"), "lab 'services', not of 'topics'", "regrade services"),
        (changed(checks=[], score=100), "a verdict, not the evidence", "evidence.json"),
    ],
    ids=[
        "empty",
        "binary",
        "deep",
        "foreign",
        "cut",
        "hollow",
        "ticks-gone",
        "part-gone",
        "short-table",
        "newer",
        "lab",
        "verdict",
    ],
)
def test_what_cannot_be_judged_is_said(
    tmp_path: Path, content: bytes, words: str, step: str
) -> None:
    """With the file, the reason on one line, and the next step on another."""
    file = tmp_path / "evidence.json"
    file.write_bytes(content)
    with pytest.raises(BadEvidence) as refusal:
        read_evidence(tmp_path, "topics")
    reason, next_step = str(refusal.value).splitlines()
    assert reason.startswith(f"{file}: ")
    assert words in reason
    assert step in next_step


def test_what_is_not_there_is_said(tmp_path: Path) -> None:
    """A folder without evidence, and no folder at all."""
    for path in (tmp_path, tmp_path / "gone"):
        with pytest.raises(BadEvidence, match=r"there is no such file\.\nGive the folder"):
            read_evidence(path, "topics")


# --- the folder --------------------------------------------------------------------------------


def other_file(place: Path) -> None:
    """Something else lies there."""
    place.mkdir()
    (place / "thesis.txt").write_text("years of work")


def earlier_evidence(place: Path) -> None:
    """Another check's."""
    place.mkdir()
    fill(place, seen())


def deep(place: Path) -> None:
    """The folder around it is not there."""
    place.parent.rmdir()


@pytest.mark.parametrize(
    ("lay_out", "words"),
    [
        (other_file, "holds other files. Nothing was changed.\nGive a new name: --evidence"),
        (earlier_evidence, "holds the evidence of another check."),
        (Path.touch, "is a file."),
        (lambda place: place.symlink_to("nowhere"), "is a file."),
        (deep, "mkdir -p"),
    ],
    ids=["others", "ours", "file", "link", "no-parent"],
)
def test_nothing_is_overwritten(
    tmp_path: Path, lay_out: Callable[[Path], None], words: str
) -> None:
    """Said before the check begins, with a name that is free."""
    place = tmp_path / "around/it"
    place.parent.mkdir()
    lay_out(place)
    before = sorted(tmp_path.rglob("*"))
    with pytest.raises(CannotKeepThere) as refusal:
        require_free(place)
    assert words in str(refusal.value)
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize("name", [".", "", "..", "/", "../here"])
def test_the_folder_that_one_is_in_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    """It would be replaced under one's feet; the new name is a name."""
    here = tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    with pytest.raises(CannotKeepThere, match=r"--evidence (\.\./here|evidence)-2"):
        require_free(Path(name))


def test_a_place_where_nobody_can_write_is_refused() -> None:
    """Not even root."""
    with pytest.raises(CannotKeepThere, match="cannot be made: "):
        require_free(Path("/proc/kept"))


def test_an_empty_folder_is_filled(tmp_path: Path) -> None:
    """And one that is not there is made; nothing else stays beside it."""
    for name in ("empty", "new"):
        place = tmp_path / name
        if name == "empty":
            place.mkdir()
        require_free(place)
        with in_the_making(place) as part:
            fill(part, seen())
    assert sorted(p.name for p in tmp_path.iterdir()) == ["empty", "new"]
    assert (tmp_path / "new/logs/talking/talker.txt").is_file()


@pytest.mark.parametrize("error", [KeyboardInterrupt, ValueError])
def test_an_interrupted_one_leaves_nothing(tmp_path: Path, error: type[BaseException]) -> None:
    """Half a folder is none."""
    with pytest.raises(error), in_the_making(tmp_path / "new") as part:
        fill(part, seen())
        raise error
    assert list(tmp_path.iterdir()) == []


def test_somebody_was_quicker(tmp_path: Path) -> None:
    """What they put there meanwhile stays, and nothing of ours."""
    place = tmp_path / "new"
    with pytest.raises(CannotKeepThere, match="holds other files"), in_the_making(place) as part:
        fill(part, seen())
        other_file(place)
    assert [p.name for p in tmp_path.rglob("*.*")] == ["thesis.txt"]


def test_a_full_disk_is_said(tmp_path: Path) -> None:
    """As what it is, and nothing stays."""
    with pytest.raises(CannotWriteFile, match="No space left"), in_the_making(tmp_path / "new"):
        raise OSError(28, os.strerror(28))
    assert list(tmp_path.iterdir()) == []


def test_no_name_leads_out_of_the_folder(tmp_path: Path) -> None:
    """An executable's, an experiment's; and a logger has no file of its own."""
    bad = talking([]).model_copy(update={"name": "../../up"})
    bad.processes = {"../../../etc/x": process("x", "a line"), "n" * 999: process("n", "b line")}
    bad.rosout = {"/../" * 99: [LogLine(arrival_ns=1, text="hello", source="rosout")]}
    place = tmp_path / "in/here"
    place.mkdir(parents=True)
    fill(place, evidence(bad))
    assert [p for p in tmp_path.rglob("*") if p.is_file() and not p.is_relative_to(place)] == []
    names = log_files(evidence(bad))
    assert len(names) == 4
    assert all(".." not in Path(name).parts for name in names)


def test_a_log_tells_when(tmp_path: Path) -> None:
    """Seconds since the program was started, without the terminal's colours."""
    files = log_files(evidence(talking([], "/chatter", "\x1b[31mred\x1b[0m")))
    assert files["talking/talker.txt"] == "   1.000  red\n"
