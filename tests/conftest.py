"""What holds for every test."""

from __future__ import annotations

import os
import signal

import pytest
from browser import browser
from costs import add_costs_option, note_costs
from needed.plugin import add_needed_option, leave_out
from once import shared_folder
from skips import hold_to_reasons, skip_without
from subreaper import leave_nothing_behind

__all__ = ["browser", "shared_folder"]

LONGEST = ("forgers", "labs", "cli", "batch", "bootstrap", "devices")
"""Folders with long tests: what is begun last ought to be short."""

DEAR = (
    "stage",
    "workshop",
    "site",
    "browser",
    "cells",
    "edition",
    "solution",
    "standing",
    "jazzy",
    "wheel",
)
"""Fixtures that are long in making, or keep a processor busy: one worker makes each, once."""


def pytest_addoption(parser: pytest.Parser) -> None:
    """Options of the tests."""
    add_costs_option(parser)
    add_needed_option(parser)


def pytest_configure(config: pytest.Config) -> None:
    """Hear Ctrl-C, and let children hear it, also where a script in the background started us."""
    os.environ["ROSLINGS_SOAK_S"] = "0"  # what is about half a minute of running says so itself
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    leave_nothing_behind(config)
    note_costs(config)
    leave_out(config)
    hold_to_reasons(config)


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    """A slow test is not begun when the time is over, and nothing is made ready for it."""
    if item.get_closest_marker("slow"):
        skip_without("time for slow tests")


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """The folders with long tests come first; who shares something dear shares a worker."""
    items.sort(key=_turn)
    for item in items:
        names = getattr(item, "fixturenames", ())
        if dear := next((name for name in DEAR if name in names), None):
            item.add_marker(pytest.mark.xdist_group(dear))


def _turn(item: pytest.Item) -> int:
    folder = item.path.parent.name
    return LONGEST.index(folder) if folder in LONGEST else len(LONGEST)
