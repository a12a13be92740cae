"""CONTRIBUTING's walk "Add a verb of `ros2`", done as it is written."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

from ros2_on_pip.domain_lease import leased_domain
from sources import ROOT, sources

TEXT = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
WALK = TEXT[TEXT.index("## Add a verb of `ros2`") :]
PACKAGE = "packages/ros2-on-pip/src"
LAST_OF_DECLARE = "    node_options(info)\n"


def blocks() -> list[str]:
    """Its code, in order."""
    found = re.findall(r"^   ```python\n(.*?)^   ```", WALK, re.DOTALL | re.MULTILINE)
    return [textwrap.dedent(each) for each in found]


def test_the_verb_is_there(tmp_path: Path) -> None:
    """In a copy of the package: it counts, and its help tells of it."""
    shutil.copytree(ROOT / PACKAGE, tmp_path / "src")
    file = tmp_path / "src/ros2_on_pip/commands/node.py"
    declares, runs = blocks()[:2]
    text = file.read_text("utf-8")
    assert text.count(LAST_OF_DECLARE) == 1
    text = text.replace(LAST_OF_DECLARE, LAST_OF_DECLARE + textwrap.indent(declares, "    "))
    file.write_text(f"{text}\n\n{runs}", "utf-8")
    others = [str(each) for each in sources() if each != ROOT / PACKAGE]
    with leased_domain() as domain:
        own = {
            "PYTHONPATH": os.pathsep.join([str(tmp_path / "src"), *others]),
            "ROS_DOMAIN_ID": str(domain),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "PATH": "/usr/bin:/bin",
        }
        said = {
            words: subprocess.run(
                [sys.executable, "-m", "ros2_on_pip", "node", words],
                env={**os.environ, **own},
                capture_output=True,
                text=True,
                check=True,
            ).stdout
            for words in ("count", "--help")
        }
    assert said["count"] == "0\n"
    assert "Print how many nodes run" in said["--help"]
