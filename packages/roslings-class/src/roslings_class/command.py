"""What `./roslings grade` does: find the submissions, grade them, hand out what came of it."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from ros2_on_pip.safe_text import harmless
from ros2_on_pip.typed_paths import from_here
from roslings import course
from roslings.arena import Isolation
from roslings.course import Lab
from roslings.course.soak import soak_seconds
from roslings.course.variants import chosen
from roslings.experiment import insist_on_wall
from roslings.experiment.run_folder import LOCK, run_folder
from roslings.experiment.walls import closed_places
from roslings.report.progress import ProgressLine
from roslings_class.alone import alone_in
from roslings_class.capacity import Capacity
from roslings_class.clock_times import zone_named
from roslings_class.dask_pool import DaskPool, dask_pool
from roslings_class.downloads import submissions_at
from roslings_class.errors import BatchError
from roslings_class.explaining import explain
from roslings_class.feedback import DownloadedHandIn
from roslings_class.gradebook import Gradebook, gradebook
from roslings_class.handed_in import told_at, told_by_itself
from roslings_class.handing_out import Settings, hand_out, keep
from roslings_class.late_days import LateRule, insist_on_people, read_extensions
from roslings_class.messages import (
    closed_lines,
    root_lines,
    soak_line,
    standing_line,
    summary_lines,
)
from roslings_class.moodle_worksheet import read_worksheet
from roslings_class.own_cards import NoList, OneMachine, OwnCards, own_cards
from roslings_class.result import GradingResult
from roslings_class.room_secret import Whose, insist_on_rooms, room_secret
from roslings_class.roster import insist_on_owners, read_roster
from roslings_class.scheduler import BatchProgress, GradingRequest, Scheduler
from roslings_class.signed_gradebook import take_key
from roslings_class.submissions import Submission
from roslings_class.worker_pool import GradingLimits


class AlreadyGrading(BatchError):
    """Another command works on the same gradebook."""

    def __init__(self, folder: Path) -> None:
        super().__init__(
            f"Another ./roslings grade works in {from_here(folder)} now.",
            "Wait for it, or give another folder: --out DIR",
        )


class NoDeadline(BatchError):
    """There are extensions of a deadline that nobody gave."""

    def __init__(self) -> None:
        super().__init__(
            "There is a list of extensions, and no deadline.", "Say it: --deadline 2026-11-30T23:59"
        )


@dataclass(frozen=True)
class GradeOptions:
    """The options of the command."""

    lab: str
    submissions: Path
    out: Path
    jobs: int | None = None
    hidden: Path | None = None
    trust: bool = False
    clock: str = "auto"
    keeps_evidence: bool = True
    limit_s: float = GradingLimits().seconds
    roster: Path | None = None
    rule: LateRule | None = None
    extensions: Path | None = None
    """The list of who has more time."""
    times: tuple[Path, ...] = ()
    """Files that tell when each was handed in."""
    dask: str | None = None
    """The address of a cluster's scheduler."""
    soak_s: float | None = None
    """How long the nodes are left running besides; None: as the card says."""
    alone: bool = False
    """Whether there is never a second one, not even one that only waits."""
    assignment: str = ""
    """What Canvas calls the lab."""
    points: float | None = None
    """What the whole is worth on the platform; None: as the class list says, or 100."""
    variants: bool = False
    """Whether each student is graded by a card of their own."""
    explain: bool = False
    """Whether questions are made about each hand-in that passes."""
    rooms: Whose | None = None
    """Whether all drive in the same secret rooms, or each in others; None: as kept, or the same."""


@dataclass(frozen=True)
class Report:
    """What the command says at its end."""

    lines: list[str]
    unclear: int
    """Submissions of which nobody could tell."""


def grade(choices: GradeOptions) -> Report:
    """Grade all submissions, or go on where an earlier run was ended.

    Raises BatchError, CourseError (LabHasNoRooms, too), and what the gradebook's disk refuses.
    """
    lab = course.lab(choices.lab, choices.hidden)
    _ = lab.card, lab.hints  # a mistake in the course is told before anything is run
    insist_on_rooms(lab, choices.rooms)
    students = read_roster(choices.roster) if choices.roster else ()
    if choices.variants:
        _insist_on_owners_of_cards(choices, lab)
    zone = choices.rule.zone if choices.rule else ""
    with submissions_at(choices.submissions, students, zone_named(zone)) as submissions:
        return _graded(choices, lab, submissions)


def _insist_on_owners_of_cards(choices: GradeOptions, lab: Lab) -> None:
    """Raises NoList, OneMachine, NoVariants, BadCourseFile."""
    if not choices.roster:
        raise NoList
    if choices.dask:
        raise OneMachine
    chosen(lab, "anybody").card()


def _graded(choices: GradeOptions, lab: Lab, submissions: list[Submission]) -> Report:
    settings = settings_for(choices, submissions)
    lines: list[str] = []
    if not choices.dask and not choices.trust:
        wall = insist_on_wall(lab, choices.submissions, choices.out)
        choices, lines = _at_once(choices, wall), [*root_lines(wall.as_root)]
        if wall.wall == "user":
            lines.extend(closed_lines(closed_places()))
    _make(choices)
    with alone_in(choices.out, AlreadyGrading), gradebook(choices.out, lab.name) as book:
        told = take_key(book, choices.out)
        keep(book, settings)
        names = [each.name for each in submissions]
        told += _anew(set(names) & book.forged().keys())
        _grade_all(choices, submissions, book, soak_seconds(lab.card, choices.soak_s))
        latest = book.latest()
        unclear = sum(latest[name].word == "inconclusive" for name in names)
        lines = [
            *lines,
            *told,
            *summary_lines(book, names),
            soak_line(latest.values()),
            *hand_out(book, lab, choices.out),
            *_explain(choices, submissions, latest),
        ]
        return Report(lines, unclear)


