"""Each student's own card is right: the solution in its words passes, everybody's does not.

So many courses are made as the word with the most values has values: each value stands in one.
"""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from pydantic import RootModel

from roslings.course import Edit, Lab
from roslings.course.contract import Plain, as_typed
from roslings.course.files import read_yaml
from roslings.course.grader import Clock
from roslings.course.variants import LabVariant, NoVariants, Variants, apply_edit, variants_of
from roslings.experiment.run_folder import run_folder
from roslings_class.result import GradingResult
from roslings_class.scheduler import Watcher
from roslings_prove.prove import Proof, failing, graded, proof_of

FILE = "variants_solution.yaml"


class SolutionEdits(RootModel[dict[str, tuple[Edit, ...]]]):
    """The file `variants_solution.yaml`: word to where the solution says it; `{value}` in it."""


@dataclass(frozen=True)
class InOwnWords:
    """The solution, with the words of one student's card in it."""

    lab: Lab
    words: Mapping[str, Plain]
    course: Path
    edits: SolutionEdits
    clock: Clock = "auto"

    @property
    def name(self) -> str:
        """By the words."""
        said = ", ".join(f"{name} {as_typed(value)}" for name, value in self.words.items())
        return f"{self.lab.name}: by the card with {said}"

    @property
    def about(self) -> str:
        """It is as right as everybody's."""
        return f"{self.name}, the solution in these words gets 100 of 100"

    def make(self, folder: Path) -> Path:
        """A copy with these words. Raises BadCourseFile."""
        package = folder / self.course.name / self.lab.card.package
        shutil.copytree(self.lab.solution, package)
        for name, value in self.words.items():
            for edit in self.edits.root.get(name, ()):
                apply_edit(edit, value, package, self.lab.folder / FILE)
        return package

    def problem(self, result: GradingResult) -> str:
        """Where it loses points."""
        return "" if result.score in (None, 100) else f"{result.score:g} of 100; {failing(result)}"


@dataclass(frozen=True)
class InEverybodysWords(InOwnWords):
    """The solution as it is: it is right by another card."""

    @property
    def name(self) -> str:
        """Of no other package."""
        return f"{super().name}: everybody's"

    @property
    def about(self) -> str:
        """Who hands in another student's package does not pass."""
        return f"{super().name}, the solution in everybody's words does not pass"

    def make(self, folder: Path) -> Path:
        """It is there."""
        return self.lab.solution

    def problem(self, result: GradingResult) -> str:
        """That it passes."""
        return "it passes: the words of this card are not judged" if result.word == "pass" else ""


def prove_variants(
    labs: Sequence[Lab], watcher: Watcher, jobs: int | None = None
) -> Iterator[Proof]:
    """Two proofs for each course. Raises NoVariants, BadCourseFile."""
    with run_folder() as scratch:
        packages = [each for lab in labs for each in _packages(lab, scratch / "courses" / lab.name)]
        results = graded(packages, scratch, watcher, jobs, book="variants")
    yield from (proof_of(each, results[each.name]) for each in packages)


def _packages(lab: Lab, folder: Path) -> Iterator[InOwnWords]:
    if (variants := variants_of(lab)) is None:
        raise NoVariants(lab)
    edits = read_yaml(lab.folder / FILE, SolutionEdits)
    for number, words in enumerate(all_values(variants)):
        course = LabVariant(lab, variants, words).make(folder / f"{number}")
        yield InOwnWords(lab, words, course, edits)
        yield InEverybodysWords(lab, words, course, edits)


def all_values(variants: Variants) -> list[dict[str, Plain]]:
    """As few choices as there can be in which each value of each word stands."""
    most = max(len(word.values) for word in variants.words.values())
    return [
        {name: word.values[n % len(word.values)] for name, word in variants.words.items()}
        for n in range(most)
    ]
