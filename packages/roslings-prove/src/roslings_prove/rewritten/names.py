"""Other names for classes, functions, variables and attributes; what ROS calls by name keeps its.

A name is changed in the whole package or not at all. Where one place that says it cannot be told
(`pose.position.x`, where a class has an `x` of its own), it stays.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass

import libcst as cst
from libcst.metadata import (
    Assignment,
    FunctionScope,
    GlobalScope,
    ImportAssignment,
    MetadataWrapper,
    Scope,
    ScopeProvider,
)

from roslings_prove.rewritten.source import Sources
from roslings_prove.rewritten.trees import (
    all_of,
    assigned,
    attributes,
    called,
    classes,
    functions,
    is_dunder,
    is_node,
    own_attribute,
    own_names,
    parameters,
    swapped,
)

NewNames = Mapping[str, str]


def renamed_classes(sources: Sources) -> Sources:
    """`Talker` is `MyTalker`."""
    names = {each.name.value for tree in sources.modules.values() for each in classes(tree)}
    return _with_globals(sources, {name: f"My{name}" for name in names})


def renamed_functions(sources: Sources) -> Sources:
    """`main` is `do_main`, and `self.hear` is `self.do_hear`; setup.py says so."""
    trees = sources.modules.values()
    own = {each.name.value for tree in trees for each in functions(tree)}
    methods = {
        each.name.value for tree in trees for one in _free_classes(tree) for each in functions(one)
    }
    names = {name: f"do_{name}" for name in own | methods if not is_dunder(name)}
    plain = _with_globals(sources, {name: names[name] for name in own})
    plain = plain.retargeted(lambda target: (target[0], names.get(target[1], target[1])))
    return _with_attributes(plain, {name: names[name] for name in methods if name in names})


def renamed_attributes(sources: Sources) -> Sources:
    """`self.count` is `self.my_count`."""
    names = {
        name
        for tree in sources.modules.values()
        for one in _free_classes(tree)
        for name in attributes(one)
    }
    return _with_attributes(sources, {name: f"my_{name}" for name in names})


def renamed_variables(sources: Sources) -> Sources:
    """`message` is `the_message`, and `NEAR` is `THE_NEAR`."""
    constants = {
        target.value
        for tree in sources.modules.values()
        for line in tree.body
        if isinstance(line, cst.SimpleStatementLine)
        for target in assigned(line)
        if isinstance(target, cst.Name)
    }
    names = {name: f"THE_{name}" for name in constants if not is_dunder(name)}
    said = _keywords(sources)
    return _with_globals(sources, names).mapped(lambda tree: _with_locals(tree, said))


def _free_classes(tree: cst.Module) -> list[cst.ClassDef]:
    """Classes that nobody else knows from within: nodes, and those that derive from nothing."""
    return [each for each in classes(tree) if is_node(each) or not each.bases]


def _keywords(sources: Sources) -> set[str]:
    """Names by which arguments are given somewhere: a parameter keeps such a name."""
    return {
        arg.keyword.value
        for tree in sources.modules.values()
        for arg in all_of(tree, cst.Arg)
        if arg.keyword
    }


# --- names of modules and functions ------------------------------------------------------------


def _renamed(tree: cst.Module, names: Mapping[cst.CSTNode, str]) -> cst.Module:
    others: dict[cst.CSTNode, cst.CSTNode] = {
        node: node.with_changes(value=name)
        for node, name in names.items()
        if isinstance(node, cst.Name)
    }
    return swapped(tree, others)


def _with_globals(sources: Sources, names: NewNames) -> Sources:
    """What modules define or import from each other, under other names."""

    def change(tree: cst.Module) -> cst.Module:
        whole = MetadataWrapper(tree, unsafe_skip_copy=True)
        scopes = {each for each in whole.resolve(ScopeProvider).values() if each}
        found: dict[cst.CSTNode, str] = {}
        for scope in scopes:
            if isinstance(scope, GlobalScope):
                for node, name in _named(scope, sources):
                    if name in names:
                        found[node] = names[name]
        return _renamed(whole.module, found)

    return sources.mapped(change)


def _named(scope: Scope, sources: Sources) -> Iterator[tuple[cst.CSTNode, str]]:
    """Each place that names something of our own in a scope."""
    for assignment in scope.assignments:
        if isinstance(assignment, ImportAssignment):
            imported = assignment.node
            if not isinstance(imported, cst.ImportFrom) or not sources.is_own(imported):
                continue
            yield from _imported(imported, assignment.name)
        elif isinstance(assignment, Assignment):
            node = assignment.node
            if isinstance(node, cst.ClassDef | cst.FunctionDef):
                node = node.name
            yield node, assignment.name
        for access in assignment.references:
            yield access.node, assignment.name


def _imported(line: cst.ImportFrom, name: str) -> Iterator[tuple[cst.CSTNode, str]]:
    for alias in all_of(line, cst.ImportAlias):
        if alias.evaluated_name == name:
            yield alias.name, name


def _with_locals(tree: cst.Module, said: Collection[str]) -> cst.Module:
    """A function's own variables and parameters, under other names."""
    whole = MetadataWrapper(tree, unsafe_skip_copy=True)
    found: dict[cst.CSTNode, str] = {}
    for scope in {each for each in whole.resolve(ScopeProvider).values() if each}:
        if isinstance(scope, FunctionScope):
            for assignment in scope.assignments:
                if _stays(assignment.name, said) or not isinstance(assignment, Assignment):
                    continue
                if isinstance(assignment, ImportAssignment):
                    continue  # the name is another package's
                node = assignment.node
                places = [node.name if isinstance(node, cst.Param) else node]
                places += [access.node for access in assignment.references]
                found.update({place: f"the_{assignment.name}" for place in places})
    return _renamed(whole.module, found)


