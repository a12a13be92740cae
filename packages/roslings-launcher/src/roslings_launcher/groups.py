"""The names of the dependency groups. Python 3.10 reads no TOML, and a name needs no more."""

import re
from pathlib import Path


def names(pyproject: Path) -> list[str]:
    """The groups of `pyproject`, in its order."""
    text = pyproject.read_text(encoding="utf-8")
    table = text.partition("[dependency-groups]\n")[2]
    return re.findall(r"^([\w-]+) = \[", re.split(r"^\[", table, flags=re.MULTILINE)[0], re.M)
