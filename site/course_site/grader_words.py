"""What graders are written with: actions of experiments, and demands of checks.

All is read from source, nothing is imported. A word's example is in its docstring, behind `>>>`, or
else it is the shortest line of the course's own graders that uses it.
"""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cache, cached_property
from importlib.util import find_spec
from pathlib import Path

from sphinx.application import Sphinx

from course_site.api import prose
from course_site.course import MarkdownDirective
from roslings.capability import BUILT_IN
from roslings.course.labs import engine_root, example_root

ENGINE = "roslings"
SCENE, UNOBSERVED = f"{ENGINE}.experiment.scene", f"{ENGINE}.experiment.unobserved"
BASES = {"stage": "Stage", "running": "Running", "watching": "Watching", "speaking": "Speaking"}
"""Module beside the scene's to the class in it: what a scene can do stands in these."""
BESIDE = (("running", "Run"), ("slips", "mending"))
"""What is no method of it, and goes with it."""
UNOBSERVED_IS_JUDGED = f"{ENGINE}.judge.unobserved"
JUDGE, VIEWS = f"{ENGINE}.judge.demands", f"{ENGINE}.judge.views"
READ_BY_CHECKS = ("ExperimentView", "PackageView", "View")
"""What a check is given, and what all views can do."""
MAIN = ("act", "demands")
LONGEST_LINE = 96
VIEW = re.compile(r"(\w*View)")
INSISTS = ("require_", "insist_")
"""Parts of demands, which hold a machine or a finding against a package."""

Function = ast.FunctionDef
Node = Function | ast.ClassDef


@dataclass(frozen=True)
class Word:
    """One action, demand or view."""

    module: str
    node: Node
    owner: str = ""
    """The class that it is a method of."""

    @property
    def name(self) -> str:
        """As it is called in a grader."""
        return self.node.name

    @property
    def key(self) -> str:
        """Of no other word of its module."""
        return f"{self.owner}.{self.name}" if self.owner else self.name

    @property
    def signature(self) -> str:
        """What goes in, each with its type, and what comes out."""
        if isinstance(self.node, Function):
            return f"({_arguments(self.node, self.owner)}){_back(self.node)}"
        made = next((each for each in _functions(self.node) if each.name == "__init__"), None)
        fields = [ast.unparse(each) for each in self.node.body if isinstance(each, ast.AnnAssign)]
        return f"({_arguments(made, self.name) if made else ', '.join(fields)})"

    @property
    def about(self) -> str:
        """The first lines of its docstring, up to an empty one."""
        text = inspect.cleandoc(ast.get_docstring(self.node) or "")
        return " ".join(text.split("\n\n")[0].split())

    @cached_property
    def example(self) -> str:
        """One line, or few; empty where there is none."""
        return self._written or self._used

    @property
    def _written(self) -> str:
        text = inspect.cleandoc(ast.get_docstring(self.node) or "")
        lines = [line[4:] for line in text.splitlines() if line.startswith((">>> ", "... "))]
        return "\n".join(lines)

    @property
    def _used(self) -> str:
        """The shortest line of a grader that uses it, of those that can mean it."""
        found = [use for use in uses() if len(use.line) <= LONGEST_LINE and use.can_mean(self)]
        ranked = sorted((not use.is_whole, len(use.line), use.line) for use in found)
        return ranked[0][2] if ranked else ""


def _functions(node: ast.AST) -> Iterator[Function]:
    yield from (each for each in ast.iter_child_nodes(node) if isinstance(each, Function))


def _arguments(node: Function, owner: str) -> str:
    """Without `self`."""
    text = ast.unparse(node.args)
    return text.removeprefix("self").removeprefix(", ") if owner else text


def _back(node: Node) -> str:
    back = ast.unparse(node.returns) if isinstance(node, Function) and node.returns else "None"
    return "" if back == "None" else f" -> {back}"


# --- the words ---------------------------------------------------------------------------------


@cache
def actions() -> dict[str, tuple[Word, ...]]:
    """Module to what an experiment can do by it."""
    found = {SCENE: tuple(_of_scene()), UNOBSERVED: _of_class(UNOBSERVED, "Unobserved")}
    for name in filter(_acts, _modules()):
        given = {each for word in _public(name) for each in _gives(word)}
        words = (each for word in _public(name) for each in (word, *_methods(word)))
        found[name] = tuple(each for each in words if each.key not in given)
    return found


