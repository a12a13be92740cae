"""Reads a student's packages without running them: package.xml, setup.py, the Python files.

setup.py is read as a syntax tree; only constants, names, lists and a few well-known calls are
followed. Where it does something else, the reader says so instead of guessing.
"""

from __future__ import annotations

import ast
import os
import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TypeAlias

from ros_doctor.machine import exists, read_text
from ros_doctor.texts import said

SKIPPED = frozenset(("build", "install", "log", "node_modules", "venv", "__pycache__"))
DEPEND_TAGS = ("depend", "exec_depend", "build_depend", "test_depend", "run_depend")
DEEPEST = 6

Value: TypeAlias = "str | list[Value] | dict[str, Value]"


class TooClever(Exception):
    """An expression of setup.py that cannot be read without running it."""


@dataclass(frozen=True)
class EntryPoint:
    """One line of console_scripts: `talker = chatter.talker:main`."""

    text: str
    name: str = ""
    module: str = ""
    function: str = ""


@dataclass(frozen=True)
class SetupPy:
    """What setup.py tells setuptools; None where it cannot be read without running it."""

    entry_points: tuple[EntryPoint, ...] | None
    installed: tuple[str, ...] | None
    problem: str = ""


@dataclass(frozen=True)
class WorkspacePackage:
    """One ROS package in the student's workspace, read lazily."""

    folder: Path

    @cached_property
    def manifest(self) -> PackageXml:
        """What package.xml says."""
        return read_manifest(self.folder / "package.xml")

    @property
    def name(self) -> str:
        """The name that package.xml gives, or the folder's where it gives none."""
        return self.manifest.name or self.folder.name

    @cached_property
    def setup(self) -> SetupPy | None:
        """What setup.py says; None in a package without one."""
        path = self.folder / "setup.py"
        return read_setup(path) if exists(path) else None

    @property
    def is_python(self) -> bool:
        """True for an ament_python package."""
        return self.manifest.build_type == "ament_python" or (
            not self.manifest.build_type and self.setup is not None
        )

    @cached_property
    def modules(self) -> tuple[Path, ...]:
        """The Python files of the package itself, without tests and setup.py."""
        return tuple(sorted((self.folder / self.name).rglob("*.py")))

    @property
    def launch_files(self) -> tuple[Path, ...]:
        """The launch files of the package."""
        found = [*self.folder.glob("*.launch.*"), *self.folder.glob("launch/**/*.launch.*")]
        return tuple(sorted({path for path in found if path.suffix in (".py", ".xml", ".yaml")}))


@dataclass(frozen=True)
class PackageXml:
    """package.xml: `problem` says what is wrong with it, in a few words."""

    name: str = ""
    build_type: str = ""
    depends: frozenset[str] = field(default_factory=frozenset)
    problem: str = ""


def read_manifest(path: Path) -> PackageXml:
    """Read a package.xml; a broken one comes back with a problem."""
    try:
        tree = ElementTree.fromstring(read_text(path))
    except ElementTree.ParseError as error:
        return PackageXml(problem=_not_valid(error.position[0], "XML"))
    depends = {(one.text or "").strip() for tag in DEPEND_TAGS for one in tree.iter(tag)}
    build_type = (tree.findtext("export/build_type") or "").strip()
    name = (tree.findtext("name") or "").strip()
    return PackageXml(name, build_type, frozenset(depends), _manifest_problem(tree))


def _not_valid(line: int, language: str) -> str:
    text = "line {line} is not valid {language}"
    return said("doctor.packages.not_valid", text, line=line, language=language)


def _manifest_problem(tree: ElementTree.Element) -> str:
    for tag in ("name", "version", "description", "maintainer", "license"):
        if not (tree.findtext(tag) or "").strip():
            return said("doctor.packages.missing", "<{tag}> is missing or empty", tag=tag)
    name = (tree.findtext("name") or "").strip()
    if not re.fullmatch(r"[a-zA-Z][a-zA-Z0-9_-]*", name):
        text = "the name '{name}' has letters that a package name may not have"
        return said("doctor.packages.name", text, name=name)
    if not re.fullmatch(r"\d+\.\d+\.\d+", (tree.findtext("version") or "").strip()):
        text = "{tag} must be three numbers, as in 0.0.1"
        return said("doctor.packages.version", text, tag="<version>")
    maintainer = tree.find("maintainer")
    email = maintainer.get("email", "") if maintainer is not None else ""
    if not re.fullmatch(r"[\w.+-]+@[\w-]+(\.[\w-]+)+", email):
        text = "the maintainer's email '{email}' is not an email address"
        return said("doctor.packages.email", text, email=email)
    return ""


def find_packages(top: Path) -> tuple[WorkspacePackage, ...]:
    """Return the packages under `top`, without build folders and those marked COLCON_IGNORE."""
    return tuple(WorkspacePackage(folder) for folder in _package_folders(top))


def _package_folders(top: Path) -> Iterator[Path]:
    for name, folders, files in os.walk(top):
        folder = Path(name)
        depth = len(folder.relative_to(top).parts)
        if "COLCON_IGNORE" in files or depth > DEEPEST:
            folders.clear()
        elif "package.xml" in files:
            folders.clear()  # packages do not nest
            yield folder
        else:
            folders[:] = sorted(f for f in folders if f not in SKIPPED and not f.startswith("."))


