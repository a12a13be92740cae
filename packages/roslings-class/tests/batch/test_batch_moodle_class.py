"""A class of thirty, as Moodle's "Download all submissions" gives it, graded by one command."""

from __future__ import annotations

import csv
import os
import subprocess
import sys
import unicodedata
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from packed import make_zip, windows_zip, zip_bytes

from roslings.course import lab
from roslings.workspace.sources import files

TOPICS = lab("topics")
NAMES = (
    "Anna Berg",
    "Ben Kaya",
    "Cleo Núñez",
    "Dora Meier-Lang",
    "Emil Öz",
    "Finn O'Neill",
    "Gül Şahin",
    "Hugo van den Berg",
    "Ida Berg",
    "Jo Li",
    "Kim Lee",
    "Kim Lee",
    "Lea Groß",
    "Mia Ann Fox",
    "Nils Å",
    "Olga Fox",
    "Pia Zoë",
    "Quin Roe",
    "Rosa Diaz",
    "Sam Poe",
    "Tim Ott",
    "Uma Rao",
    "Vera Vogt",
    "Will Wu",
    "Xi Wang",
    "Yara Noor",
    "Zoe Adler",
    "Ada Bly",
    "Bo Chen",
    "Cy Dunn",
)
FILES, TEXT = "_assignsubmission_file", "_assignsubmission_onlinetext"
PERFECT = 6
"""The first ones hand in the solution, each packed in another way; the rest cannot be graded."""


def solution() -> list[tuple[str, bytes]]:
    """The lab's own package, as a student packs it."""
    return [(f"chatter/{name}", path.read_bytes()) for name, path in files(TOPICS.solution).items()]


def hand_ins() -> Iterator[dict[str, bytes]]:
    """The files of each student, by their path below the student's name."""
    whole, empty = zip_bytes(solution()), zip_bytes([("readme.txt", b"soon")])
    yield {f"{FILES}/topics.zip": whole, f"{TEXT}/onlinetext.html": b"<p>I used rclpy.</p>"}
    yield {f"{FILES}/topics.zip": zip_bytes([("topics.zip", whole)])}
    yield {f"{FILES}/topics-2.zip": empty, f"{FILES}/topics-10.zip": whole}
    yield {f"{FILES}/Neuer Ordner.zip": windows_zip([*solution(), ("chatter/Thumbs.db", b"x")])}
    yield {f"{FILES}/a.zip": zip_bytes([("__MACOSX/chatter/._setup.py", b"x"), *solution()])}
    yield {f"{FILES}/chatter/{name[8:]}": content for name, content in solution()}
    yield {f"{FILES}/topics.zip": zip_bytes([("../../../home/x", b"1")])}
    yield {f"{FILES}/topics.zip": zip_bytes([("topics.zip", zip_bytes([("/etc/x", b"1")]))])}
    yield {f"{TEXT}/onlinetext.html": b"<p>My code is on my laptop.</p>"}
    yield {f"{FILES}/report.pdf": b"%PDF"}
    while True:
        yield {f"{FILES}/topics.zip": empty}


@pytest.fixture
def download(tmp_path: Path) -> Path:
    """The zip, as macOS packs it again: one folder around all, names with accents taken apart."""
    entries = [
        (f"CS1-topics-99/{name}_{number}{path}", content)
        for (number, name), each in zip(enumerate(NAMES, start=101), hand_ins(), strict=False)
        for path, content in each.items()
    ]
    apart = [(unicodedata.normalize("NFD", name), content) for name, content in entries]
    return make_zip(tmp_path / "moodle.zip", [*apart, ("__MACOSX/CS1-topics-99/._x", b"x")])


@pytest.fixture
def roster(tmp_path: Path) -> Path:
    """Moodle's grading worksheet, and one student more who handed in nothing."""
    people = [*enumerate(NAMES, start=101), (200, "Late Lu")]
    lines = [f'"Participant {number}","{name}",,100.00,-,' for number, name in people]
    head = (
        'Identifier,"Full name",Grade,"Maximum Grade","Last modified (grade)","Feedback comments"'
    )
    text = "\n".join([head, *lines])
    (tmp_path / "worksheet.csv").write_text(text, "utf-8")
    return tmp_path / "worksheet.csv"


@pytest.mark.slow
def test_a_moodle_class_is_graded_by_one_command(download: Path, roster: Path) -> None:
    """Every student is found; who handed in the solution, however packed, has 100."""
    place = download.parent
    words = ["grade", "topics", download.name, "--out", "out", "--roster", roster.name]
    (place / "tmp").mkdir()
    done = subprocess.run(
        [sys.executable, "-m", "roslings", *words],
        cwd=place,
        capture_output=True,
        text=True,
        env={**os.environ, "TMPDIR": str(place / "tmp")},
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "30 of 30 submissions graded." in done.stdout
    assert "Handed in nothing (1): Late Lu" in done.stdout
    for loose in ("Of nobody in the class list", "Unclear whose"):
        assert loose not in done.stdout
    with (place / "out/moodle.csv").open(encoding="utf-8", newline="") as file:
        grades = {row["Identifier"]: row["Grade"] for row in csv.DictReader(file)}
    assert [grades[f"Participant {101 + n}"] for n in range(30)] == ["100.00"] * PERFECT + [""] * 24
    with zipfile.ZipFile(place / "out/moodle-feedback.zip") as archive:
        folders = {unicodedata.normalize("NFC", name).split("/")[0] for name in archive.namelist()}
    assert folders == {
        f"{name}_{number}{FILES}"
        for number, name in enumerate(NAMES, start=101)
        if name != "Ida Berg"
    } | {f"Ida Berg_109{TEXT}"}
    assert list((place / "tmp").iterdir()) == []
