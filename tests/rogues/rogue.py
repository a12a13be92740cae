"""A rogue: the solution of a lab with an attack in it, and the verdict that is true of it."""

from __future__ import annotations

import json
import shutil
import textwrap
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import yaml
from pydantic import Field, model_validator

from roslings.course import Edit, lab
from roslings.course.contract import Contract

LAB = lab("topics")
HERE = Path(__file__).parent
PACKAGES = HERE / "packages"
KIT = HERE / "kit.py"
UNKNOWN = '"@known@"'
"""Stands in the kit for what the attacker knows."""

Place = Literal["run", "node", "import", "build", "none"]
"""Where the attack begins: before the talker makes its node, when it has made it, when Python reads
the package, in setup.py; or nowhere, where the edits are the attack."""

HOOKS: dict[Place, Edit] = {
    "run": Edit(
        file="chatter/talker.py",
        find='"""Run the node until Ctrl-C."""',
        replace='"""Run the node."""\n    from chatter.attack import attack\n    attack()',
    ),
    "node": Edit(
        file="chatter/talker.py",
        find="self.count = 0",
        replace="self.count = 0\n        from chatter.attack import attack\n        attack(self)",
    ),
    "build": Edit(
        file="setup.py",
        find="from setuptools",
        replace="import sys\nsys.path.insert(0, '.')\n"
        "from chatter.attack import attack\nattack()\nfrom setuptools",
    ),
}


class Truth(Contract):
    """What is to be said of it: a full score, failed checks, or a refusal."""

    score: Literal[100] | None = None
    fails: tuple[str, ...] = Field(default=(), description="Checks that must fail")
    may_fail: tuple[str, ...] = Field(
        default=(), description="Checks that may fail: the attack can hurt its own package there"
    )
    unclear: tuple[str, ...] = Field(
        default=(), description="Checks that may be inconclusive: what they look at has no room"
    )
    refused: str | None = Field(default=None, description="A part of the reason")
    may_be_unclear: bool = Field(
        default=False, description="It takes the processors: that may hide what its node did"
    )

    @model_validator(mode="after")
    def _says_something(self) -> Truth:
        if not (self.score or self.fails or self.may_fail or self.refused):
            raise ValueError("say one of score, fails, may_fail, refused")
        return self


class Rogue(Contract):
    """A file in packages/: one attack, at one place or at several."""

    name: str = Field(default="", description="The file's name; not written in it")
    what: str = Field(description="What it tries")
    alone: bool = Field(
        default=False, description="It takes the whole machine: nothing else is tested then"
    )
    as_root: bool = Field(
        default=False, description="What holds it off is another where the grader's user is root"
    )
    attack: str = Field(default="", description="Python; `kit` is there, `node` at the place node")
    edits: tuple[Edit, ...] = ()
    remove: tuple[str, ...] = ()
    write: dict[str, str] = Field(default_factory=dict, description="More files of the package")
    at: dict[Place, Truth] = Field(min_length=1)


@dataclass(frozen=True)
class Attempt:
    """One rogue at one place."""

    rogue: Rogue
    place: Place

    @property
    def name(self) -> str:
        """Of the submission, too."""
        return self.rogue.name if self.place == "none" else f"{self.rogue.name}-{self.place}"

    @property
    def truth(self) -> Truth:
        """What is to be said of it."""
        return self.rogue.at[self.place]

    def make(self, package: Path, known: dict[str, str]) -> Path:
        """Make the package; `known` is what the attacker knows of the machine."""
        shutil.copytree(LAB.solution, package)
        rogue = self.rogue
        hooks = (HOOKS[self.place],) if self.place in HOOKS else ()
        for edit in (*rogue.edits, *hooks):
            apply(edit, package / edit.file)
        for name in rogue.remove:
            (package / name).unlink()
        for name, content in rogue.write.items():
            (package / name).parent.mkdir(parents=True, exist_ok=True)
            (package / name).write_text(content, "utf-8")
        if rogue.attack:
            self._arm(package, known)
        return package

    def _arm(self, package: Path, known: dict[str, str]) -> None:
        """Put the attack and its kit into the package."""
        kit = kit_that_knows({**known, "place": self.place, "name": self.name})
        (package / "chatter/kit.py").write_text(kit, "utf-8")
        body = textwrap.indent(self.rogue.attack, "    ")
        code = f"from chatter import kit\n\n\ndef attack(node=None):\n    kit.mark()\n{body}\n"
        (package / "chatter/attack.py").write_text(code, "utf-8")
        if self.place == "import":
            begin = "from chatter.attack import attack\nattack()\n"
            (package / "chatter/__init__.py").write_text(begin, "utf-8")


def kit_that_knows(known: Mapping[str, str]) -> str:
    """The kit's text; an attack whose kit knows nothing would end before it begins."""
    text = KIT.read_text("utf-8")
    assert text.count(UNKNOWN) == 1, f"{UNKNOWN} must stand once in {KIT.name}"
    return text.replace(UNKNOWN, repr(json.dumps(known)))


def apply(edit: Edit, path: Path) -> None:
    """Make an edit, which fits exactly once."""
    text = path.read_text("utf-8")
    assert text.count(edit.find) == 1, f"{edit.find!r} must stand once in {edit.file}"
    path.write_text(text.replace(edit.find, edit.replace), "utf-8")


def rogues() -> Iterator[Rogue]:
    """The gallery's packages, by name."""
    for file in sorted(PACKAGES.glob("*.yaml")):
        content = yaml.safe_load(file.read_text("utf-8"))
        yield Rogue.model_validate({**content, "name": file.stem})


def attempts() -> list[Attempt]:
    """Each rogue at each of its places."""
    return [Attempt(rogue, place) for rogue in rogues() for place in rogue.at]
