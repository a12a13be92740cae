"""What is asked of one grading, and what comes of it: both cross from process to process."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import BaseModel, ConfigDict

from roslings.course.contract import Plain
from roslings.judge.grader_mistakes import GraderBroke
from roslings.verdict import Verdict
from roslings_class.platform_names import NOBODY, platform_name

State = Literal["graded", "refused", "broken"]
"""Judged; not gradable as it was handed in; the grading itself broke off (the machine's fault)."""


class GradingOrder(BaseModel):
    """One submission to grade, once."""

    model_config = ConfigDict(frozen=True)

    lab: str
    submission: str
    digest: str
    attempt: int
    path: Path
    room: Path
    """A private folder for this grading; the answer is put there."""
    seed: int
    clock: Literal["auto", "sim", "wall"] = "auto"
    hidden: Path | None = None
    course: Path | None = None
    """Where the lab's files lie, where not in this course."""
    whose: str = ""
    """By whose card it is graded; empty where everybody has the same."""
    words: dict[str, Plain] = {}
    """What is the student's own in that card, by the names that `variants.yaml` has."""
    builds: Path | None = None
    builds_from_cache: bool = False
    """One of a lab's own packages: those that differ in their modules alone share a build."""
    keeps_evidence: bool = True
    soak_s: float = 0.0
    """How long its nodes are left running besides; 0: not at all."""
    strangers: bool = False
    """Somebody else's, and not trusted: the wall for strangers' code is taken."""
    room_secret: str = ""
    """What its rooms are drawn from; empty where it drives in none, or in the lab's own."""

    @property
    def handed_in_as(self) -> str:
        """Who handed it in, by the platform's part of its name; else what it is called.

        What a student calls a file names whom the student likes. Nobody hands in a lab's own
        packages.
        """
        if self.builds_from_cache:
            return ""
        told = platform_name(self.submission)
        return told.person if told and told.person != NOBODY else self.submission

    @property
    def answer(self) -> Path:
        """Where the result is put, whole."""
        return self.room / "result.json"

    @property
    def evidence(self) -> Path:
        """Where the packed evidence is put."""
        return self.room / "evidence.zlib"

    @property
    def soaking(self) -> Path:
        """There as soon as its nodes only run on: little is computed for it then."""
        return self.room / "soaking"

    @property
    def errors(self) -> Path:
        """What the process wrote when it broke off."""
        return self.room / "errors"


NOT_YET = "There is no grade yet: the machine that grades could not tell. It is not your fault."
WHO_KNOWS = "Your instructor sees why."


class GradingResult(BaseModel):
    """What came of one grading."""

    model_config = ConfigDict(frozen=True)

    submission: str
    digest: str
    attempt: int
    state: State
    verdict: Verdict | None = None
    reason: str = ""
    """Why it was refused, or broke off."""
    next_step: str = ""
    broken_by_grader: bool = False
    """It broke off by a mistake in the grader: to try it again tells nothing new."""
    seconds: float = 0.0
    lab_version: str = ""
    """Of the engine, the card and the grader that judged it."""
    source: str = ""
    """Equal where two submissions have equal code."""
    marks: tuple[int, ...] = ()
    """Fingerprints of its code."""
    rates: dict[str, float] = {}
    """Topic of the card to the rate that was measured, in Hz."""
    whose: str = ""
    """By whose card it was judged; empty where everybody has the same."""
    words: dict[str, Plain] = {}
    """What is the student's own in that card."""
    unusual: tuple[str, ...] = ()
    """What its processes did that others' do not; empty as a rule."""

    @property
    def is_conclusive(self) -> bool:
        """It need not be tried again."""
        if self.state == "refused":
            return True
        return self.verdict is not None and self.verdict.outcome != "inconclusive"

    @property
    def grader_broke(self) -> str:
        """The mistake of the grader by which it could not tell; empty where there was none."""
        if self.broken_by_grader:
            return self.reason
        checks = self.verdict.checks if self.verdict else ()
        told = (f"{each.id}: {each.why}" for each in checks if each.fault == GraderBroke.__name__)
        return "\n".join(told)

    @property
    def score(self) -> float | None:
        """0 to 100; None where nobody could tell."""
        return self.verdict.score if self.verdict else None

    @property
    def told_to_student(self) -> tuple[str, str]:
        """Why there is no verdict, and the next step, for the author of what was handed in.

        What broke off is told the instructor, in words and paths of the machine that grades.
        """
        return (self.reason, self.next_step) if self.state == "refused" else (NOT_YET, WHO_KNOWS)

    @property
    def word(self) -> str:
        """Its outcome in one word: pass, fail, inconclusive or refused."""
        if self.state == "refused":
            return "refused"
        return self.verdict.outcome if self.verdict else "inconclusive"


def broken(
    order: GradingOrder, reason: str, seconds: float = 0.0, *, by_the_grader: bool = False
) -> GradingResult:
    """A grading that ended without an answer: never the student's fault, never a zero."""
    return GradingResult(
        submission=order.submission,
        digest=order.digest,
        attempt=order.attempt,
        state="broken",
        reason=reason,
        seconds=seconds,
        whose=order.whose,
        words=order.words,
        broken_by_grader=by_the_grader,
        next_step="Look at this one yourself: ./roslings check LAB PATH",
    )
