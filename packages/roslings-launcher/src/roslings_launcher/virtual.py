"""The virtual environment as such: made, moved, found whole. Knows nothing of what goes into it."""

import os
import shlex
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from roslings_launcher import __version__
from roslings_launcher.errors import LauncherTrouble, disk_full
from roslings_launcher.sources import OFFERS, offers, seen_by_python

COMMANDS = (
    "ros2",
    "rqt",
    "rqt_console",
    "rqt_graph",
    "rqt_image_view",
    "rqt_plot",
    "rqt_publisher",
    "rqt_reconfigure",
    "rqt_topic",
    "rviz2",
)
_COMMAND = """#!/bin/sh
# `{name}` of roslings, for machines where the real one is not installed.
exec {script} {name} "$@"
"""
_LOCAL_SETUP = """# Nothing is left to set: `source setup.bash` in the roslings folder has
# done it. colcon looks for this file in each folder of AMENT_PREFIX_PATH, and warns where it is
# missing.
"""
_METADATA = {"Metadata-Version": "2.1", "Name": "roslings_workspace", "Version": __version__}
"""All packages of the course, as one distribution."""
_SHELLS = ("bash", "sh", "zsh")
_FACTS = "import sys, sysconfig; print(sys.prefix); print(sysconfig.get_path('purelib'))"


@dataclass(frozen=True)
class Virtual:
    """A virtual environment in `folder`."""

    folder: Path

    @property
    def python(self) -> Path:
        """Its interpreter."""
        return self.folder / "bin" / "python"

    @property
    def site(self) -> Path:
        """Where its packages lie."""
        return next(self.folder.glob("lib/python3.*/site-packages"), self.folder / "site-packages")

    def runs(self) -> bool:
        """Whether its Python starts, and takes this folder for its own."""
        try:
            done = subprocess.run(
                [self.python, "-I", "-c", _FACTS],
                env={"_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1"},  # once is enough to say it
                capture_output=True,
                stdin=subprocess.DEVNULL,
                text=True,
                check=False,
            )
        except OSError:
            return False
        return done.stdout.splitlines() == [str(self.folder), str(self.site)]

    def make(self, python: str, sees_system: bool) -> None:
        """A new, empty environment of `python`; whatever was there is gone.

        Raises:
            LauncherTrouble: this Python cannot make one.
        """
        self.remove()
        command = [python, "-m", "venv", "--without-pip", *_seeing(sees_system), str(self.folder)]
        done = subprocess.run(
            command, capture_output=True, stdin=subprocess.DEVNULL, text=True, check=False
        )
        if done.returncode != 0:
            raise _no_venv(python, self.folder, done.stdout + done.stderr)

    def remove(self) -> None:
        """Nothing is left of it."""
        if self.folder.is_symlink():
            self.folder.unlink()
        elif self.folder.exists():
            shutil.rmtree(self.folder)

    def see(self, root: Path) -> None:
        """Programs of this environment can import the course's code, and its commands are here."""
        seen = "".join(f"{place}\n" for place in seen_by_python(root))
        _put(self.site / "roslings.pth", seen)
        self._tell_offers(offers(root))
        for name in COMMANDS:
            self._add_command(root, name)
        for shell in _SHELLS:
            (self.folder / f"local_setup.{shell}").write_text(_LOCAL_SETUP, encoding="utf-8")

    def _tell_offers(self, told: str) -> None:
        """Write the folder by which Python finds entry points; our packages are not built here."""
        info = self.site / f"{_METADATA['Name']}-{_METADATA['Version']}.dist-info"
        info.mkdir(exist_ok=True)
        files = {
            "METADATA": "".join(f"{name}: {value}\n" for name, value in _METADATA.items()),
            "INSTALLER": "roslings\n",
            OFFERS: told,
        }
        for name, text in files.items():
            _put(info / name, text)
        rows = [f"{info.name}/{name},,{len(text.encode())}\n" for name, text in files.items()]
        _put(info / "RECORD", "".join(rows) + f"{info.name}/RECORD,,\n")

    def _add_command(self, root: Path, name: str) -> None:
        """A real command of this name, further on the path, is handed over to by our own."""
        program = self.folder / "bin" / name
        program.write_text(
            _COMMAND.format(script=shlex.quote(str(root / "roslings")), name=name), encoding="utf-8"
        )
        program.chmod(0o755)

    def moved_from(self, old: Path) -> None:
        """Its scripts name the Python in `old`; from here on, the one in this folder."""
        for script in (self.folder / "bin").iterdir():
            if script.is_file() and not script.is_symlink():
                _rename_inside(script, os.fsencode(old), os.fsencode(self.folder))
        _rename_inside(self.folder / "pyvenv.cfg", os.fsencode(old), os.fsencode(self.folder))


def _seeing(system: bool) -> list[str]:
    return ["--system-site-packages"] if system else []


def _put(file: Path, text: str) -> None:
    """In place of what is there: another environment may hold the same file by a hard link."""
    new = file.with_name(f"{file.name}.new")
    new.write_text(text, encoding="utf-8")
    new.replace(file)


def _rename_inside(file: Path, old: bytes, new: bytes) -> None:
    content = file.read_bytes()
    if old in content:
        file.write_bytes(content.replace(old, new))


def _no_venv(python: str, folder: Path, output: str) -> LauncherTrouble:
    if "No module named venv" in output:
        version = "3" if python != sys.executable else f"3.{sys.version_info.minor}"
        return LauncherTrouble(
            f"This Python has no venv module: {python}",
            f"On Ubuntu and Debian: sudo apt install python{version}-venv",
        )
    if "No space left" in output:
        return disk_full(folder)
    last = (output.strip().splitlines() or ["it said nothing"])[-1]
    return LauncherTrouble(
        f"{python} could not make an environment: {last}",
        "Take another Python: ROSLINGS_PYTHON=/path/to/python3.12 ./roslings",
    )
