"""Both walls, and a look at what is left behind."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from roslings.arena import Isolation, Sandbox, choose_isolation
from skips import skip_without

BROWSERS_OWN = "chromium --type="
"""A browser that other tests have opened in this process starts helpers when it likes."""


def children_of_this_process() -> set[str]:
    """Command lines of every living descendant."""
    parents: dict[int, int] = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                state, parent = (entry / "stat").read_text().rpartition(")")[2].split()[:2]
            except OSError:
                continue
            if state != "Z":
                parents[int(entry.name)] = int(parent)
    found, fresh = set[int](), {os.getpid()}
    while fresh := {pid for pid, parent in parents.items() if parent in fresh}:
        found |= fresh
    commands = {command_of(pid) for pid in found} - {""}
    return {command for command in commands if BROWSERS_OWN not in command}


def command_of(pid: int) -> str:
    """The command line of a process, empty when it has gone."""
    try:
        return Path(f"/proc/{pid}/cmdline").read_bytes().replace(b"\0", b" ").decode().strip()
    except OSError:
        return ""


@pytest.fixture(params=["namespace", "domain"])
def namespaces(request: pytest.FixtureRequest) -> bool:
    """Run the test behind both walls, where the machine has both."""
    if request.param == "namespace":
        skip_without("namespaces")
    return bool(request.param == "namespace")


@pytest.fixture(autouse=True)
def nothing_left() -> Iterator[None]:
    """No test of the arena leaves a process behind."""
    before = children_of_this_process()
    yield
    assert children_of_this_process() <= before


@pytest.fixture
def isolation(monkeypatch: pytest.MonkeyPatch) -> Isolation:
    """The machine's best walls, which have a sandbox."""
    monkeypatch.delenv("ROSLINGS_ISOLATION", raising=False)
    skip_without("namespaces", "bubblewrap")
    found = choose_isolation()
    assert found.sandbox, found.lack
    return found


@pytest.fixture
def sandbox(isolation: Isolation, tmp_path: Path) -> Sandbox:
    """One with a home of its own."""
    assert isolation.sandbox
    return replace(isolation.sandbox, home=tmp_path / "home")
