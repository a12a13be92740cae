"""What the terminal shows of drills: the task, a verdict of a few lines, a hint, the list."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console

from ros2_on_pip.language import Text, counted, said
from ros2_on_pip.typed_paths import shown
from roslings.report.command_line import CommandLine
from roslings.report.log_lines import helpful
from roslings.report.often_said import (
    ASK_FOR_A_HINT,
    EXPECTED,
    MEASURED,
    NEXT,
    READ,
    STUCK,
    TRY,
    WHY,
)
from roslings.report.page import Page
from roslings_learn.drills.beside import beside
from roslings_learn.drills.card import KINDS, PROGRAM
from roslings_learn.drills.course import Drill
from roslings_learn.drills.judging import DrillVerdict
from roslings_learn.drills.student import DrillStatus, program_in

COLOURS = {"-": "red", "+": "green"}
LOG_LINES = 6
BAR = 24
STEPS = (
    Text("drill.hint.where", "where to look"),
    Text("drill.hint.idea", "which idea"),
    Text("drill.hint.code", "the same idea in other code"),
)
MORE, CAPITAL_READ = Text("drill.label.more", "More"), Text("drill.label.read", "Read")
NAME_COLUMNS = 24


@dataclass(frozen=True)
class Mend:
    """What to do with the file, for who watches it and for who types a command."""

    and_save: Text
    then_check: Text


OPEN = Mend(
    Text("drill.open.save", "Open the file, mend it, and save it."),
    Text("drill.open.check", "Open the file, mend it, then check it:"),
)
MEND = Mend(
    Text("drill.mend.save", "Mend {file}, and save it."),
    Text("drill.mend.check", "Mend {file}, then check it:"),
)
ANSWER = Mend(
    Text("drill.answer.save", "Write your answer into {file}, and save it."),
    Text("drill.answer.check", "Write your answer into {file}, then check it:"),
)


@dataclass(frozen=True)
class WayToGoOn:
    """How the student goes on: by a command, or by a save where the file is watched."""

    program: str
    watched: bool = False

    def put_next(self, to: Page, mend: Mend, drill: Drill, file: Path) -> None:
        """What to do now."""
        if self.watched:
            to.labelled(NEXT, mend.and_save.filled(file=shown(file)))
        else:
            told = mend.then_check.filled(file=shown(file))
            to.command(NEXT, told, f"{self.program} drill {drill.name}")

    def put_help(self, to: Page, drill: Drill) -> None:
        """Where the hints are; who watches has a key for them."""
        if not self.watched:
            to.command(STUCK, ASK_FOR_A_HINT, f"{self.program} drill {drill.name} --hint")


def page(console: Console | None = None) -> Page:
    """An empty page for this terminal."""
    return Page(console or Console(), CommandLine(""))


def put_task(to: Page, drill: Drill, file: Path, place: tuple[int, int], way: WayToGoOn) -> None:
    """What is to be done, and what to type next. `place` is which of how many."""
    card = drill.card
    head = "Drill {number} of {count}, day {day}: {title}"
    number, count = place
    day = int(drill.day[:2])
    told = said("drill.head", head, number=number, count=count, day=day, title=card.title)
    to.headed("", told, style="", text_style="bold")
    to.labelled("", KINDS[card.kind])
    if card.answer:
        to.labelled(said("drill.label.question", "Question"), card.answer.question)
    to.command(said("drill.label.file", "File"), "", shown(file))
    to.lesson(CAPITAL_READ, card.lesson)
    way.put_next(to, OPEN, drill, file)


def put_verdict(to: Page, drill: Drill, verdict: DrillVerdict, file: Path, way: WayToGoOn) -> None:
    """The first thing that is wrong, and its next step; or that all is well."""
    if verdict.awaits_answer:
        _put_question(to, drill, verdict, file, way)
        return
    mark = {"pass": "pass", "fail": "fail", "inconclusive": "inconclusive"}[verdict.outcome]
    style = {"pass": "green", "fail": "bold red", "inconclusive": "bold magenta"}[mark]
    head = f"{to.marks[mark]} {drill.name}  "
    took = "{headline} ({seconds:.1f} s)"
    headline = _of_one_file(verdict.headline, file)
    told = said("drill.took", took, headline=headline, seconds=verdict.seconds)
    to.headed(head, told, style=style, text_style="bold")
    if verdict.first is None:
        to.labelled(said("drill.label.idea", "Idea"), drill.card.idea)
        if verdict.because:
            to.labelled(said("drill.label.because", "Because"), verdict.because)
        return
    _put_details(to, verdict, file)
    to.lesson(READ, drill.card.lesson, indent=2)
    way.put_next(to, MEND, drill, file)
    if verdict.outcome == "fail":
        way.put_help(to, drill)


def _put_question(
    to: Page, drill: Drill, verdict: DrillVerdict, file: Path, way: WayToGoOn
) -> None:
    """Of a program to predict: nothing is wrong, an answer is awaited."""
    assert drill.card.answer and verdict.first
    head = f"{to.marks['inconclusive']} {drill.name}  "
    to.headed(head, verdict.headline, style="bold cyan", text_style="bold")
    if not way.watched:
        to.labelled(said("drill.question", "question"), drill.card.answer.question, indent=2)
    to.labelled(said("drill.how", "how"), verdict.first.hint or "", indent=2)
    to.lesson(READ, drill.card.lesson, indent=2)
    way.put_next(to, ANSWER, drill, file)
    way.put_help(to, drill)


def _put_details(to: Page, verdict: DrillVerdict, file: Path) -> None:
    assert verdict.first
    first = verdict.first
    measured = first.measured if first.measured != verdict.headline else None
    for label, text in ((EXPECTED, first.expected), (MEASURED, measured), (TRY, first.hint)):
        if text:
            to.labelled(label, _of_one_file(text, file), indent=2)
    if first.outcome == "inconclusive" and first.why != verdict.headline:
        to.labelled(WHY, first.why or "", indent=2)
    if lines := helpful(first.log, file.stem, LOG_LINES):
        title = said("drill.last_lines", "The last lines that came out")
        to.boxed(title, lines, indent=2)


def _of_one_file(text: str, file: Path) -> str:
    """A lab's words for a program that no package has."""
    runner = "bash" if file.suffix == ".sh" else "python3"
    own = text.replace(PROGRAM, said("drill.your_program", "your program"))
    by_hand = own.replace("`bash`", f"`bash {file.name}`")
    return by_hand.replace("`ros2 run`", f"`{runner} {file.name}`")


