"""Evidence is judged again where the key of the class has signed it, as it was measured."""

from __future__ import annotations

import csv
import json
import pickle
import shutil
import sqlite3
import stat
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from roslings.course import lab
from roslings.evidence import BuildSeen, Evidence, MachineSeen
from roslings.grading.shapes import SHAPES
from roslings.judge import judge
from roslings.report.evidence_file import evidence_bytes
from roslings.workspace.inspect import inspect_package
from roslings_class.command import GradeOptions, grade
from roslings_class.dask_pool import _packed
from roslings_class.folders import folder_name
from roslings_class.gradebook import SCHEMA, gradebook
from roslings_class.grading import packed, unpacked
from roslings_class.regrade import override, regrade_all
from roslings_class.result import GradingResult
from roslings_class.scheduler import GradingRequest
from roslings_class.signed_gradebook import take_key
from roslings_class.signing import BYTES, FILE, BadKey, ClassKey, EvidenceOrigin
from roslings_class.submissions import Submission, digest_of
from roslings_class.worker_pool import GradingLimits
from roslings_launcher.cli import main

TOPICS = lab("topics")
WHO = ("anna", "ben")
Forge = Callable[[Path], None]


def seen(package: Path, builds: bool = False) -> Evidence:
    """A package's files, and how its build went."""
    machine = MachineSeen(
        roslings="0", ros_distro="jazzy", rmw="r", python="3", platform="p", isolation="domain"
    )
    built = BuildSeen(succeeded=builds, recognised_as="ros.ament_python", seconds=1.0)
    files = inspect_package(package, TOPICS.card)
    return Evidence(lab="topics", seed=1, machine=machine, package=files, build=built)


FOOT = "./roslings regrade topics EVIDENCE"
"""Stands on each page that shows evidence."""
POOR, RICH = seen(TOPICS.starter), seen(TOPICS.solution, builds=True)
"""What was measured, and what a forger would like to have been measured."""


def result(name: str, evidence: Evidence = POOR, attempt: int = 1) -> GradingResult:
    """What came of a grading."""
    words = {
        "submission": name,
        "digest": f"d-{name}",
        "attempt": attempt,
        "state": "graded",
        "verdict": judge(TOPICS, evidence),
    }
    return GradingResult.model_validate(words)


def graded(folder: Path) -> Path:
    """A folder as `grade` leaves it."""
    folder.mkdir()
    with gradebook(folder, "topics") as book:
        assert take_key(book, folder) == []
        for name in WHO:
            book.write(result(name), packed(POOR))
    return folder


@pytest.fixture
def out(tmp_path: Path) -> Path:
    """One of a class of two."""
    return graded(tmp_path / "out")


def scores(folder: Path) -> dict[str, float | None]:
    """What the gradebook says."""
    with gradebook(folder, "topics") as book:
        return {name: each.score for name, each in book.latest().items()}


def sql(folder: Path, query: str, *values: object) -> None:
    """What somebody who has the file can do to it."""
    connection = sqlite3.connect(folder / "gradebook.sqlite")
    with connection:
        connection.execute(query, values)
    connection.close()


SET = "UPDATE evidence SET {} WHERE submission='anna'"


def edited(folder: Path) -> None:
    """A better build, and better files."""
    sql(folder, SET.format("content=?"), packed(RICH))


def of_another_student(folder: Path) -> None:
    """Ben's, with its signature."""
    with gradebook(folder, "topics") as book:
        take_key(book, folder)
        book.write(result("ben", RICH), packed(RICH))
    for column in ("content", "signature"):
        other = f"(SELECT {column} FROM evidence WHERE submission='ben')"
        sql(folder, SET.format(f"{column}={other}"))


def of_another_attempt(folder: Path) -> None:
    """The first try's, though a second one counts, with the whole line of the gradebook."""
    connection = sqlite3.connect(folder / "gradebook.sqlite")
    (line,) = connection.execute("SELECT * FROM evidence WHERE submission='anna'").fetchall()
    connection.close()
    with gradebook(folder, "topics") as book:
        take_key(book, folder)
        book.write(result("anna", attempt=2), packed(POOR))
    sql(folder, "INSERT OR REPLACE INTO evidence VALUES (?, ?, ?, ?, ?)", *line)


