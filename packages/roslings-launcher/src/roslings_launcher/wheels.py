"""`./roslings wheels DIR [GROUP...]`: a folder that sets roslings up where there is no network."""

import shlex
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from roslings_launcher import groups, sizes
from roslings_launcher.errors import LauncherTrouble, say
from roslings_launcher.installing import TOOLS, Installer
from roslings_launcher.machine import require_wheels, this_machine
from roslings_launcher.place import CoursePlace
from roslings_launcher.seeds import interpreter
from roslings_launcher.virtual import Virtual


def fill(place: CoursePlace, words: Sequence[str]) -> None:
    """Puts the wheels of the named groups (of all, where none is named) for this Python into DIR.

    Raises:
        LauncherTrouble: no such group, no such folder, or the wheels do not come.
    """
    folder = _folder(words)
    chosen = _chosen(words[1:], groups.names(place.pyproject))
    require_wheels(this_machine())
    with tempfile.TemporaryDirectory(prefix="roslings-") as scratch:
        _fetch(_installer(place, Path(scratch).resolve() / "venv"), folder, chosen)
    _tell(folder)


def _folder(words: Sequence[str]) -> Path:
    if not words or words[0].startswith("-"):
        raise LauncherTrouble(
            "`wheels` needs a folder to put the wheels in.",
            "For instance: ./roslings wheels /media/usb/roslings-wheels",
        )
    folder = Path(words[0]).absolute()
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise LauncherTrouble(
            f"The folder {folder} cannot be made: {error.strerror}.", "Name another folder."
        ) from None
    return folder


def _chosen(named: Sequence[str], known: Sequence[str]) -> Sequence[str]:
    for name in named:
        if name not in known:
            raise LauncherTrouble(
                f"There is no group `{name}`.", f"The groups are: {', '.join(known)}"
            )
    return named or known


def _installer(place: CoursePlace, scratch: Path) -> Installer:
    virtual = Virtual(scratch)
    virtual.make(interpreter(), sees_system=False)
    return Installer(place, virtual)


def _fetch(installer: Installer, folder: Path, chosen: Sequence[str]) -> None:
    total_mb = sizes.megabytes(sys.version_info[:2], chosen)
    if total_mb is not None:
        say(f"Up to {total_mb:.0f} MB come from the network. Interrupted, they go on next time.")
    installer.require_tools()
    installer.fetch(installer.all_of([TOOLS, *chosen]), folder, total_mb)


def _tell(folder: Path) -> None:
    quoted = shlex.quote(str(folder))
    files = list(folder.glob("*.whl"))
    mb = sum(file.stat().st_size for file in files) / 1e6
    version = f"{sys.version_info.major}.{sys.version_info.minor}"
    say(f"{folder} holds {len(files)} wheels ({mb:.0f} MB), for Python {version}.")
    say(f"Use it with: ROSLINGS_WHEELS={quoted} ./roslings check LAB")
    say(f"Another Python: ROSLINGS_PYTHON=python3.X ./roslings wheels {quoted}")