def put_hint(to: Page, drill: Drill, step: int, program: str, watched: bool = False) -> None:
    """Step 1 to 3 of the hint."""
    head, what = "Hint {step} of {count} for {drill}: {what}", STEPS[step - 1]
    told = said("drill.hint", head, step=step, count=len(STEPS), drill=drill.name, what=what)
    to.headed("", told, style="", text_style="bold")
    to.text(drill.card.hints[step - 1], indent=2)
    to.lesson(CAPITAL_READ, drill.card.lesson)
    if step < len(STEPS) and watched:
        to.labelled(MORE, said("drill.press_h", "Press {key} once more.", key="h"))
    elif step < len(STEPS):
        again = f"{program} drill {drill.name} --hint {step + 1}"
        to.command(MORE, said("drill.next_hint", "The next hint:"), again)


def put_list(to: Page, every: Sequence[DrillStatus]) -> None:
    """All drills, day by day, with a mark at those that are done."""
    done = sum(each.done for each in every)
    one, other = "{done} of {count} drill", "{done} of {count} drills"
    told = counted("drill.list.done", len(every), one=one, other=other, done=done)
    to.line(f"{bar(done, len(every))} {told}", "bold")
    day = ""
    for each in every:
        if each.drill.day != day:
            day = each.drill.day
            to.line(said("drill.list.day", "Day {day}", day=int(day[:2])), "bold")
        mark = to.marks["pass"] if each.done else " "
        to.headed(f"  {mark} {each.drill.name:<{NAME_COLUMNS}} ", each.drill.card.title, style="")


def put_day(to: Page, every: Sequence[DrillStatus], at: Drill, program: str) -> None:
    """The drills of the day of `at`, and of each other day how many are done."""
    for day in dict.fromkeys(each.drill.day for each in every):
        those = [each for each in every if each.drill.day == day]
        done = sum(each.done for each in those)
        one, other = "{done} of {count} drill done", "{done} of {count} drills done"
        told = counted("drill.day.done", len(those), one=one, other=other, done=done)
        head = said("drill.list.day", "Day {day}", day=int(day[:2]))
        to.line(f"{head}{' ' * (day[0] == '0')}  {told}", "bold")
        for each in those if day == at.day else ():
            here = ">" if each.drill == at else " "
            mark = to.marks["pass"] if each.done else " "
            head = f"{here} {mark} {each.drill.name:<{NAME_COLUMNS}} "
            to.headed(head, each.drill.card.title, style="")
    another = said("drill.another", "To work on another one, quit, and name it:")
    to.command(said("drill.label.another", "Another"), another, f"{program} watch NAME")


def put_beside(to: Page, drill: Drill, file: Path) -> None:
    """The student's program and the reference solution."""
    both = "Yours and ours of {drill}: both do all that is asked."
    told = said("drill.beside", both, drill=drill.name)
    to.headed("", told, style="", text_style="bold")
    yours, ours = (
        program_in(file, drill).decode("utf-8", "replace"),
        drill.solution.read_text("utf-8"),
    )
    if yours == ours:
        to.line(said("drill.the_same", "They are the same, letter by letter."))
        return
    for line in beside(yours, ours, to.width):
        to.line(line, COLOURS.get(line[:1], ""))


def bar(done: int, of: int, width: int = BAR) -> str:
    """A bar in plain characters: `[####----]`."""
    full = width * done // max(of, 1)
    return f"[{'#' * full}{'-' * (width - full)}]"
