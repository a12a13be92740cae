"""A class that has a node, in place of a class that is one."""

from __future__ import annotations

from collections.abc import Mapping

import libcst as cst
import libcst.matchers as m

from roslings_prove.rewritten.source import Sources
from roslings_prove.rewritten.trees import (
    Statement,
    all_of,
    body_of,
    called,
    classes,
    functions,
    is_node,
    own_attribute,
    own_names,
    statements,
    swapped,
    with_body,
)

HELD = "node"
SUPER = m.SimpleStatementLine([m.Expr(m.Call(func=m.Attribute(m.Call(m.Name("super")))))])
OUTSIDE = ("spin", "spin_once", "spin_until_future_complete", "spin_until_complete", "add_node")
"""What takes a node of somebody else."""


def composition_for_inheritance(sources: Sources) -> Sources:
    """`class Talker(Node)` is `class Talker`, whose `self.node` is the node."""
    holders = {
        one.name.value: one
        for tree in sources.modules.values()
        for one in classes(tree)
        if _can_hold(one)
    }
    return sources.mapped(lambda tree: _with_holders(tree, holders))


def _can_hold(one: cst.ClassDef) -> bool:
    first = [line for line in _init(one) if m.matches(line, SUPER)]
    return is_node(one) and HELD not in own_names(one) and len(first) == 1


def _init(one: cst.ClassDef) -> list[cst.CSTNode]:
    return [
        line for each in functions(one) if each.name.value == "__init__" for line in body_of(each)
    ]


def _with_holders(tree: cst.Module, holders: Mapping[str, cst.ClassDef]) -> cst.Module:
    changed: dict[cst.CSTNode, cst.CSTNode] = {}
    for one in tree.body:
        if isinstance(one, cst.ClassDef) and one.name.value in holders:
            changed[one] = _holder(one)
        else:
            changed[one] = _user(one, holders)
    return swapped(tree, changed)


# --- the class ---------------------------------------------------------------------------------


def _holder(one: cst.ClassDef) -> cst.ClassDef:
    own = own_names(one)
    body = [_inside(line, own) for line in body_of(one)]
    plain = one.with_changes(
        bases=(), lpar=cst.MaybeSentinel.DEFAULT, rpar=cst.MaybeSentinel.DEFAULT
    )
    return with_body(plain, body)


def _inside(line: Statement, own: frozenset[str]) -> Statement:
    if not isinstance(line, cst.FunctionDef):
        return line
    return cst.ensure_type(line.visit(_ToHeld(own)), cst.FunctionDef)


class _ToHeld(cst.CSTTransformer):
    """What the class has not by itself, its node has."""

    def __init__(self, own: frozenset[str]) -> None:
        super().__init__()
        self.own = own

    def leave_SimpleStatementLine(  # noqa: N802
        self, original_node: cst.SimpleStatementLine, updated_node: cst.SimpleStatementLine
    ) -> cst.SimpleStatementLine:
        if not m.matches(original_node, SUPER):
            return updated_node
        call = all_of(updated_node, cst.Call)[0].with_changes(func=cst.Name("Node"))
        (made,) = statements(f"self.{HELD} = 0\n")
        return swapped(made, {all_of(made, cst.Integer)[0]: call})  # type: ignore[return-value]

    def visit_Attribute(self, node: cst.Attribute) -> bool:  # noqa: N802
        return not own_attribute(node)

    def leave_Attribute(  # noqa: N802
        self, original_node: cst.Attribute, updated_node: cst.Attribute
    ) -> cst.Attribute:
        name = own_attribute(original_node)
        if not name or name in self.own:
            return updated_node
        return updated_node.with_changes(value=_held(cst.Name("self")))

    def visit_Param(self, node: cst.Param) -> bool:  # noqa: N802
        return False

    def leave_Name(  # noqa: N802
        self, original_node: cst.Name, updated_node: cst.Name
    ) -> cst.Name | cst.Attribute:
        return _held(updated_node) if original_node.value == "self" else updated_node


def _held(holder: cst.BaseExpression) -> cst.Attribute:
    return cst.Attribute(holder, cst.Name(HELD))


# --- who uses it -------------------------------------------------------------------------------


def _user(block: cst.CSTNode, holders: Mapping[str, cst.ClassDef]) -> cst.CSTNode:
    """`rclpy.spin(Talker())` takes the node that a talker has."""
    made = _variables(block, holders)
    given: dict[cst.CSTNode, cst.CSTNode] = {}
    for call in all_of(block, cst.Call):
        if called(call) in OUTSIDE:
            for arg in call.args:
                if _holder_of(arg.value, made, holders):
                    given[arg.value] = _held(arg.value)
    for each in all_of(block, cst.Attribute):
        holder = _holder_of(each.value, made, holders)
        if holder and each.attr.value not in own_names(holders[holder]):
            given[each.value] = _held(each.value)
    return swapped(block, given)


def _variables(block: cst.CSTNode, holders: Mapping[str, cst.ClassDef]) -> dict[str, str]:
    return {
        target.target.value: called(line.value)
        for line in all_of(block, cst.Assign)
        if isinstance(line.value, cst.Call) and called(line.value) in holders
        for target in line.targets
        if isinstance(target.target, cst.Name)
    }


def _holder_of(
    value: cst.BaseExpression, made: Mapping[str, str], holders: Mapping[str, cst.ClassDef]
) -> str:
    if isinstance(value, cst.Name):
        return made.get(value.value, "")
    return called(value) if isinstance(value, cst.Call) and called(value) in holders else ""
