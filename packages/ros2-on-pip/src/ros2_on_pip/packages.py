"""Packages and their executables, as the ament index of the sourced workspaces has them."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from ros2_on_pip.absent import ABSENT
from ros2_on_pip.problem import CommandProblem, did_you_mean
from ros2_on_pip.unbuilt import advice

PROGRAMS = ("demo_nodes_py", "teleop_twist_keyboard", "tf2_ros", "tf2_tools")
BUILT_IN = {name: Path(__file__).parent for name in PROGRAMS}
"""Packages that come with roslings, and the folder that each lies in."""

SOURCE_IT = (
    "If you built it yourself, source its workspace in this terminal: source install/setup.bash"
)


class PackageNotFound(CommandProblem):
    """No sourced workspace has the package."""

    def __init__(self, package: str) -> None:
        super().__init__(_not_found(package))


def _not_found(package: str) -> str:
    known = advice(package)
    if package in ABSENT and not known:
        return ABSENT[package].told(package)
    near = "" if known else did_you_mean(package, packages())
    return f"Package '{package}' not found.{near}\n{known or SOURCE_IT}"


class NoSuchExecutable(CommandProblem):
    """The package has no such executable."""

    def __init__(self, package: str, executable: str, found: Iterable[str]) -> None:
        names = sorted(found)
        super().__init__(
            f"No executable found: package '{package}' has no '{executable}'."
            + did_you_mean(executable, names)
            + _what_there_is(package, names)
        )


class SeveralExecutables(CommandProblem):
    """Two folders of the package have an executable of that name."""

    def __init__(self, paths: Iterable[Path]) -> None:
        super().__init__("\n- ".join(["Multiple executables found:", *map(str, paths)]))


def _what_there_is(package: str, names: list[str]) -> str:
    if names:
        return f"\nIt has: {', '.join(names)}"
    return (
        "\nIt has none at all. Add one to entry_points in setup.py, look whether setup.cfg is"
        f" there, and build again: colcon build --packages-select {package}"
    )


def packages() -> dict[str, Path]:
    """Name of every package to its prefix; an overlay's hides the one below it."""
    from ament_index_python.packages import get_packages_with_prefixes

    found = {name: Path(prefix) for name, prefix in get_packages_with_prefixes().items()}
    return {**BUILT_IN, **found}


def prefix_of(package: str) -> Path:
    """The prefix that `package` is installed in. Raises PackageNotFound."""
    for prefix in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep):
        if prefix and _marker(Path(prefix), package).is_file():
            return Path(prefix)
    if package in BUILT_IN:
        return BUILT_IN[package]
    raise PackageNotFound(package)


def share_of(package: str) -> Path:
    """The share folder of `package`. Raises PackageNotFound."""
    return prefix_of(package) / "share" / package


def _marker(prefix: Path, package: str) -> Path:
    return prefix / "share" / "ament_index" / "resource_index" / "packages" / package


def executables(package: str) -> list[Path]:
    """Every executable of `package`, in order. Raises PackageNotFound."""
    prefix = prefix_of(package)
    if prefix == BUILT_IN.get(package):
        return sorted(p for p in (prefix / package).glob("[!_]*.py"))
    return sorted(p for p in (prefix / "lib" / package).rglob("*") if _can_run(p))


def _can_run(place: Path) -> bool:
    hidden = any(part.startswith(".") for part in place.parts[-2:-1])
    return not hidden and place.is_file() and os.access(place, os.X_OK)


def name_of(executable: Path) -> str:
    """What `ros2 run` calls it."""
    return executable.stem if executable.parent.parent in BUILT_IN.values() else executable.name


def executable(package: str, name: str) -> Path:
    """The executable `name` of `package`.

    Raises PackageNotFound, NoSuchExecutable, SeveralExecutables.
    """
    every = executables(package)
    chosen = [place for place in every if name_of(place) == name]
    if not chosen:
        raise NoSuchExecutable(package, name, map(name_of, every))
    if len(chosen) > 1:
        raise SeveralExecutables(chosen)
    return chosen[0]
