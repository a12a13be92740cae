"""Two digests of what measures: what all labs share, and what a lab has besides.

A proof is as good as new while neither has changed, nor its package, nor its card. What only judges
is in none of them: every kept proof is judged anew each time.
"""

from __future__ import annotations

import ast
import json
import re
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from roslings.course import Lab, all_labs
from roslings.course.files import read_tree
from roslings.course.labs import engine_root
from roslings.folders.lab_folders import GRADERS
from roslings.workspace.normal import digest_of, digest_of_all, digest_of_file
from roslings_launcher import built_interfaces
from roslings_launcher.sources import source_folders
from roslings_prove.proofs.closure import (
    Code,
    Import,
    Modules,
    ModuleTree,
    Told,
    names_of,
    not_told,
    walk_at_run_time,
)

START = ("roslings.experiment.measuring", "roslings.experiment.start", "roslings.workspace.inspect")
"""Where measuring begins; a lab's grader leads on from its experiments."""
MEASURING_GROUPS = frozenset({"ros", "colcon", "check", "ros2", "vision"})
"""Groups of packages that take part when a package is built, run and watched."""
BUILT_TYPES = f"{built_interfaces.FOLDER}/*"
"""The course's message types as they are loaded."""
BROUGHT = ("interfaces", "firmware")
"""Folders of a lab that its nodes are built with or talk to."""
JUDGED_ONLY = ("points", "numbers_within", "about", "not_judged")
"""Words of a card that no experiment looks at: what only judges, and prose for people."""
CAPABILITY = re.compile(rf"(roslings\.capabilities\.[a-z]+|{GRADERS}\.\w+)\..+")
READ_WITH = ("contract", "record")
"""Modules by which a card and evidence of a capability are read."""
STARTED = {
    "roslings.capabilities.launch.act": (
        "ros2_on_pip.start",
        "ros2_on_pip.cli",
        "ros2_on_pip.commands.launch",
    ),
    "roslings.capabilities.rooms.drivers": (
        "ros2_on_pip.start",
        "ros2_on_pip.cli",
        "ros2_on_pip.commands.launch",
    ),
    "roslings.lockstep.beside": ("roslings.lockstep.program",),
    "graders.black_box.act": ("ros2_on_pip.stand_ins.rosbag2_py",),
    "graders.frames.act": ("ros2_on_pip.stand_ins.tf2_ros",),
}
"""Module that starts a program to what the program is; no import leads there. A test holds this
against the files that a grading opens."""


@dataclass(frozen=True)
class MeasuringCode:
    """What measures the labs of a course."""

    modules: Modules
    labs: tuple[Lab, ...]
    course: Path
    _closures: dict[Lab, frozenset[str]] = field(default_factory=dict)
    _digests: dict[Lab, str] = field(default_factory=dict)

    @cached_property
    def core(self) -> str:
        """What all labs share: modules, files beside them, pinned packages, message types."""
        brought = {"pins": self._pins(), "message types": self._types()}
        return digest_of_all(self._of_modules(self.shared) | brought)

    def experiments(self, lab: Lab) -> str:
        """What a lab has besides: its experiments, and what only some labs are measured with."""
        if lab not in self._digests:
            own = self._of_modules(self.closure(lab) - self.shared, self._is_told)
            self._digests[lab] = digest_of_all(own | self._brought(lab) | self._experiments(lab))
        return self._digests[lab]

    @cached_property
    def shared(self) -> frozenset[str]:
        """The modules that every lab is measured with."""
        return frozenset.intersection(*(self.closure(lab) for lab in self.labs))

    def closure(self, lab: Lab) -> frozenset[str]:
        """The modules that a lab is measured with."""
        if lab not in self._closures:
            self._closures[lab] = self._closure(lab)
        return self._closures[lab]

    def _closure(self, lab: Lab) -> frozenset[str]:
        own = self._grader(lab).modules
        found = self.modules.reached({*START, *own})
        return self.modules.reached({*found, *self._led_to(found)})

    def _led_to(self, found: Iterable[str]) -> Iterator[str]:
        """What no import of these modules names: how their cards are read, what they start."""
        for module in found:
            yield from STARTED.get(module, ())
            if inside := CAPABILITY.fullmatch(module):
                names = (f"{inside[1]}.{part}" for part in READ_WITH)
                yield from (name for name in names if self.modules.tree.file_of(name))

    def _grader(self, lab: Lab) -> Code:
        """The experiments; what they need of the folder beside the grader is reached from them."""
        return experiments_in(lab.grader, self.modules.tree)

    def _experiments(self, lab: Lab) -> dict[str, str]:
        return {"grader 0": self.modules.digest_of_code(self._grader(lab), self._is_told)}

    def _is_told(self, taken: Import) -> bool:
        """What all labs share is counted by the core; a name of it is enough where it has one."""
        name = taken.name or (taken.module or "").rpartition(".")[2]
        return taken.module in self.shared and self._names_of_shared[name] < 2

    @cached_property
    def _names_of_shared(self) -> Counter[str]:
        """How many of the shared modules are called so, or define such a name."""
        codes = map(self.modules.code, self.shared)
        defined = (frozenset[str]().union(*map(names_of, code.defining(""))) for code in codes)
        return Counter(
            [
                *(name for names in defined for name in names),
                *(module.rpartition(".")[2] for module in self.shared),
            ]
        )

    def _of_modules(self, names: Iterable[str], told: Told = not_told) -> dict[str, str]:
        """What the modules do, all together, and the files beside them."""
        found: dict[str, str] = {}
        for code in map(self.modules.code, names):
            found.update(dict.fromkeys(self.modules.does(code, told), ""))
            for file in code.files:
                found[f"file {file.name} {digest_of_file(file)}"] = ""
        return found

    def _brought(self, lab: Lab) -> dict[str, str]:
        folders = (lab.folder / part for part in BROUGHT)
        files = (file for folder in folders for file in folder.rglob("*") if file.is_file())
        return {file.relative_to(lab.folder).as_posix(): digest_of_file(file) for file in files}

    def _pins(self) -> str:
        """The packages of other programs that measuring is made with, as they are pinned."""
        lines = (self.course / "constraints.txt").read_text("utf-8").splitlines()
        return digest_of("\n".join(_measuring_pins(lines)).encode())

    def _types(self) -> str:
        """The message types that come built with the course."""
        return digest_of_all(
            {file.name: digest_of_file(file) for file in self.course.glob(BUILT_TYPES)}
        )


