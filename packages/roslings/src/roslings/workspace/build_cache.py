"""A build for a package that differs from a built one in nothing but the text of its modules.

Most wrong packages that prove a lab are its solution with one line changed, and colcon would do
the same work for each. Their setup is the lab's own, so that what it does with a module is known:
setuptools copies it and compiles it. A stranger's setup.py may do anything: each is built.
"""

from __future__ import annotations

import compileall
import fcntl
import hashlib
import os
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from roslings.workspace.sources import PackageSource, sources

PACKAGES = "lib/python*/site-packages"
"""Where setuptools installs Python packages, below colcon's folder for one package."""
BYTECODE = "__pycache__"
PIECE_BYTES = 1024 * 1024


def content_of(package: Path, begun_with: str, but: frozenset[Path] = frozenset()) -> str:
    """A name for the content of a staged package; of the files in `but` only the names count."""
    content = hashlib.sha256(begun_with.encode())
    for source in sources(package):
        runs = source.path.is_file() and os.access(source.path, os.X_OK)
        content.update(f"\0{source.name!r} {source.link_to!r} {runs}\0".encode())
        if source.link_to is None and source.path.is_file() and source.name not in but:
            with source.path.open("rb") as file:
                while piece := file.read(PIECE_BYTES):
                    content.update(piece)
    return content.hexdigest()[:32]


def modules_of(package: Path) -> frozenset[Path]:
    """The modules whose text cannot change how the package is built, relative to it.

    A module that is no Python makes a build say more: then none counts.
    """
    found = [source for source in sources(package) if _is_module(source, package.name)]
    return frozenset(each.name for each in found) if all(map(_compiles, found)) else frozenset()


def _is_module(source: PackageSource, package: str) -> bool:
    name = source.name
    return (
        source.link_to is None
        and source.path.is_file()
        and name.parts[:-1] == (package,)
        and name.suffix == ".py"
        and name.stem != "__init__"
    )


def _compiles(source: PackageSource) -> bool:
    try:
        compile(source.path.read_bytes(), source.path.name, "exec", dont_inherit=True)
    except (SyntaxError, ValueError):
        return False
    return True


class SharedSetup:
    """Packages that differ in their modules alone, and the first of them that was built."""

    def __init__(self, note: Path) -> None:
        self._note = note

    @property
    def eldest(self) -> Path | None:
        """The folder in which the first one was built; None while none is."""
        return Path(self._note.read_text("utf-8")) if self._note.is_file() else None

    def remember(self, built: Path) -> None:
        """It is the first one."""
        self._note.write_text(str(built), "utf-8")


@contextmanager
def shared_setup_of(builds: Path, package: Path, begun_with: str) -> Iterator[SharedSetup]:
    """The setup that `package` shares, held: who comes second finds the first one built."""
    name = content_of(package, begun_with, modules_of(package))
    place = builds / "families" / name
    place.mkdir(parents=True, exist_ok=True)
    with (place / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield SharedSetup(place / "eldest")


def install_like(eldest: Path, own: Path, package: Path) -> None:
    """Make in `own` what colcon would install of `package`, from what it installed in `eldest`.

    Both folders have names of equal length, which stand in scripts. Raises OSError, shutil.Error.
    """
    shutil.copytree(
        eldest / "install",
        own / "install",
        symlinks=True,
        ignore=shutil.ignore_patterns(BYTECODE),
        copy_function=_moved(eldest, own),
    )
    for installed in own.glob(f"install/{package.name}/{PACKAGES}/{package.name}"):
        for name in modules_of(package):
            shutil.copyfile(package / name, installed / name.name)
        compileall.compile_dir(installed, quiet=2)


def _moved(eldest: Path, own: Path) -> Callable[[str, str], None]:
    """Copies one file, in which the other folder's name becomes our own."""

    def copy(source: str, target: str) -> None:
        content = Path(source).read_bytes().replace(os.fsencode(eldest), os.fsencode(own))
        Path(target).write_bytes(content)
        shutil.copymode(source, target)

    return copy
