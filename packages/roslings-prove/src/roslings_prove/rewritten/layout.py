"""The same program in another order, in more files, in one file, or without its words."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from graphlib import TopologicalSorter

import libcst as cst
import libcst.matchers as m

from roslings_prove.rewritten.source import Sources, dotted
from roslings_prove.rewritten.trees import (
    Statement,
    all_of,
    assigned,
    body_of,
    classes,
    functions,
    is_docstring,
    names_in,
    parted,
    statements,
    swapped,
    with_body,
)

GUARD = m.If(test=m.Comparison(left=m.Name("__name__")))
IMPORTS = m.SimpleStatementLine([m.Import() | m.ImportFrom()])
TOGETHER = "programs"
"""The module into which all others go."""


def methods_in_another_order(sources: Sources) -> Sources:
    """The last method comes first, `__init__` last."""

    def change(tree: cst.Module) -> cst.Module:
        return swapped(tree, {one: _turned_round(one) for one in classes(tree)})

    return sources.mapped(change)


def _turned_round(one: cst.ClassDef) -> cst.CSTNode:
    methods = [each for each in functions(one) if not each.decorators]
    last_first = iter(reversed(methods))
    return with_body(one, [next(last_first) if x in methods else x for x in body_of(one)])


# --- nothing but code --------------------------------------------------------------------------


def stripped(sources: Sources) -> Sources:
    """No docstrings, comments and annotations."""
    return sources.mapped(lambda tree: tree.visit(_Strip()))


class _Strip(cst.CSTTransformer):
    def leave_SimpleStatementLine(  # noqa: N802
        self, original_node: cst.SimpleStatementLine, updated_node: cst.SimpleStatementLine
    ) -> cst.SimpleStatementLine | cst.RemovalSentinel:
        return cst.RemoveFromParent() if is_docstring(original_node) else updated_node

    def leave_IndentedBlock(  # noqa: N802
        self, original_node: cst.IndentedBlock, updated_node: cst.IndentedBlock
    ) -> cst.IndentedBlock:
        return (
            updated_node
            if updated_node.body
            else updated_node.with_changes(body=statements("pass"))
        )

    def leave_TrailingWhitespace(  # noqa: N802
        self, original_node: cst.TrailingWhitespace, updated_node: cst.TrailingWhitespace
    ) -> cst.TrailingWhitespace:
        return updated_node.with_changes(comment=None, whitespace=cst.SimpleWhitespace(""))

    def leave_EmptyLine(  # noqa: N802
        self, original_node: cst.EmptyLine, updated_node: cst.EmptyLine
    ) -> cst.EmptyLine | cst.RemovalSentinel:
        return cst.RemoveFromParent() if updated_node.comment else updated_node

    def leave_Param(self, original_node: cst.Param, updated_node: cst.Param) -> cst.Param:  # noqa: N802
        return updated_node.with_changes(annotation=None)

    def leave_FunctionDef(  # noqa: N802
        self, original_node: cst.FunctionDef, updated_node: cst.FunctionDef
    ) -> cst.FunctionDef:
        return updated_node.with_changes(returns=None)


# --- one file into three -----------------------------------------------------------------------


def one_file_into_three(sources: Sources) -> Sources:
    """Constants and functions, classes, and `main` each have a file, where a program has them."""
    changed: dict[str, cst.Module] = {}
    for name, tree in sources.modules.items():
        changed.update(_split(sources.card.package, name, tree))
    return sources.with_modules(changed)


def _split(package: str, name: str, tree: cst.Module) -> dict[str, cst.Module]:
    """A program's parts by their modules; the module as it is where it is no program."""
    words, rest = parted(tree.body)
    imports = [line for line in rest if m.matches(line, IMPORTS)]
    mains = [line for line in rest if m.matches(line, m.FunctionDef(m.Name("main")) | GUARD)]
    kinds = [line for line in rest if isinstance(line, cst.ClassDef)]
    parts = [line for line in rest if all(line is not each for each in (*imports, *mains, *kinds))]
    if not mains or not kinds or _named(parts) & _defined(kinds):
        return {name: tree}
    of_class = [*imports, *_import(package, f"{name}_parts", _defined(parts))]
    of_main = [*of_class, *_import(package, f"{name}_class", _defined(kinds))]
    made = {name: [*words, *_used(of_main, mains)], f"{name}_class": _used(of_class, kinds)}
    if parts:
        made[f"{name}_parts"] = _used(imports, parts)
    return {module: tree.with_changes(body=body, header=()) for module, body in made.items()}


