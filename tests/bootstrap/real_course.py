"""This course, copied: a fresh clone whose packages come from where pip is told to look."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

from course_copy import REAL, CourseCopy, plain_environment
from pythons_here import BASE

LEFT = shutil.ignore_patterns(".*", "tests", "site", "build", "__pycache__")
"""What no check reads."""


def copied(folder: Path, python: str = BASE, **variables: str) -> CourseCopy:
    """Into the folder `course` of a new user, who has what was downloaded here before."""
    root = Path(shutil.copytree(REAL, folder / "course", ignore=LEFT))
    pip = {name: text for name, text in os.environ.items() if name.startswith(("PIP_", "SSL_"))}
    kept = {"XDG_CACHE_HOME": os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")}
    own = plain_environment(folder / "home", python) | pip | kept | variables
    return CourseCopy(root, folder, own, patience_s=3600)
