"""Back to the students: each platform's importer, by its own rules, finds everybody's page.

The importers here are models of the platforms' own, written from what these do; where that stands
is said in roslings_class/feedback.py.
"""

from __future__ import annotations

import io
import os
import re
import tarfile
import zipfile
from dataclasses import dataclass
from html import unescape
from pathlib import Path

import pytest
from packed import make_zip, zip_bytes
from rounds import CLASS, FILES, Round, canvas_zip, clone, played, rule, run_in
from test_batch_export import TOPICS, graded, refused
from test_batch_late_days import CANVAS_LIST, TIMES, line, worksheet
from test_batch_teams import of_canvas, of_classroom, of_moodle, verdicts

from roslings import course
from roslings.verdict import CheckResult
from roslings_class.command import GradeOptions
from roslings_class.feedback import CANVAS_ZIP, COMMENTS, LONGEST_COMMENT, MOODLE_ZIP
from roslings_class.folders import folder_name
from roslings_class.gradebook import gradebook
from roslings_class.handing_out import hand_out
from roslings_class.regrade import override
from roslings_class.result import GradingResult

PAGE = "roslings-topics.html"


# --- the importers -----------------------------------------------------------------------------


def imported_by_moodle(
    content: bytes, participants: dict[int, str], needs_fifth: bool = False
) -> dict[str, dict[str, str]]:
    """Participant to files: by the first part of a path that has a number of one in its place."""
    found: dict[str, dict[str, str]] = {}
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        for path in archive.namelist():
            if path.rpartition("/")[2].startswith((".", "~")):
                continue
            parts = path.split("/")
            while parts:
                pieces = parts.pop(0).split("_", 4)
                if len(pieces) < 4 + needs_fifth or not pieces[1].isdigit():
                    continue
                if int(pieces[1]) not in participants or pieces[2] != "assignsubmission":
                    continue
                rest = "/".join([*pieces[4:5], *parts] if pieces[4:5] else parts)
                own = found.setdefault(participants[int(pieces[1])], {})
                own[rest.lstrip("/")] = archive.read(path).decode()
                break
    return found


@dataclass(frozen=True)
class Comment:
    """What a student sees in Canvas: a file under the name of the student's own."""

    name: str
    content: bytes


def imported_by_canvas(
    content: bytes, attachments: dict[int, tuple[int, str]], groups: tuple[str, ...] = ()
) -> dict[int, Comment]:
    """User to the comment; a file of no user's own attachment is passed by."""
    found: dict[int, Comment] = {}
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        for path in archive.namelist():
            name = path.rpartition("/")[2]
            for group in groups:
                name = name.removeprefix(f"{group}_")
            pieces = [piece for piece in name.split("_") if piece != "LATE"]
            user, attachment, *_ = [int(piece) for piece in pieces if piece.isdigit()] + [0, 0]
            if attachments.get(attachment, (0, ""))[0] == user:
                found[user] = Comment(attachments[attachment][1], archive.read(path))
    return found


def opened(comment: Comment) -> str:
    """As the student opens it, by the ending of its name."""
    if comment.name.endswith(".zip"):
        with zipfile.ZipFile(io.BytesIO(comment.content)) as archive:
            return archive.read(PAGE).decode()
    if ".tar" in comment.name or comment.name.endswith(".tgz"):
        with tarfile.open(fileobj=io.BytesIO(comment.content)) as archive:
            file = archive.extractfile(PAGE)
            assert file is not None
            return file.read().decode()
    return comment.content.decode()


def words_of(page: str) -> str:
    """What a reader sees."""
    return " ".join(unescape(re.sub(r"<style>.*?</style>|<[^>]*>", " ", page, flags=re.S)).split())


# --- Moodle ------------------------------------------------------------------------------------

