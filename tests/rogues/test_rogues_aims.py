"""What strangers' code reaches for is on the stage: what is nowhere proves no wall."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from stage import COURSE

from sources import ROOT

FILES = sorted(
    file
    for folder in ("rogues", "forgers")
    for file in ROOT.glob(f"tests/{folder}/packages/*.yaml")
)
AIM = re.compile(r"\{known\[\"course\"\]\}/([\w./-]+)")


def test_some_name_files_of_the_course() -> None:
    """The pattern is the one that they are written in."""
    assert sum(len(AIM.findall(file.read_text("utf-8"))) for file in FILES) > 8


@pytest.mark.parametrize("file", FILES, ids=lambda file: f"{file.parents[1].name}-{file.stem}")
def test_the_files_of_the_course_that_it_names_are_there(file: Path) -> None:
    """After a move it would fail to open them because there is none."""
    text = file.read_text("utf-8")
    aims = [Path(name) for name in AIM.findall(text)]
    assert [aim for aim in aims if not (ROOT / aim).exists()] == []
    staged = [Path(name) for name in COURSE]
    assert [aim for aim in aims if not any(aim.is_relative_to(each) for each in staged)] == []
