"""JupyterLab with the course's kernel, on the right day.

Nothing is written into the student's home but the notebooks: kernel and settings go into the
environment, at each start, so that they are right wherever the clone lies now.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.typed_paths import shown
from roslings_learn.jupyter.copies import LESSON, LIST, Copies

KERNEL = "roslings"
TITLE = "ROS 2 (roslings)"
SETTINGS = {
    # Asks for news on the network, in a window over the lesson.
    "@jupyterlab/apputils-extension:notification": {"fetchNews": "false", "checkForUpdates": False},
    # A lesson is a page to read: all of it stays on the page, also what is out of sight.
    "@jupyterlab/notebook-extension:tracker": {"windowingMode": "defer"},
    # The list of days is for reading.
    "@jupyterlab/docmanager-extension:plugin": {"defaultViewers": {"markdown": "Markdown Preview"}},
}


@dataclass(frozen=True)
class Place:
    """What to open, and how."""

    copies: Copies
    day: str | None
    """The id of a day; None opens the list of days."""
    port: int | None = None
    browser: bool = True
    ip: str | None = None
    """Where the server listens; None is this computer alone."""

    @property
    def page(self) -> str:
        """Its path in JupyterLab."""
        return f"/lab/tree/{self.day}/{LESSON}" if self.day else f"/lab/tree/{LIST}"


def open_lab(place: Place) -> int:
    """Run JupyterLab until Ctrl-C; returns its exit code."""
    write_kernel(Path(sys.prefix))
    what = f"{place.day}/{LESSON}" if place.day else LIST
    print(f"JupyterLab opens {shown(place.copies.folder / what)}")
    print("To end it: Ctrl-C here, twice.", flush=True)
    return subprocess.run(command(place), env=environment(), check=False).returncode


def command(place: Place) -> list[str]:
    """The server's command line."""
    words = [
        f"--ServerApp.root_dir={place.copies.folder}",
        f"--LabApp.default_url={place.page}",
        f"--MappingKernelManager.default_kernel_name={KERNEL}",
        "--LabApp.extension_manager=readonly",  # the other one asks the network
        "--log-level=ERROR",
    ]
    if place.port is not None:
        words += [f"--ServerApp.port={place.port}", "--ServerApp.port_retries=0"]
    if place.ip is not None:
        words.append(f"--ServerApp.ip={place.ip}")
    if not place.browser:
        words.append("--no-browser")
    if os.geteuid() == 0:  # in a container; the server still listens on this computer alone
        words.append("--allow-root")
    return [sys.executable, "-m", "jupyterlab", *words]


def environment() -> dict[str, str]:
    """This environment's kernels and settings come before those of the student's home."""
    return {**os.environ, "JUPYTER_PREFER_ENV_PATH": "1"}


def write_kernel(prefix: Path) -> None:
    """Write the kernel and the settings into the environment `prefix`."""
    share = prefix / "share" / "jupyter"
    _write_json(share / "kernels" / KERNEL / "kernel.json", _kernel(prefix))
    _write_json(share / "lab" / "settings" / "overrides.json", SETTINGS)


def _kernel(prefix: Path) -> dict[str, object]:
    python = str(prefix / "bin" / "python")
    return {
        "argv": [python, "-m", "ipykernel_launcher", "-f", "{connection_file}"],
        "display_name": TITLE,
        "language": "python",
        "metadata": {"debugger": True},
    }


def _write_json(file: Path, content: object) -> None:
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