NUMBERS = {number: name for number, name in enumerate(CLASS, start=101)}
AS_DOWNLOADED = {
    "folders": f"{{}}_{{}}{FILES}/topics.zip",
    "folders of before 4.1": f"{{}}_{{}}{FILES}_/topics.zip",
    "no folders": f"{{}}_{{}}{FILES}_topics.zip",
}


def moodle_round(folder: Path, form: str = AS_DOWNLOADED["folders"]) -> Round:
    """Anna passes a day late, Ben is refused, of Zoë nobody could tell, Finn has his points."""
    results = {
        "Ben": refused("", "There is no <ROS> package in it."),
        "Zoë": refused("", "broke off in /home/me").model_copy(update={"state": "broken"}),
    }

    def result_of(name: str) -> GradingResult:
        found = next((each for who, each in results.items() if who in name), graded(name, "figure"))
        return found.model_copy(update={"submission": name})

    names = {number: name.replace("'", "") for number, name in NUMBERS.items()}  # as Moodle does
    zip_ = make_zip(
        folder / "moodle.zip", [(form.format(name, n), zip_bytes()) for n, name in names.items()]
    )
    times = {**TIMES, "Anna Berg": "Tuesday, 1 December 2026, 1:00 PM"}
    list_ = worksheet(folder, [line(name, time) for name, time in times.items()])
    return played(
        GradeOptions("topics", zip_, folder / "out", roster=list_, rule=rule()), result_of
    )


@pytest.mark.parametrize("form", AS_DOWNLOADED.values(), ids=AS_DOWNLOADED)
def test_moodle_takes_every_page(tmp_path: Path, form: str) -> None:
    """Called as downloaded, by Moodle's of today and of before; a page for each, alone."""
    done = moodle_round(tmp_path, form)
    content = (done.out / MOODLE_ZIP).read_bytes()
    needs_fifth = "_/" in form or form.endswith("_topics.zip")
    found = imported_by_moodle(content, NUMBERS, needs_fifth)
    assert found == imported_by_moodle(content, NUMBERS)
    assert set(found) == {"Anna Berg", "Ben Kaya", "Finn O'Neill"}, "of Zoë nobody could tell"
    assert all(list(files) == [PAGE] for files in found.values())
    pages = {name: files[PAGE] for name, files in found.items()}
    for name, page in pages.items():
        assert f"{name} " in words_of(page)
        assert "href=" not in page and "<script" not in page and "src=" not in page
        assert all(other not in page for other in CLASS if other != name)
    assert "Handed in 1 day late: 10 points less. 88 of 100 count." in words_of(pages["Anna Berg"])
    assert "There is no <ROS> package in it." in words_of(pages["Ben Kaya"])
    assert "Moodle, Upload multiple feedback files in a zip: " in done.told


def test_a_folder_is_called_as_it_was_downloaded(tmp_path: Path) -> None:
    """Umlauts and all: an instructor may look for it."""
    done = moodle_round(tmp_path)
    with zipfile.ZipFile(done.out / MOODLE_ZIP) as archive:
        assert archive.namelist() == [
            f"Anna Berg_101{FILES}/{PAGE}",
            f"Ben Kaya_102{FILES}/{PAGE}",
            f"Finn ONeill_104{FILES}/{PAGE}",
        ]
    assert f"Zoë Müller_103{FILES}" in [each.name for each in (done.out / "students").iterdir()]


def test_a_score_by_hand_is_in_the_page_too(tmp_path: Path) -> None:
    """Everything is written anew; of whom nobody could tell, a person could."""
    done = moodle_round(tmp_path)
    override(done.out, "Zoë Müller", 70, "ran <in> class", "tutor")
    found = imported_by_moodle((done.out / MOODLE_ZIP).read_bytes(), NUMBERS)
    assert "70 of 100 count, by tutor: ran <in> class" in words_of(found["Zoë Müller"][PAGE])


