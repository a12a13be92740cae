"""Fixtures of the doctor's tests."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from clinic import Clinic


@pytest.fixture
def clinic() -> Iterator[Clinic]:
    """A healthy machine to be made ill. Its folder is open to every user of the computer."""
    with tempfile.TemporaryDirectory(prefix="roslings-clinic-") as name:
        root = Path(name)
        root.chmod(0o755)
        yield Clinic(root)
