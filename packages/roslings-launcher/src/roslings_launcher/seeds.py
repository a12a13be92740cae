"""A first pip, for machines whose Python has none: Ubuntu leaves pip and ensurepip out.

A seed is a pip that any Python can run from where it lies: the wheel itself, or the folder of an
installed pip. It is used once, to put the pinned pip into the environment. The ways to one, in
order, from what is at hand to what must be fetched:

    1. ROSLINGS_WHEELS             5. uv
    2. the Python's own ensurepip  6. an index that pip is configured for
    3. the Python's own pip        7. apt's python3-pip-whl, unpacked without root
    4. another Python of this machine
"""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

from roslings_launcher.errors import LauncherTrouble
from roslings_launcher.index import wheel_from_index

SYSTEM_FOLDERS = (Path("/usr/bin"), Path("/usr/local/bin"))  # whatever PATH says

# Run by the Python that is asked: prints where its pip lies, the ensurepip wheels before all.
_ASK = """
import glob, importlib.util as u, os, sysconfig
folders = [sysconfig.get_config_var("WHEEL_PKG_DIR")]
spec = u.find_spec("ensurepip")
folders += [os.path.join(p, "_bundled") for p in spec.submodule_search_locations] if spec else []
for folder in filter(None, folders):
    for wheel in sorted(glob.glob(os.path.join(folder, "pip-*.whl"))):
        print(os.path.join(wheel, "pip"))
spec = u.find_spec("pip")
if spec and spec.submodule_search_locations:
    print(list(spec.submodule_search_locations)[0])
"""


def find_seed(python: str, scratch: Path) -> Path:
    """A path that Python runs as pip. Files fetched for it go to `scratch`.

    Raises:
        LauncherTrouble: there is no pip in any of the known places.
    """
    for way in _ways(python, scratch):
        for seed in way():
            if answers(python, seed):
                return seed
    raise LauncherTrouble(
        f"This Python has no pip, and none was found elsewhere: {python}",
        "On Ubuntu and Debian: sudo apt install python3-venv",
        "Without sudo: put a pip-*.whl into a folder DIR, and run: ROSLINGS_WHEELS=DIR ./roslings",
    )


def _ways(python: str, scratch: Path) -> list[Callable[[], Iterator[Path]]]:
    return [
        _from_folder,
        lambda: from_python(python),
        _from_other_pythons,
        lambda: wheel_from_index(scratch),
        lambda: from_apt(scratch),
    ]


def answers(python: str, seed: Path) -> bool:
    """An older pip may tell a newer Python its version, and fail at all else."""
    done = subprocess.run(
        [python, "-I", str(seed), "list"],
        capture_output=True,
        stdin=subprocess.DEVNULL,
        check=False,
    )
    return done.returncode == 0


def _from_folder() -> Iterator[Path]:
    folder = os.environ.get("ROSLINGS_WHEELS")
    for wheel in sorted(Path(folder).glob("pip-*.whl")) if folder else ():
        yield wheel / "pip"


def from_python(python: str) -> Iterator[Path]:
    """What that Python tells of its pips; nothing where it does not start."""
    try:
        done = subprocess.run(
            [python, "-c", _ASK],
            capture_output=True,
            stdin=subprocess.DEVNULL,
            text=True,
            timeout=20,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired):
        return
    yield from map(Path, done.stdout.split("\n")[:-1])


def _from_other_pythons() -> Iterator[Path]:
    for python in other_pythons("python3*"):
        yield from from_python(python)


def other_pythons(name: str) -> list[str]:
    """Every Python called `name` on PATH, and those of version managers; each real file once."""
    versions = Path(os.environ.get("PYENV_ROOT") or "~/.pyenv") / "versions"
    folders = [Path(folder) for folder in os.get_exec_path() if folder]
    folders += [*SYSTEM_FOLDERS, *_matching(versions, "*/bin")]
    found = [python for folder in folders for python in _matching(folder, name)]
    return list({python.resolve(): str(python) for python in found if _program(python)}.values())


def _matching(folder: Path, pattern: str) -> list[Path]:
    try:
        return sorted(folder.expanduser().glob(pattern))
    except (OSError, RuntimeError):  # unreadable, or "~" without a home
        return []


def _program(python: Path) -> bool:
    end = python.name.removeprefix("python3")
    return end.lstrip(".").isdigit() or not end


def _from_uv(python: str, scratch: Path) -> Iterator[Path]:
    uv = shutil.which("uv")
    command = ["pip", "install", "--python", python, "--target", str(scratch), "pip"]
    if uv and _quietly([uv, *command], scratch):
        yield scratch / "pip"


def from_apt(scratch: Path) -> Iterator[Path]:
    """`apt-get download` and `dpkg-deb -x` need no root."""
    if not (shutil.which("apt-get") and shutil.which("dpkg-deb")):
        return
    if not _quietly(["apt-get", "download", "python3-pip-whl"], scratch):
        return
    for package in scratch.glob("python3-pip-whl*.deb"):
        _quietly(["dpkg-deb", "-x", str(package), "unpacked"], scratch)
    for wheel in scratch.glob("unpacked/usr/share/python-wheels/pip-*.whl"):
        yield wheel / "pip"


def _quietly(command: list[str], folder: Path) -> bool:
    folder.mkdir(parents=True, exist_ok=True)
    done = subprocess.run(
        command, cwd=folder, capture_output=True, stdin=subprocess.DEVNULL, check=False
    )
    return done.returncode == 0


def interpreter() -> str:
    """The Python that runs this, outside of any virtual environment."""
    return getattr(sys, "_base_executable", "") or sys.executable
