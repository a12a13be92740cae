"""A clone as its files are now, and how to see that one of them has become another.

What was opened by its own name counts by its bytes: somebody may have read its text. A Python file
of which only the bytecode was read counts by what it means: a comment or a blank line changes
nothing there. Its docstrings count, since students read those of graders and commands. A folder
counts by the names in it that git would keep. Where only some of its modules were opened, Python
has looked there for one that it knew by name: a new module beside them changes nothing, nor does a
new folder of modules. What is installed counts entry by entry: `needed/entries.py`.
"""

from __future__ import annotations

import ast
import subprocess
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path, PurePosixPath
from typing import Final, Literal

from needed.entries import pins, settings
from needed.opened import Opened
from roslings.workspace.normal import digest_of, normal, tree_of

BYTES: Final = "b"
MEANING: Final = "m"
NAMES: Final = "n"
NAMES_BUT_MODULES: Final = "o"
ENTRY: Final = "e"
Kind = Literal["b", "m", "n", "o", "e"]
"""Letters, since records hold many: bytes, meaning, names, other names than those of modules, and
an entry."""
RECORDS = "tests/proofs/needs"
"""What is recorded is no need: else each record would make the others stale."""
OF_ALL = {"pyproject.toml": settings, "constraints.txt": pins}
"""Files that say what is installed, to their entries. Every test needs each of them: where one is
another, so is what is installed, and no test opens all of that here."""
NOTES_ONLY = frozenset({"tests/costs.py", "tests/needed/left_out.py", "tests/needed/plugin.py"})
"""What is loaded with every test, and only notes what came of it, or leaves it out: no test passes
or fails by it."""
DIGITS = 12
"""Chance alone makes two of them equal once in 10^14 times."""
THERE, GONE = "+", "-"


class NoGit(Exception):
    """git does not say which files belong to a clone."""


@dataclass(frozen=True, order=True)
class Need:
    """A file or a folder of the clone, and what of it counts."""

    path: str
    """From the clone's root, which is the empty one itself; of an entry its file, and the entry."""
    kind: Kind

    @property
    def is_list(self) -> bool:
        """Of the names in a folder."""
        return self.kind in (NAMES, NAMES_BUT_MODULES)


@dataclass
class Tree:
    """The files in a clone that git keeps or would keep."""

    root: Path
    _entries: dict[str, frozenset[str]] = field(default_factory=dict)

    @cached_property
    def names(self) -> frozenset[str]:
        """From the root, with slashes. Raises NoGit."""
        words = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
        listed = subprocess.run(words, cwd=self.root, capture_output=True, text=True, check=False)
        if listed.returncode:
            raise NoGit(listed.stderr.strip())
        names = (name for name in listed.stdout.split("\0") if name and not _is_record(name))
        return frozenset(name for name in names if (self.root / name).exists())

    @cached_property
    def folders(self) -> dict[str, frozenset[str]]:
        """Each that holds such a file, at any depth, to the names that stand in it."""
        found: defaultdict[str, set[str]] = defaultdict(set)
        for name in self.names:
            path = PurePosixPath(name)
            for each in (path, *path.parents):
                if each.name:
                    found[_name(each.parent)].add(each.name)
        return {folder: frozenset(names) for folder, names in found.items()}

    @property
    def watched(self) -> Iterator[str]:
        """All folders, and those that hold the bytecode of their modules."""
        for folder in self.folders:
            yield folder
            yield f"{folder}/__pycache__" if folder else "__pycache__"

    def needs(self, test: str, opened: Opened) -> Iterator[Need]:
        """What a test file needs, where it has opened this. Its own text always counts."""
        for file in OF_ALL.keys() & self.names:
            yield from (Need(f"{file} {entry}", ENTRY) for entry in self.entries(file))
        by_bytes = (opened.files & self.names | {test}) - OF_ALL.keys() - NOTES_ONLY
        yield from (Need(name, BYTES) for name in by_bytes)
        yield from (
            Need(name, MEANING) for name in opened.modules & self.names - by_bytes - NOTES_ONLY
        )
        for folder in opened.folders & self.folders.keys():
            yield Need(folder, self._kind_of(folder, opened.files | opened.modules))

    def _kind_of(self, folder: str, opened: frozenset[str]) -> Kind:
        modules = (_joined(folder, name) for name in self.folders[folder] if _is_module(name))
        return NAMES if opened.issuperset(modules) else NAMES_BUT_MODULES

    def entries(self, file: str) -> frozenset[str]:
        """Of a file of what is installed; none where it is not there."""
        if file not in self._entries:
            text = self._content(file).decode() if file in self.names else ""
            self._entries[file] = frozenset(OF_ALL[file](text))
        return self._entries[file]

    def digest(self, need: Need) -> str:
        """What it is now; `GONE` where it is not there."""
        if need.kind == ENTRY:
            file, _, entry = need.path.partition(" ")
            return THERE if entry in self.entries(file) else GONE
        if need.is_list:
            return self._digest_of_names(need)
        if need.path not in self.names:
            return GONE
        content = self._content(need.path)
        return _short(meaning(content) if need.kind == MEANING else content)

    def _digest_of_names(self, need: Need) -> str:
        names = self.folders.get(need.path)
        if names is None:
            return GONE
        counted = names if need.kind == NAMES else self._but_modules(need.path, names)
        return _short("\0".join(sorted(counted)).encode())

    def _but_modules(self, folder: str, names: frozenset[str]) -> Iterator[str]:
        for name in names:
            inside = self.folders.get(_joined(folder, name), frozenset())
            if not any(map(_is_module, (name, *inside))):
                yield name

    def _content(self, name: str) -> bytes:
        """A link is where it leads to; what lies there has a name of its own."""
        file = self.root / name
        return bytes(file.readlink()) if file.is_symlink() else file.read_bytes()


def meaning(source: bytes) -> bytes:
    """What a Python file does and says, without how it is written; its bytes, if it is none."""
    tree = tree_of(source)
    if tree is None:
        return source
    return "\n".join([normal(tree).decode(), *docstrings(tree)]).encode()


def docstrings(tree: ast.Module) -> Iterator[str]:
    """In an order that every Python has; those that are missing, too."""
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    for node in ast.walk(tree):
        if isinstance(node, documented):
            yield ascii(ast.get_docstring(node, clean=False))


def _short(content: bytes) -> str:
    return digest_of(content)[:DIGITS]


def _name(path: PurePosixPath) -> str:
    return "" if path == PurePosixPath() else path.as_posix()


def _joined(folder: str, name: str) -> str:
    return f"{folder}/{name}" if folder else name


def _is_module(name: str) -> bool:
    return name.endswith(".py")


def _is_record(name: str) -> bool:
    return name.startswith(f"{RECORDS}/")


def few(names: Iterable[str], most: int = 3) -> str:
    """Some of them, and how many more."""
    found = sorted(names)
    more = f" and {len(found) - most} more" if len(found) > most else ""
    return f"{', '.join(found[:most])}{more}"
