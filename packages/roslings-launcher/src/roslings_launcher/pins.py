"""`./roslings pins [--upgrade]`: writes constraints.txt and sizes.json again, for maintainers.

Pins that still fit stay as they are, unless `--upgrade` asks for newer ones. The sizes are
measured with every Python from 3.10 to 3.14 that this machine has; those of the others are kept.
"""

import json
import shutil
import subprocess
import tempfile
import urllib.request
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from roslings_launcher import constraints, groups, sizes
from roslings_launcher.errors import LauncherTrouble, say
from roslings_launcher.installing import Installer, drain
from roslings_launcher.packages import normal
from roslings_launcher.place import CoursePlace
from roslings_launcher.seeds import interpreter, other_pythons
from roslings_launcher.virtual import Virtual

_HEADER = """\
# Every package of every group of pyproject.toml, transitive ones included, Python 3.10 to 3.14.
# Behind each stand the groups that need it; what they need beside it is not looked for any more.
# Written by `./roslings pins`; edit pyproject.toml instead, and run that again.
"""
_MINORS = (10, 11, 12, 13, 14)


def write_pins(place: CoursePlace, upgrade: bool) -> None:
    """Pins every package of every group of `place`, then measures what each group downloads.

    Raises:
        LauncherTrouble: the groups do not go together, or the index does not answer.
    """
    with tempfile.TemporaryDirectory(prefix="roslings-") as scratch:
        folder = Path(scratch).resolve()
        _Pinning(place, _uv(place, folder / "uv"), folder).write(upgrade)
        measured = {
            version: _measured(place, Virtual(folder / version), python)
            for version, python in _pythons()
        }
    table = json.dumps(sizes.read() | measured, indent=2, sort_keys=True)
    sizes.FILE.write_text(f"{table}\n", encoding="utf-8")


def _uv(place: CoursePlace, folder: Path) -> str:
    if found := shutil.which("uv"):
        return found
    installer = Installer(place, Virtual(folder))
    installer.virtual.make(interpreter(), sees_system=False)
    installer.require_tools()
    drain(installer.pip(), ["install", "uv"], place.root)
    return str(folder / "bin" / "uv")


@dataclass(frozen=True)
class _Pinning:
    """Asks uv for one set of pins, and then which of them each group needs."""

    place: CoursePlace
    uv: str
    scratch: Path

    def write(self, upgrade: bool) -> None:
        names = groups.names(self.place.pyproject)
        pins = self.scratch / "all.txt"
        if not upgrade:
            shutil.copyfile(self.place.constraints, pins)
        lines = self._compiled(pins, names)
        needed = {name: self._compiled(self._like(pins, name), [name]) for name in names}
        text = "".join(f"{line}  # {_needing(line, needed)}\n" for line in lines)
        self.place.constraints.write_text(_HEADER + text, encoding="utf-8")

    def _like(self, pins: Path, name: str) -> Path:
        """uv keeps the versions that it finds where it is to write."""
        return Path(shutil.copyfile(pins, self.scratch / f"group-{name}.txt"))

    def _compiled(self, pins: Path, names: Sequence[str]) -> list[str]:
        words = ["pip", "compile", "--universal", "--python-version", "3.10", "--no-header"]
        named = [word for name in names for word in ("--group", name)]
        done = subprocess.run(
            [self.uv, *words, "--no-annotate", "--quiet", *named, "-o", str(pins)],
            cwd=self.place.root,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
        if done.returncode != 0:
            raise LauncherTrouble(f"Could not be pinned.\n{done.stderr}", "Mend pyproject.toml.")
        return [pin.requirement for pin in constraints.read(pins)]


def _needing(line: str, needed: dict[str, list[str]]) -> str:
    """The groups that need a package.

    By its name: asked about alone, a group may be content with another version or marker than
    all groups together.
    """
    package = _package(line)
    return " ".join(name for name in needed if package in map(_package, needed[name]))


def _package(line: str) -> str:
    return line.partition("==")[0].strip()


def _pythons() -> Iterator[tuple[str, str]]:
    for minor in _MINORS:
        for python in other_pythons(f"python3.{minor}"):
            if subprocess.run([python, "-c", ""], capture_output=True, check=False).returncode == 0:
                yield f"3.{minor}", python
                break


def _measured(place: CoursePlace, virtual: Virtual, python: str) -> dict[str, float]:
    """Group -> megabytes that it adds to the groups before it."""
    say(f"Measuring what the groups download on {python}")
    virtual.make(python, sees_system=False)
    installer = Installer(place, virtual)
    installer.require_tools()
    names = groups.names(place.pyproject)
    size_b = _sizes_b(installer, _one_each(installer.all_of(names)))
    found, counted = {}, set[str]()
    for name in names:
        new = set(_one_each(installer.all_of([name]))) - counted
        found[name] = round(sum(size_b[package] for package in new) / 1e6, 1)
        counted |= new
    return found


def _one_each(pins: Sequence[str]) -> list[str]:
    """One pin a package: 3.11.4 and 3.11.5 may need two, and pip then asks for both."""
    return sorted({_package(pin): pin for pin in pins}.values())


def _sizes_b(installer: Installer, packages: Sequence[str]) -> dict[str, int]:
    """`name==version` -> bytes of the file that pip would download."""
    report = installer.virtual.folder / "report.json"
    words = ["install", "--dry-run", "--ignore-installed", "--no-deps", "--no-build-isolation"]
    drain(installer.pip(), [*words, "--report", str(report), *packages], installer.place.root)
    plan = json.loads(report.read_text(encoding="utf-8"))["install"]
    with ThreadPoolExecutor(8) as workers:
        found = workers.map(_size_b, (item["download_info"]["url"] for item in plan))
        return dict(zip((_pin(item["metadata"]) for item in plan), found, strict=True))


def _pin(metadata: dict[str, str]) -> str:
    return f"{normal(metadata['name'])}=={metadata['version']}"


def _size_b(url: str) -> int:
    request = urllib.request.Request(url, method="HEAD")
    with urllib.request.urlopen(request, timeout=30) as answer:
        return int(answer.headers["Content-Length"])
