"""All code of a lesson and of its lab's hints, as one module: what a student could paste.

Sessions, prints and asserts of the cells are left out. What stays are imports, constants, classes
and functions, and a main() that runs every class of nodes at once.
"""

from __future__ import annotations

import ast
import shutil
import textwrap
from collections.abc import Iterator
from pathlib import Path

from roslings.course import Lab
from roslings_learn.lessons.rules import Lesson

KEPT = (
    ast.Import,
    ast.ImportFrom,
    ast.ClassDef,
    ast.FunctionDef,
    ast.AsyncFunctionDef,
    ast.Assign,
    ast.AnnAssign,
)
MAIN = """

def main():
    import rclpy
    from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
    from rclpy.node import Node
    rclpy.init()
    executor = SingleThreadedExecutor()
    kinds = [kind for kind in list(globals().values())
             if isinstance(kind, type) and issubclass(kind, Node) and kind is not Node]
    for kind in kinds:
        try:
            executor.add_node(kind())
        except Exception as error:
            print(kind.__name__, error)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
"""


def module_of(lesson: Lesson, lab: Lab) -> str:
    """One module; a piece of code that is no Python is left out."""
    pieces = [*_of_cells(lesson), *_of_hints(lab)]
    kept = [ast.unparse(node) for piece in pieces for node in _definitions(piece)]
    return "\n".join(kept) + MAIN


def _of_cells(lesson: Lesson) -> Iterator[str]:
    for cell in lesson.cells:
        if cell.is_code:
            yield cell.answered() if cell.answer else cell.text
        yield from (block.text for block in cell.blocks if block.kind == "code")


def _of_hints(lab: Lab) -> Iterator[str]:
    for hint in lab.hints.values():
        for step in hint.steps:
            code = [line for line in step.splitlines() if line.startswith("    ")]
            yield textwrap.dedent("\n".join(code))


def _definitions(code: str) -> Iterator[ast.stmt]:
    try:
        tree = ast.parse(code)
    except SyntaxError:
        return
    for node in tree.body:
        if isinstance(node, ast.Assign | ast.AnnAssign) and _runs(node):
            continue
        if isinstance(node, ast.Import | ast.ImportFrom) and "roslings" in ast.unparse(node):
            continue
        if isinstance(node, KEPT):
            yield node


def _runs(node: ast.stmt) -> bool:
    """An assignment that calls something belongs to the cell, not to a module."""
    return any(isinstance(each, ast.Call) for each in ast.walk(node))


def package_of(lesson: Lesson, lab: Lab, folder: Path) -> Path:
    """The lab's starter with that module in the place of each of its own."""
    package = folder / lab.card.package
    shutil.copytree(lab.starter, package)
    code = module_of(lesson, lab)
    for module in (package / lab.card.package).glob("*.py"):
        if module.name != "__init__.py":
            module.write_text(code, "utf-8")
    return package
