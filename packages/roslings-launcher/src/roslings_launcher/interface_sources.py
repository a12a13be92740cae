"""Where the course's own message types lie, as sources.

A lab may hold ROS packages of types in `labs/LAB/interfaces/PACKAGE`, and the rover has those that
no wheel brings in its own `interfaces/PACKAGE`.
"""

from collections.abc import Iterator
from pathlib import Path

_PLACES = ("labs/*/interfaces/*", "packages/*/src/*/interfaces/*")


def packages_of(root: Path) -> list[Path]:
    """The folder of each package of types in the course."""
    places = {folder.parent for place in _PLACES for folder in root.glob(place)}
    return sorted(package for place in places for package in packages_in(place))


def packages_in(folder: Path) -> list[Path]:
    """The folder of each package of types in `folder`."""
    return sorted(manifest.parent for manifest in folder.glob("*/package.xml"))


def files_of(root: Path) -> Iterator[tuple[str, Path]]:
    """Every file of the packages of types, and of what comes built of them, from its folder on."""
    for folder in sorted(folder for place in _PLACES for folder in root.glob(place)):
        yield from files_in(folder)


def files_in(folder: Path) -> Iterator[tuple[str, Path]]:
    """Every file of one of them: its name begins with the folder's."""
    for file in sorted(folder.rglob("*")):
        if file.is_file():
            yield str(file.relative_to(folder.parent)), file
