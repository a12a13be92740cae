"""Run as root, or as somebody else, where every user can read the Python that runs these tests."""

from __future__ import annotations

import sys

from sources import ROOT

AS_ORDINARY = ROOT / "tests/rogues" / "as_ordinary.py"


def shown(*command: str) -> list[str]:
    """The command as root, in a view of the disk where nobody's home hides Python."""
    show = ["unshare", "--mount", sys.executable, "-I", "-S", str(AS_ORDINARY), "0"]
    return [*show, sys.prefix, sys.base_prefix, "--", *command]
