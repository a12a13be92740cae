"""`ros2 pkg create`: look whether the request can be fulfilled, tell it, write the files."""

from __future__ import annotations

import argparse
import getpass
import keyword
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.create.texts import PackageRequest, files_of
from ros2_on_pip.packages import packages
from ros2_on_pip.problem import CommandProblem, did_you_mean
from ros2_on_pip.words import OK

_NAME = re.compile(r"[a-z][a-z0-9_]*")


class OnlyPython(CommandProblem):
    """C++ packages cannot be built on the wheels."""

    def __init__(self, build_type: str) -> None:
        super().__init__(
            f"A package of the build type {build_type} is written in C++, and C++ needs the full"
            " ROS 2 on Ubuntu 24.04.\nFor a Python package add: --build-type ament_python"
        )


class BadPackageName(CommandProblem):
    """The name cannot be the name of a package."""

    def __init__(self, name: str, why: str) -> None:
        super().__init__(f"'{name}' cannot be the name of a package: {why}.")


class BadNodeName(CommandProblem):
    """The name cannot be the name of a Python file and of an executable."""

    def __init__(self, name: str) -> None:
        super().__init__(
            f"'{name}' cannot be the name of a node's file: use letters, digits and _,"
            " and no digit first."
        )


class PackageAlreadyThere(CommandProblem):
    """There is something of that name; nothing is overwritten."""

    def __init__(self, place: Path) -> None:
        super().__init__(
            f"\nAborted!\nThe directory already exists: {place}\nEither remove the directory or"
            " choose a different destination directory or package name"
        )


class FolderNotWritable(CommandProblem):
    """The folder cannot be written to."""

    def __init__(self, fault: OSError) -> None:
        super().__init__(f"unable to create {fault.filename}: {fault.strerror}")


@dataclass(frozen=True)
class Maintainer:
    """Who looks after the package."""

    name: str
    email: str


def create_package(options: argparse.Namespace) -> int:
    """Create the package that `options` ask for."""
    _check(options)
    request = _request(options)
    root = Path(options.destination_directory) / request.package
    if root.exists():
        raise PackageAlreadyThere(root)
    print("\n".join(_summary(request, options)))
    try:
        _write(root, request)
    except OSError as fault:
        raise FolderNotWritable(fault) from fault
    _warn(request)
    return OK


def _check(options: argparse.Namespace) -> None:
    """Raises OnlyPython, BadPackageName, BadNodeName."""
    if options.build_type != "ament_python":
        raise OnlyPython(options.build_type)
    _check_package(options.package_name)
    for name in filter(None, (options.node_name, options.library_name)):
        if not name.isidentifier() or keyword.iskeyword(name):
            raise BadNodeName(name)


def _check_package(name: str) -> None:
    if not _NAME.fullmatch(name):
        better = re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_")
        hint = f". Try {better}" if _NAME.fullmatch(better) else ""
        raise BadPackageName(name, f"use small letters, digits and _, a letter first{hint}")
    if name == "test":
        raise BadPackageName(name, "the folder 'test' is for the tests. Choose another one")
    if keyword.iskeyword(name) or name in sys.stdlib_module_names:
        raise BadPackageName(name, "Python itself has something of that name. Choose another one")


def _request(options: argparse.Namespace) -> PackageRequest:
    who = _maintainer(options)
    node, library = options.node_name, options.library_name
    if node and node == library:
        node = f"{node}_node"
        print("[WARNING] node name can not be equal to the library name", file=sys.stderr)
        print(f"[WARNING] renaming node to {node}", file=sys.stderr)
    return PackageRequest(
        package=options.package_name,
        format=options.package_format,
        description=options.description,
        license=options.license,
        maintainer=who.name,
        email=who.email,
        dependencies=tuple(options.dependencies),
        node=node,
        library=library,
    )


def _maintainer(options: argparse.Namespace) -> Maintainer:
    name = options.maintainer_name or _user()
    email = options.maintainer_email or _git_email()
    return Maintainer(name, email or f"{re.sub(r'[^A-Za-z0-9._-]+', '.', name)}@todo.todo")


def _user() -> str:
    try:
        return getpass.getuser()
    except (KeyError, OSError):  # a container may run as a user without a name
        return "user"


def _git_email() -> str:
    try:
        done = subprocess.run(
            ["git", "config", "user.email"], capture_output=True, text=True, check=False
        )
    except OSError:
        return ""
    return done.stdout.strip()


def _summary(request: PackageRequest, options: argparse.Namespace) -> list[str]:
    return [
        "going to create a new package",
        f"package name: {request.package}",
        f"destination directory: {Path(options.destination_directory).resolve()}",
        f"package format: {request.format}",
        "version: 0.0.0",
        f"description: {request.description}",
        f"maintainer: {[f'{request.maintainer} <{request.email}>']}",
        f"licenses: {[request.license]}",
        "build type: ament_python",
        f"dependencies: {list(request.dependencies)}",
        *([f"node_name: {request.node}"] if request.node else []),
        *([f"library_name: {request.library}"] if request.library else []),
    ]


def _write(root: Path, request: PackageRequest) -> None:
    """Write every file, and tell each file and folder as it is made."""
    _make_folder(root, request)
    for name, text in files_of(request):
        place = root / name
        folder = place if name.endswith("/") else place.parent
        if not folder.exists():
            _make_folder(folder, request)
        if place != folder:
            print(f"creating {_shown(place)}")
            place.write_text(text, encoding="utf-8")


def _make_folder(folder: Path, request: PackageRequest) -> None:
    if folder.name == request.package and folder.parent.name == request.package:
        print("creating source folder")
    print(f"creating folder {_shown(folder)}")
    folder.mkdir(parents=True)


def _shown(place: Path) -> str:
    return str(place) if place.is_absolute() else f"./{place}"


def _warn(request: PackageRequest) -> None:
    """What will trip up a beginner later."""
    there = packages()
    for name in request.dependencies:
        if name not in there:
            near = did_you_mean(name, there)
            print(f"[WARNING]: no package '{name}' is installed here.{near}", file=sys.stderr)
    if request.package in there:
        print(
            f"[WARNING]: a package '{request.package}' is installed already;"
            " yours will hide it where both are sourced.",
            file=sys.stderr,
        )
    if request.license.startswith("TODO"):
        print(
            "\n[WARNING]: Unknown license 'TODO: License declaration'. This has been set in"
            " package.xml.\nBefore you publish the package, choose one there, for example"
            " Apache-2.0."
        )
