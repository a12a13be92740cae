"""Another card of the same lab for each student: names, rates, limits and texts of their own.

`labs/LAB/variants.yaml` says which words of the card may be others. Whose card it is decides which
they are: the same name has the same words on each computer. The task, its tables and the starter
say the same words, so a student's course is this one with that lab written anew.
"""

from __future__ import annotations

import hashlib
import re
import shutil
import unicodedata
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import Field, field_validator

from roslings.course.contract import Contract, Plain, as_typed
from roslings.course.files import (
    BadCourseFile,
    CourseError,
    Location,
    line_in,
    read_tree,
    read_yaml,
)
from roslings.course.labs import Lab
from roslings.course.mutants import Edit

FILE = "variants.yaml"
VALUE = "{value}"
OF_ALL = ("id", "title", "day", "needs", "package", "points", "groups")
"""What no student has alone: a lab is found, built and paid by it."""
NOT_FOR_STUDENTS = (
    "solution",
    "mutants",
    "promises.yaml",
    "generated.yaml",
    "variants_solution.yaml",
)
"""Of a lab's folder: they hold answers."""
_LEFT_OUT = (*NOT_FOR_STUDENTS, FILE, "__pycache__", ".*")
"""Of a student's own course: there is no second choice on top of the first."""
_NO_LETTER = re.compile(r"[\W_]+")


class NoVariants(CourseError):
    """Everybody has the same card of this lab."""

    def __init__(self, lab: Lab) -> None:
        super().__init__(
            f"The lab {lab.name!r} has one card for everybody: there is no labs/{lab.name}/{FILE}."
        )


# --- what may be chosen -----------------------------------------------------------------------


class VariantWord(Contract):
    """One word that each student has another one of."""

    at: dict[str, str] = Field(
        min_length=1, description="Places in the card, each with what stands there; `{value}` in it"
    )
    values: tuple[Plain, ...] = Field(min_length=2, description="One of these")
    starter: tuple[Edit, ...] = Field(
        default=(), description="Where the starter says the word; `{value}` in `replace`"
    )

    @field_validator("at")
    @classmethod
    def _say_it(cls, at: dict[str, str]) -> dict[str, str]:
        for place, says in at.items():
            if VALUE not in says:
                raise ValueError(f"{place}: write {VALUE} where the word stands")
            if place.partition(".")[0] in OF_ALL:
                raise ValueError(f"{place}: everybody has the same")
        return at

    @property
    def alone(self) -> tuple[str, ...]:
        """The places where nothing else stands."""
        return tuple(place for place, says in self.at.items() if says == VALUE)


class Variants(Contract):
    """The file `variants.yaml`."""

    term: str = Field(default="", description="Another word here gives everybody another choice")
    words: dict[str, VariantWord] = Field(min_length=1)

    def chosen(self, lab: str, whose: str) -> dict[str, Plain]:
        """The words of a student's card: each by itself, and as often as the others."""
        return {
            name: word.values[_number(self.term, lab, name, key_of(whose)) % len(word.values)]
            for name, word in self.words.items()
        }


def _number(*words: str) -> int:
    """Of these words, the same one everywhere; Python's own `hash` is not."""
    return int.from_bytes(hashlib.sha256("\n".join(words).encode()).digest()[:8], "big")


def key_of(whose: str) -> str:
    """Letters and digits alone, small: `Ada Lovelace` and `ada-lovelace` have one card."""
    return _NO_LETTER.sub("", unicodedata.normalize("NFKC", whose)).casefold()


def variants_of(lab: Lab) -> Variants | None:
    """What a lab lets be chosen; None where everybody has its card. Raises BadCourseFile."""
    file = lab.folder / FILE
    return read_yaml(file, Variants) if file.is_file() else None


# --- a course with these words ----------------------------------------------------------------


