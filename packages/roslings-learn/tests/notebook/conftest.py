"""One kernel for the tests of a file: its cells run one after the other, as a student's do."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from kernels import Kernel, kernel


@pytest.fixture(scope="module")
def cells(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Kernel]:
    """A kernel with the names of a lesson imported."""
    with kernel(tmp_path_factory.mktemp("notebook")) as opened:
        yield opened
