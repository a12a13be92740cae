"""What a program of ours is made of: its modules, and the files that lie beside them.

Followed are imports, those inside of functions too. Followed are also texts that name a module or a
file beside the one that they stand in. What is started by `-m NAME` or read by `with_name("x.xml")`
counts. Imports for the type checker alone do not.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from roslings.folders.lab_folders import GRADERS
from roslings.workspace.normal import digest_of, normal

TABLE = re.compile(rf"roslings\.(capability|capabilities\.[a-z]+)|{GRADERS}\.\w+")
"""Modules whose texts name others that they do not need: a table of what may be there."""
OF_A_LAB = re.compile(rf"({GRADERS}\.\w+(?:\.\w+)*)(:\w+)?")
"""A text of this kind names a module of a lab's own folder, or something in it."""


@dataclass(frozen=True)
class ModuleTree:
    """Where modules lie: the folders above our packages, and the one with what labs bring."""

    sources: tuple[Path, ...]
    graders: Path | None = None

    @cached_property
    def packages(self) -> dict[str, Path]:
        """Each package of ours to the folder above it."""
        places = (file.parent for above in self.sources for file in above.glob("*/__init__.py"))
        return {place.name: place.parent for place in places}

    def file_of(self, module: str) -> Path | None:
        """Its file; None where it is none of ours."""
        first, *inner = module.split(".")
        if first == GRADERS and self.graders:
            place = self.graders.joinpath(*inner)
        elif above := self.packages.get(first):
            place = above.joinpath(first, *inner)
        else:
            return None
        found = (place / "__init__.py", place.with_suffix(".py"))
        return next((file for file in found if file.is_file()), None)

    def name_of(self, file: Path) -> str:
        """The module that lies in a file."""
        parts = self.parts_of(file.with_suffix(""))
        return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)

    def with_parents(self, module: str) -> Iterator[str]:
        """A module and the packages around it: their `__init__` runs, too, where there is one."""
        parts = module.split(".")
        names = (".".join(parts[: length + 1]) for length in range(len(parts)))
        return (name for name in names if self.file_of(name))

    def parts_of(self, place: Path) -> tuple[str, ...]:
        """Of a module or a folder: the words of its name, from its package on."""
        if self.graders and place.is_relative_to(self.graders):
            return (GRADERS, *place.relative_to(self.graders).parts)
        above = next(each for each in self.sources if place.is_relative_to(each))
        return place.relative_to(above).parts


@dataclass(frozen=True)
class Import:
    """One name that a module takes, and from which module of ours; None: from another package."""

    name: str
    known_as: str
    module: str | None

    def words(self, modules: Modules, told: Told) -> str:
        """The name, and what it is where the name does not tell; where it stands does not count."""
        source = modules.meaning(self.module, self.name) if self.module and not told(self) else ""
        return f"{self.name} {self.known_as} {source}"


Told = Callable[[Import], bool]
"""Whether what an import takes is counted elsewhere, and known there by its name."""


def not_told(taken: Import) -> bool:
    """Of no import."""
    return False


@dataclass(frozen=True)
class Code:
    """Some statements of a file, and what they reach."""

    file: Path
    body: ast.Module
    tree: ModuleTree

    @cached_property
    def imports(self) -> tuple[Import, ...]:
        """All names that come from elsewhere, in no order that counts."""
        nodes = walk_at_run_time(self.body)
        return tuple(found for node in nodes for found in _imports_of(node, self))

    def absolute(self, node: ast.ImportFrom) -> str:
        """The module that `from ... import` names; dots before it count from where this lies."""
        if not node.level:
            return node.module or ""
        folder = self.file.parents[node.level - 1]
        parts = [*self.tree.parts_of(folder), *filter(None, [node.module])]
        return ".".join(parts)

    @cached_property
    def modules(self) -> frozenset[str]:
        """Those of ours that it imports or names, and the packages that they lie in."""
        taken = {each.module for each in self.imports if each.module}
        named = {name for text in self._texts for name in [self.module_named(text)] if name}
        return frozenset(each for name in taken | named for each in self.tree.with_parents(name))

    @cached_property
    def _definitions(self) -> dict[str, list[ast.stmt]]:
        found: dict[str, list[ast.stmt]] = {}
        for statement in self.defining(""):
            for name in names_of(statement):
                found.setdefault(name, []).append(statement)
        return found

    def defining(self, name: str) -> list[ast.stmt]:
        """The statements that give a name its meaning; all of them without a name."""
        if not name:
            return [each for each in self.body.body if not _is_import(each)]
        return self._definitions.get(name, [])

    @cached_property
    def taken(self) -> dict[str, Import]:
        """What comes from elsewhere, by the name that it has here."""
        return {each.known_as: each for each in self.imports}

    @cached_property
    def files(self) -> frozenset[Path]:
        """Files beside it that its texts name, and all in a folder that they name."""
        return frozenset(file for text in self._texts for file in self._beside(text))

    @cached_property
    def _texts(self) -> tuple[str, ...]:
        nodes = (node for node in ast.walk(self.body) if isinstance(node, ast.Constant))
        return tuple(node.value for node in nodes if isinstance(node.value, str))

    def module_named(self, text: str) -> str | None:
        """The module that a text names, as `a.b`, `a.b:NAME` or the file `b.py` beside it."""
        if self.tree.file_of(name := text.partition(":")[0]) and "." in name:
            return name
        file = self._named(text)
        return self.tree.name_of(file) if file and file.is_file() and _is_ours(file) else None

    def _named(self, text: str) -> Path | None:
        if not 0 < len(text) <= LONGEST_NAME or {"\0", "\n", "/"} & set(text) or text in ".. ":
            return None
        return self.file.parent / text

    def _beside(self, text: str) -> Iterator[Path]:
        place = self._named(text)
        if place and place.is_dir() and not (place / "__init__.py").exists():
            yield from (file for file in place.rglob("*") if file.is_file() and _counts(file))
        elif place and place.is_file() and not _is_ours(place):
            yield place


