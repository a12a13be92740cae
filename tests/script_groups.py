"""What the script `./roslings` installs for each command: the table in it, as it stands there."""

from __future__ import annotations

import re

from sources import ROOT

ROW = re.compile(r"^ +([\w |-]+)\) *(?:\n *)?echo ([\w -]+) ;;$", re.MULTILINE)
"""Commands, and the groups of each; a command that asks first what is there has no such row."""


def groups_of_commands() -> dict[str, set[str]]:
    """Command to the groups that it needs without further words."""
    script = (ROOT / "roslings").read_text("utf-8")
    return {
        command: set(row[2].split())
        for row in ROW.finditer(script)
        for command in row[1].split(" | ")
    }
