"""Back to the students: what each platform takes to show everybody their own page.

| platform | file | how it finds the student |
| --- | --- | --- |
| Moodle: *Upload multiple feedback files in a zip* | `moodle-feedback.zip` | by the number |
| Canvas: *Re-upload Submissions* | `canvas-feedback.zip` | by both numbers |
| GitHub Classroom | `github-comments/REPOSITORY.md` | a comment on a pull request |

**Moodle** (mod/assign/feedback/file/importziplib.php). Of each file's path the first part that has
four pieces between `_` counts. They are NAME, NUMBER, `assignsubmission`, `file`, and since 4.1 no
more. Before, a fifth piece had to follow, be it empty. NUMBER is the participant's. So a folder is
called as it was downloaded, and so is the start of a file that came without a folder. What begins
with `.` or `~` is passed by. Only the participant of the number gets the file, also where teams
hand in. There, the number in the download is the group's, and each member gets a folder with the
member's own number.

**Canvas** (app/models/abstract_assignment.rb, `infer_comment_context_from_filename`). The first two
pieces between `_` that are all digits are the user and the attachment. `LATE` and a group's name
before them are taken away. Both must be of this assignment, so a file is called as it was
downloaded. It is shown as a comment to the student, or to all of the group, under the name that the
*student's* file had (`FileInContext.attach`, `display_name`). So what is in it must be of that
kind: a page in a zip for a zip.

**GitHub Classroom** has no importer. Its assignments can open a pull request for feedback, which is
number 1 in each repository (`gh pr comment 1 --body-file FILE`); a comment has at most 65,536
characters.

Who has no score, and was not refused, gets nothing: there is nothing to mend yet. Of nobody's and
unclear hand-ins nothing goes back.
"""

from __future__ import annotations

import io
import re
import tarfile
import zipfile
from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from pydantic import BaseModel

from ros2_on_pip.safe_text import harmless
from ros2_on_pip.typed_paths import from_here
from roslings.course import Lab
from roslings.hand_in.archives import SUFFIXES
from roslings.report.markdown import escaped, markdown_of
from roslings.report.shown_checks import shown_checks
from roslings.report.whole_file import write_whole
from roslings.verdict import CheckResult
from roslings_class.folders import PAGE, folder_name, folder_of
from roslings_class.grades import UNCLEAR, Class, StudentGrade
from roslings_class.platform_names import CANVAS, FILE, MOODLE, PlatformName, told_by_platform

MOODLE_ZIP, CANVAS_ZIP, COMMENTS = "moodle-feedback.zip", "canvas-feedback.zip", "github-comments"
LONGEST_COMMENT = 60_000
SAME_TIME = (2000, 1, 1, 0, 0, 0)
"""Of every entry: the same feedback is the same file."""
_CLEANED = re.compile(r"[\x00-\x1f&<>\"`|':\\/]")
"""What Moodle takes out of a name of a file (`PARAM_FILE` of lib/moodlelib.php)."""
Entries = dict[str, bytes]


class DownloadedHandIn(BaseModel):
    """A hand-in as it lay in the download."""

    name: str
    """With its ending."""
    is_clone: bool = False


