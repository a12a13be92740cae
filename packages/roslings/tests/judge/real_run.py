"""The evidence of a real run of a lab's solution.

It is measured by the command, in a process of its own: what is measured in a fork of a process that
has used ROS before, as tests have, does not live.
"""

from __future__ import annotations

import sys
from pathlib import Path

from ros2_on_pip.errors import OK
from roslings.evidence import Evidence
from until_told import run_until_told


def evidence_of_solution(lab: str, folder: Path) -> Evidence:
    """All that was seen of the solution; `folder` is for what is kept of it."""
    kept = folder / "kept"
    words = ["check", lab, "--solution", "--seed", "1", "--evidence", str(kept)]
    ran = run_until_told([sys.executable, "-m", "roslings", *words], kept=kept)
    assert ran.returncode == OK, ran.stdout + ran.stderr
    return Evidence.model_validate_json((kept / "evidence.json").read_bytes())
