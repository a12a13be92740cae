"""Which walls this machine allows between the student's nodes and everybody else's.

`namespace`: a network of its own, where only loopback exists: nothing can come in or go out.
`domain`: a leased ROS domain with discovery kept on this machine; for kernels that refuse more.
"""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

Wall = Literal["namespace", "domain"]

HERE = Path(__file__).parent
ENTER = HERE / "enter.py"
GUARDIAN = HERE / "guardian.py"
BARE = (sys.executable, "-I", "-S")
"""A Python without site packages: quick to start, and without the threads that forbid unshare."""


@dataclass(frozen=True)
class Isolation:
    """The wall that is used, and why it is not the better one."""

    wall: Wall
    because: str = ""

    def command(self, inner: list[str]) -> list[str]:
        """The command that runs `inner` behind this wall."""
        return [*BARE, str(ENTER), *inner] if self.wall == "namespace" else inner


def choose_isolation() -> Isolation:
    """Namespaces where the kernel allows them; `ROSLINGS_ISOLATION=domain` does without."""
    if os.environ.get("ROSLINGS_ISOLATION") == "domain":
        return Isolation("domain", "ROSLINGS_ISOLATION asks for it")
    refusal = _refusal()
    return Isolation("domain", refusal) if refusal else Isolation("namespace")


def _refusal() -> str:
    """Why this machine refuses namespaces; empty where it does not."""
    if sys.platform != "linux":
        return "only Linux has them"
    tried = subprocess.run(
        [*BARE, str(ENTER), "--try"], capture_output=True, text=True, check=False, timeout=60
    )
    if tried.returncode == 0:
        return ""
    return tried.stderr.strip().splitlines()[-1] if tried.stderr.strip() else "the kernel refused"
