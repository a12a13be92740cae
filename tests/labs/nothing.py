"""Packages in which something, or everything, is not there: no point for what does not exist."""

from __future__ import annotations

import re
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from roslings.course import Lab
from roslings.course.grader import Clock
from roslings.workspace.inspect import inspect_package
from roslings_class.result import GradingResult

Kind = Literal["empty", "starter", "idle"]
SCRIPTS = re.compile(r"'console_scripts': \[.*?\]", re.DOTALL)
IDLE = """import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node


def main():
    try:
        rclpy.init()
        rclpy.spin(Node({name!r}))
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
"""

NO_NODE = """def main():
    pass
"""


@dataclass(frozen=True)
class Nothing:
    """A package that passes certain checks, and no other."""

    lab: Lab
    kind: Kind
    passes: frozenset[str]
    clock: Clock = "auto"
    course: None = None

    @property
    def name(self) -> str:
        """It is the only one of its kind."""
        return f"{self.lab.name}: {self.kind}"

    @property
    def about(self) -> str:
        """What it gets points for."""
        return f"{self.name} passes {', '.join(sorted(self.passes))}"

    def make(self, folder: Path) -> Path:
        """The solution without its programs, or with others in their place; or the starter."""
        if self.kind == "starter":
            return self.lab.starter
        package = folder / self.name / self.lab.card.package
        shutil.copytree(self.lab.solution, package)
        make_empty(package) if self.kind == "empty" else make_idle(package, self.lab)
        return package.parent

    def problem(self, result: GradingResult) -> str:
        """The checks that pass and should not, or that should and do not."""
        checks = result.verdict.checks if result.verdict else ()
        passed = {check.id for check in checks if check.outcome == "pass"}
        more, less = sorted(passed - self.passes), sorted(self.passes - passed)
        return f"passes {more}, does not pass {less}" if more or less else ""


def make_empty(package: Path) -> None:
    """A package that can be built, and holds no program."""
    setup = package / "setup.py"
    setup.write_text(SCRIPTS.sub("'console_scripts': []", setup.read_text("utf-8")), "utf-8")
    for module in (package / package.name).glob("*.py"):
        if module.name != "__init__.py":
            module.unlink()


def make_idle(package: Path, lab: Lab) -> None:
    """Each program makes a node of the right name, and nothing else; or not even that."""
    names = {node.executable: node.node.rpartition("/")[2] for node in lab.card.nodes}
    for script, place in inspect_package(package, lab.card).entry_points.items():
        module = place.partition(":")[0].replace(".", "/")
        code = IDLE.format(name=names[script]) if script in names else NO_NODE
        (package / f"{module}.py").write_text(code, "utf-8")
