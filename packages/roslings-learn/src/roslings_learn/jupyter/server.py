"""JupyterLab with the course's kernel, on the right day.

Nothing is written into the student's home but the notebooks: kernel and settings go into the
environment, at each start, so that they are right wherever the clone lies now. Where many use one
installation, nobody may write there: then they lie in the student's workspace.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.typed_paths import shown
from roslings_learn.jupyter.copies import LESSON, LIST, Copies
from roslings_learn.jupyter.errors import NoHub

KERNEL = "roslings"
FROM_HUB = "JUPYTERHUB_SERVICE_URL"
"""JupyterHub tells each server that it starts where to listen."""
TITLE = "ROS 2 (roslings)"
SETTINGS_FOLDER = "lab/settings"
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
    hub: bool = False
    """JupyterHub has started this, for one of its users, and says where the server listens."""

    @property
    def page(self) -> str:
        """Its path in JupyterLab."""
        return f"/lab/tree/{self.day}/{LESSON}" if self.day else f"/lab/tree/{LIST}"


def open_lab(place: Place) -> int:
    """Run JupyterLab until Ctrl-C; returns its exit code. Raises NoHub."""
    if place.hub and FROM_HUB not in os.environ:
        raise NoHub
    share = write_kernel(Path(sys.prefix), place.copies.workspace)
    words, variables = command(place, share), environment(share)
    if place.hub:  # it ends what it has started: this process, and no child of it
        sys.stdout.flush()
        os.execve(words[0], words, variables)
    what = f"{place.day}/{LESSON}" if place.day else LIST
    print(f"JupyterLab opens {shown(place.copies.folder / what)}")
    print("To end it: Ctrl-C here, twice.", flush=True)
    return subprocess.run(words, env=variables, check=False).returncode


def command(place: Place, share: Path) -> list[str]:
    """The server's command line; kernel and settings lie in `share`."""
    words = [
        f"--ServerApp.root_dir={place.copies.folder}",
        f"--MappingKernelManager.default_kernel_name={KERNEL}",
        f"--LabApp.app_settings_dir={share / SETTINGS_FOLDER}",
        "--LabApp.extension_manager=readonly",  # the other one asks the network
        "--log-level=ERROR",
    ]
    if os.geteuid() == 0:  # in a container; the server still listens on this computer alone
        words.append("--allow-root")
    program = "jupyterhub.singleuser" if place.hub else "jupyterlab"
    own = _of_hub(place) if place.hub else _alone(place)
    return [sys.executable, "-m", program, *words, *own]


def _of_hub(place: Place) -> list[str]:
    return [f"--ServerApp.default_url={place.page}"]


def _alone(place: Place) -> list[str]:
    words = [f"--LabApp.default_url={place.page}"]
    if place.port is not None:
        words += [f"--ServerApp.port={place.port}", "--ServerApp.port_retries=0"]
    if place.ip is not None:
        words.append(f"--ServerApp.ip={place.ip}")
    if not place.browser:
        words.append("--no-browser")
    return words


def environment(share: Path) -> dict[str, str]:
    """Our kernels and settings come before those of the student's home."""
    own = {} if share.is_relative_to(sys.prefix) else {"JUPYTER_PATH": _before(share, os.environ)}
    return {**os.environ, "JUPYTER_PREFER_ENV_PATH": "1", **own}


def _before(share: Path, variables: Mapping[str, str]) -> str:
    others = variables.get("JUPYTER_PATH")
    return os.pathsep.join([str(share), *([others] if others else [])])


def write_kernel(prefix: Path, workspace: Path) -> Path:
    """Write the kernel and the settings into the environment `prefix`; the folder they are in.

    Where they cannot be written there, they go into the workspace. Raises OSError.
    """
    share = prefix / "share" / "jupyter"
    try:
        _write_into(share, prefix)
    except OSError:
        share = workspace / ".roslings" / "jupyter"
        _write_into(share, prefix)
    return share


def _write_into(share: Path, prefix: Path) -> None:
    _write_json(share / "kernels" / KERNEL / "kernel.json", _kernel(prefix))
    _write_json(share / SETTINGS_FOLDER / "overrides.json", SETTINGS)


def _kernel(prefix: Path) -> dict[str, object]:
    python = str(prefix / "bin" / "python")
    return {
        "argv": [python, "-m", "ipykernel_launcher", "-f", "{connection_file}"],
        "display_name": TITLE,
        "language": "python",
        "metadata": {"debugger": True},
    }


def _write_json(file: Path, content: object) -> None:
    """What is right already may belong to another user."""
    text = json.dumps(content, indent=1) + "\n"
    if not file.is_file() or file.read_text("utf-8") != text:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
