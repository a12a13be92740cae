"""`./roslings pins [--upgrade]`: writes constraints.txt and sizes.json again, for maintainers.

Pins that still fit stay as they are, unless `--upgrade` asks for newer ones. The sizes are
measured with every Python from 3.10 to 3.13 that this machine has; those of the others are kept.
"""

import json
import shutil
import subprocess
import tempfile
import urllib.request
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from roslings.bootstrap import groups, sizes
from roslings.bootstrap.installing import Installer, drain, wanted
from roslings.bootstrap.place import Place
from roslings.bootstrap.seeds import interpreter, other_pythons
from roslings.bootstrap.trouble import Trouble, say
from roslings.bootstrap.virtual import Virtual

_HEADER = """\
# Every package of every group of pyproject.toml, transitive ones included, Python 3.10 to 3.13.
# Written by `./roslings pins`; edit pyproject.toml instead, and run that again.
"""
_MINORS = (10, 11, 12, 13)


def write_pins(place: Place, upgrade: bool) -> None:
    """Pins every package of every group of `place`, then measures what each group downloads.

    Raises:
        Trouble: the groups do not go together, or the index does not answer.
    """
    with tempfile.TemporaryDirectory(prefix="roslings-") as scratch:
        folder = Path(scratch).resolve()
        _compile(_uv(place, folder / "uv"), place, folder / "pins.txt", upgrade)
        measured = {
            version: _measure(place, Virtual(folder / version), python)
            for version, python in _pythons()
        }
    table = json.dumps(sizes.read() | measured, indent=2, sort_keys=True)
    sizes.FILE.write_text(f"{table}\n", encoding="utf-8")


def _uv(place: Place, folder: Path) -> str:
    if found := shutil.which("uv"):
        return found
    installer = Installer(place, Virtual(folder), wheels=None)
    installer.virtual.make(interpreter(), sees_system=False)
    installer.require_tools()
    drain(installer.pip(), ["install", "uv"], place.root)
    return str(folder / "bin" / "uv")


def _compile(uv: str, place: Place, pins: Path, upgrade: bool) -> None:
    if not upgrade:
        shutil.copyfile(place.constraints, pins)
    named = [word for group in groups.names(place.pyproject) for word in ("--group", group)]
    words = ["pip", "compile", "--universal", "--python-version", "3.10", "--no-header"]
    done = subprocess.run(
        [uv, *words, "--no-annotate", "--quiet", *named, "-o", str(pins)],
        cwd=place.root,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        check=False,
    )
    if done.returncode != 0:
        raise Trouble(f"The groups could not be pinned.\n{done.stderr}", "Mend pyproject.toml.")
    place.constraints.write_text(_HEADER + _without_comments(pins), encoding="utf-8")


def _without_comments(pins: Path) -> str:
    lines = pins.read_text(encoding="utf-8").splitlines(keepends=True)
    return "".join(line for line in lines if not line.startswith("#"))


def _pythons() -> Iterator[tuple[str, str]]:
    for minor in _MINORS:
        for python in other_pythons(f"python3.{minor}"):
            if subprocess.run([python, "-c", ""], capture_output=True, check=False).returncode == 0:
                yield f"3.{minor}", python
                break


def _measure(place: Place, virtual: Virtual, python: str) -> dict[str, float]:
    """Group -> megabytes that it adds to the groups before it."""
    say(f"Measuring what the groups download on {python}")
    virtual.make(python, sees_system=False)
    installer = Installer(place, virtual, wheels=None)
    installer.require_tools()
    names, before_b, found = groups.names(place.pyproject), 0, {}
    for count, name in enumerate(names, start=1):
        now_b = _download_b(installer, names[:count])
        found[name] = round((now_b - before_b) / 1e6, 1)
        before_b = now_b
    return found


def _download_b(installer: Installer, names: Sequence[str]) -> int:
    report = installer.virtual.folder / "report.json"
    words = ["install", "--dry-run", "--ignore-installed", "--report", str(report)]
    drain(installer.pip(), [*words, *wanted(installer.place, names)], installer.place.root)
    plan = json.loads(report.read_text(encoding="utf-8"))
    with ThreadPoolExecutor(8) as workers:
        return sum(workers.map(_size_b, (item["download_info"]["url"] for item in plan["install"])))


def _size_b(url: str) -> int:
    request = urllib.request.Request(url, method="HEAD")
    with urllib.request.urlopen(request, timeout=30) as answer:
        return int(answer.headers["Content-Length"])
