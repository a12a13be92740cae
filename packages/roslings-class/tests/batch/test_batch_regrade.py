"""After a regrade: who, which check, from, to; in the terminal, in a file, on the class's page."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from test_batch_export import cells, verdict
from test_batch_signed import POOR, result

from roslings.verdict import Verdict
from roslings_class.changes import changes
from roslings_class.gradebook import gradebook
from roslings_class.grading import packed
from roslings_class.handing_out import Settings, keep
from roslings_class.regrade import regrade_all
from roslings_class.signed_gradebook import take_key

NAMES = ("Anna Berg", "Ben Kaya", "Zoe Ott")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Anna and Ben were judged too well by an earlier grader, Zoe as she is judged today."""
    (tmp_path / "class.csv").write_text("name,id\nAnna Berg,anna\nBen Kaya,ben\nZoe Ott,zoe\n")
    with gradebook(tmp_path, "topics") as book:
        assert take_key(book, tmp_path) == []
        keep(book, Settings(roster=tmp_path / "class.csv"))
        for name in ("anna", "ben"):
            earlier = result(name).model_copy(update={"verdict": verdict()})
            book.write(earlier, packed(POOR))
        book.write(result("zoe"), packed(POOR))
    return tmp_path


def test_a_regrade_tells_who_which_check_from_and_to(folder: Path) -> None:
    """Only whose verdict changed, the score first; all of it in the file."""
    told = regrade_all(folder, "topics", None).lines
    assert told[0] == "3 judged again, 2 scores changed."
    assert re.fullmatch(r"  Anna Berg: score, 100 -> \d+(\.\d+)?", told[1])
    rows = cells(folder / "regraded.csv")
    assert {row["name"] for row in rows} == {"Anna Berg", "Ben Kaya"}
    assert (rows[0]["check"], rows[0]["from"]) == ("score", "100")
    built = next(row for row in rows if row["check"] == "builds")
    most = next(c.max_points for c in verdict().checks if c.id == "builds")
    assert built == {
        "name": "Anna Berg",
        "submission": "anna",
        "check": "builds",
        "from": f"pass, {most:g} of {most:g}",
        "to": f"fail, 0 of {most:g}",
    }
    assert "  and " in told[11] and told[12].endswith("regraded.csv")
    page = (folder / "class.html").read_text("utf-8")
    part = page.partition("<h2>Judged again</h2>")[2].partition("</section>")[0]
    assert part.count("<tbody>") == 2 and part.count("</tr>") == len(rows) + 2
    assert "Anna Berg</a>" in part and "Zoe" not in part


def test_a_regrade_that_changes_nothing_keeps_what_the_last_one_changed(folder: Path) -> None:
    """It says so itself; the page still tells of the change that made these grades."""
    regrade_all(folder, "topics", None)
    before = (folder / "regraded.csv").read_text("utf-8")
    told = regrade_all(folder, "topics", None).lines
    assert told[0] == "3 judged again, 0 scores changed."
    assert "->" not in "\n".join(told)
    assert (folder / "regraded.csv").read_text("utf-8") == before
    assert "<h2>Judged again</h2>" in (folder / "class.html").read_text("utf-8")


def without(told: Verdict, name: str) -> Verdict:
    """A verdict in which a check was not asked."""
    checks = tuple(check for check in told.checks if check.id != name)
    return told.model_copy(update={"checks": checks})


def test_a_check_that_is_new_or_gone_is_a_change() -> None:
    """As a hidden check is, that came later."""
    whole = verdict("rate")
    (new,) = changes("anna", without(whole, "rate"), whole)
    (gone,) = changes("anna", whole, without(whole, "rate"))
    assert (new.check, new.before, gone.after) == ("rate", "not asked", "not asked")
    assert new.after == gone.before != "not asked"
    assert [*changes("anna", whole, whole)] == []
