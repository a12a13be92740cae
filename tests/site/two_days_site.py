"""The course of two days: written, built, and visited."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

from roslings.course import root

BUILDER = root() / "site" / "build.py"
TWO_DAYS = Path(__file__).parent / "two_days"


def write_course(folder: Path) -> Path:
    """The real words, path, drawings and one lab, with the two days of the tests."""
    shutil.copytree(root() / "glossary", folder / "glossary")
    shutil.copytree(root() / "labs" / "topics", folder / "labs" / "topics")
    (folder / "days").mkdir()
    shutil.copy(root() / "days" / "path.yaml", folder / "days")
    shutil.copytree(TWO_DAYS, folder / "days", dirs_exist_ok=True)
    place = "days/03-topics/pictures/rover.svg"
    shutil.copy(root() / place, folder / place)
    return folder


def build(course: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Run the builder on a course."""
    return subprocess.run(
        [sys.executable, str(BUILDER), "--out", str(course / "out"), *words],
        env={**os.environ, "ROSLINGS_COURSE": str(course)},
        capture_output=True,
        text=True,
        check=False,
    )


class Visit:
    """A page of the site in a fresh browser profile, that keeps what went wrong and where to."""

    def __init__(self, context: Any, base: str) -> None:
        self.base, self.requests, self.errors = base, list[str](), list[str]()
        context.on("request", lambda request: self.requests.append(request.url))
        self.page = context.new_page()
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))

    def go(self, name: str) -> Any:
        """Open a page: `go("glossary.html")`."""
        self.page.goto(f"{self.base}/{name}")
        return self.page
