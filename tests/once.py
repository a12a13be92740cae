"""What is dear is made once in a test run, whichever of its processes asks first."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Callable
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def shared_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of this test run; all its processes have the same."""
    folder = tmp_path_factory.getbasetemp()
    return folder.parent if "PYTEST_XDIST_WORKER" in os.environ else folder


def once(file: Path, make: Callable[[], str]) -> str:
    """The content of `file`: what `make` gives to the first who asks; the others wait for it.

    Where `make` raised, all fail: nobody tries again what was dear and went wrong.
    """
    failed = file.with_suffix(".failed")
    with file.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        assert not failed.exists(), f"{file.stem} could not be made: see the first test's error"
        if not file.exists():
            failed.touch()
            part = file.with_suffix(".part")
            part.write_text(make(), "utf-8")
            part.rename(file)
            failed.unlink()
    return file.read_text("utf-8")
