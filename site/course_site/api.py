"""The engine's public names, read from its source: signatures and docstrings, nothing imported."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from sphinx.application import Sphinx

from course_site.course import MarkdownDirective

Definition = ast.FunctionDef | ast.ClassDef


@dataclass(frozen=True)
class Room:
    """One room of the engine: its name, what it says of itself, its public definitions."""

    name: str
    about: str
    definitions: tuple[Definition, ...]


class EngineApi(MarkdownDirective):
    """`{engine-api} roslings.evidence ...`: what each room offers."""

    required_arguments = 1
    final_argument_whitespace = True

    def markdown(self) -> str:
        """A section a room, a section a name."""
        return "\n\n".join(_room(room(name)) for name in self.arguments[0].split())


def room(name: str) -> Room:
    """Read a room: a module, or a package that says by `__all__` what is public."""
    first = _place_of(name)
    files = sorted(first.parent.glob("*.py")) if first.stem == "__init__" else [first]
    trees = [ast.parse(file.read_text("utf-8")) for file in files]
    public = {each for tree in trees for each in _all_of(tree)}
    about = ast.get_docstring(ast.parse(first.read_text("utf-8"))) or ""
    found = {each.name: each for tree in trees for each in _definitions(tree)}
    chosen = [each for key, each in sorted(found.items()) if key in public or _open(key, public)]
    return Room(name, about, tuple(chosen))


def _place_of(name: str) -> Path:
    """The file of a module; of a package its `__init__`."""
    found = find_spec(name)
    assert found and found.origin, name
    return Path(found.origin)


def _open(name: str, public: set[str]) -> bool:
    """A module without `__all__` opens every name that has no underscore in front."""
    return not public and not name.startswith("_")


def _all_of(tree: ast.Module) -> list[str]:
    for node in tree.body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            return [str(each) for each in ast.literal_eval(node.value)]
    return []


def _definitions(tree: ast.AST) -> Iterator[Definition]:
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            yield node


def _room(room: Room) -> str:
    parts = [f"## `{room.name}`", prose(room.about)]
    return "\n\n".join([*parts, *(_definition(each) for each in room.definitions)])


def _definition(node: Definition) -> str:
    about = prose(inspect.cleandoc(ast.get_docstring(node) or ""))
    methods = [
        f"- `{_signature(each)}`: {_first_sentence(each)}"
        for each in _definitions(node)
        if isinstance(node, ast.ClassDef) and not each.name.startswith("_")
    ]
    code = f"```python\n{_signature(node)}\n```"
    return "\n\n".join([f"### `{node.name}`", code, about, "\n".join(methods)])


def _signature(node: Definition) -> str:
    if isinstance(node, ast.ClassDef):
        bases = f"({', '.join(map(ast.unparse, node.bases))})" if node.bases else ""
        fields = [each for each in node.body if isinstance(each, ast.AnnAssign)]
        lines = [
            f"    {ast.unparse(each.target)}: {ast.unparse(each.annotation)}" for each in fields
        ]
        return "\n".join([f"class {node.name}{bases}", *lines])
    back = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return f"{node.name}({ast.unparse(node.args)}){back}"


def _first_sentence(node: Definition) -> str:
    text = " ".join((ast.get_docstring(node) or "").split("\n\n")[0].split())
    return prose(text)


def prose(docstring: str) -> str:
    """A docstring as Markdown: indented parts are examples, code marks are kept."""
    pieces = re.split(r"(`[^`]*`)", docstring)
    kept = [
        each if index % 2 else re.sub(r"([*_<\[\]])", r"\\\1", each)
        for index, each in enumerate(pieces)
    ]
    return "".join(kept)


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.add_directive("engine-api", EngineApi)