@dataclass(frozen=True)
class Feedback:
    """What goes back, from the pages that are written already."""

    lab: Lab
    folder: Path
    given: Mapping[str, DownloadedHandIn]
    counts: Mapping[str, str]
    """Submission to what counts beside its measured score."""
    has_worksheet: bool = False
    """The class list is Moodle's: it numbers every student."""

    def write(self, found: Class) -> Iterator[str]:
        """Write a file for each platform that is there; what to do with it.

        Raises CannotWriteFile.
        """
        own = [each for each in found.grades if is_for_a_student(each, found.unknown)]
        told = told_by_platform(grade.submission for grade in found.grades)
        moodle, canvas = Entries(), Entries()
        for grade in own:
            moodle.update(self._moodles(grade, told.get(grade.submission), moodle))
            canvas.update(self._canvass(grade, told.get(grade.submission)))
        upload = "Upload multiple feedback files in a zip"
        yield from self._zip(MOODLE_ZIP, moodle, f"Moodle, {upload}")
        yield from self._zip(CANVAS_ZIP, canvas, "Canvas, Re-upload Submissions")
        yield from self._comments(own)
        if lost := [grade.name for grade in own if self._is_lost(grade, told)]:
            yield f"No page for who has no number: {', '.join(lost)}. Give Moodle's worksheet."

    @property
    def name(self) -> str:
        """Of the page: a student may have several labs."""
        return f"roslings-{self.lab.name}.html"

    def _page(self, grade: StudentGrade) -> bytes:
        return (folder_of(self.folder, grade.submission) / PAGE).read_bytes()

    def _zip(self, name: str, entries: Entries, button: str) -> Iterator[str]:
        if entries:
            write_whole(self.folder / name, zipped(entries))
            yield f"{button}: {from_here(self.folder)}/{name}"

    # --- Moodle --------------------------------------------------------------------------------

    def _moodles(self, grade: StudentGrade, told: PlatformName | None, taken: Entries) -> Entries:
        """Without a class list, two hand-ins of one student have a page each."""
        place = self._place(grade, told)
        own = f"{folder_name(grade.submission)}.html"
        name = f"{place}{own if f'{place}{self.name}' in taken else self.name}"
        return {name: self._page(grade)} if place else {}

    def _place(self, grade: StudentGrade, told: PlatformName | None) -> str:
        """What stands before the page's name; empty where Moodle would find nobody by it."""
        if told and told.platform == MOODLE and not grade.team:
            start = f"{told.person}_{told.number}_assignsubmission_{told.part}"
            rest = grade.submission.removeprefix(start)
            return f"{start}_" if rest.strip("_") else f"{start}{rest}/"
        is_numbered = self.has_worksheet or (told is not None and told.platform == MOODLE)
        number = moodle_number(grade) if is_numbered else ""
        person = _CLEANED.sub("", grade.name.replace("_", " "))
        return f"{person}_{number}_assignsubmission_{FILE}/" if number else ""

    def _is_lost(self, grade: StudentGrade, told: Mapping[str, PlatformName]) -> bool:
        each = told.get(grade.submission)
        is_of_moodle = each is not None and each.platform == MOODLE
        return is_of_moodle and not self._place(grade, each)

    # --- Canvas --------------------------------------------------------------------------------

    def _canvass(self, grade: StudentGrade, told: PlatformName | None) -> Entries:
        if told is None or told.platform != CANVAS:
            return {}
        given = self.given.get(grade.submission)
        name = given.name if given else f"{grade.submission}.zip"
        return {name: self._of_kind(grade, name)}

    def _of_kind(self, grade: StudentGrade, name: str) -> bytes:
        """The page as a file of the kind that the name says; else a text with the same words."""
        small, page = name.lower(), {self.name: self._page(grade)}
        if small.endswith(".zip") or "." not in small:
            return zipped(page)
        if small.endswith(SUFFIXES):
            return tarred(page, small)
        return page[self.name] if small.endswith((".html", ".htm")) else self._text(grade)

    # --- GitHub Classroom ----------------------------------------------------------------------

    def _comments(self, own: Iterable[StudentGrade]) -> Iterator[str]:
        clones = [grade for grade in own if self._is_clone(grade)]
        for grade in clones:
            place = self.folder / COMMENTS / f"{folder_name(grade.submission)}.md"
            place.parent.mkdir(exist_ok=True)
            write_whole(place, self._comment(grade))
        if clones:
            yield f"GitHub, a comment for each: {from_here(self.folder)}/{COMMENTS}"

    def _is_clone(self, grade: StudentGrade) -> bool:
        given = self.given.get(grade.submission)
        return given is not None and given.is_clone

    def _comment(self, grade: StudentGrade) -> bytes:
        text = "\n\n".join(self._parts(grade))
        cut = text if len(text) <= LONGEST_COMMENT else f"{text[:LONGEST_COMMENT]}\n..."
        return f"{_without_mentions(cut)}\n".encode("utf-8", "replace")

    def _parts(self, grade: StudentGrade) -> Iterator[str]:
        heading, *lines = self._lines(grade)
        yield f"**{heading}**"
        yield from map(escaped, lines)
        for check in to_mend(grade):
            yield from filter(None, (f"**{escaped(check.title)}**", markdown_of(check)))

    # --- words ---------------------------------------------------------------------------------

    def _lines(self, grade: StudentGrade) -> Iterator[str]:
        """The lab and its score, what counts besides, and why there is no verdict."""
        score = "no score" if grade.measured is None else f"{grade.measured:g} of 100"
        yield f"Lab {self.lab.name}: {score}"
        if counts := self.counts.get(grade.submission):
            yield counts
        if grade.result and not grade.result.verdict:
            yield from filter(None, grade.result.told_to_student)

    def _text(self, grade: StudentGrade) -> bytes:
        """The same for who reads no page: one line for each part of it."""
        checks = [
            f"{check.title}\n  {harmless(check.measured or '')}".rstrip()
            for check in to_mend(grade)
        ]
        parts = [*self._lines(grade), *(["To mend:"] if checks else []), *checks]
        return ("\n".join(parts) + "\n").encode("utf-8", "replace")


def to_mend(grade: StudentGrade) -> list[CheckResult]:
    """The checks that failed, as the student may see them."""
    verdict = grade.result.verdict if grade.result else None
    return [each for each in shown_checks(verdict) if each.outcome == "fail"] if verdict else []


def is_for_a_student(grade: StudentGrade, unknown: Container[str]) -> bool:
    """Whether there is something to tell, and somebody whose it is for sure."""
    if grade.result is None or grade.outcome == UNCLEAR or grade.submission in unknown:
        return False
    return grade.final is not None or grade.outcome == "refused"


def moodle_number(grade: StudentGrade) -> str:
    """The participant's number in Moodle's worksheet; empty where the class list has none."""
    cells = grade.student.cells if grade.student else {}
    found = re.fullmatch(r"\D+(\d+)", cells.get("identifier", "").strip())
    return found[1] if found else ""


def zipped(entries: Mapping[str, bytes]) -> bytes:
    """A zip file; Python marks a name that is not ASCII as UTF-8."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, page in sorted(entries.items()):
            entry = zipfile.ZipInfo(name, SAME_TIME)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, page)
    return content.getvalue()


def tarred(entries: Mapping[str, bytes], name: str) -> bytes:
    """A tar file, packed as its name says."""
    packed = next((form for form in ("gz", "bz2", "xz") if name.endswith(form)), "")
    packed = "gz" if name.endswith(".tgz") else packed
    content = io.BytesIO()
    with tarfile.open(fileobj=content, mode=f"w:{packed}") as archive:  # type: ignore[call-overload]
        for path, page in entries.items():
            entry = tarfile.TarInfo(path)
            entry.size = len(page)
            archive.addfile(entry, io.BytesIO(page))
    return content.getvalue()


def _without_mentions(text: str) -> str:
    """GitHub tells everybody who is named after an `@`; a space without width keeps it quiet."""
    return text.replace("@", "@\u200b")
