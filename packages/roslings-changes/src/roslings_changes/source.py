"""One module of a solution, read by LibCST, and what stands around each of its nodes.

LibCST and no mutation library (mutmut, cosmic-ray): those change a program in place and run its
unit tests in one process. Here a wrong program must be a whole package, built and graded as a
student's is, so only the changing of source was wanted. LibCST keeps comments and layout: the diff
of a change is the change alone, and a person can read it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path

import libcst as cst
from libcst.metadata import MetadataWrapper, ParentNodeProvider, PositionProvider

New = cst.CSTNode | cst.FlattenSentinel[cst.BaseStatement] | cst.RemovalSentinel
"""What may stand in the place of a node."""


@dataclass(frozen=True)
class ModuleSource:
    """A module's tree, with the lines and the parents of its nodes."""

    file: str
    """Its name in the package, with `/`."""
    module: cst.Module
    text: str
    """What the file holds."""
    _lines: dict[cst.CSTNode, int] = field(repr=False)
    _parents: dict[cst.CSTNode, cst.CSTNode] = field(repr=False)

    def line(self, node: cst.CSTNode) -> int:
        """The line in which a node begins, from 1."""
        return self._lines[node]

    def around(self, node: cst.CSTNode) -> Iterator[cst.CSTNode]:
        """The nodes that it stands in, the nearest first."""
        while node in self._parents:
            node = self._parents[node]
            yield node

    def parent(self, node: cst.CSTNode) -> cst.CSTNode:
        """The node that it stands in."""
        return self._parents[node]

    def comment(self, node: cst.CSTNode) -> str:
        """What is said behind the statement that a node stands in; empty where nothing is."""
        for each in (node, *self.around(node)):
            if isinstance(each, cst.SimpleStatementLine):
                said = each.trailing_whitespace.comment
                return said.value if said else ""
        return ""

    def nodes(self) -> Iterator[cst.CSTNode]:
        """All nodes that run when ROS runs the package, in the order of the file."""
        yield from _below(self.module)

    def with_new(self, node: cst.CSTNode, new: New) -> str:
        """The module's text with one node changed."""
        while node is not self.module:
            parent = self.parent(node)
            node, new = parent, _with_child(parent, node, new)
        assert isinstance(new, cst.Module)
        return new.code


def read_source(folder: Path, file: str) -> ModuleSource:
    """The module `file` of the package in `folder`. Raises ParserSyntaxError of LibCST."""
    text = (folder / file).read_text("utf-8")
    wrapper = MetadataWrapper(cst.parse_module(text))
    lines = wrapper.resolve(PositionProvider)
    parents = wrapper.resolve(ParentNodeProvider)
    starts = {node: place.start.line for node, place in lines.items()}
    return ModuleSource(file, wrapper.module, text, starts, dict(parents))


def _below(node: cst.CSTNode) -> Iterator[cst.CSTNode]:
    if is_documentation(node) or is_guard(node) or isinstance(node, cst.Import | cst.ImportFrom):
        return
    yield node
    for child in node.children:
        yield from _below(child)


def is_documentation(node: cst.CSTNode) -> bool:
    """A text that stands alone as a statement: nobody but people read it."""
    match node:
        case cst.SimpleStatementLine(body=[cst.Expr(value=cst.SimpleString())]):
            return True
    return False


def is_guard(node: cst.CSTNode) -> bool:
    """`if __name__ == '__main__':`, which `ros2 run` never enters: it calls `main`."""
    match node:
        case cst.If(test=cst.Comparison(left=cst.Name("__name__"))):
            return True
    return False


def _with_child(parent: cst.CSTNode, child: cst.CSTNode, new: New) -> cst.CSTNode:
    """The parent with another child; LibCST's own way visits the whole module for it."""
    for part in fields(parent):
        value = getattr(parent, part.name)
        if value is child:
            kept = None if isinstance(new, cst.RemovalSentinel) else new
            return parent.with_changes(**{part.name: kept})
        if isinstance(value, Sequence) and any(each is child for each in value):
            return parent.with_changes(**{part.name: list(_spliced(value, child, new))})
    raise LookupError(f"{type(child).__name__} stands in no field of its parent")


def _spliced(nodes: Sequence[cst.CSTNode], child: cst.CSTNode, new: New) -> Iterator[cst.CSTNode]:
    for each in nodes:
        if each is not child:
            yield each
        elif isinstance(new, cst.FlattenSentinel):
            yield from new
        elif isinstance(new, cst.CSTNode):
            yield new