def said_to_be_of_another_attempt(folder: Path) -> None:
    """The same, with the number of the try that counts."""
    of_another_attempt(folder)
    sql(folder, SET.format("attempt=2"))


def of_another_lab(folder: Path) -> None:
    """Signed by the same key for another lab."""
    key = ClassKey(bytes.fromhex((folder / FILE).read_text()))
    content = packed(RICH)
    signature = key.sign(EvidenceOrigin("services", "anna", "d-anna", 1), content)
    sql(folder, SET.format("content=?, signature=?"), content, signature)


def of_another_class(folder: Path) -> None:
    """Signed by the key of another class."""
    content = packed(RICH)
    signature = ClassKey(bytes(BYTES)).sign(EvidenceOrigin("topics", "anna", "d-anna", 1), content)
    sql(folder, SET.format("content=?, signature=?"), content, signature)


def truncated(folder: Path) -> None:
    """The end is missing."""
    sql(folder, SET.format("content=substr(content, 1, length(content) - 1)"))


def truncated_signature(folder: Path) -> None:
    """Of the signature only a start is left, which may be guessed."""
    sql(folder, SET.format("signature=substr(signature, 1, 1)"))


def without_signature(folder: Path) -> None:
    """As before there were keys."""
    sql(folder, SET.format("content=?, signature=NULL"), packed(RICH))


FORGED: dict[Forge, str] = {
    edited: "it was changed, or is of something else",
    of_another_student: "it was changed, or is of something else",
    of_another_attempt: "it is of another try",
    said_to_be_of_another_attempt: "it was changed, or is of something else",
    of_another_lab: "it was changed, or is of something else",
    of_another_class: "it was changed, or is of something else",
    truncated: "it was changed, or is of something else",
    truncated_signature: "it was changed, or is of something else",
    without_signature: "its signature was taken away",
}


