"""What of the engine serves exactly one lab: read from imports.

    .venv/bin/python tests/one_lab_only.py

Users of a module are the labs whose graders lead to it, courses outside of this one that a test
proves, and whatever is typed. What one lab alone uses belongs into the folder beside its grader
(`roslings/folders/lab_folders.py`), unless it is a concept of ROS: then a course outside uses it
too, with other names, types and numbers. `EXPLAINED` says of which that is not so yet.
"""

from __future__ import annotations

import ast
import re
import sys
from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping
from functools import cache
from pathlib import Path

from roslings.course import all_labs
from roslings.folders.lab_folders import GRADERS
from roslings_prove.proofs.closure import Code, Modules, ModuleTree
from roslings_prove.proofs.digests import START
from sources import ROOT, sources

ENGINE = "roslings"
TABLE = "roslings.capability"
"""It names all capabilities, and needs none."""
TYPED = "what is typed"
COURSES_OUTSIDE = ("example-course/course", "tests/outside/courses/*")
WALKS = ("site/pages/teachers/a-larger-lab.md",)
"""Pages that lead to a lab of another course; a test goes each way."""
CODE = re.compile(r"^```python\n(.*?)^```", re.DOTALL | re.MULTILINE)

EXPLAINED: Mapping[str, str] = {
    "roslings.walks": "it knows no lab and no ROS; each lab with a state is to be walked through"
}
"""Module, or the room that it lies in, to why it is where it is."""


def main() -> int:
    """Print what serves one lab, with the statements of each module."""
    modules, alone = Modules(tree()), serves_one_lab()
    for lab, names in sorted(alone.items()):
        counts = {name: statements(modules.code(name).body) for name in sorted(names)}
        print(f"{lab}: {sum(counts.values())} statements")
        for name, count in counts.items():
            print(f"  {count:5} {name}{'' if is_explained(name) else '  NOT EXPLAINED'}")
    return 0


def tree() -> ModuleTree:
    """Of this course."""
    return ModuleTree(tuple(sources()), ROOT / GRADERS)


def serves_one_lab() -> dict[str, set[str]]:
    """Lab to the modules of the engine that nobody else uses."""
    users: defaultdict[str, set[str]] = defaultdict(set)
    for user, names in reached_by_users().items():
        for name in names:
            users[name].add(user)
    labs, found = {lab.name for lab in all_labs()}, defaultdict[str, set[str]](set)
    for name, who in users.items():
        if len(who) == 1 and who <= labs and name.partition(".")[0] == ENGINE:
            found[next(iter(who))].add(name)
    return dict(found)


@cache
def reached_by_users() -> dict[str, frozenset[str]]:
    """User to the modules that it leads to."""
    modules = Modules(tree())
    begin = {
        TYPED: typed(modules.tree),
        **{lab.name: _taken_by(modules, lab.grader) for lab in all_labs()},
        **{str(file.relative_to(ROOT)): _taken_by(modules, file) for file in graders_outside()},
        **{walk: _taken_in(modules, ROOT / walk) for walk in WALKS},
    }
    return {user: frozenset(_reached(modules, names)) for user, names in begin.items()}


def graders_outside() -> Iterator[Path]:
    """Those of other courses, and what lies beside them."""
    for place in COURSES_OUTSIDE:
        yield from sorted(ROOT.glob(f"{place}/{GRADERS}/**/*.py"))


def typed(tree: ModuleTree) -> set[str]:
    """Where each command begins, and where measuring does."""
    names = (tree.name_of(file) for above in tree.sources for file in above.rglob("*.py"))
    others = {name for name in names if not f"{name}.".startswith(f"{ENGINE}.capabilities.")}
    own = {name for name in others if name.startswith(f"{ENGINE}.")}
    return (others - own) | {name for name in own if ".commands." in name} | {*START}


def _taken_by(modules: Modules, file: Path) -> set[str]:
    """What a file imports of ours; what lies beside it is none of this course."""
    return _imports(modules, Code(file, ast.parse(file.read_bytes()), modules.tree))


def _taken_in(modules: Modules, page: Path) -> set[str]:
    """What the code of a page imports."""
    lines = _whole_imports("\n".join(CODE.findall(page.read_text("utf-8"))))
    return _imports(modules, Code(page, ast.parse("\n".join(lines)), modules.tree))


def _imports(modules: Modules, code: Code) -> set[str]:
    taken = {each.module for each in code.imports if each.module}
    return {name for each in taken for name in modules.tree.with_parents(each)}


def _whole_imports(text: str) -> Iterator[str]:
    """Lines that begin with `from` or `import`, up to the end of each."""
    for found in re.finditer(r"^(?:from \S+ )?import (?:\([^)]*\)|.+)$", text, re.MULTILINE):
        yield found[0]


def _reached(modules: Modules, start: Collection[str]) -> set[str]:
    found: set[str] = set()
    todo = [*start]
    while todo:
        name = todo.pop()
        if name not in found:
            found.add(name)
            code = modules.code(name)
            todo += _imports(modules, code) if name == TABLE else code.modules
    return found


def statements(body: ast.Module) -> int:
    """Without docstrings."""
    nodes = [node for node in ast.walk(body) if isinstance(node, ast.stmt)]
    texts = [
        node
        for node in nodes
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    ]
    return len(nodes) - len(texts)


def is_explained(name: str) -> bool:
    """By itself, or with the room that it lies in."""
    return any(name == known or name.startswith(f"{known}.") for known in EXPLAINED)


if __name__ == "__main__":
    sys.exit(main())
