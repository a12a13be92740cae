"""JupyterLab with the course's kernel, on the right day.

Nothing is written into the student's home but the notebooks. Kernel and settings go into the
environment, at each start, so that they are right wherever the clone lies now. Where many use one
installation, nobody may write there: then they lie in the student's workspace.
"""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from socket import socket
from urllib.parse import quote

from ros2_on_pip.surroundings import domain_id
from ros2_on_pip.typed_paths import shown
from roslings_learn.jupyter.copies import LESSON, LIST, Copies
from roslings_learn.jupyter.errors import NoHub
from roslings_learn.of_window import OF_WINDOW, wanted_or_next

KERNEL = "roslings"
FROM_HUB = "JUPYTERHUB_SERVICE_URL"
"""JupyterHub tells each server that it starts where to listen."""
TITLE = "ROS 2 (roslings)"
SETTINGS_FOLDER = "lab/settings"
WINDOW = "roslings_learn.jupyter.window"
EXTENSION, TERMINALS = f"{WINDOW}.extension", f"{WINDOW}.terminals.NamedTerminals"
LABEXTENSIONS = Path(__file__).parent / "window" / "labextension"
READ_FIRST = Path(__file__).parent / "window" / "terminal.bash"
CODESPACES = "app.github.dev"
"""Where GitHub forwards a port of a Codespace to, unless it says another name."""
SETTINGS = {
    # Asks for news on the network, in a window over the lesson.
    "@jupyterlab/apputils-extension:notification": {"fetchNews": "false", "checkForUpdates": False},
    # A lesson is a page to read: all of it stays on the page, also what is out of sight.
    "@jupyterlab/notebook-extension:tracker": {"windowingMode": "defer"},
    # The list of days is for reading.
    "@jupyterlab/docmanager-extension:plugin": {"defaultViewers": {"markdown": "Markdown Preview"}},
}


@dataclass(frozen=True)
class JupyterOptions:
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
        """Its path in JupyterLab: a day has a workspace of its own."""
        if self.day:
            lesson = self.copies.path_of(self.copies.folder / self.day / LESSON)
            return quote(f"/lab/workspaces/{self.day}/tree/{lesson}")
        return quote(f"/lab/tree/{self.copies.path_of(self.copies.folder / LIST)}")


def open_lab(place: JupyterOptions) -> int:
    """Run JupyterLab until Ctrl-C; returns its exit code.

    Raises NoHub, BadDomain, NoFreeDomain, and what cannot be written in the workspace.
    """
    if place.hub and FROM_HUB not in os.environ:
        raise NoHub
    share = write_kernel(Path(sys.prefix), place.copies.workspace)
    domain, held = _domain()
    words = command(place, share)
    variables = {**environment(share), "ROS_DOMAIN_ID": str(domain), OF_WINDOW: str(domain)}
    if place.hub:  # it ends what it has started: this process, and no child of it
        held.set_inheritable(True)
        sys.stdout.flush()
        os.execve(words[0], words, variables)
    what = f"{place.day}/{LESSON}" if place.day else LIST
    print(f"JupyterLab opens {shown(place.copies.folder / what)}")
    print("To end it: Ctrl-C here, twice.", flush=True)
    with held:
        return subprocess.run(words, env=variables, check=False).returncode


def _domain() -> tuple[int, socket]:
    """The domain of the window, and its lease. Raises BadDomain, NoFreeDomain."""
    wanted = domain_id()
    domain, held = wanted_or_next(wanted)
    if domain != wanted:
        print(
            f"Another page of ./roslings lab uses ROS domain {wanted}, so this one uses {domain}."
            f" In a terminal outside of it, to see its nodes: export ROS_DOMAIN_ID={domain}"
        )
    return domain, held


def command(place: JupyterOptions, share: Path) -> list[str]:
    """The server's command line; kernel and settings lie in `share`."""
    words = [
        f"--ServerApp.root_dir={place.copies.root}",
        f"--FileContentsManager.preferred_dir={place.copies.path_of(place.copies.folder)}",
        "--ContentsManager.allow_hidden=True",  # a workspace may lie in a hidden folder
        f"--MappingKernelManager.default_kernel_name={KERNEL}",
        f"--LabApp.app_settings_dir={share / SETTINGS_FOLDER}",
        "--LabApp.extension_manager=readonly",  # the other one asks the network
        "--log-level=ERROR",
        *_of_window(place.copies.workspace),
        *_of_machine(os.environ),
    ]
    if os.geteuid() == 0:  # in a container; the server still listens on this computer alone
        words.append("--allow-root")
    program = "jupyterhub.singleuser" if place.hub else "jupyterlab"
    own = _of_hub(place) if place.hub else _alone(place)
    return [sys.executable, "-m", program, *words, *own]


def workspaces(workspace: Path) -> Path:
    """Where JupyterLab keeps how its pages are arranged."""
    return workspace / ".roslings" / "jupyter" / "workspaces"


def _of_window(workspace: Path) -> list[str]:
    """What makes a page of the lesson, terminals that are ready, and the desk."""
    return [
        f"--LabApp.workspaces_dir={workspaces(workspace)}",
        f"--LabApp.extra_labextensions_path={LABEXTENSIONS}",
        f"--ServerApp.jpserver_extensions={EXTENSION}=True",
        f"--TerminalsExtensionApp.terminal_manager_class={TERMINALS}",
        *_shell(),
    ]


def _shell() -> list[str]:
    """Where there is no bash, a terminal is what Jupyter takes."""
    bash = shutil.which("bash")
    if bash is None:
        return []
    words = shlex.join([bash, "--rcfile", str(READ_FIRST), "-i"])
    return [f"--ServerApp.terminado_settings=shell_command={words}"]


def _of_machine(variables: Mapping[str, str]) -> list[str]:
    """How the browser comes here, where it is not one of this computer.

    A file with the address is no use to a browser on another system.
    """
    words = []
    if "WSL_DISTRO_NAME" in variables or "CODESPACE_NAME" in variables:
        words.append("--ServerApp.use_redirect_file=False")
    if name := variables.get("CODESPACE_NAME"):
        domain = variables.get("GITHUB_CODESPACES_PORT_FORWARDING_DOMAIN", CODESPACES)
        pattern = rf"https://{re.escape(name)}-\d+\.{re.escape(domain)}"
        words += [f"--ServerApp.allow_origin_pat={pattern}", "--ServerApp.allow_remote_access=True"]
    return words


def _of_hub(place: JupyterOptions) -> list[str]:
    return [f"--ServerApp.default_url={place.page}"]


def _alone(place: JupyterOptions) -> list[str]:
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
