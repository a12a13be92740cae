"""What Python source does, without how it is written: the same bytes under every Python we run on.

Comments, blank lines and docstrings leave no trace. `ast.dump` and `ast.unparse` write other texts
from one Python to the next, so the tree is written here.
"""

from __future__ import annotations

import ast
import hashlib
import warnings
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

Special = Callable[[ast.AST], str | None]
"""What stands for a node in place of its own words; None: its own words. Empty: nothing."""

LARGEST_CODE_BYTES = 1_000_000
PIECE_BYTES = 1024 * 1024
WITHOUT_MEANING = frozenset({"kind", "type_comment", "type_ignores", "lineno", "col_offset"})
"""Fields of a node that change nothing of what it does: `u''`, comments with types."""
HAVE_DOCSTRINGS = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)


def digest_of(content: bytes) -> str:
    """One word for some bytes."""
    return hashlib.sha256(content).hexdigest()


def digest_of_all(digests: Mapping[str, str]) -> str:
    """One word for a number of named digests, in any order."""
    lines = (f"{name}\0{digest}\n" for name, digest in sorted(digests.items()))
    return digest_of("".join(lines).encode())


def digest_of_files(files: Iterable[tuple[str, Path]]) -> str:
    """Of a package's files, each with its name in it; Python counts by what it does."""
    return digest_of_all({name: digest_of_file(path) for name, path in files})


def digest_of_file(path: Path) -> str:
    """Of one file; Python that cannot be read counts by its bytes, as all other files do."""
    if path.suffix != ".py" or path.stat().st_size > LARGEST_CODE_BYTES:
        return _digest_of_bytes(path)
    content = path.read_bytes()
    try:
        tree = tree_of(content)
        return digest_of(normal(tree) if tree else content)
    except RecursionError:  # Python reads what is nested deeper than we go
        return digest_of(content)


def _digest_of_bytes(path: Path) -> str:
    """A piece at a time: it may be as large as a package may be."""
    content = hashlib.sha256()
    with path.open("rb") as file:
        while piece := file.read(PIECE_BYTES):
            content.update(piece)
    return content.hexdigest()


def tree_of(content: bytes) -> ast.Module | None:
    """The syntax tree; None where Python cannot read it."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return ast.parse(content)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def normal(tree: ast.AST, special: Special = lambda node: None) -> bytes:
    """The tree in words, each node by its class and the fields that hold something."""
    words: list[str] = []
    _write(tree, special, words)
    return "".join(words).encode()


def _write(node: ast.AST, special: Special, words: list[str]) -> None:
    instead = special(node)
    if instead is not None:
        words.append(instead)
        return
    words.append(f"({type(node).__name__}")
    for name in node._fields:
        value = getattr(node, name, None)
        if name not in WITHOUT_MEANING and value is not None and value != []:
            words.append(f" {name}=")
            _write_value(node, name, value, special, words)
    words.append(")")


def _write_value(
    node: ast.AST, name: str, value: object, special: Special, words: list[str]
) -> None:
    if isinstance(value, ast.AST):
        _write(value, special, words)
    elif isinstance(value, list):
        words.append("[")
        for each in value[_docstrings(node, name) :]:
            if not _is_empty_text(node, each):
                _write_value(node, "", each, special, words)
        words.append("]")
    else:
        words.append(ascii(value))  # repr() asks which letters can be printed: newer Pythons more


def _docstrings(node: ast.AST, field: str) -> int:
    """How many statements at the start of this field are a docstring: one or none."""
    if field != "body" or not isinstance(node, HAVE_DOCSTRINGS):
        return 0
    return int(ast.get_docstring(node, clean=False) is not None)


def _is_empty_text(node: ast.AST, part: object) -> bool:
    """A piece of an f-string with nothing in it: Python 3.12 alone makes some."""
    return isinstance(node, ast.JoinedStr) and isinstance(part, ast.Constant) and part.value == ""
