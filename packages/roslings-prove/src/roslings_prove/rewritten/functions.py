"""A part of a function as a function of its own, and a small function back in its caller."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import libcst as cst
import libcst.matchers as m

from roslings_prove.rewritten.source import Sources
from roslings_prove.rewritten.trees import (
    Statement,
    all_of,
    assigned,
    body_of,
    callbacks,
    classes,
    expression,
    functions,
    is_dunder,
    local_names,
    names_in,
    own_attribute,
    own_names,
    parameters,
    parted,
    statements,
    swapped,
    with_body,
)

SHORTEST = 3
"""Statements of a method of which a part may become one of its own."""
CLOSED = (cst.Yield, cst.Await, cst.Global, cst.Nonlocal, cst.Lambda, cst.FunctionDef)
"""What ties a statement to its function."""

# --- extracted ---------------------------------------------------------------------------------


def extracted(sources: Sources) -> Sources:
    """The second half of each longer method is a method: `finish_say_hello`."""

    def change(tree: cst.Module) -> cst.Module:
        return swapped(tree, {one: _with_halves(one) for one in classes(tree)})

    return sources.mapped(change)


def _with_halves(one: cst.ClassDef) -> cst.CSTNode:
    body: list[Statement] = []
    for line in body_of(one):
        if isinstance(line, cst.FunctionDef) and not line.decorators:
            body += [line] if is_dunder(line.name.value) else _halves(line)
        else:
            body.append(line)
    return with_body(one, body)


def _halves(function: cst.FunctionDef) -> list[Statement]:
    """The method, and the one that it calls in the end; itself where it cannot be parted."""
    words, rest = parted(body_of(function))
    if len(rest) < SHORTEST or function.asynchronous:
        return [function]
    middle = len(rest) // 2
    for at in (*range(middle, len(rest)), *range(middle - 1, 0, -1)):
        given = _given(function, rest[:at], rest[at:])
        if given is not None:
            first = [*words, *rest[:at], *_handing_over(function, rest[at:], given)]
            return [with_body(function, first), _second(function, rest[at:], given)]
    return [function]


def _given(
    function: cst.FunctionDef, head: Sequence[Statement], tail: Sequence[Statement]
) -> list[str] | None:
    """The variables that the second half needs; None where they may not be there yet."""
    if any(all_of(line, kind) for line in tail for kind in CLOSED):
        return None
    own = local_names(function) - {"self"}
    there = {*parameters(function), *_surely(head)}
    maybe = {each.value for line in head for each in assigned(line) if isinstance(each, cst.Name)}
    needed = [name for name in dict.fromkeys(_named(tail)) if name in own & (maybe | there)]
    return needed if set(needed) <= there else None


def _surely(lines: Sequence[Statement]) -> set[str]:
    """What plain statements assign."""
    plain = [line for line in lines if isinstance(line, cst.SimpleStatementLine)]
    return {each.value for line in plain for each in assigned(line) if isinstance(each, cst.Name)}


def _named(lines: Sequence[Statement]) -> Iterator[str]:
    return (name.value for line in lines for name in names_in(line))


def _name_of_second(function: cst.FunctionDef) -> str:
    return f"finish_{function.name.value}"


def _handing_over(
    function: cst.FunctionDef, tail: Sequence[Statement], given: Sequence[str]
) -> list[Statement]:
    answers = any(each.value for line in tail for each in all_of(line, cst.Return))
    call = f"self.{_name_of_second(function)}({', '.join(given)})"
    return statements(f"return {call}\n" if answers else f"{call}\n")


def _second(
    function: cst.FunctionDef, tail: Sequence[Statement], given: Sequence[str]
) -> cst.FunctionDef:
    head = f"def {_name_of_second(function)}({', '.join(['self', *given])}):"
    (made,) = statements(f"{head}\n    pass\n")
    whole = cst.ensure_type(with_body(made, tail), cst.FunctionDef)
    return whole.with_changes(leading_lines=[cst.EmptyLine(indent=False)])


# --- inlined -----------------------------------------------------------------------------------


def inlined(sources: Sources) -> Sources:
    """Functions that only return something stand where they were called; so do short callbacks."""
    return sources.mapped(lambda tree: _with_lambdas(_without_small(tree)))


def _without_small(tree: cst.Module) -> cst.Module:
    """Without one function of one line, and so on until there is none."""
    for small in _small(tree):
        if (without := _without(tree, small)) is not None:
            return _without_small(without)
    return tree


def _small(tree: cst.Module) -> list[cst.FunctionDef]:
    """Functions and methods that do nothing but return an expression."""
    every = [*functions(tree), *(each for one in classes(tree) for each in functions(one))]
    return [each for each in every if _answer(each) and not each.decorators]


def _answer(function: cst.FunctionDef) -> cst.BaseExpression | None:
    _, rest = parted(body_of(function))
    if len(rest) == 1 and m.matches(rest[0], m.SimpleStatementLine([m.Return()])):
        return all_of(rest[0], cst.Return)[0].value
    return None


def _without(tree: cst.Module, small: cst.FunctionDef) -> cst.Module | None:
    """The module with each call replaced by the answer; None where one cannot be."""
    calls = [call for call in all_of(tree, cst.Call) if _calls(call, small)]
    if not calls or _mentions(tree, small) != len(calls):
        return None
    others: dict[cst.CSTNode, cst.CSTNode] = {}
    for call in calls:
        answer = _filled_in(small, call)
        if answer is None or _clashes(tree, small, call):
            return None
        others[call] = answer
    return swapped(tree, others).visit(_Without(small.name.value))


class _Without(cst.CSTTransformer):
    def __init__(self, name: str) -> None:
        super().__init__()
        self.name = name

    def leave_FunctionDef(  # noqa: N802
        self, original_node: cst.FunctionDef, updated_node: cst.FunctionDef
    ) -> cst.FunctionDef | cst.RemovalSentinel:
        is_it = original_node.name.value == self.name
        return cst.RemoveFromParent() if is_it else updated_node


def _is_method(small: cst.FunctionDef) -> bool:
    return parameters(small)[:1] == ["self"]


def _calls(call: cst.Call, small: cst.FunctionDef) -> bool:
    if _is_method(small):
        return own_attribute(call.func) == small.name.value
    return m.matches(call.func, m.Name(small.name.value))


def _mentions(tree: cst.Module, small: cst.FunctionDef) -> int:
    """How often the name is said, its definition aside; also where it means something else."""
    return sum(each.value == small.name.value for each in all_of(tree, cst.Name)) - 1


def _filled_in(small: cst.FunctionDef, call: cst.Call) -> cst.BaseExpression | None:
    """The answer with a call's arguments in place of the parameters."""
    answer = _answer(small)
    assert answer is not None
    taken = [name for name in parameters(small) if name != "self"]
    if len(taken) != len(call.args) or any(arg.keyword or arg.star for arg in call.args):
        return None
    given = dict(zip(taken, (arg.value for arg in call.args), strict=True))
    used = [name for name in names_in(answer) if name.value in given]
    if not all(_may_repeat(given[name.value]) for name in used):
        return None
    if isinstance(answer, cst.Name):
        return None  # nothing is left to write
    filled = swapped(answer, {name: given[name.value] for name in used})
    return filled.with_changes(lpar=[cst.LeftParen()], rpar=[cst.RightParen()])