def test_moodles_teams_get_a_page_each(tmp_path: Path) -> None:
    """By each member's number: Moodle would give the group's own to the participant so numbered."""
    done = played(of_moodle(tmp_path), verdicts)
    people = {101: "Anna Berg", 102: "Ben Kaya", 103: "Zoë Müller", 104: "Kim Lee", 7: "Late Lu"}
    found = imported_by_moodle((done.out / MOODLE_ZIP).read_bytes(), people)
    assert set(found) == {"Anna Berg", "Ben Kaya", "Zoë Müller", "Kim Lee"}
    assert found["Anna Berg"] == found["Ben Kaya"]
    assert "Anna Berg, Ben Kaya" in found["Ben Kaya"][PAGE]
    assert "Anna Berg" not in found["Zoë Müller"][PAGE]


def test_what_a_team_gets_may_differ(tmp_path: Path) -> None:
    """One member has more time: the page that they share says where to look."""
    choices = of_moodle(tmp_path)
    (tmp_path / "more.csv").write_text("name,until\nBen Kaya,2026-12-24 08:00\n")
    done = played(GradeOptions(**{**vars(choices), "extensions": tmp_path / "more.csv"}), verdicts)
    with zipfile.ZipFile(done.out / MOODLE_ZIP) as archive:
        page = words_of(archive.read(f"Ben Kaya_102{FILES}/{PAGE}").decode())
    assert "What counts is not the same for all of the team" in page
    assert "10 points less" not in page


def test_without_numbers_a_team_gets_nothing_and_it_is_said(tmp_path: Path) -> None:
    """Else Moodle would give the page to somebody else."""
    (tmp_path / "class.csv").write_text("name,team\nAnna Berg,Rot\nBen Kaya,Rot\n")
    zip_ = make_zip(tmp_path / "moodle.zip", [(f"Rot_101{FILES}/t.zip", zip_bytes())])
    done = played(GradeOptions("topics", zip_, tmp_path / "out", roster=tmp_path / "class.csv"))
    assert not (done.out / MOODLE_ZIP).exists()
    assert "No page for who has no number: Anna Berg, Ben Kaya." in done.told


def test_of_nobody_and_of_whom_it_is_unclear_nothing_goes_back(tmp_path: Path) -> None:
    """A page is for its author alone."""
    list_ = worksheet(tmp_path, [line("Anna Berg", "-")])
    names = [f"Anna Berg_101{FILES}", f"Anna Berg_222{FILES}", f"Mallory_333{FILES}"]
    zip_ = make_zip(tmp_path / "moodle.zip", [(f"{name}/t.zip", zip_bytes()) for name in names])
    done = played(GradeOptions("topics", zip_, tmp_path / "out", roster=list_))
    with zipfile.ZipFile(done.out / MOODLE_ZIP) as archive:
        assert archive.namelist() == [f"{names[0]}/{PAGE}"]


def test_without_a_class_list_each_of_ones_hand_ins_has_a_page(tmp_path: Path) -> None:
    """Nobody says which counts."""
    names = [f"Anna Berg_101{FILES}_{own}.zip" for own in ("a", "b")]
    zip_ = make_zip(tmp_path / "moodle.zip", [(name, zip_bytes()) for name in names])
    done = played(GradeOptions("topics", zip_, tmp_path / "out"))
    found = imported_by_moodle((done.out / MOODLE_ZIP).read_bytes(), NUMBERS)
    assert len(found["Anna Berg"]) == 2


def test_the_same_feedback_is_the_same_file(tmp_path: Path) -> None:
    """Nothing in it tells when it was packed."""
    done = moodle_round(tmp_path)
    before = (done.out / MOODLE_ZIP).read_bytes()
    with gradebook(done.out, "topics") as book:
        hand_out(book, TOPICS, done.out)
    assert (done.out / MOODLE_ZIP).read_bytes() == before


