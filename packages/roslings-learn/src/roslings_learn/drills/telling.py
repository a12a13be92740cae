"""What the terminal shows of drills: the task, a verdict of a few lines, a hint, the list."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console

from ros2_on_pip.typed_paths import shown
from roslings.report.log_lines import helpful
from roslings.report.page import Page
from roslings.report.typed import Typed
from roslings_learn.drills.beside import beside
from roslings_learn.drills.card import KINDS
from roslings_learn.drills.course import Drill
from roslings_learn.drills.judging import DrillVerdict
from roslings_learn.drills.student import DrillStatus, program_in

COLOURS = {"-": "red", "+": "green"}
LOG_LINES = 6
BAR = 24
STEPS = ("where to look", "which idea", "the same idea in other code")


@dataclass(frozen=True)
class Way:
    """How the student goes on: by a command, or by a save where the file is watched."""

    program: str
    watched: bool = False

    def put_next(self, to: Page, mend: str, drill: Drill) -> None:
        """What to do now."""
        if self.watched:
            to.labelled("Next", f"{mend}, and save it.")
        else:
            to.command("Next", f"{mend}, then check it:", f"{self.program} drill {drill.name}")

    def put_help(self, to: Page, drill: Drill) -> None:
        """Where the hints are; who watches has a key for them."""
        if not self.watched:
            to.command("Stuck", "Ask for a hint:", f"{self.program} drill {drill.name} --hint")


def page(console: Console | None = None) -> Page:
    """An empty page for this terminal."""
    return Page(console or Console(), Typed(""))


def put_task(to: Page, drill: Drill, file: Path, place: tuple[int, int], way: Way) -> None:
    """What is to be done, and what to type next. `place` is which of how many."""
    card = drill.card
    to.line(f"Drill {place[0]} of {place[1]}, day {int(drill.day[:2])}: {card.title}", "bold")
    to.labelled("", KINDS[card.kind])
    if card.answer:
        to.labelled("Question", card.answer.question)
    to.command("File", "", shown(file))
    to.lesson("Read", card.lesson)
    way.put_next(to, "Open the file, mend it", drill)


def put_verdict(to: Page, drill: Drill, verdict: DrillVerdict, file: Path, way: Way) -> None:
    """The first thing that is wrong, and its next step; or that all is well."""
    if verdict.awaits_answer:
        _put_question(to, drill, verdict, file, way)
        return
    mark = {"pass": "pass", "fail": "fail", "inconclusive": "inconclusive"}[verdict.outcome]
    style = {"pass": "green", "fail": "bold red", "inconclusive": "bold magenta"}[mark]
    head = f"{to.marks[mark]} {drill.name}  "
    to.headed(head, f"{verdict.headline} ({verdict.seconds:.1f} s)", style=style, text_style="bold")
    if verdict.first is None:
        to.labelled("Idea", drill.card.idea)
        if verdict.because:
            to.labelled("Because", verdict.because)
        return
    _put_details(to, verdict, file)
    to.lesson("read", drill.card.lesson, indent=2)
    way.put_next(to, f"Mend {shown(file)}", drill)
    if verdict.outcome == "fail":
        way.put_help(to, drill)


def _put_question(to: Page, drill: Drill, verdict: DrillVerdict, file: Path, way: Way) -> None:
    """Of a program to predict: nothing is wrong, an answer is awaited."""
    assert drill.card.answer and verdict.first
    head = f"{to.marks['inconclusive']} {drill.name}  "
    to.headed(head, verdict.headline, style="bold cyan", text_style="bold")
    if not way.watched:
        to.labelled("question", drill.card.answer.question, indent=2)
    to.labelled("how", verdict.first.hint or "", indent=2)
    to.lesson("read", drill.card.lesson, indent=2)
    way.put_next(to, f"Write your answer into {shown(file)}", drill)
    way.put_help(to, drill)


def _put_details(to: Page, verdict: DrillVerdict, file: Path) -> None:
    assert verdict.first
    first = verdict.first
    measured = first.measured if first.measured != verdict.headline else None
    for label, text in (("expected", first.expected), ("measured", measured), ("try", first.hint)):
        if text:
            to.labelled(label, _of_one_file(text, file), indent=2)
    if first.outcome == "inconclusive" and first.why != verdict.headline:
        to.labelled("why", first.why or "", indent=2)
    if lines := helpful(first.log, file.stem, LOG_LINES):
        to.boxed("The last lines that came out", lines, indent=2)


def _of_one_file(text: str, file: Path) -> str:
    """A lab's words for a program that no package has."""
    runner = "bash" if file.suffix == ".sh" else "python3"
    by_hand = text.replace("`bash`", f"`bash {file.name}`")
    return by_hand.replace("`ros2 run`", f"`{runner} {file.name}`")


def put_hint(to: Page, drill: Drill, step: int, program: str, watched: bool = False) -> None:
    """Step 1 to 3 of the hint."""
    to.line(f"Hint {step} of {len(STEPS)} for {drill.name}: {STEPS[step - 1]}", "bold")
    to.text(drill.card.hints[step - 1], indent=2)
    to.lesson("Read", drill.card.lesson)
    if step < len(STEPS) and watched:
        to.labelled("More", "Press h once more.")
    elif step < len(STEPS):
        again = f"{program} drill {drill.name} --hint {step + 1}"
        to.command("More", "The next hint:", again)


def put_list(to: Page, every: Sequence[DrillStatus]) -> None:
    """All drills, day by day, with a mark at those that are done."""
    done = sum(each.done for each in every)
    to.line(f"{bar(done, len(every))} {done} of {len(every)} drills", "bold")
    day = ""
    for each in every:
        if each.drill.day != day:
            day = each.drill.day
            to.line(f"Day {int(day[:2])}", "bold")
        mark = to.marks["pass"] if each.done else " "
        to.line(f"  {mark} {each.drill.name:<24} {each.drill.card.title}")


def put_day(to: Page, every: Sequence[DrillStatus], at: Drill, program: str) -> None:
    """The drills of the day of `at`, and of each other day how many are done."""
    for day in dict.fromkeys(each.drill.day for each in every):
        those = [each for each in every if each.drill.day == day]
        done = sum(each.done for each in those)
        to.line(f"Day {int(day[:2]):<2}  {done} of {len(those)} drills done", "bold")
        for each in those if day == at.day else ():
            here = ">" if each.drill == at else " "
            mark = to.marks["pass"] if each.done else " "
            to.line(f"{here} {mark} {each.drill.name:<24} {each.drill.card.title}")
    to.command("Another", "To work on another one, quit, and name it:", f"{program} watch NAME")


def put_beside(to: Page, drill: Drill, file: Path) -> None:
    """The student's program and the reference solution."""
    to.line(f"Yours and ours of {drill.name}: both do all that is asked.", "bold")
    yours, ours = (
        program_in(file, drill).decode("utf-8", "replace"),
        drill.solution.read_text("utf-8"),
    )
    if yours == ours:
        to.line("They are the same, letter by letter.")
        return
    for line in beside(yours, ours, to.width):
        to.line(line, COLOURS.get(line[:1], ""))


def bar(done: int, of: int, width: int = BAR) -> str:
    """A bar in plain characters: `[####----]`."""
    full = width * done // max(of, 1)
    return f"[{'#' * full}{'-' * (width - full)}]"
