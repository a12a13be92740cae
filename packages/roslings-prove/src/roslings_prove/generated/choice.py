"""Which wrong packages are made of a lab's solution: the same ones each time, spread over it.

The seed is fixed, as the operators are. The order is that of hashes, so that a new operator or a
new line of a solution moves few of the others, and no version of Python moves any.
"""

from __future__ import annotations

import ast
import difflib
import hashlib
import re
import textwrap
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

import libcst as cst

from roslings.course import Lab
from roslings_prove.contract.words import words_of
from roslings_prove.generated.flow import called
from roslings_prove.generated.operators import OPERATORS
from roslings_prove.generated.source import Source, read_source

SEED = 20261123
WANTED = 100
"""So many packages of a lab; all, where fewer can be made."""


@dataclass(frozen=True)
class Generated:
    """One module of a solution, made wrong in one place."""

    lab: Lab
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

    @cached_property
    def name(self) -> str:
        """Short, and the same as long as the place and the change are."""
        short = hashlib.sha256(self.changed.encode()).hexdigest()[:8]
        place = f"{self.file.rpartition('/')[2]}:{self.line}"
        return f"{self.lab.name}-{self.operator}-{place}-{short}"

    @property
    def place(self) -> tuple[str, int]:
        """The line that was changed."""
        return self.file, self.line


def generated(lab: Lab) -> list[Generated]:
    """The wrong packages of a lab, as they were drawn: the first ones are spread over it, too."""
    return chosen(candidates(lab))


def candidates(lab: Lab) -> list[Generated]:
    """All that the operators make of a solution, each program once."""
    found: dict[tuple[str, str], Generated] = {}
    for file in modules_of(lab):
        source = read_source(lab.solution, file)
        found[file, _meaning(source.text)] = _none(lab)
        for each in _changed(lab, source):
            if meaning := _meaning(each.after):
                found.setdefault((file, meaning), each)
    return [each for each in found.values() if each.operator]


def chosen(found: Iterable[Generated]) -> list[Generated]:
    """As many as are wanted: the operators in turn, each time the line changed least so far."""
    by_operator: dict[str, list[Generated]] = {}
    for each in sorted(found, key=_drawn):
        by_operator.setdefault(each.operator, []).append(each)
    result: list[Generated] = []
    lines: Counter[tuple[str, int]] = Counter()
    while len(result) < WANTED and any(by_operator.values()):
        for waiting in filter(None, by_operator.values()):
            next_one = min(waiting, key=lambda each: lines[each.place])
            waiting.remove(next_one)
            lines[next_one.place] += 1
            result.append(next_one)
    return result[:WANTED]


def modules_of(lab: Lab) -> Iterator[str]:
    """The modules that a student writes: those that the starter has word for word are given."""
    package = lab.outline.package
    for path in sorted((lab.solution / package).glob("*.py")):
        given = lab.starter / package / path.name
        content = path.read_bytes()
        if content.strip() and not (given.is_file() and given.read_bytes() == content):
            yield path.relative_to(lab.solution).as_posix()


def _changed(lab: Lab, source: Source) -> Iterator[Generated]:
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
                yield Generated(lab, operator, source.file, line, source.text, text)


# --- what no card asks for: the author's own, and what is given ---------------------------------

LOGS = frozenset({"debug", "info", "warning", "warn", "error", "fatal", "print"})
SMALL = 3
"""Up to so much, a whole number counts things or names one of them."""


def given_functions(lab: Lab, source: Source) -> frozenset[cst.CSTNode]:
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
        for node in nodes if isinstance(node, cst.FunctionDef)
    }  # fmt: skip


def _is_own_log(lab: Lab, node: cst.CSTNode, source: Source) -> bool:
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


def _drawn(each: Generated) -> str:
    return hashlib.sha256(f"{SEED} {each.name}".encode()).hexdigest()


def _none(lab: Lab) -> Generated:
    """The solution itself: who makes it again has made nothing."""
    return Generated(lab, "", "", 0, "", "")
