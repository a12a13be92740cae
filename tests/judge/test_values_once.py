"""What counts as the same is said once; labs and drills ask there."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

from sources import ROOT

ROOMS = ("packages/roslings/src", "packages/roslings-learn/src", "graders")


def _asks_for_nearly(node: ast.AST) -> bool:
    return isinstance(node, ast.Call) and ast.unparse(node.func).endswith("isclose")


def _files() -> Iterator[Path]:
    for room in ROOMS:
        yield from sorted((ROOT / room).rglob("*.py"))


def test_nobody_else_says_how_near_is_the_same() -> None:
    """One tolerance, in one place; a card can say another one."""
    files = [
        file.relative_to(ROOT).as_posix()
        for file in _files()
        if any(map(_asks_for_nearly, ast.walk(ast.parse(file.read_bytes()))))
    ]
    assert files == ["packages/roslings/src/roslings/judge/values.py"]