@dataclass(frozen=True)
class LabVariant:
    """A lab, and the words that take the place of the card's."""

    lab: Lab
    variants: Variants
    words: Mapping[str, Plain]

    def card(self) -> dict[str, Any]:
        """The card's tree, with these words in it. Raises BadCourseFile."""
        tree: dict[str, Any] = read_tree(self.lab.folder / "card.yaml")
        for name, value in self.words.items():
            for place, says in self.variants.words[name].at.items():
                said = value if says == VALUE else says.replace(VALUE, as_typed(value))
                self._put(tree, name, place, said)
        return tree

    def make(self, folder: Path) -> Path:
        """A course in `folder`, which is new or empty: this lab by these words, all else linked."""
        root, name = self.lab.folder.parents[1], self.lab.name
        _link(root, folder, but={"labs", "graders"})
        _link(root / "labs", folder / "labs", but={name})
        _link(root / "graders", folder / "graders", but={self.lab.grader.name})
        shutil.copy(self.lab.grader, folder / "graders")
        own = folder / "labs" / name
        shutil.copytree(self.lab.folder, own, ignore=shutil.ignore_patterns(*_LEFT_OUT))
        self._write_card(own)
        self._write_texts(Lab(name, own, folder / "graders" / self.lab.grader.name))
        return folder

    def digest(self) -> str:
        """Of all that it is made of."""
        found = hashlib.sha256(repr(sorted(self.words.items())).encode())
        for file in (self.lab.grader, *sorted(self._files())):
            found.update(f"{file.name}\n".encode() + file.read_bytes())
        return found.hexdigest()[:12]

    def _files(self) -> Iterator[Path]:
        for file in self.lab.folder.rglob("*"):
            top = file.relative_to(self.lab.folder).parts[0]
            if file.is_file() and top not in NOT_FOR_STUDENTS and not top.startswith("."):
                yield file

    def _write_card(self, own: Path) -> None:
        import yaml

        text = yaml.safe_dump(self.card(), allow_unicode=True, sort_keys=False)
        (own / "card.yaml").write_text(text, "utf-8")

    def _write_texts(self, made: Lab) -> None:
        from roslings.course.task import task_text

        for file in (made.task, made.folder / "hints.yaml"):
            file.write_text(self._in_words(file.read_text("utf-8")), "utf-8")
        made.task.write_text(task_text(made), "utf-8")
        for name, value in self.words.items():
            for edit in self.variants.words[name].starter:
                apply_edit(edit, value, made.starter, self.lab.folder / FILE)

    def _in_words(self, text: str) -> str:
        """Where a text says a name of the card, it says the student's."""
        for name, value in self.words.items():
            before = self.value_before(name)
            if isinstance(value, str) and isinstance(before, str):
                alone = rf"(?<![\w/]){re.escape(before)}(?![\w/])"
                text = re.sub(alone, lambda _, said=value: said, text)  # type: ignore[misc]
        return text

    def value_before(self, name: str) -> Any:
        """What the card itself says; None where the word stands in sentences only."""
        alone = self.variants.words[name].alone
        if not alone:
            return None
        part, key = self._at(read_tree(self.lab.folder / "card.yaml"), name, alone[0])
        return part[key]

    def _put(self, tree: dict[str, Any], name: str, place: str, said: Plain) -> None:
        part, key = self._at(tree, name, place)
        part[key] = said

    def _at(self, tree: Any, name: str, place: str) -> tuple[Any, Any]:
        """The part of the card, and the key in it. Raises BadCourseFile."""
        *way, last = steps = [int(step) if step.isdecimal() else step for step in place.split(".")]
        try:
            for step in way:
                tree = tree[step]
            _ = tree[last]
        except (KeyError, IndexError, TypeError):
            where: Location = ("words", name, "at", place)
            file = self.lab.folder / FILE
            problem = f"the card has nothing at {'.'.join(map(str, steps))}"
            raise BadCourseFile(file, line_in(file, where), problem) from None
        return tree, last


def _link(source: Path, folder: Path, but: set[str]) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for entry in source.iterdir():
        if entry.name not in but and not entry.name.startswith((".", "__pycache__")):
            (folder / entry.name).symlink_to(entry)


def apply_edit(edit: Edit, value: Plain, package: Path, said_in: Path) -> None:
    """Put a word into a file of a package. Raises BadCourseFile where it does not fit once."""
    file = package / edit.file
    text = file.read_text("utf-8") if file.is_file() else ""
    if (times := text.count(edit.find)) != 1:
        problem = f"{edit.find!r} stands {times} times in {edit.file}; it must stand once"
        raise BadCourseFile(said_in, 1, problem)
    file.write_text(text.replace(edit.find, edit.replace.replace(VALUE, as_typed(value))), "utf-8")


def chosen(lab: Lab, whose: str) -> LabVariant:
    """The card of `lab` that is somebody's. Raises NoVariants and BadCourseFile."""
    found = variants_of(lab)
    if found is None:
        raise NoVariants(lab)
    return LabVariant(lab, found, found.chosen(lab.name, whose))
