"""Where the packages of the course lie, and what of them an environment is to see."""

from collections.abc import Iterable
from pathlib import Path

PACKAGES = "packages"
STAND_INS = "ros2-on-pip/src/ros2_on_pip/stand_ins"
"""Modules that have the names of ROS's own, for an environment that has none of that name."""
OFFERS = "entry_points.txt"
"""What a package offers to others by name, as a wheel of it says it: commands, plugins."""


def source_folders(root: Path) -> list[Path]:
    """The folder of modules of each package in the course at `root`: packages/NAME/src."""
    return sorted(root.glob(f"{PACKAGES}/*/src"))


def seen_by_python(root: Path) -> list[Path]:
    """All that an environment of the course adds to its path."""
    stand_ins = root / PACKAGES / STAND_INS
    return [*source_folders(root), *([stand_ins] if stand_ins.is_dir() else [])]


def offers_as_written(root: Path) -> str:
    """All lines of what packages offer, sorted by their bytes. `./roslings` compares it."""
    texts = (file.read_text(encoding="utf-8") for file in _offers(root))
    return "".join(sorted(f"{line}\n" for text in texts for line in text.splitlines()))


def offers(root: Path) -> str:
    """What all packages offer, as one file of entry points."""
    return merged(_offers(root))


def merged(files: Iterable[Path]) -> str:
    """Files of entry points, as one."""
    import configparser  # `./roslings --help` reads this module, and none of these files

    told: dict[str, list[str]] = {}
    for file in files:
        read = configparser.ConfigParser(delimiters=("=",))
        read.optionxform = str  # type: ignore[assignment,method-assign] # a name keeps its capitals
        read.read(file, encoding="utf-8")
        for group in read.sections():
            told.setdefault(group, []).extend(f"{name} = {at}" for name, at in read[group].items())
    return "\n".join(f"[{group}]\n" + "\n".join(lines) + "\n" for group, lines in told.items())


def _offers(root: Path) -> list[Path]:
    return sorted(root.glob(f"{PACKAGES}/*/{OFFERS}"))
