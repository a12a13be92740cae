"""`./roslings site`: build the website."""

from __future__ import annotations

import argparse
import subprocess
import sys
from pathlib import Path

from roslings import course

SITE_WORDS = ("open", "fresh", "links", "check_links")


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument("--open", action="store_true", help="open it in the browser")
    word.add_argument("--fresh", action="store_true", help="build all of it anew")
    links = word.add_mutually_exclusive_group()
    links.add_argument("--links", action="store_true", help="list the links to other sites")
    links.add_argument(
        "--check-links", action="store_true", help="try the links to other sites (needs a network)"
    )
    word.add_argument(
        "--out", metavar="DIR", type=Path, help="where to build (default: build/site)"
    )


def run(options: argparse.Namespace) -> int:
    """Build the site. Sphinx and its settings live beside the pages, not in the engine."""
    words = [f"--{name.replace('_', '-')}" for name in SITE_WORDS if getattr(options, name)]
    place = ["--out", str(options.out)] if options.out else []
    builder = course.root() / "site" / "build.py"
    return subprocess.run([sys.executable, str(builder), *words, *place], check=False).returncode