def _may_repeat(value: cst.BaseExpression) -> bool:
    """It may be computed twice, or never: a name, a number, a text."""
    plain = m.Name() | m.SimpleString() | m.Integer() | m.Float()
    return m.matches(value, plain | m.Attribute(value=plain | m.Attribute()))


def _clashes(tree: cst.Module, small: cst.FunctionDef, call: cst.Call) -> bool:
    """A name of the answer means another thing where it is called."""
    answer = _answer(small)
    assert answer is not None
    free = {name.value for name in names_in(answer)} - set(parameters(small))
    around = [each for each in all_of(tree, cst.FunctionDef) if call in all_of(each, cst.Call)]
    return any(free & local_names(each) for each in around) or small in around


def _with_lambdas(tree: cst.Module) -> cst.Module:
    return swapped(tree, {one: _without_short_callbacks(one) for one in classes(tree)})


def _without_short_callbacks(one: cst.ClassDef) -> cst.CSTNode:
    """A callback of one expression stands as a lambda where it was given away."""
    short = {
        each.name.value: each
        for each in functions(one)
        if each.name.value in callbacks(one) and _only(each) and _said_once(one, each)
    }
    given: dict[cst.CSTNode, cst.CSTNode] = {
        node: _as_lambda(short[own_attribute(node)])
        for node in all_of(one, cst.Attribute)
        if own_attribute(node) in short
    }
    changed = swapped(one, given)
    kept = [line for line in body_of(changed) if _name(line) not in short]
    return with_body(changed, kept)


def _name(line: Statement) -> str:
    return line.name.value if isinstance(line, cst.FunctionDef) else ""


def _said_once(one: cst.ClassDef, function: cst.FunctionDef) -> bool:
    said = [own_attribute(each) for each in all_of(one, cst.Attribute)]
    return function.name.value in own_names(one) and said.count(function.name.value) == 1


def _only(function: cst.FunctionDef) -> cst.BaseExpression | None:
    """The only expression of a function; its answer is of no use to a subscription."""
    _, rest = parted(body_of(function))
    if len(rest) == 1 and m.matches(rest[0], m.SimpleStatementLine([m.Expr()])):
        return all_of(rest[0], cst.Expr)[0].value
    return _answer(function)


def _as_lambda(function: cst.FunctionDef) -> cst.BaseExpression:
    taken = [name for name in parameters(function) if name != "self"]
    made = cst.ensure_type(expression(f"lambda {', '.join(taken)}: 0"), cst.Lambda)
    body = _only(function)
    assert body is not None
    return made.with_changes(body=body)
