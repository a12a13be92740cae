"""`explain` as it is typed, and its questions again by hand: is its answer what `check` says?"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from until_told import run_until_told

QUESTION = re.compile(r"^\d of 3   (\S+), line (\d+)\n\n((?:    [-+] .*\n)+)\n.*? is (\w+):", re.M)
MOST = 3


@dataclass(frozen=True)
class Printed:
    """A question with its answer."""

    file: str
    line: int
    changed: str
    """Lines with - and +, as a person sees them."""
    failed: str
    """The check that fails first, as `explain` has it."""

    def make_by_hand(self, package: Path) -> None:
        """As a person does who sees file, line, and lines with - and +."""
        shown = [(each[4], each[6:]) for each in self.changed.splitlines()]
        old, new = ([text for sign, text in shown if sign == kind] for kind in "-+")
        file = package / self.file
        lines = file.read_text("utf-8").splitlines()
        there = lines[self.line - 1 : self.line - 1 + len(old)]
        assert [each.strip() for each in there] == [each.strip() for each in old]
        indent = " " * (_indent(there[0]) - _indent(old[0]))
        lines[self.line - 1 : self.line - 1 + len(old)] = [indent + each for each in new]
        file.write_text("\n".join([*lines, ""]), "utf-8")


def _indent(line: str) -> int:
    return len(line) - len(line.lstrip())


def typed(*words: str, ws: Path) -> subprocess.CompletedProcess[str]:
    """A command of the course, in a workspace of its own."""
    return run_until_told(
        [sys.executable, "-m", "roslings", *words],
        env={**os.environ, "ROSLINGS_WS": str(ws)},
        stdin=subprocess.DEVNULL,
    )


def asked_about(lab: str, package: Path, folder: Path) -> list[Printed]:
    """What `explain` asks about a package that passes, each about another check.

    `folder` holds the workspace, and is made where it is not there.
    """
    folder.mkdir(parents=True, exist_ok=True)
    said = typed("explain", lab, str(package), "--answers", ws=folder / "ws")
    assert said.returncode == 0, said.stdout + said.stderr
    found = [
        Printed(file, int(line), changed, failed)
        for file, line, changed, failed in QUESTION.findall(said.stdout)
    ]
    assert len({each.failed for each in found}) == len(found) <= MOST, said.stdout
    return found


def first_that_fails(lab: str, package: Path, question: Printed, folder: Path) -> str:
    """As `check` says of a copy with this change; nothing where all passes."""
    copy = Path(shutil.copytree(package, Path(tempfile.mkdtemp(dir=folder)) / package.name))
    question.make_by_hand(copy)
    told = typed("check", lab, str(copy), "--json", "-", ws=folder / "ws")
    checks = json.loads(told.stdout)["checks"]
    failed = (str(each["id"]) for each in checks if each["outcome"] == "fail")
    return next(failed, "") if told.returncode == 1 else ""