# --- Canvas ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "own",
    [
        "topics.zip",
        "topics.tar.gz",
        "topics.tgz",
        "topics.tar.xz",
        "topics_2_3.zip",
        "talker.py",
        "Lösung.html",
    ],
)
def test_canvas_takes_every_page(tmp_path: Path, own: str) -> None:
    """Called as downloaded; it opens as what the student's own file was called."""
    (tmp_path / "canvas-list.csv").write_text(CANVAS_LIST, "utf-8")
    names = [f"berganna_77_8812_{own}", f"müllerzoë_LATE_79_8814_{own}"]
    done = played(
        GradeOptions(
            "topics",
            canvas_zip(tmp_path, names),
            tmp_path / "out",
            roster=tmp_path / "canvas-list.csv",
            rule=rule(),
        )
    )
    found = imported_by_canvas(
        (done.out / CANVAS_ZIP).read_bytes(), {8812: (77, own), 8814: (79, own), 8815: (78, own)}
    )
    assert set(found) == {77, 79}
    page = opened(found[79])
    assert "About figure." in page
    assert ("Müller, Zoë" in page) == (not own.endswith(".py")), "a comment names nobody"
    assert "Berg" not in page


def test_canvass_groups_get_one_comment(tmp_path: Path) -> None:
    """Canvas gives it to all of the group; a number in the group's name misleads nobody."""
    done = played(of_canvas(tmp_path), verdicts)
    found = imported_by_canvas(
        (done.out / CANVAS_ZIP).read_bytes(),
        {8812: (78, "topics.zip"), 8813: (79, "topics.zip")},
        ("team rot", "teamrot", "grüne7"),
    )
    assert set(found) == {78, 79}
    assert "Anna Berg, Ben Kaya" in opened(found[78])


def test_a_gradebook_of_before_still_makes_it(tmp_path: Path) -> None:
    """It does not know what a hand-in was called; most are zip files."""
    with gradebook(tmp_path, "topics") as book:
        book.write(graded("berganna_77_8812_topics", "figure"))
        hand_out(book, TOPICS, tmp_path)
    found = imported_by_canvas((tmp_path / CANVAS_ZIP).read_bytes(), {8812: (77, "topics.zip")})
    assert "About figure." in opened(found[77])


# --- clones ------------------------------------------------------------------------------------


def test_each_clone_gets_a_comment(tmp_path: Path) -> None:
    """By the name of its repository; a team's is one."""
    done = played(of_classroom(tmp_path), verdicts)
    comments = {path.name: path.read_text("utf-8") for path in (done.out / COMMENTS).iterdir()}
    assert set(comments) == {"lab-topics-team-rot.md", "lab-topics-gruen.md"}
    red = comments["lab-topics-team-rot.md"].replace("\\", "")
    assert red.startswith(
        "**Lab topics: 84 of 100**\n\nHanded in 1 day late: 10 points less. 74 of"
    )
    assert "**About rate.**" in red and "**About figure.**" in red
    assert not (done.out / MOODLE_ZIP).exists() and not (done.out / CANVAS_ZIP).exists()


def test_a_comment_calls_nobody_and_has_an_end(tmp_path: Path) -> None:
    """What a student prints stays words: no mention, no heading, no HTML; GitHub has a bound."""
    measured = "# <b>@octocat</b> " + "x" * 90_000
    check = CheckResult(
        id="rate",
        title="A rate.",
        outcome="fail",
        points=0,
        max_points=5,
        measured=measured,
        log=("@teacher", "```", "# end"),
    )
    clone(tmp_path / "clones/lab-topics-anna")

    def result_of(name: str) -> GradingResult:
        found = graded(name)
        assert found.verdict
        verdict = found.verdict.model_copy(update={"checks": (check,), "outcome": "fail"})
        return found.model_copy(update={"verdict": verdict})

    done = played(GradeOptions("topics", tmp_path / "clones", tmp_path / "out"), result_of)
    text = (done.out / COMMENTS / "lab-topics-anna.md").read_text("utf-8")
    assert len(text) < LONGEST_COMMENT + 100
    assert not re.search(r"@\w|^# |<b>", text, re.MULTILINE)