def _import(package: str, module: str, names: Iterable[str]) -> list[Statement]:
    wanted = ", ".join(sorted(names))
    return statements(f"from {package}.{module} import {wanted}\n") if wanted else []


def _used(imports: Sequence[Statement], body: Sequence[Statement]) -> list[Statement]:
    """The statements below those imports that they need."""
    needed = _named(body)
    kept = [line for each in imports for line in _needed(each, needed)]
    return [*kept, *body]


def _needed(line: Statement, names: set[str]) -> list[Statement]:
    """An import without what nobody uses."""
    found: list[cst.Import | cst.ImportFrom] = [
        *all_of(line, cst.Import),
        *all_of(line, cst.ImportFrom),
    ]
    imported = found[0]
    if isinstance(imported.names, cst.ImportStar):
        return [line]
    kept = [each for each in imported.names if _bound(each) in names]
    if not kept:
        return []
    kept[-1] = kept[-1].with_changes(comma=cst.MaybeSentinel.DEFAULT)
    return [swapped(line, {imported: imported.with_changes(names=kept)})]


def _bound(alias: cst.ImportAlias) -> str:
    """The name that an import gives."""
    return alias.evaluated_alias or alias.evaluated_name.split(".")[0]


def _named(body: Iterable[cst.CSTNode]) -> set[str]:
    return {name.value for line in body for name in names_in(line)}


def _defined(body: Iterable[cst.CSTNode]) -> set[str]:
    """What statements of a module define."""
    found = set()
    for line in body:
        if isinstance(line, cst.ClassDef | cst.FunctionDef):
            found.add(line.name.value)
        else:
            found |= {each.value for each in assigned(line) if isinstance(each, cst.Name)}
    return found


# --- all files into one ------------------------------------------------------------------------


def all_files_into_one(sources: Sources) -> Sources:
    """One module holds every class and function; setup.py names it."""
    trees = sources.modules
    if len(trees) < 2 or not _fit_together(trees):
        return sources
    mains = {name for name, tree in trees.items() if "main" in _defined(tree.body)}
    order = [name for name in _by_need(sources, trees) if name in trees]
    bodies = {name: _without_frame(sources, name, trees[name]) for name in order}
    lines = _once([line for name in order for line in bodies[name]])
    whole = trees[order[0]].with_changes(body=lines, header=())
    joined = sources.with_modules({TOGETHER: whole})
    return joined.retargeted(
        lambda target: (TOGETHER, f"{target[0]}_main" if target[0] in mains else target[1])
    )


def _fit_together(trees: Mapping[str, cst.Module]) -> bool:
    """No two define the same, but for `main`, and none is used as a module."""
    defined = [name for tree in trees.values() for name in _defined(tree.body) - {"main"}]
    lines = [line for tree in trees.values() for line in tree.body if not m.matches(line, IMPORTS)]
    named = {dotted(each.value) for line in lines for each in all_of(line, cst.Attribute)}
    return len(defined) == len(set(defined)) and not named & set(trees)


def _by_need(sources: Sources, trees: Mapping[str, cst.Module]) -> list[str]:
    """The modules, those first that others import."""
    needs = {
        name: {
            dotted(each.module).removeprefix(f"{sources.card.package}.")
            for each in all_of(tree, cst.ImportFrom)
            if sources.is_own(each)
        }
        for name, tree in trees.items()
    }
    return list(TopologicalSorter(needs).static_order())


def _without_frame(sources: Sources, name: str, tree: cst.Module) -> list[Statement]:
    """A module's lines for another one: no docstring, no import of ours, its main by its name."""
    _, rest = parted(tree.body)
    own = [each for each in all_of(tree, cst.ImportFrom) if sources.is_own(each)]
    kept = [
        line
        for line in rest
        if not m.matches(line, GUARD) and not any(x in own for x in all_of(line, cst.ImportFrom))
    ]
    mains: dict[cst.CSTNode, cst.CSTNode] = {
        each.name: cst.Name(f"{name}_main") for each in functions(tree) if each.name.value == "main"
    }
    return [swapped(line, mains) for line in kept]


def _once(lines: Sequence[Statement]) -> list[Statement]:
    """The imports first, each once."""
    imports: dict[str, Statement] = {}
    for line in lines:
        if m.matches(line, IMPORTS):
            plain = line.with_changes(leading_lines=())
            imports.setdefault(cst.Module(body=[]).code_for_node(plain), plain)
    return [*imports.values(), *(line for line in lines if not m.matches(line, IMPORTS))]