def _of_scene() -> Iterator[Word]:
    """As words of the scene, whichever class they stand in: an experiment is given a scene."""
    for module, owner in BASES.items():
        own = _of_class(_beside(module), owner)
        yield from (replace(word, module=SCENE, owner="Scene") for word in own)
    for module, name in BESIDE:
        found = (word for word in _public(_beside(module)) if word.name == name)
        yield from (replace(word, module=SCENE) for word in found)


def _beside(module: str) -> str:
    return f"{SCENE.rpartition('.')[0]}.{module}"


def _gives(word: Word) -> list[str]:
    """The class of what a block is given by a `with` of it: no grader makes one by itself."""
    return re.findall(r"^Iterator\[(\w+)", _back(word.node).removeprefix(" -> "))


@cache
def demands() -> dict[str, tuple[Word, ...]]:
    """Module to what a check can demand by it."""
    rooms = (JUDGE, UNOBSERVED_IS_JUDGED, *_modules())
    found = {name: tuple(filter(is_demand, _public(name))) for name in rooms}
    return {name: words for name, words in found.items() if any(map(_makes, words))}


def _makes(word: Word) -> bool:
    """A module without such a word has parts of demands, and none of its own."""
    return _back(word.node).startswith(" -> Demand[")


@cache
def views() -> tuple[Word, ...]:
    """What a check can look at."""
    return tuple(each for owner in READ_BY_CHECKS for each in _of_class(VIEWS, owner))


def is_demand(word: Word) -> bool:
    """`view.must(...)` takes it: it has a view, or it makes what has one."""
    node = word.node
    if not isinstance(node, Function) or word.owner or word.name.startswith(INSISTS):
        return False
    if _makes(word):
        return True
    takes = [_named(each) for each in node.args.args]
    return len(takes) == 1 and bool(VIEW.fullmatch(takes[0])) and not _back(node)


def demanded_of(word: Word) -> str:
    """The view that a demand is made of."""
    assert isinstance(word.node, Function)
    said = ast.unparse(word.node.returns or ast.Constant(None)), ast.unparse(word.node.args)
    found = next(VIEW.search(each) for each in said if VIEW.search(each))
    assert found
    return found[1]


def _modules() -> Iterator[str]:
    """All of the capabilities: what a room offers stands in more than one; the main ones first."""
    for name in _capabilities():
        folder = _file(f"{ENGINE}.capabilities.{name}").parent
        for file in sorted(folder.glob("*.py"), key=lambda file: (file.stem not in MAIN, file)):
            yield f"{ENGINE}.capabilities.{name}.{file.stem}"


def _capabilities() -> list[str]:
    """The built-in ones, and what else lies beside them: that comes in by an entry point."""
    beside = _file(f"{ENGINE}.capabilities").parent.glob("*/__init__.py")
    return [*BUILT_IN, *sorted({file.parent.name for file in beside} - set(BUILT_IN))]


def _acts(module: str) -> bool:
    """It works with a scene."""
    return any(
        isinstance(node, ast.ImportFrom) and node.module == SCENE for node in _tree(module).body
    )


def _file(module: str) -> Path:
    found = find_spec(module)
    assert found and found.origin, module
    return Path(found.origin)


@cache
def _tree(module: str) -> ast.Module:
    return ast.parse(_file(module).read_text("utf-8"))


def _public(module: str) -> tuple[Word, ...]:
    nodes = (each for each in _tree(module).body if isinstance(each, Function | ast.ClassDef))
    return tuple(Word(module, each) for each in nodes if not each.name.startswith("_"))


def _methods(word: Word) -> tuple[Word, ...]:
    """Of a class: what can be done with it."""
    if not isinstance(word.node, ast.ClassDef):
        return ()
    return tuple(
        Word(word.module, each, word.name)
        for each in _functions(word.node)
        if not each.name.startswith("_") and not _is_read(each)
    )


def _is_read(node: Function) -> bool:
    """A value, and nothing that is done."""
    return any(ast.unparse(each) in ("property", "cached_property") for each in node.decorator_list)


def _of_class(module: str, name: str) -> tuple[Word, ...]:
    return _methods(next(each for each in _public(module) if each.name == name))


# --- how graders use them ----------------------------------------------------------------------


@dataclass(frozen=True)
class Use:
    """A line of a grader, and the words that it calls or names."""

    line: str
    is_whole: bool
    """A statement, or the head of a block; else only what is called in a longer one."""
    names: frozenset[str]
    """Used as they are: `have_rate`."""
    methods: frozenset[tuple[str, str]]
    """Called of something: what it is called in the grader, and the method."""
    within: Within

    def can_mean(self, word: Word) -> bool:
        """A method by the type of what it is called of, else by the grader's imports."""
        if word.owner:
            return any(
                name == word.name and self.within.may_be(of, word) for of, name in self.methods
            )
        return word.name in self.names and self.within.takes(word)


