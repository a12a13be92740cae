"""A small course of two days, built once by the real builder, in a real headless Chromium."""

from __future__ import annotations

import fcntl
import http.server
import os
import threading
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from two_days_site import Visit, build, write_course


@pytest.fixture
def course(tmp_path: Path) -> Path:
    """A course that a test may spoil."""
    return write_course(tmp_path / "course")


@pytest.fixture(scope="session")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The built site of the two days; workers of one run share it."""
    base = tmp_path_factory.getbasetemp()
    shared = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "two-days"
    with (shared.parent / "two-days.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not shared.is_dir():
            done = build(write_course(shared))
            assert done.returncode == 0, done.stdout + done.stderr
    return shared / "out" / "html"


@pytest.fixture(scope="package")
def address(site: Path) -> Iterator[str]:
    """The site over HTTP, on this computer only."""

    class Silent(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_: Any) -> None:
            """Say nothing."""

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), partial(Silent, directory=str(site)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()
    server.server_close()


@pytest.fixture(params=["file", "http"])
def visit(
    request: pytest.FixtureRequest, browser: Any, site: Path, address: str
) -> Iterator[Visit]:
    """From the file and over HTTP; no other host is asked, and no script fails."""
    context = browser.new_context(viewport={"width": 1280, "height": 900})
    context.set_default_timeout(30_000)
    visit = Visit(context, site.as_uri() if request.param == "file" else address)
    yield visit
    context.close()
    own = (visit.base, "blob:", "data:")
    assert [url for url in visit.requests if not url.startswith(own)] == []
    assert visit.errors == []