def _measuring_pins(lines: Iterable[str]) -> Iterator[str]:
    for line in lines:
        pin, _, groups = line.partition("#")
        if pin.strip() and MEASURING_GROUPS & set(groups.split()):
            yield pin.strip()


def measuring() -> MeasuringCode:
    """Of this course, as its files are now."""
    root = engine_root()
    tree = ModuleTree(tuple(source_folders(root)), root / GRADERS)
    return MeasuringCode(Modules(tree), tuple(all_labs()), root)


def card_digest(lab: Lab) -> str:
    """Of what the card says, comments and what only judges aside."""
    said = read_tree(lab.folder / "card.yaml")
    return digest_of(json.dumps(_measured_by(said), sort_keys=True, default=str).encode())


def _measured_by(said: Any) -> Any:
    """Without the words that no experiment looks at, wherever they stand."""
    if isinstance(said, dict):
        return {n: _measured_by(part) for n, part in said.items() if n not in JUDGED_ONLY}
    return [_measured_by(part) for part in said] if isinstance(said, list) else said


# --- the experiments of a grader ---------------------------------------------------------------


def experiments_in(grader: Path, tree: ModuleTree) -> Code:
    """The experiments that stand in a grader's file, and what of the file they use."""
    body = ast.parse(grader.read_bytes()).body
    defined = {name: statement for statement in body for name in names_of(statement)}
    wanted = [statement for statement in body if _is_experiment(statement)]
    found: list[ast.stmt] = []
    while wanted:
        statement = wanted.pop()
        if statement not in found:
            found.append(statement)
            wanted += [defined[name] for name in _used(statement) if name in defined]
    taken = {name for statement in found for name in _used(statement)}
    kept = [
        _only(statement, taken) if isinstance(statement, ast.ImportFrom) else statement
        for statement in body
        if statement in found
    ]
    return Code(grader, ast.Module(kept, []), tree)


def _is_experiment(statement: ast.stmt) -> bool:
    if not isinstance(statement, ast.FunctionDef):
        return False
    return any(
        isinstance(node, ast.Name) and node.id == "experiment"
        for each in statement.decorator_list
        for node in ast.walk(each)
    )


def _used(statement: ast.stmt) -> set[str]:
    nodes = walk_at_run_time(statement)
    return {node.id for node in nodes if isinstance(node, ast.Name)}


def _only(statement: ast.ImportFrom, taken: set[str]) -> ast.ImportFrom:
    """The same import, of the names that are used."""
    names = [each for each in statement.names if (each.asname or each.name) in taken]
    return ast.ImportFrom(statement.module, names, statement.level)