@pytest.mark.parametrize(("forge", "says"), FORGED.items(), ids=[f.__name__ for f in FORGED])
def test_forged_evidence_is_not_judged(
    out: Path, forge: Forge, says: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """It keeps the measured score, is named with the next step, and exit code 3 says it."""
    measured = scores(out)
    assert (judge(TOPICS, RICH).score or 0) > (measured["anna"] or 0)
    forge(out)
    assert main(["regrade", "topics", str(out)]) == 3
    told = capsys.readouterr().out
    assert f"\n  anna: {says}\n" in told
    assert "1 not judged again: the evidence is not what was measured." in told
    assert "To measure them anew:\n  ./roslings grade topics SUBMISSIONS --out " in told
    assert scores(out)["anna"] == measured["anna"]
    assert "1 judged again" in told


@pytest.mark.parametrize("forge", FORGED, ids=[f.__name__ for f in FORGED])
def test_forged_evidence_is_shown_to_nobody(out: Path, forge: Forge) -> None:
    """The student's page has the verdict alone."""
    forge(out)
    regrade_all(out, "topics", None)
    page = (out / "students" / folder_name("anna") / "report.html").read_text("utf-8")
    other = (out / "students" / folder_name("ben") / "report.html").read_text("utf-8")
    assert f"{scores(out)['anna']:g} of 100" in page
    assert FOOT in other and FOOT not in page


def test_what_was_measured_is_judged_again_as_often_as_one_likes(
    out: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """A changed card too: each verdict is another try of the same evidence."""
    measured = scores(out)
    for points in ("depends: 5", "depends: 4", "depends: 5"):
        course = tmp_path / points.replace(": ", "-")
        if not course.exists():
            shutil.copytree(TOPICS.folder, course / "labs/topics")
            (course / "graders").mkdir()
            shutil.copy(TOPICS.grader, course / "graders")
        card = course / "labs/topics/card.yaml"
        text = card.read_text("utf-8")
        more = {"depends: 4": ("depends: 5", "figure: 2", "figure: 3")}.get(points)
        if more:
            card.write_text(text.replace(more[0], points).replace(more[1], more[2]), "utf-8")
        monkeypatch.setenv("ROSLINGS_COURSE", str(course))
        told = regrade_all(out, "topics", None)
        assert told.forged == {}
        assert told.lines[0].startswith("2 judged again")
    assert scores(out) == measured


def test_grade_measures_anew_what_was_forged(out: Path, tmp_path: Path) -> None:
    """The same command again, and it is said."""
    for name in WHO:
        (tmp_path / "in" / name).mkdir(parents=True)
    for name in WHO:
        digest = digest_of(tmp_path / "in" / name)
        for table in ("results", "evidence"):
            sql(out, f"DELETE FROM {table} WHERE submission=?", name)
        with gradebook(out, "topics") as book:
            take_key(book, out)
            told = result(name).model_copy(update={"digest": digest})
            book.write(told, packed(POOR))
    edited(out)
    report = grade(GradeOptions("topics", tmp_path / "in", out, trust=True))
    assert "not what was measured:\n  anna" in report.lines[0]
    with gradebook(out, "topics") as book:
        words = {name: (each.word, each.attempt) for name, each in book.latest().items()}
    assert words == {"anna": ("refused", 2), "ben": ("fail", 1)}


# --- the key -----------------------------------------------------------------------------------


def test_the_key_is_made_once_and_for_its_owner_alone(out: Path) -> None:
    """32 bytes that nobody can guess; never in the gradebook."""
    file = out / FILE
    assert stat.S_IMODE(file.stat().st_mode) == 0o600
    secret = bytes.fromhex(file.read_text("ascii"))
    assert len(secret) == BYTES and len(set(secret)) > 8
    regrade_all(out, "topics", None)
    assert bytes.fromhex(file.read_text("ascii")) == secret
    content = (out / "gradebook.sqlite").read_bytes()
    assert secret not in content and secret.hex().encode() not in content
    assert not list(out.glob("*.part")) + list(out.glob(".*.part"))


def lost(folder: Path) -> None:
    """The key is gone."""
    (folder / FILE).unlink()


def of_others(folder: Path) -> None:
    """The key is of another class."""
    other = graded(folder.parent / "other")
    shutil.copy(other / FILE, folder / FILE)


def cut_off(folder: Path) -> None:
    """A copy broke off."""
    (folder / FILE).write_bytes((folder / FILE).read_bytes()[:20])


def empty(folder: Path) -> None:
    """The disk was full."""
    (folder / FILE).write_bytes(b"")


def link(folder: Path) -> None:
    """It leads to a file that somebody else may have made."""
    (folder / FILE).rename(folder / "mine")
    (folder / FILE).symlink_to("mine")


def book_of_others(folder: Path) -> None:
    """Another class's gradebook is put beside this key."""
    other = graded(folder.parent / "other")
    shutil.copy(other / "gradebook.sqlite", folder)


def all_signatures_gone(folder: Path) -> None:
    """As if there had never been a key, so that everything is signed once more."""
    edited(folder)
    sql(folder, "UPDATE evidence SET signature=NULL")
    sql(folder, "DELETE FROM about WHERE key='key'")


BAD_KEYS: dict[Forge, tuple[str, str]] = {
    lost: ("is gone: the key that signed", "Put the key back that was there"),
    of_others: ("is the key of another class", "Put the key back that was there"),
    book_of_others: ("is the key of another class", "Put the key back that was there"),
    cut_off: ("is no key: it was changed, or cut off", "Put the key back that was there"),
    empty: ("is no key: it was changed, or cut off", "Put the key back that was there"),
    link: ("cannot be read", "Put the key back that was there"),
    all_signatures_gone: ("nothing in the gradebook is signed", "back from a backup"),
}


@pytest.mark.parametrize(
    ("forge", "says", "step"),
    [(forge, *words) for forge, words in BAD_KEYS.items()],
    ids=[f.__name__ for f in BAD_KEYS],
)
def test_a_key_that_does_not_fit_stops_everything(
    out: Path,
    forge: Forge,
    says: str,
    step: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Nothing is judged and nothing is written, and the next step is told; so for `grade`."""
    forge(out)
    before = {path: path.read_bytes() for path in out.rglob("*.csv")}
    (tmp_path / "in/anna").mkdir(parents=True)
    commands = (
        ["regrade", "topics", str(out)],
        ["grade", "topics", str(tmp_path / "in"), "--out", str(out), "--trust"],
    )
    for command in commands:
        assert main(command) == 2
        told = capsys.readouterr()
        assert says in told.err and step in told.err
        assert max(map(len, told.err.replace(str(out), "out").splitlines())) <= 80 + len(
            "roslings: "
        )
        assert told.out == ""
    assert {path: path.read_bytes() for path in out.rglob("*.csv")} == before
    assert not (out / "students").exists()


@pytest.mark.parametrize("forge", BAD_KEYS, ids=[f.__name__ for f in BAD_KEYS])
def test_a_score_by_hand_needs_no_key(out: Path, forge: Forge) -> None:
    """It is given, and what is wrong is said; no page is made from what nobody can believe."""
    forge(out)
    told = override(out, "anna", 70, "showed it", "me")
    assert BAD_KEYS[forge][0] in told[1]
    with (out / "grades.csv").open(encoding="utf-8", newline="") as file:
        assert {row["name"]: row["final"] for row in csv.DictReader(file)}["anna"] == "70"


@pytest.mark.parametrize("mode", [0o644, 0o640, 0o604, 0o660])
def test_a_key_that_others_can_read_is_closed(out: Path, mode: int) -> None:
    """And it is said, for somebody may have read it."""
    (out / FILE).chmod(mode)
    (told, *_) = regrade_all(out, "topics", None).lines
    assert "could be read by others on this machine. Now it cannot." in told
    assert "grade into a new folder: --out DIR" in told
    assert stat.S_IMODE((out / FILE).stat().st_mode) == 0o600
    assert "could be read" not in "\n".join(regrade_all(out, "topics", None).lines)


def test_no_signature_at_all_is_gone_by_itself(out: Path) -> None:
    """What the next step of a stripped gradebook says works: then it is signed once."""
    sql(out, "UPDATE evidence SET signature=NULL")
    sql(out, "DELETE FROM about WHERE key='key'")
    with pytest.raises(BadKey, match="type the same command again"):
        regrade_all(out, "topics", None)
    (out / FILE).unlink()
    assert (
        "The evidence of 2 submissions was not signed" in regrade_all(out, "topics", None).lines[0]
    )


# --- gradebooks of before ----------------------------------------------------------------------


def of_before(folder: Path) -> Path:
    """A gradebook as roslings wrote it before there were keys; one was judged again since."""
    folder.mkdir()
    connection = sqlite3.connect(folder / "gradebook.sqlite")
    connection.executescript(f"{SCHEMA.replace('signature BLOB,', '')} PRAGMA user_version=1;")
    connection.execute("INSERT INTO about VALUES ('lab', 'topics')")
    for name, attempts in (("anna", (1, 2)), ("ben", (1,))):
        for attempt in attempts:
            told = result(name, attempt=attempt)
            connection.execute(
                "INSERT INTO results (submission, digest, attempt, word, score, result, written)"
                " VALUES (?, ?, ?, ?, ?, ?, '')",
                (
                    name,
                    told.digest,
                    attempt,
                    told.word,
                    told.score,
                    told.model_dump_json(by_alias=True),
                ),
            )
        connection.execute(
            "INSERT INTO evidence VALUES (?, ?, 1, ?)", (name, f"d-{name}", packed(POOR))
        )
    connection.commit()
    connection.close()
    return folder


def test_a_gradebook_of_before_is_signed_once(tmp_path: Path) -> None:
    """On its first use, and it is said; from then on it is as any other."""
    out = of_before(tmp_path / "old")
    told = regrade_all(out, "topics", None)
    assert told.lines[0].startswith("The evidence of 2 submissions was not signed.")
    assert "believe it as you did before" in told.lines[0] and FILE in told.lines[0]
    assert (told.forged, told.lines[1][:14]) == ({}, "2 judged again")
    assert "not signed" not in "\n".join(regrade_all(out, "topics", None).lines)
    edited(out)
    assert regrade_all(out, "topics", None).forged == {"anna": FORGED[edited]}


def test_nothing_of_it_is_lost(tmp_path: Path) -> None:
    """A score by hand opens it, too: results and evidence are those of before."""
    out = of_before(tmp_path / "old")
    assert "was not signed" in override(out, "ben", 50, "x", "me")[1]
    with gradebook(out, "topics") as book:
        take_key(book, out)
        for each in book.latest().values():
            content = book.evidence(each)
            assert content is not None and unpacked(content) == POOR
        assert book.overrides()["ben"].score == 50


def test_an_empty_folder_says_nothing_of_signing(tmp_path: Path) -> None:
    """The first `grade` makes the key without a word."""
    (tmp_path / "in/anna").mkdir(parents=True)
    report = grade(GradeOptions("topics", tmp_path / "in", tmp_path / "new", trust=True))
    assert "sign" not in "\n".join(report.lines)
    assert (tmp_path / "new" / FILE).is_file()


# --- where there is no key ---------------------------------------------------------------------


def test_what_proofs_are_kept_with_needs_no_key(tmp_path: Path) -> None:
    """A gradebook of our own packages is a table, and is believed as it is."""
    with gradebook(tmp_path, "labs") as book:
        book.write(result("anna"), packed(POOR))
        assert book.evidence(result("anna")) == packed(POOR)
        assert (book.forged(), book.signed_by()) == ({}, None)
    assert not (tmp_path / FILE).exists()


def test_the_key_never_travels(out: Path, tmp_path: Path) -> None:
    """What a Dask worker gets has nothing of it: the command signs what comes back."""
    request = GradingRequest("topics", tmp_path, tmp_path / "lock")
    submission = Submission("anna", shutil.copytree(TOPICS.starter, tmp_path / "anna"))
    parcel = pickle.dumps(_packed(request.order(submission, "d", 1), "v", False, GradingLimits()))
    secret = bytes.fromhex((out / FILE).read_text())
    assert secret not in parcel and secret.hex().encode() not in parcel


# --- evidence in a folder ----------------------------------------------------------------------


@pytest.fixture
def kept(tmp_path: Path) -> Path:
    """What a student sends: here with a better build than there was."""
    (tmp_path / "kept").mkdir()
    (tmp_path / "kept/evidence.json").write_bytes(evidence_bytes(RICH))
    return tmp_path / "kept"


@pytest.mark.parametrize("shape", SHAPES)
def test_no_platforms_file_is_made_of_it(
    kept: Path, shape: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit code 2, what to do instead, and no file at all."""
    files = [tmp_path / "it", tmp_path / "it.json", tmp_path / "it.html"]
    words = [f"--{shape}", str(files[0]), "--json", str(files[1]), "--html", str(files[2])]
    assert main(["regrade", "topics", str(kept), *words]) == 2
    told = capsys.readouterr().err
    assert "not signed" in told
    assert f"./roslings check LAB PATH --{shape} FILE" in told
    assert not any(file.exists() for file in files)


def test_whose_word_it_is_is_said(
    kept: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """`--json` and `--html` work as ever, also into the terminal."""
    page = tmp_path / "it.html"
    assert main(["regrade", "topics", str(kept), "--json", "-", "--html", str(page)]) == 1
    told = capsys.readouterr()
    verdict: dict[str, Any] = json.loads(told.out)
    assert verdict["lab"] == "topics" and page.is_file()
    assert "is the word of who saved it" in told.err
    assert "./roslings grade LAB SUBMISSIONS --out DIR" in told.err
