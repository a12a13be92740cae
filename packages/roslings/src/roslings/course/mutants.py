"""A mutant: the solution with one thing wrong, and the checks that must catch it."""

from __future__ import annotations

import shutil
from pathlib import Path

from pydantic import Field

from roslings.course.contract import Contract
from roslings.course.files import CourseError


class Edit(Contract):
    """One place in one file of the solution, and what stands there instead."""

    file: str
    find: str
    replace: str


class Mutant(Contract):
    """A wrong package, as a small patch on the solution."""

    name: str = Field(default="", description="The file's name; not written in it")
    what: str = Field(description="The mistake, as the student would tell it")
    fails: tuple[str, ...] = Field(min_length=1, description="The checks that must fail, no others")
    skips: tuple[str, ...] = Field(
        default=(), description="Checks that have nothing to judge then, beside the dependants"
    )
    faults: dict[str, str] = Field(default_factory=dict, description="Check to kind of fault")
    proves: tuple[str, ...] = Field(
        default=(), description="Places of words of the card that it shows to be judged"
    )
    edits: tuple[Edit, ...] = ()
    remove: tuple[str, ...] = ()
    write: dict[str, bytes] = Field(
        default_factory=dict, description="Files with other content; YAML's !!binary for a picture"
    )

    def make(self, solution: Path, package: Path) -> Path:
        """Copy `solution` to `package` and injure it; returns `package`.

        Raises CourseError where an edit does not fit the solution exactly once.
        """
        shutil.copytree(solution, package)
        for edit in self.edits:
            self._apply(edit, package / edit.file)
        for name in self.remove:
            (package / name).unlink()
        for name, content in self.write.items():
            (package / name).write_bytes(content)
        return package

    def _apply(self, edit: Edit, path: Path) -> None:
        text = path.read_text("utf-8")
        if text.count(edit.find) != 1:
            raise CourseError(
                f"mutant {self.name}: {edit.find!r} stands {text.count(edit.find)} times"
                f" in {edit.file}; it must stand once"
            )
        path.write_text(text.replace(edit.find, edit.replace), "utf-8")