def test_a_folder_that_is_no_clone_gets_none(tmp_path: Path) -> None:
    """Where there is no repository, nobody reads a comment."""
    (tmp_path / "in/anna").mkdir(parents=True)
    done = played(GradeOptions("topics", tmp_path / "in", tmp_path / "out"))
    assert not (done.out / COMMENTS).exists()


def test_a_name_that_is_no_text_ends_nothing(tmp_path: Path) -> None:
    """Bytes of another code page, and signs that steer a terminal: it is shown as escapes."""
    for name in (b"kayaben_77_8812_t\xf6pics.zip", b"berganna_78_8813_\x1b[2K.zip"):
        (tmp_path / "in").mkdir(exist_ok=True)
        Path(os.fsdecode(os.fsencode(tmp_path / "in") + b"/" + name)).write_bytes(zip_bytes())
    done = played(GradeOptions("topics", tmp_path / "in", tmp_path / "out", rule=rule()))
    with zipfile.ZipFile(done.out / CANVAS_ZIP) as archive:
        assert [name.partition("_t")[0] for name in archive.namelist()][1] == "kayaben_77_8812"
        assert all(name.isprintable() for name in archive.namelist())


# --- what students may not see -----------------------------------------------------------------


def test_hidden_checks_stay_hidden(tmp_path: Path) -> None:
    """In page, comment and worksheet they are one line together; the class page has them all."""
    secret = CheckResult(
        id="secret",
        title="SECRET.",
        outcome="fail",
        points=0,
        max_points=5,
        measured="SECRET",
        hidden=True,
    )

    def result_of(name: str) -> GradingResult:
        found = graded(name, "figure")
        assert found.verdict
        checks = (*found.verdict.checks, secret)
        verdict = found.verdict.model_copy(update={"checks": checks})
        return found.model_copy(update={"verdict": verdict})

    zip_ = make_zip(tmp_path / "moodle.zip", [(f"Anna Berg_101{FILES}/t.zip", zip_bytes())])
    list_ = worksheet(tmp_path, [line("Anna Berg", "-")])
    done = played(GradeOptions("topics", zip_, tmp_path / "out", roster=list_), result_of)
    found = imported_by_moodle((done.out / MOODLE_ZIP).read_bytes(), NUMBERS)
    told = (found["Anna Berg"][PAGE], (done.out / "moodle.csv").read_text("utf-8"))
    for text in told:
        assert "SECRET" not in text and "Checks that you do not have, together." in text
    assert "SECRET" in (done.out / "class.html").read_text("utf-8")
    own = done.out / "students" / folder_name(f"Anna Berg_101{FILES}")
    assert "SECRET" in (own / "verdict.json").read_text("utf-8"), "it is the instructor's"


def test_the_page_tells_the_files(tmp_path: Path) -> None:
    """Each is named on it, and its loop over the comments finds each repository."""
    text = (course.root() / "site/pages/teachers/feedback.md").read_text("utf-8")
    for name in (
        MOODLE_ZIP,
        CANVAS_ZIP,
        COMMENTS,
        "Upload multiple feedback files in a zip",
        "Re-upload Submissions",
    ):
        assert name in text
    done = played(of_classroom(tmp_path), verdicts)
    (loop,) = re.findall(r"```bash\n(for .*?)```", text, re.DOTALL)
    (tmp_path / "gh").write_text('#!/bin/sh\necho "$@"\n')
    (tmp_path / "gh").chmod(0o755)
    said = run_in(done.out.parent, loop.replace("grades-topics", "out"), tmp_path)
    assert said.splitlines() == [
        f"pr comment 1 --repo my-class/{name} --body-file out/{COMMENTS}/{name}.md"
        for name in ("lab-topics-gruen", "lab-topics-team-rot")
    ]
