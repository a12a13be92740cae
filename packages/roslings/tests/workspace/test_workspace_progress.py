"""What is kept of a student's verdicts, and what is next."""

from __future__ import annotations

import multiprocessing
import shutil
from collections.abc import Iterator
from datetime import date, timedelta
from pathlib import Path

import pytest
from hardship import Run

from roslings.course import Lab
from roslings.verdict import (
    CheckOutcome,
    CheckResult,
    Environment,
    Timings,
    Verdict,
    outcome_of,
    score_of,
)
from roslings.workspace.progress import (
    NextStep,
    days_done,
    read_progress,
    record,
    status,
    today,
)
from roslings.workspace.progress_file import StudentProgress, as_json, progress_in
from roslings.workspace.student import start


def verdict(points: float, lab: str = "topics", outcome: CheckOutcome | None = None) -> Verdict:
    """A verdict with one check of 100 points."""
    found: CheckOutcome = outcome or ("pass" if points == 100 else "fail")
    checks = (CheckResult(id="it", title="It", outcome=found, points=points, max_points=100),)
    return Verdict(
        lab=lab,
        package="chatter",
        outcome=outcome_of(checks),
        score=score_of(checks),
        checks=checks,
        seconds=Timings(),
        environment=Environment(
            roslings="",
            ros_distro="",
            rmw="",
            python="",
            platform="",
            isolation="",
            clock="",
            seed=0,
        ),
    )