LONGEST_NAME = 60


def _is_ours(file: Path) -> bool:
    return file.suffix == ".py"


def _counts(file: Path) -> bool:
    return "__pycache__" not in file.parts


def walk_at_run_time(tree: ast.AST) -> Iterator[ast.AST]:
    """Every node but those that only a type checker reads."""
    todo = [tree]
    while todo:
        node = todo.pop()
        yield node
        todo += (each for each in ast.iter_child_nodes(node) if not is_for_types(each))


def is_for_types(node: ast.AST) -> bool:
    """`if TYPE_CHECKING:`, as our modules write it."""
    return (
        isinstance(node, ast.If)
        and isinstance(node.test, ast.Name)
        and node.test.id == "TYPE_CHECKING"
    )


def _imports_of(node: ast.AST, code: Code) -> Iterator[Import]:
    if isinstance(node, ast.Import):
        for each in node.names:
            known_as = each.asname or each.name.partition(".")[0]
            ours = each.name if code.tree.file_of(each.name) else None
            yield Import("" if ours else each.name, known_as, ours)
    elif isinstance(node, ast.ImportFrom):
        module = code.absolute(node)
        yield from (_taken(module, each, code.tree) for each in node.names)


def _taken(module: str, name: ast.alias, tree: ModuleTree) -> Import:
    known_as = name.asname or name.name
    if tree.file_of(inner := f"{module}.{name.name}"):
        return Import("", known_as, inner)
    if tree.file_of(module):
        return Import(name.name, known_as, module)
    return Import(inner, known_as, None)


@dataclass
class Modules:
    """The modules of a tree; each is read once."""

    tree: ModuleTree
    _code: dict[str, Code] = field(default_factory=dict)
    _digests: dict[int, tuple[ast.stmt, str]] = field(default_factory=dict)

    def code(self, module: str) -> Code:
        """What stands in a module of ours."""
        if module not in self._code:
            file = self.tree.file_of(module)
            assert file, module
            self._code[module] = Code(file, ast.parse(file.read_bytes()), self.tree)
        return self._code[module]

    def reached(self, start: Iterable[str]) -> frozenset[str]:
        """These modules, and all that they lead to."""
        found: set[str] = set()
        todo = [each for name in start for each in self.tree.with_parents(name)]
        while todo:
            module = todo.pop()
            if module not in found:
                found.add(module)
                todo += self.next_to(module)
        return frozenset(found)

    def next_to(self, module: str) -> Collection[str]:
        """The modules that one leads to; a table leads only to what it imports."""
        code = self.code(module)
        if not TABLE.fullmatch(module):
            return code.modules
        taken = {each.module for each in code.imports if each.module}
        return {each for name in taken for each in self.tree.with_parents(name)}

    def meaning(self, module: str, name: str) -> str:
        """What a name of a module is: the statements that define it; without a name, all of them.

        What these use is no part of it: that is reached, and counts by itself. A name that the
        module takes from elsewhere is what it is there.
        """
        seen: set[tuple[str, str]] = set()
        while (module, name) not in seen:
            seen.add((module, name))
            taken = self.code(module).taken.get(name)
            if taken and not taken.module:
                return taken.name
            module, name = (taken.module, taken.name) if taken and taken.module else (module, name)
        defined = (self._digest_of(each) for each in self.code(module).defining(name))
        return digest_of("\n".join(sorted(defined)).encode())

    def _digest_of(self, statement: ast.stmt) -> str:
        if id(statement) not in self._digests:  # kept with it: the number of what is gone is free
            self._digests[id(statement)] = (statement, digest_of(self._words(statement)))
        return self._digests[id(statement)][1]

    def does(self, code: Code, told: Told = not_told) -> frozenset[str]:
        """What some code does: its statements, and each name that it takes with what that is.

        In no order, and without where any of it lies. A module that moves does the same, and
        another thing of the same name is another. Of what is `told` elsewhere, the name is enough.
        """
        own = {self._digest_of(each) for each in code.body.body if not _is_import(each)}
        return frozenset(own | {each.words(self, told) for each in code.imports})

    def digest_of_code(self, code: Code, told: Told = not_told) -> str:
        """Of what some code does."""
        return digest_of("\n".join(sorted(self.does(code, told))).encode())

    def _words(self, statement: ast.stmt) -> bytes:
        """Without imports, and a module that a text names by what it holds."""

        def special(node: ast.AST) -> str | None:
            if isinstance(node, ast.Import | ast.ImportFrom) or is_for_types(node):
                return ""
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                return self._place_in(node.value)
            return None

        return normal(ast.Module([statement], []), special)

    def _place_in(self, text: str) -> str | None:
        """What counts of a text that names a module: where that lies does not."""
        if self.tree.file_of(text):
            return "(module)"
        found = OF_A_LAB.fullmatch(text)
        named = found and self.tree.file_of(found[1])
        return f"(module){found[2]}" if found and named else None


def _is_import(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Import | ast.ImportFrom) or is_for_types(statement)


def names_of(statement: ast.stmt) -> frozenset[str]:
    """The names to which a statement of a file gives a meaning."""
    if isinstance(statement, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        return frozenset({statement.name})
    if isinstance(statement, ast.Import | ast.ImportFrom):
        return frozenset(each.asname or each.name.partition(".")[0] for each in statement.names)
    stored = (node for node in ast.walk(statement) if isinstance(node, ast.Name))
    return frozenset(node.id for node in stored if isinstance(node.ctx, ast.Store))
