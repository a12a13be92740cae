"""Each word of each card is judged, and stays so: a new word without a proof is told here.

./roslings test tests/labs/test_contracts.py -m slow
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from roslings.course import all_labs

LABS = [lab.name for lab in all_labs()]
"""CI proves the card of the guide's lab, in the same way; these take seven minutes."""


@pytest.mark.slow
@pytest.mark.twice
@pytest.mark.parametrize("lab", LABS)
def test_each_word_of_the_card_is_judged(lab: str, tmp_path: Path) -> None:
    """By the command that an author types."""
    command = [sys.executable, "-m", "roslings", "prove", lab, "--contract"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 0, done.stdout
    assert "(100%)" in done.stdout