@pytest.fixture
def two_labs(topics: Lab, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A course of two labs: `later`, of day 4, needs topics."""
    course = tmp_path / "course"
    shutil.copytree(topics.folder, course / "labs" / "topics")
    shutil.copytree(topics.folder, course / "labs" / "later")
    card = course / "labs" / "later" / "card.yaml"
    text = card.read_text()
    text = text.replace("id: topics", "id: later").replace("day: 03-topics", "day: 04-services")
    text = text.replace("\npackage: chatter\n", "\nneeds: [topics]\npackage: later\n")
    card.write_text(text)
    for folder in ("starter", "solution"):
        old = course / "labs" / "later" / folder / "chatter"
        old.rename(old.with_name("later"))
    xml = course / "labs" / "later" / "starter" / "later" / "package.xml"
    xml.write_text(xml.read_text().replace("<name>chatter<", "<name>later<"))
    monkeypatch.setenv("ROSLINGS_COURSE", str(course))
    yield course


def test_the_best_and_the_last_score_are_kept(workspace: Path) -> None:
    """A later, worse score takes nothing away."""
    for points in (40, 100, 70):
        lab = record(verdict(points))
    assert (lab.best, lab.last, lab.checks, lab.done) == (100, 70, 3, True)
    assert lab.best_at and lab.last_at and lab.passed_at
    assert read_progress(workspace).labs == {"topics": lab}


def test_a_verdict_of_zero_is_a_verdict(workspace: Path) -> None:
    """Zero points, checked once."""
    lab = record(verdict(0))
    assert (lab.best, lab.checks, lab.done) == (0, 1, False)
    assert lab.best_at == lab.last_at


def test_the_machines_fault_is_not_kept(workspace: Path) -> None:
    """A verdict without a score changes nothing, and makes no file."""
    assert record(verdict(0, outcome="inconclusive")).checks == 0
    assert not workspace.exists()


@pytest.mark.parametrize(
    "content", [b"", b"{", b"\xff\xfe", b'{"schema": 9}', b'{"labs": {"topics": {"best": 1e9}}}']
)
def test_a_damaged_file_is_set_aside(workspace: Path, content: bytes) -> None:
    """Nothing of it is lost, and the next score is kept."""
    record(verdict(40))
    file = workspace / ".roslings" / "progress.json"
    file.write_bytes(content)
    assert read_progress(workspace).labs == {}
    file.write_bytes(content)
    assert record(verdict(70)).best == 70
    aside = sorted(file.parent.glob("progress-damaged-*.json"))
    assert [path.read_bytes() for path in aside] == [content, content]


def test_a_newer_file_is_read_as_far_as_it_is_known(workspace: Path) -> None:
    """A field of a later roslings is no damage."""
    (workspace / ".roslings").mkdir(parents=True)
    text = '{"schema": 1, "medal": 1, "labs": {"topics": {"best": 40, "stars": 3}}}'
    (workspace / ".roslings" / "progress.json").write_text(text)
    assert read_progress(workspace).labs["topics"].best == 40


def test_two_checks_at_once_are_both_counted(workspace: Path) -> None:
    """Two terminals."""
    with multiprocessing.get_context("spawn").Pool(4) as pool:
        pool.map(record, [verdict(points) for points in range(20)])
    assert read_progress(workspace).labs["topics"].checks == 20


def test_what_may_not_be_written_is_told(workspace: Path, without_rights: Run) -> None:
    """The caller shows the verdict all the same."""
    workspace.mkdir(parents=True)
    workspace.chmod(0o555)
    source = f"""
        from pathlib import Path
        from roslings.verdict import Verdict
        from roslings.workspace.progress import record
        from roslings.workspace.errors import CannotWriteFolder
        try:
            record(Verdict.model_validate_json({verdict(40).model_dump_json(by_alias=True)!r}))
        except CannotWriteFolder:
            print("told")
    """
    assert without_rights(source) == "told"
    assert list(workspace.iterdir()) == []


def test_a_full_disk_keeps_the_old_file(with_little_room: Run) -> None:
    """The new file is whole before it takes the place of the old."""
    source = f"""
        import sys
        from pathlib import Path
        from roslings.verdict import Verdict
        from roslings.workspace.progress import read_progress, record
        from roslings.workspace.errors import DiskFull
        little = Path(sys.argv[1])
        seen = Verdict.model_validate_json({verdict(40).model_dump_json(by_alias=True)!r})
        record(seen, little)
        with (little / "full").open("wb", buffering=0) as full:
            try:
                while True:
                    full.write(bytes(4096))
            except OSError:
                pass
        try:
            record(seen, little)
        except DiskFull:
            checks = read_progress(little).labs["topics"].checks
            print(checks, len(list((little / ".roslings").iterdir())))
    """
    assert with_little_room(source) == "1 2"


@pytest.mark.parametrize(
    ("days", "row"),
    [
        ([], 0),
        ([0], 1),
        ([1], 1),
        ([2], 0),
        ([0, 1, 2, 4], 3),
        ([1, 2], 2),
        ([0, 2, 3], 1),
    ],
)
def test_days_in_a_row_end_today_or_yesterday(days: list[int], row: int) -> None:
    """Numbers are days ago; who has not begun today has lost nothing yet."""
    today = date(2026, 3, 1)
    kept = StudentProgress(days=[today - timedelta(days=ago) for ago in days])
    assert kept.days_in_a_row(today) == row


def test_a_check_is_kept_with_its_day_and_its_moment(workspace: Path) -> None:
    """Twice on one day is one day; all of it is read as it was written."""
    (workspace / ".roslings").mkdir(parents=True, exist_ok=True)
    record(verdict(40))
    record(verdict(60))
    kept = read_progress(workspace)
    assert len(kept.days) == 1
    assert progress_in(as_json(kept).encode()) == kept
    assert kept.labs["topics"].last_at is not None
    assert kept.labs["topics"].last_at.tzinfo is not None


def test_today_leads_through_the_labs(two_labs: Path, workspace: Path) -> None:
    """Start, go on, the next lab, and at last all is done."""
    first = today()
    assert first.at
    assert (first.step, first.at.lab.name, first.at.package) == (NextStep.START, "topics", None)
    begun = start(first.at.lab)
    record(verdict(40))
    second = today()
    assert second.at
    assert (second.step, second.at.package) == (NextStep.GO_ON, begun.package)
    assert second.at.progress.best == 40
    record(verdict(100))
    third = today()
    assert third.at
    assert (third.step, third.at.lab.name) == (NextStep.START, "later")
    record(verdict(100, "later"))
    assert today().step is NextStep.ALL_DONE


def test_status_lists_every_lab_by_day(two_labs: Path, workspace: Path) -> None:
    """Also those that nobody began."""
    record(verdict(100))
    labs = status()
    assert [each.lab.name for each in labs] == ["topics", "later"]
    assert days_done(labs) == {"03-topics": True, "04-services": False}
