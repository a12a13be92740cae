"""Where the environment stands, and whether it can stand there."""

import os
import platform
import re
from dataclasses import dataclass
from pathlib import Path

from roslings_launcher.errors import LauncherTrouble

# The start of a script names its Python (`#!...`), cut by the kernel at this many bytes.
_SHEBANG_BYTES = 255
_SHEBANG_BYTES_BEFORE_5_1 = 127
_LONGEST_TAIL = "#!/.venv-apt/bin/python3.12"

# Found by building and running a package in an environment under a path with each of them. Letters
# of any language work, and so do most signs.
_BREAKING = re.compile(r"""[\s:"`\x00-\x1f\x7f]""")


@dataclass(frozen=True)
class CoursePlace:
    """The course's folder and what the bootstrap keeps in it."""

    root: Path
    name: str = ".venv"  # ".venv-apt" where a sourced ROS is used

    @property
    def environment(self) -> Path:
        """The virtual environment."""
        return self.root / self.name

    @property
    def constraints(self) -> Path:
        """The pins of every package."""
        return self.root / "constraints.txt"

    @property
    def pyproject(self) -> Path:
        """The dependency groups."""
        return self.root / "pyproject.toml"

    @property
    def lock(self) -> Path:
        """Held while the environment is being changed."""
        return self.root / f"{self.name}.lock"

    @property
    def log(self) -> Path:
        """All that pip said at the last change."""
        return self.root / f"{self.name}.log"

    @property
    def wheels(self) -> Path:
        """What is fetched and not yet installed: a broken download goes on from here."""
        return self.root / f"{self.name}.wheels"


def require_usable(root: Path) -> None:
    """Nothing where an environment in `root` would work.

    Raises:
        LauncherTrouble: colcon's scripts would break under this path, or nothing can be written
            there.
    """
    _require_plain(str(root))
    _require_short(root)
    if not os.access(root, os.W_OK):
        raise LauncherTrouble(
            f"This folder cannot be written: {root}",
            "Copy it to a folder of your own, for instance your home folder, and run it there.",
        )


def _require_plain(path: str) -> None:
    found = _BREAKING.search(path)
    if found:
        raise LauncherTrouble(
            f"The path of this folder has {_called(found.group())} in it, and the scripts that "
            f"colcon writes do not run from there: {path}",
            "Move this folder, for instance to ~/roslings, and run it there.",
        )


def _called(character: str) -> str:
    return "a space" if character.isspace() else f"the character {character}"


def _require_short(root: Path) -> None:
    limit = _shebang_bytes(platform.release())
    length = len(os.fsencode(root)) + len(_LONGEST_TAIL)
    if length > limit:
        raise LauncherTrouble(
            f"The path of this folder is {length - limit} bytes too long for Linux to start a "
            f"script from it: {root}",
            "Move this folder, for instance to ~/roslings, and run it there.",
        )


def _shebang_bytes(release: str) -> int:
    numbers = tuple(map(int, re.findall(r"\d+", release)[:2]))
    return _SHEBANG_BYTES if numbers >= (5, 1) else _SHEBANG_BYTES_BEFORE_5_1
