"""A verdict in the false language: no plain English is left, on the terminal and on the page.

Wrong packages of the lab are judged from the evidence that is kept with their proofs. Where a
sentence of a fault is still made by a property, it has no id, and its verdict is not looked at.
"""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest
from rich.console import Console

from plain_english import plain, read_in, words_of
from ros2_on_pip.language import FALSE, speaking
from roslings.course import lab
from roslings.course.grader import experiments_of, load_grader
from roslings.evidence import Evidence, read_json
from roslings.grading.saving import required_rates
from roslings.judge import judge
from roslings.judge.faults.base import Fault
from roslings.report.command_line import CommandLine
from roslings.report.html import Own, html_of
from roslings.report.terminal import print_verdict
from roslings.verdict import Verdict
from roslings_prove.proofs.kept import kept_here

LAB = lab("nodes")
KEPT = kept_here().archives(LAB)
SENTENCES = ("expected", "measured", "why", "hint", "mend")
FEWEST = 5
"""So many verdicts must be looked at, with faults of different kinds."""


def classes(kind: type[Fault] = Fault) -> Iterator[type[Fault]]:
    """All faults that are loaded."""
    yield kind
    for each in kind.__subclasses__():
        yield from classes(each)


def has_ids(fault: str | None) -> bool:
    """Whether each sentence of a fault is a template, or is none."""
    kind = next((each for each in classes() if each.__name__ == fault), Fault)
    own = kind.__mro__[: kind.__mro__.index(Fault)]
    return not any(isinstance(_first(name, own), property) for name in SENTENCES)


def _first(name: str, kinds: Iterable[type]) -> object:
    return next((vars(kind)[name] for kind in kinds if name in vars(kind)), None)


def judged(content: bytes) -> tuple[Verdict, Evidence]:
    """In the language that is spoken. Why a run is in doubt was recorded, in the words of then."""
    evidence = read_json(content)
    verdict = judge(LAB, evidence)
    checks = tuple(check.model_copy(update={"log": ()}) for check in verdict.checks)
    certain = {"machine_fault": None, "not_believed": None}
    seen = {name: run.model_copy(update=certain) for name, run in evidence.experiments.items()}
    shown = evidence.model_copy(update={"attempts": [], "experiments": seen})
    return verdict.model_copy(update={"checks": checks}), shown


@pytest.fixture(scope="module")
def verdicts() -> dict[str, tuple[Verdict, Evidence]]:
    """Of each wrong package whose faults have ids."""
    with speaking(FALSE):
        found = {
            package: judged(content)
            for file in KEPT.files()
            for package, content in KEPT.members(file).items()
        }
    return {
        name: each
        for name, each in found.items()
        if all(has_ids(c.fault) for c in each[0].failed())
    }


def known(verdict: Verdict) -> frozenset[str]:
    """What each language says alike: names of the card, of checks, of runs, of the machine."""
    card = words_of((LAB.folder / "card.yaml").read_text("utf-8"))
    experiments = words_of(" ".join(each.name for each in experiments_of(load_grader(LAB.grader))))
    checks = words_of(" ".join(check.id for check in verdict.checks))
    machine = words_of(str(verdict.environment.model_dump()))
    return card | experiments | checks | machine | {LAB.name}


def terminal(verdict: Verdict, **asked: int) -> str:
    """What is printed, whole."""
    console = Console(file=io.StringIO(), record=True, width=300, color_system=None)
    with speaking(FALSE):
        print_verdict(verdict, console=console, **asked)
    return console.export_text()


def test_enough_verdicts_are_looked_at(verdicts: dict[str, tuple[Verdict, Evidence]]) -> None:
    """Else the tests below would hold nothing."""
    faults = {check.fault for verdict, _ in verdicts.values() for check in verdict.failed()}
    assert len(verdicts) >= FEWEST
    assert len(faults) >= FEWEST


def test_the_terminal_says_nothing_in_plain_english(
    verdicts: dict[str, tuple[Verdict, Evidence]],
) -> None:
    """Titles, sentences, what comes next; and the first hint."""
    found = [
        line
        for name, (verdict, _) in verdicts.items()
        for said in (terminal(verdict), terminal(verdict, hint_step=1))
        for line in plain(
            [(each, f"{name}, terminal") for each in said.splitlines()], known(verdict)
        )
    ]
    assert not found, "\n".join(found)


def test_the_page_says_nothing_in_plain_english(
    verdicts: dict[str, tuple[Verdict, Evidence]],
) -> None:
    """Headings, plots, tables, and what is read aloud."""
    found = [
        f"{name}: {line}"
        for name, (verdict, evidence) in verdicts.items()
        for line in plain(read_in(page_of(verdict, evidence)), known(verdict))
    ]
    assert not found, "\n".join(found)


def page_of(verdict: Verdict, evidence: Evidence) -> str:
    """The page of one's own package."""
    with speaking(FALSE):
        return html_of(verdict, evidence, required_rates(LAB), Own(CommandLine(LAB.name)))


def test_plain_english_is_found(verdicts: dict[str, tuple[Verdict, Evidence]]) -> None:
    """Else the silence of the tests above would mean nothing: one heading without an id."""
    verdict, evidence = next(iter(verdicts.values()))
    page = page_of(verdict, evidence).replace("<h2>", "<h2>What to mend ", 1)
    (first, *_) = plain(read_in(page), known(verdict))
    assert first.startswith("'What' in 'What to mend")
    assert "h2" in first


def test_the_language_of_the_page_is_told(verdicts: dict[str, tuple[Verdict, Evidence]]) -> None:
    """So that it is read aloud as it is written."""
    assert '<html lang="en-XA">' in page_of(*next(iter(verdicts.values())))


@pytest.mark.slow
@pytest.mark.parametrize("width", [390, 1280])
def test_no_page_is_wider_than_the_screen(
    browser: object, verdicts: dict[str, tuple[Verdict, Evidence]], tmp_path: Path, width: int
) -> None:
    """With every word a third longer, and all that is folded open."""
    page = browser.new_page(viewport={"width": width, "height": 900})  # type: ignore[attr-defined]
    wide = []
    for name, each in verdicts.items():
        (file := tmp_path / f"{name}.html").write_text(page_of(*each), "utf-8")
        page.goto(file.as_uri())
        page.evaluate("document.querySelectorAll('details').forEach(part => part.open = true)")
        if page.evaluate("document.documentElement.scrollWidth") > width:
            wide.append(name)
    page.close()
    assert wide == []
