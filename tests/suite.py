"""What holds for every test."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from browser import browser
from changed import add_changed_option, choose_what_is_changed
from costs import add_costs_option, note_costs
from needed.plugin import add_needed_option, leave_out
from once import shared_folder
from skips import hold_to_reasons, skip_without
from slow import is_slow_whole
from subreaper import leave_nothing_behind

__all__ = ["browser", "shared_folder"]

NOT_SLOW = "not slow"
"""The expression of `-m` in pyproject.toml: README's command."""

LONGEST = (
    "/forgers/",
    "/labs/",
    "/cli/",
    "/batch/",
    "/roslings-launcher/",
    "/roslings-rover/",
)
"""Places with long tests: what is begun last ought to be short."""

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
    add_changed_option(parser)


def pytest_configure(config: pytest.Config) -> None:
    """Hear Ctrl-C, and let children hear it, also where a script in the background started us."""
    os.environ["ROSLINGS_SOAK_S"] = "0"  # what is about half a minute of running says so itself
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    choose_what_is_changed(config, NOT_SLOW)
    leave_nothing_behind(config)
    note_costs(config)
    leave_out(config)
    hold_to_reasons(config)


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    """A slow test is not begun when the time is over, and nothing is made ready for it."""
    if item.get_closest_marker("slow"):
        skip_without("time for slow tests")


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """A file of slow tests alone is not even read where none of them is wanted.

    One that was asked for by its name is: who typed it is told how many were left out.
    """
    if config.option.markexpr != NOT_SLOW or collection_path.suffix != ".py":
        return None
    asked_for = any(collection_path.samefile(word.split("::")[0]) for word in _files_of(config))
    return True if not asked_for and is_slow_whole(collection_path) else None


def _files_of(config: pytest.Config) -> Iterator[str]:
    return (word for word in config.args if Path(word.split("::")[0]).is_file())


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """The folders with long tests come first; who shares something shares a worker.

    Quick tests share what their file makes once and what it imports; slow ones are spread.
    """
    items.sort(key=_turn)
    for item in items:
        names = getattr(item, "fixturenames", ())
        dear = next((name for name in DEAR if name in names), None)
        if dear or not (item.get_closest_marker("slow") or item.get_closest_marker("xdist_group")):
            item.add_marker(pytest.mark.xdist_group(dear or item.path.stem))


def _turn(item: pytest.Item) -> int:
    place = item.path.as_posix()
    return next((n for n, part in enumerate(LONGEST) if part in place), len(LONGEST))
