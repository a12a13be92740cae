"""A package of others is installed beside the course, and a command sees it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

PIP = ("pip", "install", "--quiet", "--disable-pip-version-check")
ALONE = ("--no-deps", "--no-build-isolation", "--no-index")
CONFORMS = """
from roslings.capabilities.conformance import CHECKS
from {package} import CAPABILITY
for holds in CHECKS:
    holds(CAPABILITY)
print(len(CHECKS), "hold")
"""


def install(source: Path, site: Path) -> None:
    """Into a folder of the test, with no index."""
    words = [*PIP, *ALONE, "--target", str(site), str(source)]
    subprocess.run([sys.executable, "-m", *words], check=True)


def run(environment: dict[str, str], *words: str, cwd: Path | None = None) -> str:
    """What Python prints; it must end well."""
    done = subprocess.run(
        [sys.executable, *words],
        env=environment,
        cwd=cwd,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout
