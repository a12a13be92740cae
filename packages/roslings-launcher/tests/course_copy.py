"""A course in miniature: the real script and bootstrap, with tiny packages and a tiny command."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

REAL = Path(__file__).resolve().parents[3]

# What runs in place of the command line: says what it sees, and ends as its second word says.
COMMAND = """
import importlib.util, json, os, sys

def begin():
    print(json.dumps(seen))
    code = sys.argv[2] if len(sys.argv) > 2 else "0"
    sys.exit(int(code) if code.isdigit() else 0)

seen = {
    "words": sys.argv[1:],
    "prefix": sys.prefix,
    "python": list(sys.version_info[:2]),
    "path": sys.path,
    "libraries": os.environ.get("LD_LIBRARY_PATH", ""),
    "ready_s": os.environ.get("ROSLINGS_READY_S"),
    "once": os.environ.get("_ROS_WHEELS_BOOTSTRAP_COMPLETE", ""),
    "has": [n for n in ("ros_x", "col_x", "check_x", "draw_x", "bag_x", "type_x", "rclpy")
            if importlib.util.find_spec(n)],
}
"""

PYPROJECT = """\
[dependency-groups]
setup = ["pip", "setuptools"]
ros = ["ros-x"]
colcon = ["col-x"]
check = ["check-x"]
graph = ["draw-x"]
ros2 = ["bag-x"]
test = [{include-group = "check"}]
"""

PINS = {"ros-x": "1.0", "col-x": "1.0", "check-x": "1.0", "draw-x": "1.0", "bag-x": "1.0"}

GROUPS = {
    "pip": "setup",
    "setuptools": "setup",
    "ros-x": "ros",
    "col-x": "colcon",
    "check-x": "check test",
    "draw-x": "graph",
    "bag-x": "ros2",
}


OFFERING = ("roslings-launcher", "roslings", "roslings-learn")
"""Packages that bring commands. Shells and Python put such names in different orders."""


@dataclass
class Outcome:
    """How one run of `./roslings` ended."""

    code: int
    out: str
    err: str

    @property
    def seen(self) -> dict[str, Any]:
        """What the command saw."""
        found: dict[str, Any] = json.loads(self.out)
        return found


@dataclass
class CourseCopy:
    """A course in `root` whose packages come from `wheels`."""

    root: Path
    wheels: Path
    environment: dict[str, str]
    pins: dict[str, str] = field(default_factory=lambda: dict(PINS))
    patience_s: float = 300

    def lay_out(self) -> None:
        """Writes the course's files."""
        bootstrap = Path("packages/roslings-launcher/src/roslings_launcher")
        self.root.mkdir(parents=True)
        shutil.copy2(REAL / "roslings", self.root)
        shutil.copytree(
            REAL / bootstrap, self.root / bootstrap, ignore=shutil.ignore_patterns("__pycache__")
        )
        for name in OFFERING:
            (self.root / f"packages/{name}").mkdir(exist_ok=True)
            offers = self.root / f"packages/{name}/entry_points.txt"
            module = name.replace("-", "_")
            offers.write_text(f"[roslings.command]\n{module} = {module}.x:Y\n")
        (self.root / bootstrap / "cli/__init__.py").write_text(COMMAND)
        (self.root / "packages/ros2-on-pip/src/ros2_on_pip/stand_ins").mkdir(parents=True)
        (self.root / "pyproject.toml").write_text(PYPROJECT)
        self.pin()

    def pin(self, **versions: str) -> None:
        """Writes the constraints; `ros_x="2.0"` changes a pin."""
        self.pins |= {name.replace("_", "-"): version for name, version in versions.items()}
        lines = [f"{name}=={version}  # {GROUPS[name]}\n" for name, version in self.pins.items()]
        lines.append("other-x==1.0 ; python_full_version < '3'  # ros colcon check graph\n")
        (self.root / "constraints.txt").write_text("".join(lines))

    @property
    def venv(self) -> Path:
        """Where the environment stands when no ROS is sourced."""
        return self.root / ".venv"

    @property
    def site(self) -> Path:
        """The environment's packages."""
        return next(self.venv.glob("lib/python3*/site-packages"))

    def run(self, *words: str, **changes: str | None) -> Outcome:
        """Runs `./roslings words...`; a change to None takes a variable away."""
        return self.run_through(self.root / "roslings", *words, **changes)

    def run_through(self, script: Path, /, *words: str, **changes: str | None) -> Outcome:
        """The same through a link to the script."""
        done = subprocess.run(
            [script, *words],
            env=self.changed(changes),
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=self.patience_s,
            check=False,
        )
        return Outcome(done.returncode, done.stdout, done.stderr)

    def start(self, *words: str, **changes: str | None) -> subprocess.Popen[str]:
        """The same in a process group of its own, not waited for."""
        return subprocess.Popen(
            [self.root / "roslings", *words],
            env=self.changed(changes),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )

    def changed(self, changes: dict[str, str | None]) -> dict[str, str]:
        """The environment variables with `changes` applied."""
        mixed: dict[str, str | None] = {**self.environment, **changes}
        return {name: value for name, value in mixed.items() if value is not None}


def plain_environment(home: Path, python: str) -> dict[str, str]:
    """The variables of a new user; nothing of the machine that runs the tests."""
    home.mkdir(exist_ok=True)
    return {
        "PATH": "/usr/bin:/bin",
        "HOME": str(home),
        "ROSLINGS_PYTHON": python,
        "PIP_CONFIG_FILE": os.devnull,
    }
