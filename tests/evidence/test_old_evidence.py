"""Evidence of earlier schemas is judged as it was then, word for word."""

from __future__ import annotations

import pytest
from judged_words import LABS, judged, recorded


@pytest.mark.parametrize("name", LABS)
def test_old_evidence_is_judged_as_before(name: str) -> None:
    """The solution, and some twenty wrong packages."""
    before, now = recorded(name), judged(name)
    assert now.keys() == before.keys()
    for package, words in before.items():
        assert now[package] == words, package
