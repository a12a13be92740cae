"""What the page says of JupyterHub fits the commands of this course; nothing is started."""

from __future__ import annotations

import argparse
from pathlib import Path
from types import SimpleNamespace

from hub_page import block

from roslings_learn.commands.lab import add_options


def configured(server: Path) -> SimpleNamespace:
    """The settings, as JupyterHub reads such a file: it gives it `c`."""
    rooms = ("JupyterHub", "Authenticator", "Spawner", "ConfigurableHTTPProxy")
    c = SimpleNamespace(**{room: SimpleNamespace() for room in rooms})
    exec(compile(block("python", "Write this into", server), "config", "exec"), {"c": c})
    return c


def test_jupyterhub_is_told_to_start_our_command(tmp_path: Path) -> None:
    """With words that it takes."""
    program, command, *words = configured(tmp_path).Spawner.cmd
    assert (program, command) == (f"{tmp_path}/opt/roslings/roslings", "lab")
    parser = argparse.ArgumentParser()
    add_options(parser)
    assert parser.parse_args(words).hub


def test_what_is_installed_is_what_is_started(tmp_path: Path) -> None:
    """In the edition's own environment; the same option brings it."""
    assert "./roslings ready lab --hub" in block("bash", "and add JupyterHub to it", tmp_path)
    own = f"{tmp_path}/opt/roslings/.venv/bin"
    assert f"{own}/jupyterhub -f " in block("bash", "Then start it", tmp_path)
    assert configured(tmp_path).ConfigurableHTTPProxy.command == [f"{own}/configurable-http-proxy"]
