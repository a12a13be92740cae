"""A shape of a verdict brings what it needs, and nothing heavy beside that."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

HEAVY = ("matplotlib", "numpy", "rich", "pydantic", "PIL")


def modules_after(code: str) -> set[str]:
    """Which of HEAVY a fresh Python has imported after `code`."""
    done = subprocess.run(
        [sys.executable, "-c", f"{code}\nimport sys; print(*sys.modules)"],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        capture_output=True,
        check=True,
        text=True,
    )
    return set(HEAVY) & set(done.stdout.split())


@pytest.mark.parametrize(
    ("code", "heavy"),
    [
        ("import roslings.report", set()),
        ("from roslings.report.progress import ProgressLine", set()),
        ("from roslings.report.terminal import print_verdict", {"rich", "pydantic"}),
        ("from roslings.report.json_file import write_json", {"pydantic"}),
        ("from roslings.report.graph_picture import draw_graph", set()),
    ],
)
def test_each_shape_brings_only_what_it_needs(code: str, heavy: set[str]) -> None:
    """matplotlib only when a picture is drawn."""
    assert modules_after(code) == heavy
