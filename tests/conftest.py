"""What holds for every test."""

from __future__ import annotations

import signal
from pathlib import Path

import pytest
from costs import Costs
from once import shared_folder

__all__ = ["shared_folder"]

LONGEST = ("forgers", "labs", "cli", "batch", "bootstrap", "devices")
"""Folders with long tests: what is begun last ought to be short."""

DEAR = ("stage", "workshop", "site", "browser", "cells", "edition", "solution", "standing", "jazzy")
"""Fixtures that are long in making, or keep a processor busy: one worker makes each, once."""


def pytest_addoption(parser: pytest.Parser) -> None:
    """Options of the tests."""
    parser.addoption(
        "--costs", metavar="FILE", type=Path, help="add what each test cost to FILE, as JSON lines"
    )


def pytest_configure(config: pytest.Config) -> None:
    """Hear Ctrl-C, and let children hear it, also where a script in the background started us."""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    if file := config.getoption("--costs"):
        config.pluginmanager.register(Costs(file.absolute()))


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
