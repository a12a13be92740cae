"""A round as an instructor makes it: a platform's download, the class list, grades, what goes back.

Only the measuring is left out: who has which verdict is said by the test.
"""

from __future__ import annotations

import csv
import os
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path

from packed import make_zip, zip_bytes
from test_batch_export import TOPICS, graded

from roslings_class.clock_times import as_time, zone_named, zone_of
from roslings_class.command import GradeOptions, settings_for
from roslings_class.downloads import submissions_at
from roslings_class.gradebook import gradebook
from roslings_class.handing_out import hand_out, keep
from roslings_class.late_days import LateRule
from roslings_class.result import GradingResult
from roslings_class.roster import read_roster

FILES = "_assignsubmission_file"
BERLIN = "2026-11-30 23:59 Europe/Berlin"
CLASS = ("Anna Berg", "Ben Kaya", "Zoë Müller", "Finn O'Neill")


def rule(deadline: str = BERLIN, points_a_day: float = 10, free_days: int = 0) -> LateRule:
    """What `--deadline` and `--late-points` say."""
    return LateRule(
        deadline=as_time(deadline),
        zone=zone_of(deadline),
        points_a_day=points_a_day,
        free_days=free_days,
    )


@dataclass(frozen=True)
class Round:
    """What the command says at the end, and the folder that it has filled."""

    lines: list[str]
    out: Path

    @property
    def told(self) -> str:
        """In one line, however it was wrapped."""
        return " ".join("\n".join(self.lines).split())

    def rows(self, name: str = "grades.csv", key: str = "name") -> dict[str, dict[str, str]]:
        """The lines of a CSV file, by their person."""
        with (self.out / name).open(encoding="utf-8-sig", newline="") as file:
            return {row[key]: row for row in csv.DictReader(file)}

    def late(self) -> dict[str, str]:
        """Person to days late, as grades.csv has them."""
        return {name: row["days late"] for name, row in self.rows().items()}


def played(
    choices: GradeOptions,
    result_of: Callable[[str], GradingResult] = lambda name: graded(name, "figure"),
) -> Round:
    """Everything that `grade` does, but for the measuring."""
    choices.out.mkdir(exist_ok=True)
    students = read_roster(choices.roster) if choices.roster else ()
    zone = zone_named(choices.rule.zone) if choices.rule else None
    with (
        submissions_at(choices.submissions, students, zone) as found,
        gradebook(choices.out, "topics") as book,
    ):
        keep(book, settings_for(choices, found))
        for each in found:
            book.write(result_of(each.name))
        return Round(hand_out(book, TOPICS, choices.out), choices.out)


def moodle_zip(folder: Path, numbers: dict[str, int]) -> Path:
    """The download of an assignment: each with a folder."""
    entries = [
        (f"{name}_{number}{FILES}/topics.zip", zip_bytes()) for name, number in numbers.items()
    ]
    return make_zip(folder / "moodle.zip", entries)


def canvas_zip(folder: Path, names: list[str]) -> Path:
    """The download of an assignment: files side by side."""
    return make_zip(folder / "submissions.zip", [(name, zip_bytes()) for name in names])


def clone(folder: Path, time: datetime | None = None, files: int = 1) -> Path:
    """A repository as `gh classroom clone` leaves it, with one commit of this time."""
    at = (time or datetime(2026, 11, 30, 12, tzinfo=timezone.utc)).isoformat()
    who = ["-c", "user.name=Anna", "-c", "user.email=a@example.org"]
    folder.mkdir(parents=True)
    for number in range(files):
        (folder / f"talker_{number}.py").write_text(f"print({number})\n")
    for words in (["init", "-q", "-b", "main"], ["add", "."], [*who, "commit", "-qm", "done"]):
        dates = {"GIT_AUTHOR_DATE": at, "GIT_COMMITTER_DATE": at, "HOME": str(folder)}
        subprocess.run(
            ["git", *words], cwd=folder, check=True, env={"PATH": "/usr/bin:/bin", **dates}
        )
    return folder


def run_in(folder: Path, script: str, programs: Path) -> str:
    """What a script of a page prints, with `programs` before all others."""
    own = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"}
    done = subprocess.run(
        ["bash", "-ec", script], cwd=folder, env=own, check=True, capture_output=True, text=True
    )
    return done.stdout
