"""Read Python files without running them: mistakes of syntax, imports, and setup.py's words."""

from __future__ import annotations

import ast
import configparser
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from roslings.workspace.bounded import is_memory_full

LARGEST_BYTES = 1_000_000


class NotPython(Exception):
    """Python cannot read a file; says `line: message`."""

    def __init__(self, line: int, message: str) -> None:
        super().__init__(f"{line}: {message}")


def parse(path: Path) -> ast.Module:
    """The syntax tree of a file. Raises NotPython."""
    if path.stat().st_size > LARGEST_BYTES:
        raise NotPython(1, f"the file has {path.stat().st_size:,} bytes: too many to be code")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # warnings about the student's code are not ours
            tree = ast.parse(path.read_bytes(), path.name)
            compile(tree, path.name, "exec", dont_inherit=True)
        return tree
    except SyntaxError as error:
        raise NotPython(error.lineno or 1, error.msg) from error
    except (ValueError, RecursionError) as error:  # zero bytes, endless brackets
        raise NotPython(1, str(error) or "too deeply nested") from error
    except MemoryError as error:
        if is_memory_full():  # else Python says so of what is nested too deeply
            raise
        raise NotPython(1, str(error) or "too deeply nested") from error


def imports(tree: ast.Module) -> Iterator[tuple[str, int]]:
    """Each package that a file imports, by its first name, with the line."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((alias.name.partition(".")[0], node.lineno) for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module.partition(".")[0], node.lineno


@dataclass
class Setup:
    """What setup.py says in so many words; what it computes stays empty."""

    name: str | None = None
    console_scripts: dict[str, str] = field(default_factory=dict)
    """Name of an executable to `module:function`."""
    markers: list[str] = field(default_factory=list)
    """Files that it installs into the index of packages, e.g. `resource/lamp`."""


def read_setup(tree: ast.Module) -> Setup:
    """Read the call of `setup(...)` in setup.py."""
    constants = _constants(tree)
    call = next((node for node in ast.walk(tree) if _is_setup(node)), None)
    words = {word.arg: word.value for word in call.keywords} if isinstance(call, ast.Call) else {}
    return Setup(
        name=_text(words.get("name"), constants),
        console_scripts=dict(_scripts(words.get("entry_points"), constants)),
        markers=list(_markers(words.get("data_files"), constants)),
    )


def script_folders(path: Path) -> dict[str, str]:
    """Where setup.cfg puts executables: `develop` and `install`, each to its folder.

    Raises configparser.Error and UnicodeDecodeError for what is no setup.cfg.
    """
    parser = configparser.RawConfigParser()
    parser.read_string(path.read_text("utf-8-sig"), path.name)
    wanted = {
        "develop": ("script_dir", "script-dir"),
        "install": ("install_scripts", "install-scripts"),
    }
    return {
        section: parser.get(section, option)
        for section, options in wanted.items()
        for option in options
        if parser.has_option(section, option)
    }


def _is_setup(node: ast.AST) -> bool:
    if not isinstance(node, ast.Call):
        return False
    called = node.func
    name = called.attr if isinstance(called, ast.Attribute) else getattr(called, "id", "")
    return name == "setup"


def _constants(tree: ast.Module) -> dict[str, str]:
    """Names at the top of a file that stand for a text, e.g. `package_name = 'chatter'`."""
    return {
        target.id: statement.value.value
        for statement in tree.body
        if isinstance(statement, ast.Assign)
        and isinstance(statement.value, ast.Constant)
        and isinstance(statement.value.value, str)
        for target in statement.targets
        if isinstance(target, ast.Name)
    }


def _text(node: ast.AST | None, constants: dict[str, str]) -> str | None:
    """The text that an expression means, where it is put together of plain parts."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.Name):
        return constants.get(node.id)
    if isinstance(node, ast.FormattedValue):
        return _text(node.value, constants)
    if isinstance(node, ast.JoinedStr):
        return _joined(node.values, constants)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        return _joined([node.left, node.right], constants)
    return None


def _joined(parts: list[ast.expr], constants: dict[str, str]) -> str | None:
    texts = [_text(part, constants) for part in parts]
    return None if None in texts else "".join(text or "" for text in texts)


def _scripts(node: ast.AST | None, constants: dict[str, str]) -> Iterator[tuple[str, str]]:
    for line in _elements(_value(node, "console_scripts")):
        name, equals, target = (_text(line, constants) or "").partition("=")
        if equals:
            yield name.strip(), target.strip()


def _markers(node: ast.AST | None, constants: dict[str, str]) -> Iterator[str]:
    for pair in _elements(node):
        folder, *rest = _elements(pair) or [pair]
        if rest and (_text(folder, constants) or "").endswith("resource_index/packages"):
            texts = (_text(name, constants) for name in _elements(rest[0]))
            yield from (text for text in texts if text)


def _value(node: ast.AST | None, key: str) -> ast.AST | None:
    if not isinstance(node, ast.Dict):
        return None
    pairs = zip(node.keys, node.values, strict=True)
    return next((v for k, v in pairs if isinstance(k, ast.Constant) and k.value == key), None)


def _elements(node: ast.AST | None) -> list[ast.expr]:
    return node.elts if isinstance(node, (ast.List, ast.Tuple)) else []