@dataclass(frozen=True)
class Within:
    """The function and the file that a line stands in."""

    taken: frozenset[tuple[str, str]]
    """Module and name, as the file imports them."""
    types: frozenset[tuple[str, str]]
    """What the function is given, to its type."""

    def takes(self, word: Word) -> bool:
        """It is imported, from where it is or from the room around that."""
        places = (word.module, word.module.rpartition(".")[0])
        return any((place, word.name) in self.taken for place in places)

    def may_be(self, name: str, word: Word) -> bool:
        """Whether what the grader calls `name` can be of the word's class."""
        said = dict(self.types).get(name)
        if word.module in (SCENE, UNOBSERVED, VIEWS):
            return said == word.owner or (word.owner == "View" and said in READ_BY_CHECKS)
        return said is None and any(module == word.module for module, _ in self.taken)


@cache
def uses() -> tuple[Use, ...]:
    """All of the graders that lie beside the engine."""
    places = (engine_root() / "graders", example_root() / "graders")
    files = sorted({file for place in places for file in place.rglob("*.py")})
    return tuple(use for file in files for use in _uses_in(ast.parse(file.read_text("utf-8"))))


def _uses_in(tree: ast.Module) -> Iterator[Use]:
    taken = frozenset(
        (node.module or "", each.name)
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom)
        for each in node.names
    )
    for function in _functions(tree):
        types = frozenset((each.arg, _named(each)) for each in function.args.args)
        for statement in function.body:
            yield from _uses_below(statement, Within(taken, types))
    for statement in tree.body:
        if isinstance(statement, ast.Assign):
            yield from _uses_below(statement, Within(taken, frozenset()))


def _named(argument: ast.arg) -> str:
    return ast.unparse(argument.annotation) if argument.annotation else ""


def _uses_below(statement: ast.stmt, within: Within) -> Iterator[Use]:
    """Each statement and each head of a block as a whole, and each call for itself."""
    for node in ast.walk(statement):
        if isinstance(node, ast.With):
            yield _use(f"with {', '.join(map(ast.unparse, node.items))}:", node.items, within)
        elif isinstance(node, ast.Expr | ast.Assign | ast.Return):
            yield _use(ast.unparse(node), [node], within)
        elif isinstance(node, ast.Call):
            yield _use(ast.unparse(node), [node], within, is_whole=False)


def _use(line: str, parts: Iterable[ast.AST], within: Within, is_whole: bool = True) -> Use:
    nodes = [node for part in parts for node in ast.walk(part)]
    if not is_whole:  # what the call itself is of, not what stands in its brackets
        nodes = [nodes[0], *ast.walk(nodes[0].func)]  # type: ignore[attr-defined]
    called = [node.func for node in nodes if isinstance(node, ast.Call)]
    methods = {
        (ast.unparse(each.value), each.attr) for each in called if isinstance(each, ast.Attribute)
    }
    names = {node.id for node in nodes if isinstance(node, ast.Name)}
    return Use(line, is_whole, frozenset(names), frozenset(methods), within)


# --- the page ----------------------------------------------------------------------------------


class GraderWords(MarkdownDirective):
    """`{grader-words} actions`, `demands` or `views`."""

    required_arguments = 1

    def markdown(self) -> str:
        """A section a module, an entry a word."""
        if self.arguments[0] == "views":
            return "\n\n".join(map(_entry, views()))
        found = {"actions": actions, "demands": demands}[self.arguments[0]]()
        return "\n\n".join(_section(name, words) for name, words in found.items() if words)


def _section(module: str, words: Iterable[Word]) -> str:
    return "\n\n".join([f"### `{module}`", *map(_entry, words)])


def _entry(word: Word) -> str:
    """Its name and what it does; below, how it is written, and an example."""
    of = f", of a `{demanded_of(word)}`" if is_demand(word) else ""
    head = f"**`{word.key}`**`{word.signature}`{of}"
    return f"{head}\n: {prose(word.about)}\n\n  ```python\n{_indented(word.example)}\n  ```"


def _indented(code: str) -> str:
    return "\n".join(f"  {line}" for line in code.splitlines())


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.add_directive("grader-words", GraderWords)
