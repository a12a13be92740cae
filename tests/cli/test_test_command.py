"""`./roslings test`: which plugins of pytest its processes load."""

from __future__ import annotations

from importlib.metadata import entry_points

import pytest

from roslings.commands.test import plugins_without_use

INSTALLED = {each.name for each in entry_points(group="pytest11")}


@pytest.mark.parametrize("rest", [[], ["packages/roslings/tests/judge", "-n", "0"], ["-m", "slow"]])
def test_what_no_test_asks_for_is_not_loaded(rest: list[str]) -> None:
    """Each loads in every process; a name that is not installed would leave nothing out."""
    left_out = set(plugins_without_use(rest))
    assert "nbval" in left_out and left_out <= INSTALLED and "xdist" not in left_out


@pytest.mark.parametrize("rest", [["days", "--nbval-lax"], ["days/02-nodes", "--nbval"], ["days"]])
def test_lessons_have_their_plugin(rest: list[str]) -> None:
    """They are run by it."""
    assert "nbval" not in plugins_without_use(rest)
