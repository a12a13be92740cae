"""What the tests of the desk share: a domain, a desk on it, nodes, and a page."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from desk_program import PATIENCE_S, Desk, Nodes, desk

from ros2_on_pip.domain_lease import leased_domain


@pytest.fixture(scope="module")
def opened(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Desk]:
    """A desk on a domain of its own, for all tests of a file."""
    with leased_domain() as domain, desk(domain, tmp_path_factory.mktemp("home")) as found:
        yield found


@pytest.fixture
def nodes(opened: Desk, monkeypatch: pytest.MonkeyPatch) -> Iterator[Nodes]:
    """A node of the test's on the same domain."""
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    with Nodes(opened.domain) as found:
        yield found


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """Where other programs of a test begin."""
    return tmp_path


@pytest.fixture
def context(browser: Any, opened: Desk) -> Iterator[Any]:
    """A browser of this user, who has come in by the file. It may ask no other host."""
    found = browser.new_context()
    found.set_default_timeout(PATIENCE_S * 1000)
    asked: list[str] = []
    found.on("request", lambda request: asked.append(request.url))
    page = found.new_page()
    opened.let_in(page)
    page.close()
    yield found
    found.close()
    own = (opened.base, "data:", "blob:", "file:")
    assert [url for url in asked if not url.startswith(own)] == []
