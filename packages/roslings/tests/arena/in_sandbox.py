"""A piece of Python in a sandbox, and what came of it."""

from __future__ import annotations

import os
import sys
import textwrap
from dataclasses import replace
from pathlib import Path

from roslings.arena import Launch, Process, Sandbox
from roslings.arena.bounds import Bounds
from roslings.evidence import ProcessSeen

LONG_S = 60.0


def launch_in(sandbox: Sandbox, source: str) -> Launch:
    """A piece of Python, to be started in the sandbox."""
    command = [sys.executable, "-I", "-S", "-c", textwrap.dedent(source)]
    environment = {"PATH": os.defpath, "HOME": str(sandbox.home)}
    folder = sandbox.home or Path("/")
    return Launch(command, environment, folder, namespaces=True, sandbox=sandbox)


def run(sandbox: Sandbox, source: str) -> ProcessSeen:
    """The same, run to its end."""
    with Process("it", launch_in(sandbox, source)) as process:
        assert process.wait_ended(LONG_S)
    return process.seen


def said(sandbox: Sandbox, source: str) -> str:
    """What it wrote."""
    return "\n".join(line.text for line in run(sandbox, source).lines)


def bounded(sandbox: Sandbox, **bounds: int) -> Sandbox:
    """With smaller bounds."""
    return replace(sandbox, bounds=replace(Bounds(), **bounds))
