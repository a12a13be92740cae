"""Small changes that make a package of a lab wrong, one at a time: which there are.

What a card does not ask for is left as it is, and what the lab has given.
"""

from __future__ import annotations

import ast
import difflib
import re
import textwrap
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

import libcst as cst

from roslings.course import Lab
from roslings_changes.card_words import words_of
from roslings_changes.flow import called
from roslings_changes.operators import OPERATORS
from roslings_changes.source import ModuleSource, read_source


@dataclass(frozen=True)
class CodeChange:
    """One module of a package, made wrong in one place."""

    operator: str
    file: str
    """Of the package, with `/`."""
    line: int
    before: str
    after: str

    @cached_property
    def diff(self) -> str:
        """What is changed: lines with `-` and `+`, and where they stand."""
        before, after = self.before.splitlines(), self.after.splitlines()
        return "\n".join(list(difflib.unified_diff(before, after, n=0, lineterm=""))[2:])

    @cached_property
    def changed(self) -> str:
        """The changed lines alone, wherever they stand."""
        return "\n".join(line for line in self.diff.splitlines() if not line.startswith("@@"))

    @property
    def place(self) -> tuple[str, int]:
        """The line that was changed."""
        return self.file, self.line


LARGEST_BYTES = 100_000
"""A larger module is no student's, and LibCST would take long."""


def candidates(lab: Lab, package: Path) -> list[CodeChange]:
    """All that the operators make of a package of this lab, each program once.

    Raises ParserSyntaxError of LibCST where a module is no Python.
    """
    found: dict[tuple[str, str], CodeChange | None] = {}
    for file in modules_of(lab, package):
        source = read_source(package, file)
        found[file, _meaning(source.text)] = None
        for each in _changed(lab, source):
            if meaning := _meaning(each.after):
                found.setdefault((file, meaning), each)
    return [each for each in found.values() if each]


def modules_of(lab: Lab, package: Path) -> Iterator[str]:
    """The modules that a student writes: those that the starter has word for word are given."""
    name = lab.outline.package
    for path in sorted((package / name).glob("*.py")):
        given = lab.starter / name / path.name
        if path.is_symlink() or path.stat().st_size > LARGEST_BYTES:
            continue
        content = path.read_bytes()
        if content.strip() and not (given.is_file() and given.read_bytes() == content):
            yield path.relative_to(package).as_posix()


def _changed(lab: Lab, source: ModuleSource) -> Iterator[CodeChange]:
    given = given_functions(lab, source)
    for node in source.nodes():
        if given & {node, *source.around(node)} or _is_own_log(lab, node, source):
            continue
        for operator, change in OPERATORS.items():
            if operator == "text" and not _is_promised(lab, node):
                continue
            if operator == "number" and not _is_near_the_card(lab, node):
                continue
            for new in change(node, source):
                text = source.with_new(node, new)
                line = _first_difference(source.text, text)
                yield CodeChange(operator, source.file, line, source.text, text)


# --- what no card asks for: the author's own, and what is given ---------------------------------

LOGS = frozenset({"debug", "info", "warning", "warn", "error", "fatal", "print"})
SMALL = 3
"""Up to so much, a whole number counts things or names one of them."""


def given_functions(lab: Lab, source: ModuleSource) -> frozenset[cst.CSTNode]:
    """The functions that the starter has word for word, but for remarks."""
    file = lab.starter / source.file
    if not file.is_file():
        return frozenset()
    there = _definitions(cst.parse_module(file.read_text("utf-8")))
    own = _definitions(source.module)
    return frozenset(node for code, node in own.items() if code in there)


def _definitions(module: cst.Module) -> dict[str, cst.CSTNode]:
    """What it does to each function that a module or a class of it defines."""
    blocks = [each.body.body for each in module.body if isinstance(each, cst.ClassDef)]
    nodes = [node for block in (module.body, *blocks) for node in block]
    return {
        _meaning(textwrap.dedent(module.code_for_node(node)).strip()): node
        for node in nodes
        if isinstance(node, cst.FunctionDef)
    }


def _is_own_log(lab: Lab, node: cst.CSTNode, source: ModuleSource) -> bool:
    """It stands in, or is, a line that writes what no card names."""
    around = (node, *source.around(node))
    line = next((each for each in around if isinstance(each, cst.SimpleStatementLine)), None)
    match line:
        case cst.SimpleStatementLine(body=[cst.Expr(value=cst.Call() as call)]):
            return called(call) in LOGS and not any(_is_promised(lab, arg) for arg in call.args)
    return False


def _is_promised(lab: Lab, node: cst.CSTNode) -> bool:
    """The card asks for some piece of this text: other texts are the author's own."""
    texts = [each for each in _texts_in(node) if len(each.strip()) >= SMALL]
    return any(text in asked for text in texts for asked in _asked_texts(lab.folder))


def _texts_in(node: cst.CSTNode) -> Iterator[str]:
    """What stands between the quotes, without what is put in."""
    match node:
        case cst.SimpleString():
            yield node.raw_value
        case cst.FormattedStringText(value=value):
            yield value
        case _:
            for child in node.children:
                yield from _texts_in(child)


def _is_near_the_card(lab: Lab, node: cst.CSTNode) -> bool:
    """A number that counts, or that the card has: by how little others may be off, nobody said."""
    match node:
        case cst.Integer(value=value) if int(value, 0) > SMALL:
            return float(int(value, 0)) in _asked_numbers(lab.folder)
        case cst.Float(value=value) if float(value):
            return float(value) in _asked_numbers(lab.folder)
    return True


@cache
def _asked_texts(folder: Path) -> tuple[str, ...]:
    return tuple(each for each in _words_of(folder) if isinstance(each, str))


@cache
def _asked_numbers(folder: Path) -> frozenset[float]:
    """The numbers of the card, and those within its texts."""
    found = [each for each in _words_of(folder) if isinstance(each, int | float)]
    within = re.findall(r"\d+(?:\.\d+)?", " ".join(_asked_texts(folder)))
    return frozenset(float(each) for each in (*found, *within))


def _words_of(folder: Path) -> Iterator[object]:
    """What the card says, without what is for people or says in words what the package does."""
    for word in words_of(folder / "card.yaml"):
        yield from _parts(word.value)


def _parts(value: object) -> Iterator[object]:
    match value:
        case dict():
            for each in value.values():
                yield from _parts(each)
        case list() | tuple():
            for each in value:
                yield from _parts(each)
        case _:
            yield value


def _first_difference(before: str, after: str) -> int:
    """The line, from 1, from which on two texts differ."""
    pairs = zip(before.splitlines(), after.splitlines(), strict=False)
    same = next((at for at, (one, other) in enumerate(pairs) if one != other), None)
    return (len(after.splitlines()) if same is None else same) + 1


def _meaning(text: str) -> str:
    """The program without comments and layout; empty where it is none."""
    try:
        compile(text, "generated", "exec", dont_inherit=True)
        return ast.dump(ast.parse(text))
    except (SyntaxError, ValueError):
        return ""
