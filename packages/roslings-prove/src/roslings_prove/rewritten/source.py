"""A package's sources, which a rewrite takes and gives back changed."""

from __future__ import annotations

import difflib
import re
import shutil
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

import libcst as cst

from roslings.course import Card
from roslings.course.files import CourseError

SETUP, MANIFEST = "setup.py", "package.xml"
EMPTY = ("__init__",)
"""Modules that a rewrite leaves where they are."""


class CannotRewrite(CourseError):
    """A solution that this part of roslings cannot read."""

    def __init__(self, package: Path, why: str) -> None:
        super().__init__(f"{package} cannot be rewritten: {why}.")


Target = tuple[str, str]
"""A module of the package and a function in it, as an entry point names them."""


@dataclass(frozen=True)
class Sources:
    """A package's modules, its setup.py and package.xml, and the card that they are made for."""

    card: Card
    texts: Mapping[str, str]
    """File, by its place in the package, to what stands in it."""

    @staticmethod
    def read(folder: Path, card: Card) -> Sources:
        """The sources of the package in `folder`."""
        code = sorted((folder / card.package).rglob("*.py"))
        found = [file for file in (*code, folder / SETUP, folder / MANIFEST) if file.is_file()]
        texts = {file.relative_to(folder).as_posix(): file.read_text("utf-8") for file in found}
        if missing := {SETUP, MANIFEST} - set(texts):
            raise CannotRewrite(folder, f"it has no {' and no '.join(sorted(missing))}")
        return Sources(card, texts)

    def write(self, original: Path, folder: Path) -> Path:
        """Copy the package `original` to `folder`, with these sources; returns `folder`."""
        shutil.copytree(original, folder, ignore=shutil.ignore_patterns("__pycache__"))
        for name in Sources.read(folder, self.card).texts:
            (folder / name).unlink()
        for name, text in self.texts.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(text, "utf-8")
        return folder

    # --- the modules ---------------------------------------------------------------------------

    @property
    def modules(self) -> dict[str, cst.Module]:
        """Each module's name inside the package (`talker`) to its tree."""
        return {
            name: parsed(text)
            for file, text in self.texts.items()
            if (name := self._module(file)) and name.split(".")[-1] not in EMPTY
        }

    def _module(self, file: str) -> str:
        inside = file.removeprefix(f"{self.card.package}/")
        return "" if inside == file else inside.removesuffix(".py").replace("/", ".")

    def _file(self, module: str) -> str:
        return f"{self.card.package}/{module.replace('.', '/')}.py"

    def with_modules(self, modules: Mapping[str, cst.Module]) -> Sources:
        """The same package with these modules in place of its own."""
        kept = {
            file: text
            for file, text in self.texts.items()
            if self._module(file).split(".")[-1] in ("", *EMPTY)
        }
        changed = {self._file(name): tree.code for name, tree in modules.items()}
        return replace(self, texts={**kept, **changed})

    def mapped(self, change: Callable[[cst.Module], cst.Module]) -> Sources:
        """The same package with each module changed."""
        return self.with_modules({name: change(tree) for name, tree in self.modules.items()})

    def is_own(self, imported: cst.ImportFrom) -> bool:
        """Whether the names come from another module of the package."""
        return bool(imported.relative) or dotted(imported.module).split(".")[0] == self.card.package

    # --- what else names them ------------------------------------------------------------------

    @property
    def entry_points(self) -> list[Target]:
        """What the executables call, as setup.py says."""
        return [(found[1], found[2]) for found in self._targets()]

    def _targets(self) -> Iterator[re.Match[str]]:
        return re.finditer(self._target, self.texts.get(SETUP, ""))

    @property
    def _target(self) -> str:
        return rf"\b{self.card.package}\.([\w.]+):(\w+)"

    def retargeted(self, to: Callable[[Target], Target]) -> Sources:
        """The same package whose executables call something else."""

        def other(found: re.Match[str]) -> str:
            return f"{self.card.package}.{':'.join(to((found[1], found[2])))}"

        setup = re.sub(self._target, other, self.texts[SETUP])
        return replace(self, texts={**self.texts, SETUP: setup})

    def depending_on(self, package: str) -> Sources:
        """The same package; package.xml names what a rewrite imports."""
        manifest = self.texts[MANIFEST]
        if f">{package}<" in manifest:
            return self
        line = f"  <exec_depend>{package}</exec_depend>\n"
        at = manifest.index("</package>")
        return replace(self, texts={**self.texts, MANIFEST: manifest[:at] + line + manifest[at:]})

    def difference(self, other: Sources) -> str:
        """What `other` changed, as `diff -u` shows it."""
        names = sorted({*self.texts, *other.texts})
        return "".join(
            line
            for name in names
            for line in difflib.unified_diff(
                self.texts.get(name, "").splitlines(keepends=True),
                other.texts.get(name, "").splitlines(keepends=True),
                f"solution/{name}",
                f"rewritten/{name}",
                n=2,
            )
        )


@lru_cache(maxsize=256)
def parsed(text: str) -> cst.Module:
    """A module's tree, which nobody changes."""
    return cst.parse_module(text)


def dotted(name: cst.BaseExpression | None) -> str:
    """`a.b.c` as a text; empty where it is no such name."""
    if isinstance(name, cst.Attribute):
        return f"{dotted(name.value)}.{name.attr.value}"
    return name.value if isinstance(name, cst.Name) else ""