def _explain(
    choices: GradeOptions, submissions: list[Submission], latest: Mapping[str, GradingResult]
) -> list[str]:
    """Questions about what passes, where they were asked for."""
    if not choices.explain:
        return []
    with ProgressLine() as progress:
        return explain(choices.lab, submissions, latest, choices.out, choices.trust, progress.step)


def _anew(names: set[str]) -> list[str]:
    """Verdicts that do not count, for their evidence is not what was measured."""
    if not names:
        return []
    return [
        "Measured anew, for the evidence in the gradebook was not what was measured:\n"
        f"  {', '.join(sorted(names))}"
    ]


def _at_once(choices: GradeOptions, wall: Isolation) -> GradeOptions:
    """Users of one machine share its network: one at a time, none can speak in another's place."""
    return replace(choices, jobs=1, alone=True) if wall.wall == "user" else choices


def _make(choices: GradeOptions) -> None:
    """The folder of the gradebook, for nobody else's eyes. Raises BatchError."""
    out = choices.out.absolute()
    if out.is_relative_to(choices.submissions.absolute()):
        problem = f"{from_here(choices.out)} lies among the submissions: it would be graded as one."
        raise BatchError(problem, "Give a place outside of that folder: --out ../grades")
    make_private(choices.out)


def make_private(out: Path) -> None:
    """A folder for nobody else's eyes. Raises BatchError."""
    try:
        out.absolute().mkdir(mode=0o700, parents=True, exist_ok=True)
    except OSError as error:
        problem = f"{from_here(out)} cannot be made: {error.strerror}."
        raise BatchError(problem, "Give a place where you may write: --out ~/grades") from error


def settings_for(choices: GradeOptions, submissions: list[Submission]) -> Settings:
    """A class list that cannot be read, or is of others, is told before anything is run.

    Raises BadTable, NobodyInTheList.
    """
    if choices.roster:
        read_worksheet(choices.roster)
        insist_on_owners(choices.roster, [each.name for each in submissions])
    times = {each.name: each.submitted for each in submissions if each.submitted}
    rule = _rule(choices, [each.name for each in submissions])
    told = told_at(choices.times, rule.zone if rule else "")
    roster = choices.roster.absolute() if choices.roster else None
    hidden = choices.hidden.absolute() if choices.hidden else None
    return Settings(
        roster=roster,
        rule=rule,
        times=times,
        hidden=hidden,
        assignment=choices.assignment,
        points=choices.points,
        told=(*told, *told_by_itself(submissions)),
        variants=choices.variants,
        given=given_names(submissions),
    )


def given_names(submissions: list[Submission]) -> dict[str, DownloadedHandIn]:
    """What each was called in the download, and which are clones."""
    return {
        each.name: DownloadedHandIn(
            name=harmless(each.path.name), is_clone=(each.path / ".git").is_dir()
        )
        for each in submissions
    }


def _rule(choices: GradeOptions, submissions: list[str]) -> LateRule | None:
    """With everybody's own time in it. Raises BadTable, ExtensionOfNobody, NoDeadline."""
    if choices.extensions is None:
        return choices.rule
    if choices.rule is None:
        raise NoDeadline
    more = read_extensions(choices.extensions, choices.rule.zone)
    rule = choices.rule.model_copy(update={"extensions": more})
    students = read_roster(choices.roster) if choices.roster else []
    insist_on_people(choices.extensions, rule, students, submissions)
    return rule


def _grade_all(
    choices: GradeOptions, submissions: list[Submission], book: Gradebook, soak_s: float
) -> None:
    with run_folder() as scratch, ProgressLine() as progress:
        request = GradingRequest(
            lab=choices.lab,
            scratch=scratch,
            lock=scratch / LOCK,
            clock=choices.clock,
            hidden=choices.hidden.absolute() if choices.hidden else None,
            strangers=not choices.trust,
            keeps_evidence=choices.keeps_evidence,
            limits=GradingLimits(choices.limit_s),
            soak_s=soak_s,
            cards=_cards(choices, submissions, scratch / "cards"),
            rooms=room_secret(course.lab(choices.lab), book, choices.rooms),
        )
        teller = ProgressTeller(progress)
        if choices.dask is None:
            capacity = Capacity(fixed=choices.jobs, alone=choices.alone)
            Scheduler(request, book, capacity, teller).run(submissions)
        else:
            lab = course.lab(choices.lab, request.hidden)
            with dask_pool(choices.dask, lab, choices.trust, request.limits) as workers:
                Scheduler(request, book, ClusterCapacity(workers), teller).run(submissions, workers)


def _cards(choices: GradeOptions, submissions: list[Submission], folder: Path) -> OwnCards | None:
    if not choices.variants or not choices.roster:
        return None
    students, names = read_roster(choices.roster), [each.name for each in submissions]
    return own_cards(course.lab(choices.lab), students, names, folder)


@dataclass
class ClusterCapacity:
    """As many as the cluster has threads, workers that come later too."""

    workers: DaskPool
    fixed: int | None = None

    def now(self, working: int, soaking: int = 0) -> int:
        """One more than there are threads waits on its way."""
        return self.workers.threads() + 1


@dataclass
class ProgressTeller:
    """Says how far the work is, when that has changed."""

    progress: ProgressLine
    said: tuple[int, int] | None = None

    def __call__(self, standing: BatchProgress) -> None:
        """Say it: always on a terminal, where the line is drawn anew, else only what is new."""
        now = (standing.done, standing.unclear)
        if sys.stderr.isatty() or now != self.said:
            self.progress.step(standing_line(standing))
            self.said = now
