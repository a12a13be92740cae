"""Programs beside the tests that are typed by hand (figures, pictures, old evidence) begin.

Nothing else starts most of them: what moves leaves them behind.
"""

from __future__ import annotations

import re
import subprocess
import sys

import pytest

from sources import ROOT

MAIN = re.compile(r"^if __name__ == \"__main__\":$", re.MULTILINE)
AS_TYPED = """
import pathlib, runpy, sys
file = sys.argv[1]
sys.path[0] = str(pathlib.Path(file).resolve().parent)
runpy.run_path(file, run_name="imported")
"""
"""All but its main function: what it imports is where it looks for it."""
FOLDERS = (".ci", "tests", "tests/bench", "tests/labs", "packages/*/tests/evidence")


def programs() -> list[str]:
    """Files that are run by their name."""
    files = (file for folder in FOLDERS for file in ROOT.glob(f"{folder}/*.py"))
    return sorted(
        file.relative_to(ROOT).as_posix() for file in files if MAIN.search(file.read_text("utf-8"))
    )


@pytest.mark.parametrize("file", programs())
def test_a_program_finds_what_it_imports(file: str) -> None:
    """Typed in the course's folder, with the course's Python and nothing else on the path."""
    done = subprocess.run(
        [sys.executable, "-c", AS_TYPED, file],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
