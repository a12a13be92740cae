"""What the tests of launches share: a launch file that is written, and a process that is gone."""

from __future__ import annotations

import sys
from pathlib import Path

from terminal import HERE, Running, Shell


def written(folder: Path, name: str, text: str) -> Path:
    """A launch file."""
    place = folder / name
    place.write_text(text)
    return place


def package(shell: Shell, prefix: Path, **programs: str) -> Shell:
    """The same terminal with the package `mine`, which has these programs; `teller` is a node."""
    marker = prefix / "share" / "ament_index" / "resource_index" / "packages" / "mine"
    marker.parent.mkdir(parents=True)
    marker.touch()
    folder = prefix / "lib" / "mine"
    folder.mkdir(parents=True)
    teller = (HERE / "nodes" / "teller.py").read_text("utf-8")
    for name, text in {**programs, "teller": f"#!{sys.executable}\n{teller}"}.items():
        (folder / name).write_text(text)
        (folder / name).chmod(0o755)
    return Shell(shell.environment | {"AMENT_PREFIX_PATH": str(prefix)}, prefix)


def pid_of(launch: Running, name: str) -> int:
    """The last process of this name that a launch started."""
    starts = [line for line in launch.lines if f"[{name}]: process started" in line]
    return int(starts[-1].rpartition("[")[2].strip("]"))


def is_gone(pid: int) -> bool:
    """The process has ended: it is not there, or is only waited for."""
    try:
        text = Path(f"/proc/{pid}/stat").read_text("utf-8")
    except (FileNotFoundError, ProcessLookupError):
        return True
    return text.rpartition(")")[2].split()[0] == "Z"
