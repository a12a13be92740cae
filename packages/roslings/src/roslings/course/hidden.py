"""A file of checks that students do not have: its points, read without running it."""

from __future__ import annotations

import ast
from pathlib import Path

from roslings.course.card import Card
from roslings.course.files import BadCourseFile

NAME = "POINTS"


def hidden_points(file: Path, card: Card) -> dict[str, float]:
    """Check's name to its points, as the file's `POINTS = {"name": 5}` has them.

    They come on top of the card's 100; the score stays a part of all, from 0 to 100. Raises
    BadCourseFile.
    """
    try:
        tree = ast.parse(file.read_text("utf-8"))
    except OSError as error:
        raise BadCourseFile(file, 1, f"it cannot be read ({error.strerror})") from error
    except (SyntaxError, ValueError) as error:
        raise BadCourseFile(file, getattr(error, "lineno", 1) or 1, "no Python") from error
    line, points = _points_in(tree, file)
    if twice := sorted(set(points) & set(card.points)):
        raise BadCourseFile(file, line, f"the card has a check of this name: {twice[0]}")
    return points


def _points_in(tree: ast.Module, file: Path) -> tuple[int, dict[str, float]]:
    for node in tree.body:
        if isinstance(node, ast.Assign) and NAME in map(ast.unparse, node.targets):
            return node.lineno, _table(node, file)
    raise BadCourseFile(file, 1, f'write the points of its checks: {NAME} = {{"name": 5}}')


def _table(node: ast.Assign, file: Path) -> dict[str, float]:
    try:
        return {str(name): float(points) for name, points in ast.literal_eval(node.value).items()}
    except (ValueError, TypeError, AttributeError):
        problem = f'{NAME} is a plain table: {NAME} = {{"name": 5}}'
        raise BadCourseFile(file, node.lineno, problem) from None
