"""`import roslings.report` stays quick: nothing heavy before it is used."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

import roslings.report

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
        ("from roslings.report import Progress", set()),
        ("from roslings.report import print_verdict", {"rich", "pydantic"}),
        ("from roslings.report import write_json", {"pydantic"}),
        ("from roslings.report import draw_graph", set()),
    ],
)
def test_each_name_brings_only_what_it_needs(code: str, heavy: set[str]) -> None:
    """matplotlib only when a picture is drawn."""
    assert modules_after(code) == heavy


def test_every_name_of_the_room_is_there() -> None:
    """And another one is an AttributeError, as in any module."""
    for name in roslings.report.__all__:
        assert getattr(roslings.report, name).__name__ == name
    with pytest.raises(AttributeError, match="no attribute 'draw_grpah'"):
        _ = roslings.report.draw_grpah
