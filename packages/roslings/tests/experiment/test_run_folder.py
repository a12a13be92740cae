"""The folder of a run goes with it, whoever still writes there, and whoever was killed."""

from __future__ import annotations

import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest

from roslings.experiment.run_folder import LOCK, run_folder, sweep

WRITES_S = 0.2


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Where such folders are made."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    yield tmp_path
    assert list(tmp_path.iterdir()) == []


def test_it_goes_though_somebody_still_writes_there(place: Path) -> None:
    """A process that is just being ended."""

    def write(folder: Path) -> None:
        until_s = time.monotonic() + WRITES_S
        while time.monotonic() < until_s:
            with suppress(OSError):
                (folder / "built").mkdir(exist_ok=True)
                (folder / "built" / "result").write_text("late")

    with run_folder() as folder:
        writer = threading.Thread(target=write, args=[folder])
        writer.start()
    writer.join()
    assert place.is_dir()


def test_one_that_lost_its_lock_is_swept(place: Path) -> None:
    """Its owner was killed between the lock and the last file."""
    with run_folder() as folder:
        pass
    folder.mkdir()
    (folder / "built").mkdir()
    (folder / "built" / "result").write_text("late")
    sweep()
    assert not folder.exists()


def test_one_in_use_stays(place: Path) -> None:
    """Its lock is held."""
    with run_folder() as folder:
        (folder / "result").write_text("mine")
        sweep()
        assert (folder / "result").read_text() == "mine"
        assert (folder / LOCK).exists()
    assert not folder.exists()
