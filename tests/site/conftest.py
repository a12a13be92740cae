"""A small course of two days, built once by the real builder, in a real headless Chromium."""

from __future__ import annotations

import fcntl
import http.server
import os
import shutil
import subprocess
import sys
import threading
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from roslings.course import root

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
NO_CHROMIUM = "no Chromium here; next: sudo apt install chromium"
BUILDER = root() / "site" / "build.py"
TWO_DAYS = Path(__file__).parent / "two_days"


def write_course(folder: Path) -> Path:
    """The real words, path and one lab, with the two days of the tests."""
    shutil.copytree(root() / "glossary", folder / "glossary")
    shutil.copytree(root() / "labs" / "topics", folder / "labs" / "topics")
    (folder / "days").mkdir()
    shutil.copy(root() / "days" / "path.yaml", folder / "days")
    shutil.copytree(TWO_DAYS, folder / "days", dirs_exist_ok=True)
    return folder


def build(course: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Run the builder on a course."""
    return subprocess.run(
        [sys.executable, str(BUILDER), "--out", str(course / "out"), *words],
        env={**os.environ, "ROSLINGS_COURSE": str(course)},
        capture_output=True, text=True, check=False,
    )  # fmt: skip


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


@pytest.fixture(scope="session")
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


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    """Chromium, as Debian packages it."""
    if not CHROMIUM:
        pytest.skip(NO_CHROMIUM)
    playwright = pytest.importorskip("playwright.sync_api")
    with playwright.sync_playwright() as driver:
        chromium = driver.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield chromium
        chromium.close()


class Visit:
    """A page of the site in a fresh browser profile, that keeps what went wrong and where to."""

    def __init__(self, context: Any, base: str) -> None:
        self.base, self.requests, self.errors = base, list[str](), list[str]()
        context.on("request", lambda request: self.requests.append(request.url))
        self.page = context.new_page()
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))

    def go(self, name: str) -> Any:
        """Open a page: `go("glossary.html")`."""
        self.page.goto(f"{self.base}/{name}")
        return self.page


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
