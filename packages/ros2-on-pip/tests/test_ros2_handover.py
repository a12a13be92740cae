"""Who is handed over to is the real `ros2`, and never what starts us: that would not end."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import ros2_on_pip
from sources import python_path

START = Path(ros2_on_pip.__path__[0]) / "start.py"
BY_PIP = """#!{python}
import re
import sys
from ros2_on_pip.cli import begin
if __name__ == '__main__':
    sys.argv[0] = re.sub(r'(-script.pyw|.exe)?$', '', sys.argv[0])
    sys.exit(begin())
"""
"""As pip writes an entry point."""
BY_FILE = '#!/bin/sh\nexec "{python}" "{start}" "$@"\n'
"""As the course's drills find it."""
PATIENCE_S = 60.0


def asked(folder: Path, script: str) -> subprocess.CompletedProcess[str]:
    """`ros2 --help`, where the script is the first `ros2` on the path."""
    place = folder / "ros2"
    place.write_text(script.format(python=sys.executable, start=START), "utf-8")
    place.chmod(0o755)
    path = os.pathsep.join([str(folder), os.defpath])
    return subprocess.run(
        [place, "--help"],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=True,
        env={"PATH": path, "HOME": str(folder), "PYTHONPATH": python_path()},
    )


@pytest.mark.parametrize("script", [BY_PIP, BY_FILE], ids=["pip", "file"])
def test_what_starts_us_is_not_handed_over_to(tmp_path: Path, script: str) -> None:
    """It answers itself."""
    assert "Various topic related sub-commands" in asked(tmp_path, script).stdout


def test_the_real_one_is(tmp_path: Path) -> None:
    """With the same words."""
    real = tmp_path / "real"
    real.mkdir()
    (real / "ros2").write_text('#!/bin/sh\necho "the real one: $*"\n', "utf-8")
    (real / "ros2").chmod(0o755)
    done = subprocess.run(
        [sys.executable, START, "topic", "list"],
        capture_output=True,
        text=True,
        check=True,
        env={"PATH": f"{real}:{os.defpath}", "HOME": str(tmp_path), "PYTHONPATH": python_path()},
    )
    assert done.stdout == "the real one: topic list\n"
