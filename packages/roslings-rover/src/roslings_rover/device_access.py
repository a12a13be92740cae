"""Lend a device to those who may enter its folder, where that is another group than our own."""

from __future__ import annotations

import os
import stat
from pathlib import Path

FOR_THE_GROUP = stat.S_IRGRP | stat.S_IWGRP


def lend(device: Path, folder: Path) -> None:
    """Let the group of `folder` read and write `device`, a terminal or a socket. Raises OSError.

    Only root can, and only root runs somebody else's nodes as another user: else nothing changes.
    """
    group = folder.stat().st_gid
    if os.geteuid() == 0 and group != os.getegid():
        os.chown(device, -1, group)
        device.chmod(stat.S_IMODE(device.stat().st_mode) | FOR_THE_GROUP)
