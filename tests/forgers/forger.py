"""A forger: a package whose talker speaks at 1 Hz, half as fast as the card asks, and an attack.

It earns 86 points of 100. A file in packages/ holds an attack, in Python: `build` runs in setup.py,
`run` in the talker before it makes its node. A folder in strangers/ holds the files that differ.
"""

from __future__ import annotations

import shutil
import textwrap
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import yaml
from pydantic import Field
from rogue import HOOKS, LAB, kit_that_knows

from roslings.course import Edit
from roslings.course.card import Contract

HERE = Path(__file__).parent
PACKAGES, STRANGERS = HERE / "packages", HERE / "strangers"
HONEST_SCORE = 86.7
"""91 of 105 points: the sheet of hidden checks that is graded with has 5 more, and they pass."""
TOO_SLOW = Edit(
    file="chatter/talker.py", find="self.create_timer(0.5", replace="self.create_timer(1.0"
)


class Attack(Contract):
    """A file in packages/."""

    what: str = Field(description="What it tries")
    build: str = ""
    run: str = ""
    write: dict[str, str] = Field(default_factory=dict, description="More files of the package")


@dataclass(frozen=True)
class Forger:
    """One submission that would have a better grade than it earned."""

    name: str
    file: Path

    def make(self, package: Path, known: dict[str, str]) -> None:
        """Make the package; `known` is what the attacker knows of the machine."""
        slow_talker(package)
        if self.file.is_dir():
            shutil.copytree(self.file, package, dirs_exist_ok=True)
            _link(package)
            return
        attack = Attack.model_validate(yaml.safe_load(self.file.read_text("utf-8")))
        for place, code in (("build", attack.build), ("run", attack.run)):
            if code:
                _arm(package, place, code, {**known, "place": place, "name": self.name})
        for name, content in attack.write.items():
            (package / name).parent.mkdir(parents=True, exist_ok=True)
            (package / name).write_text(content, "utf-8")


def _link(package: Path) -> None:
    """Make the links that the file LINKS names: among our files, every tool would follow them."""
    listed = package / "LINKS"
    if listed.exists():
        for line in listed.read_text("utf-8").splitlines():
            name, target = line.split(" ", 1)
            (package / name).parent.mkdir(parents=True, exist_ok=True)
            (package / name).symlink_to(target)
        listed.unlink()


def slow_talker(package: Path) -> None:
    """The honest one, which has its 86."""
    shutil.copytree(LAB.solution, package)
    _apply(TOO_SLOW, package)


def _arm(package: Path, place: str, code: str, known: dict[str, str]) -> None:
    """Put an attack and its kit into the package; what it raises is its own trouble."""
    (package / f"chatter/kit_{place}.py").write_text(kit_that_knows(known), "utf-8")
    body = textwrap.indent(code, "        ")
    text = (
        f"from chatter import kit_{place} as kit\n\n\ndef attack():\n    kit.mark()\n"
        f"    try:\n{body}\n    except Exception as error:\n        print('held off:', error)\n"
    )
    (package / f"chatter/attack_{place}.py").write_text(text, "utf-8")
    hook = HOOKS["build" if place == "build" else "run"]
    replace = hook.replace.replace("chatter.attack", f"chatter.attack_{place}")
    _apply(hook.model_copy(update={"replace": replace}), package)


def _apply(edit: Edit, package: Path) -> None:
    file = package / edit.file
    text = file.read_text("utf-8")
    assert text.count(edit.find) == 1, f"{edit.find!r} must stand once in {edit.file}"
    file.write_text(text.replace(edit.find, edit.replace), "utf-8")


def forgers() -> Iterator[Forger]:
    """All of them, by name."""
    for file in sorted(PACKAGES.glob("*.yaml")):
        yield Forger(file.stem, file)
    for folder in sorted(STRANGERS.iterdir()):
        if folder.is_dir():
            yield Forger(f"stranger_{folder.name}", folder)