def _stays(name: str, said: Collection[str]) -> bool:
    return name in said or name in ("self", "cls") or name.startswith("_")


# --- names behind a dot ------------------------------------------------------------------------


@dataclass(frozen=True)
class _Owners:
    """Which of the package's classes a piece of a program is made of, where that can be told."""

    classes: Mapping[str, cst.ClassDef]

    def has(self, holder: str, name: str) -> bool:
        return holder in self.classes and name in own_names(self.classes[holder])

    def made_by(self, value: cst.CSTNode | None) -> str:
        """The class of `Talker()`."""
        if isinstance(value, cst.Call) and called(value) in self.classes:
            return called(value)
        return ""

    def variables(self, tree: cst.CSTNode) -> dict[str, str]:
        """What is given one class of ours, and never another one, to that class."""
        kinds: dict[str, set[str]] = {}
        for line in all_of(tree, cst.Assign):
            if isinstance(line.value, cst.Name) and line.value.value == "None":
                continue
            for target in line.targets:
                for part in assigned(target):
                    kinds.setdefault(_spoken(part), set()).add(self.made_by(line.value))
        return {name: next(iter(kind)) for name, kind in kinds.items() if len(kind) == 1}

    def holder(self, value: cst.BaseExpression, known: Mapping[str, str]) -> str:
        """The class of what stands before a dot; empty where it cannot be told."""
        return self.made_by(value) or known.get(_spoken(value), "")


def _spoken(value: cst.BaseExpression) -> str:
    """A variable, or an attribute of `self`, as a text."""
    if name := own_attribute(value):
        return f"self.{name}"
    return value.value if isinstance(value, cst.Name) else ""


def _with_attributes(sources: Sources, names: NewNames) -> Sources:
    """Attributes and methods under other names, where each place that says one is surely ours."""
    owners = _Owners({one.name.value: one for t in sources.modules.values() for one in classes(t)})
    places = {module: _places(tree, owners) for module, tree in sources.modules.items()}
    unsure = {
        node.attr.value for found in places.values() for node, is_ours in found if not is_ours
    }
    free = {name: new for name, new in names.items() if name not in unsure and _is_free(name)}
    changed = {}
    for module, tree in sources.modules.items():
        named = {
            node.attr: free[node.attr.value]
            for node, _ in _places(tree, owners)
            if node.attr.value in free
        }
        changed[module] = tree
        changed[module] = _renamed(tree, named | _definitions(tree, free))
    return sources.with_modules(changed)


def _definitions(tree: cst.Module, names: NewNames) -> dict[cst.CSTNode, str]:
    return {
        each.name: names[each.name.value]
        for one in classes(tree)
        for each in functions(one)
        if each.name.value in names
    }


def _is_free(name: str) -> bool:
    """ROS has no such name in a node."""
    from rclpy.node import Node

    return not is_dunder(name) and not hasattr(Node, name)


def _places(tree: cst.Module, owners: _Owners) -> list[tuple[cst.Attribute, bool]]:
    """Everything behind a dot, and whether it belongs to a class of the package."""
    found = []
    for block in (*classes(tree), *functions(tree), *_other_lines(tree)):
        known = owners.variables(block)
        if isinstance(block, cst.ClassDef):
            known["self"] = block.name.value
        for given in _parameters_below(block):
            known.pop(given, None)
        for node in all_of(block, cst.Attribute):
            holder = owners.holder(node.value, known)
            found.append((node, owners.has(holder, node.attr.value)))
    return found


def _other_lines(tree: cst.Module) -> list[cst.CSTNode]:
    return [line for line in tree.body if not isinstance(line, cst.ClassDef | cst.FunctionDef)]


def _parameters_below(block: cst.CSTNode) -> set[str]:
    """What is given to functions may be anything."""
    below = all_of(block, cst.FunctionDef)
    return {name for each in below for name in parameters(each)} - {"self"}
