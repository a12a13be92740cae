"""README's command finds ten wrong edits, and nothing live is run for those that evidence shows."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import yaml
from pydantic import BaseModel, ConfigDict

from roslings.course import root
from sources import python_path

FAILED, CANNOT_BE_READ = 1, 2
"""What pytest ends with; 5 would say that no quick test was chosen."""


class WrongEdit(BaseModel):
    """One edit, and the quick test that finds it."""

    model_config = ConfigDict(extra="forbid")

    edit: str
    file: str
    find: str
    replace: str
    found_by: str
    of: str = ""
    live: bool = False
    """Only a real grading finds it."""


EDITS = [
    WrongEdit.model_validate(each)
    for each in yaml.safe_load(Path(__file__).with_name("wrong_edits.yaml").read_text("utf-8"))
]


def test_there_are_ten_in_labs_graders_and_the_engine() -> None:
    """Each fits its file, once; all but two are found without a live run."""
    places = [each.file.partition("/")[0] for each in EDITS]
    assert [places.count(place) for place in ("labs", "graders", "packages")] == [4, 3, 3]
    assert sum(each.live for each in EDITS) == 2
    for each in EDITS:
        assert (root() / each.file).read_text("utf-8").count(each.find) == 1, each.edit


@pytest.fixture(scope="module")
def clone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The course as git has it, with what is not committed."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=root(),
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    folder = tmp_path_factory.mktemp("clone")
    for name in filter(None, listed.split("\0")):
        if (root() / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(root() / name, folder / name)
    return folder


@contextmanager
def made(each: WrongEdit, clone: Path) -> Iterator[None]:
    """The edit stands in the copy."""
    file = clone / each.file
    before = file.read_text("utf-8")
    file.write_text(before.replace(each.find, each.replace), "utf-8")
    try:
        yield
    finally:
        file.write_text(before, "utf-8")


def quick_tests(each: WrongEdit, clone: Path) -> tuple[int, str]:
    """How the test ends among the quick ones of that copy, and what is told."""
    words = ["-n", "0", "-p", "no:cacheprovider", each.found_by, *(["-k", each.of] * bool(each.of))]
    kept = {key: value for key, value in os.environ.items() if not key.startswith("PYTEST_")}
    own = {"PYTHONPATH": python_path(clone), "ROSLINGS_COURSE": str(clone)}
    done = subprocess.run(
        [sys.executable, "-m", "pytest", *words],
        cwd=clone,
        env={**kept, **own},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.returncode, done.stdout + done.stderr


@pytest.mark.slow
@pytest.mark.xdist_group("wrong_edits")
@pytest.mark.parametrize("each", EDITS, ids=lambda each: each.edit)
def test_a_wrong_edit_is_found(each: WrongEdit, clone: Path) -> None:
    """The test passes without it, and fails with it."""
    status, told = quick_tests(each, clone)
    assert status == 0, told
    with made(each, clone):
        status, told = quick_tests(each, clone)
    assert status in (FAILED, CANNOT_BE_READ), told
