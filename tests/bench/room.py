"""A room of fresh environments from one `./roslings serve`; prints, and asserts nothing.

    .venv/bin/python tests/bench/room.py [COUNT] [AT_ONCE]

Each student has a home of their own, empty but for what is typed: the lines of the first page,
with packages from nowhere else, up to the first grading. Told are the seconds of one, from Enter to
100 points, those of all, the processor's seconds of one, and what one fetches and keeps on the
disk: the course with its environment, and what pip keeps. All students are on this computer, so its
processors and its disk are what they share; 30 of them take 11 GB until all are done.
"""

from __future__ import annotations

import os
import platform
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from roslings import course
from roslings.arena.kernel import cores
from roslings_class.classroom import ARCHIVE, LOOPBACK, Handout, commands, made_in, serving

COUNT, AT_ONCE = 30, 2
GROUPS = ("ros", "colcon", "check")
RIGHT = "100 of 100"


@dataclass(frozen=True)
class Ready:
    """A student who has typed all lines."""

    right: bool
    wall_s: float
    cpu_s: float


def main(words: Sequence[str]) -> None:
    """Fill a folder of packages, serve it, and let them all begin."""
    count, at_once = map(int, [*words, *map(str, (COUNT, AT_ONCE)[len(words) :])])
    print(f"{platform.platform()}, Python {platform.python_version()}, {cores()} cores")
    with tempfile.TemporaryDirectory(prefix="roslings-room-") as name:
        folder = Path(name).resolve()
        _fill(folder / "wheels")
        offered = made_in(folder / "served", folder / "wheels", None)
        with serving(offered, LOOPBACK, 0) as (address, *_):
            homes = [folder / f"student-{number}" for number in range(count)]
            began_s = time.monotonic()
            with ThreadPoolExecutor(at_once) as desks:
                found = list(desks.map(lambda home: _student(home, address), homes))
            whole_s = time.monotonic() - began_s
        print(f"{count} students, {at_once} at once: {whole_s:.0f} s for all")
        _tell(found, offered, _size_mb(homes[0]))


def _fill(wheels: Path) -> None:
    words = [str(course.root() / "roslings"), "wheels", str(wheels), *GROUPS]
    subprocess.run(words, check=True, capture_output=True, env=os.environ | _python())


def _python() -> dict[str, str]:
    """The wheels are for this one."""
    return {"ROSLINGS_PYTHON": str(Path(sys.base_prefix, "bin", "python3"))}


def _student(home: Path, address: str) -> Ready:
    """One of them, from the first line to the last."""
    home.mkdir()
    plain = {"PATH": "/usr/bin:/bin", "HOME": str(home), "PIP_CONFIG_FILE": os.devnull}
    began_s, log = time.monotonic(), home / "said.txt"
    with log.open("w") as said:
        typed = subprocess.Popen(
            ["bash", "-ec", "\n".join(commands(address))],
            cwd=home,
            stdout=said,
            stderr=said,
            stdin=subprocess.DEVNULL,
            env={**plain, **_python(), "no_proxy": "*"},
        )
        _, status, used = os.wait4(typed.pid, 0)
    typed.returncode = os.waitstatus_to_exitcode(status)
    wall_s = time.monotonic() - began_s
    right = typed.returncode == 0 and RIGHT in log.read_text("utf-8")
    if not right:
        print(log.read_text("utf-8")[-2000:], file=sys.stderr)
    return Ready(right, wall_s, used.ru_utime + used.ru_stime)


def _size_mb(folder: Path) -> float:
    said = subprocess.run(["du", "-sk", folder], capture_output=True, text=True, check=True)
    return int(said.stdout.split()[0]) / 1000


def _tell(found: Sequence[Ready], offered: Handout, kept_mb: float) -> None:
    wall_s, cpu_s = (median(getattr(each, name) for each in found) for name in ("wall_s", "cpu_s"))
    longest_s = max(each.wall_s for each in found)
    fetched = [*offered.wheels.values(), offered.files[ARCHIVE]]
    fetched_mb = sum(file.stat().st_size for file in fetched) / 1e6
    print(f"{sum(each.right for each in found)} of {len(found)} have {RIGHT}")
    print(f"one of them: {wall_s:.0f} s (longest {longest_s:.0f} s), {cpu_s:.0f} CPU s")
    print(f"one fetches {fetched_mb:.0f} MB and keeps {kept_mb:.0f} MB on the disk")


if __name__ == "__main__":
    main(sys.argv[1:])
