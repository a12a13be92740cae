"""What the rewrites ask of a program's tree, and how they put something into it."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import fields
from functools import cache, lru_cache
from typing import TypeVar

import libcst as cst
import libcst.matchers as m

from roslings_prove.rewritten.source import dotted

N = TypeVar("N", bound=cst.CSTNode)
K = TypeVar("K", bound=cst.CSTNode)
Statement = cst.SimpleStatementLine | cst.BaseCompoundStatement

BLANK = (cst.BaseParenthesizableWhitespace, cst.TrailingWhitespace, cst.EmptyLine)
"""Nodes that no rewrite looks for."""

ASSIGN = (
    cst.AssignTarget,
    cst.AnnAssign,
    cst.AugAssign,
    cst.For,
    cst.CompFor,
    cst.NamedExpr,
)

TAKES_CALLBACKS = ("create_timer", "create_subscription", "create_service", "ActionServer")
"""What keeps a function and has it called by the executor."""


def all_of(tree: cst.CSTNode, kind: type[N]) -> list[N]:
    """Every node of a kind in `tree`, what holds another one before it."""
    return [each for each in _every(tree) if isinstance(each, kind)]


@lru_cache(maxsize=4096)
def _every(tree: cst.CSTNode) -> list[cst.CSTNode]:
    """All nodes of a tree, which never changes; most are asked for many times."""
    found: list[cst.CSTNode] = []
    pending = [tree]
    while pending:
        node = pending.pop()
        if not isinstance(node, BLANK):
            found.append(node)
            pending.extend(reversed(list(_below(node))))
    return found


def _below(node: cst.CSTNode) -> Iterator[cst.CSTNode]:
    """The nodes that a node holds; `children` of LibCST makes a copy of each first."""
    for name in _fields(type(node)):
        held = getattr(node, name)
        if isinstance(held, cst.CSTNode):
            yield held
        elif isinstance(held, list | tuple):
            yield from (each for each in held if isinstance(each, cst.CSTNode))


@cache
def _fields(kind: type[cst.CSTNode]) -> tuple[str, ...]:
    return tuple(field.name for field in fields(kind))


def classes(tree: cst.Module) -> list[cst.ClassDef]:
    """The classes of a module."""
    return [each for each in tree.body if isinstance(each, cst.ClassDef)]


def functions(block: cst.Module | cst.ClassDef) -> list[cst.FunctionDef]:
    """The functions of a module, or the methods of a class."""
    body = block.body if isinstance(block, cst.Module) else block.body.body
    return [each for each in body if isinstance(each, cst.FunctionDef)]


def is_node(one: cst.ClassDef) -> bool:
    """A class that is a ROS node by inheritance, and of no other class."""
    return [dotted(base.value).split(".")[-1] for base in one.bases] == ["Node"]


def is_dunder(name: str) -> bool:
    """Names that Python itself calls."""
    return name.startswith("__") and name.endswith("__")


def called(call: cst.Call) -> str:
    """The last name of what is called: `create_timer` of `self.create_timer(...)`."""
    return dotted(call.func).split(".")[-1] or (
        call.func.attr.value if isinstance(call.func, cst.Attribute) else ""
    )


def own_attribute(node: cst.CSTNode | None) -> str:
    """`x` of `self.x`; empty for all else."""
    if isinstance(node, cst.Attribute) and m.matches(node.value, m.Name("self")):
        return node.attr.value
    return ""


def assigned(tree: cst.CSTNode) -> Iterator[cst.BaseExpression]:
    """What is assigned to, in every way that a statement can assign."""
    for node in _every(tree):
        if isinstance(node, ASSIGN):
            yield from _parts(node.target)
        elif isinstance(node, cst.AsName):
            yield from _parts(node.name)


def _parts(target: cst.BaseExpression) -> Iterator[cst.BaseExpression]:
    if isinstance(target, cst.Tuple | cst.List):
        for element in target.elements:
            yield from _parts(element.value)
    else:
        yield target


def attributes(one: cst.ClassDef) -> set[str]:
    """What its methods assign to `self`."""
    return {name for target in assigned(one) if (name := own_attribute(target))}


@lru_cache(maxsize=256)
def own_names(one: cst.ClassDef) -> frozenset[str]:
    """Attributes and methods that the class itself has."""
    return frozenset(attributes(one) | {each.name.value for each in functions(one)})


def parameters(function: cst.FunctionDef) -> list[str]:
    """The names of what it takes."""
    taken = function.params
    plain = [*taken.posonly_params, *taken.params, *taken.kwonly_params]
    stars = [each for each in (taken.star_arg, taken.star_kwarg) if isinstance(each, cst.Param)]
    return [each.name.value for each in (*plain, *stars)]


def local_names(function: cst.FunctionDef) -> set[str]:
    """All names that belong to a function alone."""
    given = {each.value for each in assigned(function) if isinstance(each, cst.Name)}
    return given | set(parameters(function))


class _Names(cst.CSTVisitor):
    def __init__(self) -> None:
        self.found: list[cst.Name] = []

    def visit_Name(self, node: cst.Name) -> None:  # noqa: N802
        self.found.append(node)

    def visit_Attribute_attr(self, node: cst.Attribute) -> None:  # noqa: N802
        self.found.append(node.attr)

    def leave_Attribute(self, original_node: cst.Attribute) -> None:  # noqa: N802
        self.found = [each for each in self.found if each is not original_node.attr]

    def leave_Arg(self, original_node: cst.Arg) -> None:  # noqa: N802
        self.found = [each for each in self.found if each is not original_node.keyword]


def names_in(tree: cst.CSTNode) -> list[cst.Name]:
    """Every variable that is named; no attribute, no keyword of an argument."""
    visitor = _Names()
    tree.visit(visitor)
    return visitor.found


def callbacks(one: cst.ClassDef, takers: Collection[str] = TAKES_CALLBACKS) -> set[str]:
    """Its methods that are given away to be called by others."""
    return {
        name
        for call in all_of(one, cst.Call)
        if called(call) in takers
        for arg in call.args
        if (name := own_attribute(arg.value))
    }


def called_here(one: cst.ClassDef) -> set[str]:
    """Its methods that it calls itself."""
    return {own_attribute(call.func) for call in all_of(one, cst.Call)}


def method(one: cst.ClassDef, name: str) -> cst.FunctionDef | None:
    """A method by its name."""
    return next((each for each in functions(one) if each.name.value == name), None)


# --- putting something in ----------------------------------------------------------------------


class _Swap(cst.CSTTransformer):
    def __init__(self, others: Mapping[K, cst.CSTNode]) -> None:
        super().__init__()
        self.others: dict[cst.CSTNode, cst.CSTNode] = dict(others.items())

    def on_leave(self, original_node: cst.CSTNode, updated_node: cst.CSTNode) -> cst.CSTNode:  # type: ignore[override]
        return self.others.get(original_node, updated_node)


def swapped(tree: N, others: Mapping[K, cst.CSTNode]) -> N:
    """The tree with some of its nodes replaced; none may lie in another one."""
    if not others:
        return tree
    new = tree.visit(_Swap(others))
    assert isinstance(new, type(tree))
    return new


def statements(code: str) -> list[Statement]:
    """Lines of Python as statements."""
    return list(cst.parse_module(code).body)


def expression(code: str) -> cst.BaseExpression:
    """A piece of Python as an expression."""
    return cst.parse_expression(code)


def code_of(node: cst.CSTNode) -> str:
    """A piece of a tree as Python."""
    return cst.Module(body=[]).code_for_node(node)


def importing(tree: cst.Module, module: str, name: str | None = None) -> cst.Module:
    """The module with one more import, behind those that are there."""
    line = f"from {module} import {name}\n" if name else f"import {module}\n"
    if line.strip() in (code_of(each).strip() for each in tree.body):
        return tree
    imports = m.SimpleStatementLine([m.Import() | m.ImportFrom()])
    last = max((n for n, each in enumerate(tree.body) if m.matches(each, imports)), default=0)
    body = [*tree.body[: last + 1], *statements(line), *tree.body[last + 1 :]]
    return tree.with_changes(body=body)


def with_body(block: N, body: Sequence[Statement]) -> N:
    """A class or function with other statements."""
    return block.with_changes(body=cst.IndentedBlock(body=body))


def body_of(block: cst.ClassDef | cst.FunctionDef) -> list[Statement]:
    """The statements of a class or a function, its docstring too."""
    kinds = (cst.SimpleStatementLine, cst.BaseCompoundStatement)
    return [line for line in block.body.body if isinstance(line, kinds)]


def is_docstring(statement: cst.CSTNode) -> bool:
    """A text that stands alone."""
    return m.matches(
        statement, m.SimpleStatementLine([m.Expr(m.SimpleString() | m.ConcatenatedString())])
    )


def parted(body: Sequence[Statement]) -> tuple[list[Statement], list[Statement]]:
    """The docstring, if there is one, and what follows."""
    start = 1 if body and is_docstring(body[0]) else 0
    return list(body[:start]), list(body[start:])


def argument(value: cst.BaseExpression, keyword: str) -> cst.Arg:
    """`keyword=value`, as it stands in a call."""
    return cst.Arg(
        value,
        keyword=cst.Name(keyword),
        equal=cst.AssignEqual(cst.SimpleWhitespace(""), cst.SimpleWhitespace("")),
    )


def with_arguments(call: cst.Call, args: Iterable[cst.Arg]) -> cst.Call:
    """A call with other arguments, each after a comma and a blank."""
    listed = list(args)
    comma = cst.Comma(whitespace_after=cst.SimpleWhitespace(" "))
    spaced = [each.with_changes(comma=_comma_of(each, comma)) for each in listed[:-1]]
    return call.with_changes(args=[*spaced, *listed[-1:]])


def _comma_of(arg: cst.Arg, comma: cst.Comma) -> cst.Comma:
    return arg.comma if isinstance(arg.comma, cst.Comma) else comma


def keyword_of(call: cst.Call, name: str) -> cst.Arg | None:
    """The argument that is given by this name."""
    return next((arg for arg in call.args if arg.keyword and arg.keyword.value == name), None)
