"""The package roslings-my-rover, alone."""

from __future__ import annotations

import pytest
from on_its_own import passes_alone

pytestmark = [pytest.mark.slow, pytest.mark.alone]


def test_it_passes_its_tests_in_a_fresh_environment() -> None:
    """With what it says that it needs, and no other package of ours."""
    passes_alone("roslings-my-rover")
