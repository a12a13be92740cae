"""A platform, played: its folders, user, environment and time limit, and a bundle that is set up.

Setting up makes an environment of 80 MB. Here each bundle is given that of these tests, by hard
links: `./roslings` finds it complete, and downloads nothing.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from stage import NOBODY, readable_to_all

from roslings import course
from roslings_class.export import SYSTEMS, export
from roslings_launcher.sources import OFFERS, offers_as_written
from roslings_launcher.virtual import Virtual

LAB = course.lab("topics")
SYSTEMS_PATH = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
WRITTEN_ANEW = ("bin", "pyvenv.cfg", "roslings")
"""Parts of an environment that name its place: copied, so that nothing is written through."""


@dataclass(frozen=True)
class Played:
    """One platform with a bundle of the lab."""

    place: Path
    bundle: Path
    user: int
    environment: dict[str, str]
    lab: course.Lab

    def run(
        self, *words: str, cwd: Path, within_s: float, env: Mapping[str, str] | None = None
    ) -> subprocess.CompletedProcess[str]:
        """A command as the platform gives it: its user, its variables and no others."""
        return subprocess.run(
            [*readable_to_all(self.user, f"--hide={course.root() / 'labs'}"), *words],
            cwd=cwd,
            env={**self.environment, **(env or {})},
            timeout=within_s,
            text=True,
            capture_output=True,
            check=False,
        )

    def hand_in(self, to: Path) -> Path:
        """The solution's files in the folder `to`."""
        shutil.copytree(self.lab.solution, to / self.lab.card.package)
        self.give(to)
        return to

    def give(self, folder: Path) -> None:
        """A folder of the platform's own user."""
        for at, folders, files in os.walk(folder):
            for name in (at, *(str(Path(at, each)) for each in (*folders, *files))):
                os.chown(name, self.user, self.user, follow_symlinks=False)


@contextmanager
def played(
    name: str,
    bundle_at: str,
    environment: Mapping[str, str] | None = None,
    user: int = 0,
    hidden: str | None = None,
    lab: course.Lab = LAB,
) -> Iterator[Played]:
    """The platform `name`, whose bundle lies at `bundle_at` below a folder of its own.

    `hidden` are checks that students do not have, as text.
    """
    place = Path(tempfile.mkdtemp(prefix="played-"))
    place.chmod(0o755)
    try:
        bundle = place / bundle_at
        export(name, replace(lab, hidden=_written(place, hidden)), bundle)
        (place / "instructors_own.py").unlink(missing_ok=True)
        furnish(bundle / SYSTEMS[name].course.replace("@LAB@", lab.name))
        home = place / "home"
        home.mkdir()
        own = {"PATH": SYSTEMS_PATH, "HOME": str(home), "LANG": "C.UTF-8", **(environment or {})}
        made = Played(place, bundle, user, own, lab)
        made.give(home)
        yield made
    finally:
        shutil.rmtree(place, ignore_errors=True)


def _written(place: Path, hidden: str | None) -> Path | None:
    """The file that an instructor names. It is gone when the platform begins to grade."""
    if hidden is None:
        return None
    file = place / "instructors_own.py"
    file.write_text(hidden, "utf-8")
    return file


def furnish(root: Path) -> None:
    """The environment of these tests for the course in `root`."""
    old, new = Path(sys.prefix), root / ".venv"
    subprocess.run(["cp", "-al", str(old), str(new)], check=True)
    for part in WRITTEN_ANEW:
        again(old / part, new / part)
    virtual = Virtual(new)
    virtual.moved_from(old)
    virtual.see(root)
    (new / "roslings/home").write_text(f"{root}\n")
    libraries = new / "roslings/libraries"
    libraries.write_text(libraries.read_text().replace(str(old), str(new)))
    for name in ("constraints.txt", "pyproject.toml"):
        shutil.copy(root / name, new / "roslings" / name)
    (new / "roslings" / OFFERS).write_text(offers_as_written(root), "utf-8")
    subprocess.run(["chmod", "-R", "go+rX", str(root)], check=True)


def again(source: Path, copy: Path) -> None:
    """A copy in place of hard links."""
    if source.is_dir():
        shutil.rmtree(copy)
        shutil.copytree(source, copy, symlinks=True)
    else:
        copy.unlink()
        shutil.copy2(source, copy)


ORDINARY = NOBODY
