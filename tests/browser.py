"""One Chromium for all tests of a process: Playwright drives no second one beside it."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from skips import imported, skip_without

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")


@contextmanager
def chromium() -> Iterator[Any]:
    """Chromium, as Debian packages it; where it is not there, the test is skipped."""
    skip_without("Chromium")
    playwright = imported("playwright.sync_api")
    arguments = ["--no-sandbox"] if os.geteuid() == 0 else []
    with playwright.sync_playwright() as driver:
        found = driver.chromium.launch(executable_path=CHROMIUM, args=arguments)
        yield found
        found.close()


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    """For all tests of a process."""
    with chromium() as found:
        yield found
