"""`./roslings forget`: no byte of a submission stays in the folder of the grades."""

from __future__ import annotations

from datetime import datetime, timezone
from pathlib import Path

import pytest

from roslings.course import lab
from roslings_class.errors import BadGradebook, BatchError
from roslings_class.forgetting import forget
from roslings_class.gradebook import gradebook
from roslings_class.handing_out import Settings, hand_out, keep, settings_of
from roslings_class.result import GradingResult

ANNA, BEN = "anna_quimby_4711", "ben_osterwald_4712"
WHAT_ANNA_SAID = b"what anna's nodes said " * 5000


@pytest.fixture
def grades(tmp_path: Path) -> Path:
    """A gradebook with two hand-ins, evidence, a score by hand, pages and tables."""
    with gradebook(tmp_path, "topics") as book:
        for name, evidence in ((ANNA, WHAT_ANNA_SAID), (BEN, b"ben's")):
            reason = f"{name} has no package"
            for attempt in (1, 2):
                result = GradingResult(
                    submission=name, digest="d", attempt=attempt, state="refused", reason=reason
                )
                book.write(result, evidence)
        book.override(ANNA, 80, "anna_quimby showed it in class", "Mrs. K")
        now = datetime(2026, 11, 20, tzinfo=timezone.utc)
        keep(book, Settings(times={ANNA: now, BEN: now}))
        hand_out(book, lab("topics"), tmp_path)
    assert seen(tmp_path, "anna_quimby")
    return tmp_path


def seen(folder: Path, text: str) -> list[str]:
    """Files that hold it, or are called so."""
    return [
        str(path.relative_to(folder))
        for path in folder.rglob("*")
        if text in path.name or (path.is_file() and text.encode() in path.read_bytes())
    ]


def test_nothing_is_left_of_it(grades: Path) -> None:
    """In the gradebook and its free pages, in tables and pages; the others' are as they were."""
    told = "\n".join(forget(grades, ANNA))
    assert f"Nothing of {ANNA} is left" in told
    assert "Not reached: your class list" in told
    assert seen(grades, "anna_quimby") == []
    assert seen(grades, "what anna's nodes said") == []
    with gradebook(grades, "topics") as book:
        assert list(book.latest()) == [BEN]
        assert book.overrides() == {}
        assert list(settings_of(book).times) == [BEN]
    assert "grades.csv" in seen(grades, BEN)
    assert any(name.startswith("students/") for name in seen(grades, BEN))


def test_a_name_that_is_not_there_deletes_nothing(grades: Path, tmp_path: Path) -> None:
    """The nearest one is named; and a folder without a gradebook gets none."""
    with pytest.raises(BatchError, match=f"Did you mean {ANNA}"):
        forget(grades, "anna_quimby_4710")
    with pytest.raises(BatchError, match=r"grades\.csv"):
        forget(grades, "zzz")
    assert "grades.csv" in seen(grades, ANNA)
    (tmp_path / "empty").mkdir()
    with pytest.raises(BadGradebook, match="no gradebook"):
        forget(tmp_path / "empty", ANNA)
    assert list((tmp_path / "empty").iterdir()) == []


def test_it_waits_for_nobody(grades: Path) -> None:
    """While somebody grades into the folder, it is refused."""
    from roslings_class.alone import alone_in

    with (
        alone_in(grades, lambda _: BatchError("?", "?")),
        pytest.raises(BatchError, match="works in"),
    ):
        forget(grades, ANNA)
    assert "grades.csv" in seen(grades, ANNA)