def read_setup(path: Path) -> SetupPy:
    """Read a setup.py as a syntax tree; nothing in it is run."""
    try:
        tree = ast.parse(read_text(path))
    except (SyntaxError, ValueError) as error:
        return SetupPy(None, None, _not_valid(getattr(error, "lineno", 1), "Python"))
    call = next((node for node in ast.walk(tree) if _called(node) == "setup"), None)
    if not isinstance(call, ast.Call):
        never = said("doctor.packages.never", "it never calls {function}", function="setup()")
        return SetupPy(None, None, never)
    words = {word.arg: word.value for word in call.keywords if word.arg}
    reader = SetupPyReader(_constants(tree), path.parent)
    return SetupPy(_entry_points(reader, words), _installed(reader, words))


def _called(node: ast.AST) -> str:
    if not isinstance(node, ast.Call):
        return ""
    if isinstance(node.func, ast.Attribute):
        return node.func.attr
    return node.func.id if isinstance(node.func, ast.Name) else ""


def _constants(tree: ast.Module) -> dict[str, ast.expr]:
    return {
        target.id: node.value
        for node in tree.body
        if isinstance(node, ast.Assign)
        for target in node.targets
        if isinstance(target, ast.Name)
    }


def _entry_points(
    reader: SetupPyReader, words: dict[str, ast.expr]
) -> tuple[EntryPoint, ...] | None:
    if "entry_points" not in words:
        return ()
    try:
        value = reader.value(words["entry_points"])
    except TooClever:
        return None
    scripts = value.get("console_scripts", []) if isinstance(value, dict) else None
    if not isinstance(scripts, (list, tuple)):
        return None
    return tuple(entry_point(str(line)) for line in scripts)


def entry_point(text: str) -> EntryPoint:
    """Read one line of console_scripts; the parts stay empty where it has another form."""
    match = re.fullmatch(r"\s*([\w.-]+)\s*=\s*([\w.]+)\s*:\s*([\w.]+)\s*(\[.*\])?", text)
    return EntryPoint(text, *match.groups()[:3]) if match else EntryPoint(text)


def _installed(reader: SetupPyReader, words: dict[str, ast.expr]) -> tuple[str, ...] | None:
    """Return the files that data_files names, relative to the package."""
    if "data_files" not in words:
        return ()
    try:
        value = reader.value(words["data_files"])
    except TooClever:
        return None
    if not isinstance(value, (list, tuple)):
        return None
    pairs = [pair for pair in value if isinstance(pair, (list, tuple)) and len(pair) == 2]
    files = [file for _, group in pairs if isinstance(group, (list, tuple)) for file in group]
    return tuple(os.path.normpath(str(file)) for file in files)


@dataclass(frozen=True)
class SetupPyReader:
    """Works out the plain values in a setup.py. `glob` is the only call that looks at files."""

    constants: dict[str, ast.expr]
    folder: Path

    def value(self, node: ast.expr) -> Value:
        """Return the value of an expression.

        Raises:
            TooClever: it cannot be known without running the file.
        """
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            return node.value
        if isinstance(node, ast.Name) and node.id in self.constants:
            return SetupPyReader(self._without(node.id), self.folder).value(self.constants[node.id])
        if isinstance(node, (ast.List, ast.Tuple)):
            return [self.value(item) for item in node.elts]
        if isinstance(node, ast.Dict):
            return self._dict(node)
        if isinstance(node, ast.JoinedStr):
            return "".join(self._text(part) for part in node.values)
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
            return self._sum(node)
        if isinstance(node, ast.Call):
            return self._call(node)
        raise TooClever(ast.dump(node))

    def _without(self, name: str) -> dict[str, ast.expr]:
        """Drop a name while it is followed: `a = a` must not go round for ever."""
        return {key: value for key, value in self.constants.items() if key != name}

    def _dict(self, node: ast.Dict) -> Value:
        pairs = zip(node.keys, node.values, strict=True)
        return {self._text(key): self.value(value) for key, value in pairs if key is not None}

    def _text(self, node: ast.expr) -> str:
        inner = node.value if isinstance(node, ast.FormattedValue) else node
        value = self.value(inner)
        if isinstance(value, str):
            return value
        raise TooClever("a text was expected")

    def _sum(self, node: ast.BinOp) -> Value:
        left, right = self.value(node.left), self.value(node.right)
        if isinstance(left, str) and isinstance(right, str):
            return left + right
        if isinstance(left, list) and isinstance(right, list):
            return left + right
        raise TooClever("a sum of unlike things")

    def _call(self, node: ast.Call) -> Value:
        name = _called(node)
        if name == "join":
            return "/".join(self._text(part) for part in node.args)
        if name == "glob" and node.args:
            found = self.folder.glob(self._text(node.args[0]))
            return [str(path.relative_to(self.folder)) for path in sorted(found)]
        raise TooClever(name)


def parse(path: Path) -> ast.Module | SyntaxError:
    """Return the syntax tree of a Python file, or the error in it."""
    try:
        return ast.parse(read_text(path))
    except SyntaxError as error:
        return error
    except ValueError as error:  # a zero byte
        return SyntaxError(str(error))


def defined_names(tree: ast.Module) -> set[str] | None:
    """Return the names that a module defines; None where `import *` may define any."""
    names: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            names.add(node.name)
        elif isinstance(node, (ast.Import, ast.ImportFrom)):
            names |= {alias.asname or alias.name for alias in node.names}
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            names.add(node.id)
    return None if "*" in names else names


def imported_packages(tree: ast.Module) -> set[str]:
    """Return the first part of every absolute import."""
    names: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names |= {alias.name.partition(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and not node.level and node.module:
            names.add(node.module.partition(".")[0])
    return names
