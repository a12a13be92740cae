"""`./roslings site`: the course as a website; it is built where there is none yet."""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import webbrowser
from pathlib import Path

from ros2_on_pip.errors import OK
from ros2_on_pip.language import language
from roslings import course
from roslings.commands.built_site import HOME, built_in, is_up_to_date, site_here, tell
from roslings.commands.invocation import program
from roslings.course import CourseError
from roslings.workspace.errors import WorkspaceError
from roslings.workspace.student import workspace_root

BUILDS = ("build", "fresh", "out", "language")
"""Options that ask for a new site."""
LOOKS = ("links", "check_links", "catalogue")
"""Options that build none."""
SCREENS = ("DISPLAY", "WAYLAND_DISPLAY", "WSL_DISTRO_NAME")


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes. `./roslings` looks at the same words, to see whether anything is needed."""
    word.add_argument(
        "--open", action="store_true", help="open it also where no screen is to be seen"
    )
    word.add_argument(
        "--build", action="store_true", help="build it anew where the course has changed"
    )
    word.add_argument("--fresh", action="store_true", help="build all of it anew")
    links = word.add_mutually_exclusive_group()
    links.add_argument("--links", action="store_true", help="list the links to other sites")
    links.add_argument(
        "--check-links", action="store_true", help="try the links to other sites (needs a network)"
    )
    links.add_argument(
        "--catalogue", action="store_true", help="write the texts that a translator fills in"
    )
    word.add_argument(
        "--language", metavar="LANG", help="build it in another language (en_XA: a false one)"
    )
    word.add_argument(
        "--out", metavar="DIR", type=Path, help="build it in DIR (default: build/site)"
    )


def run(options: argparse.Namespace) -> int:
    """Open the site that is there. Sphinx and its settings lie beside the pages, not here."""
    if _asks(options, LOOKS):
        return _build(options)
    html = None if _asks(options, BUILDS) else site_here()
    if html:
        return _show(html, options)
    if code := _build(options):
        return code
    built = options.out / "html" if options.out else built_in(options.language or language())
    only_built = _asks(options, BUILDS) and not options.open
    return _say_where(built) if only_built else _show(built, options)


def _asks(options: argparse.Namespace, words: tuple[str, ...]) -> bool:
    return any(getattr(options, word) for word in words)


def _build(options: argparse.Namespace) -> int:
    words = [f"--{name.replace('_', '-')}" for name in ("fresh", *LOOKS) if getattr(options, name)]
    place = ["--out", str(options.out)] if options.out else []
    place += ["--language", options.language] if options.language else []
    builder = course.root() / "site" / "build.py"
    return subprocess.run([sys.executable, str(builder), *words, *place], check=False).returncode


def _show(html: Path, options: argparse.Namespace) -> int:
    """Open it, with the labs and drills of this computer's student."""
    if not is_up_to_date(html, course.root()):
        print("The course has changed since this site was built.")
        print(f"To build it anew: {program()} site --build")
    if not (options.open or _has_screen()):
        return _say_where(html)
    _tell(html)
    webbrowser.open((html / HOME).as_uri())
    print(f"The site opens in your browser: {html / HOME}")
    return OK


def _tell(html: Path) -> None:
    """Without what the student has done, the site is as good."""
    try:
        tell(html, workspace_root())
    except (WorkspaceError, CourseError, OSError) as error:
        print(f"roslings: the site cannot show what you have done. {error}", file=sys.stderr)


def _say_where(html: Path) -> int:
    print(f"The site: {html / HOME}\nOpen this file in a browser. The folder can be copied.")
    return OK


def _has_screen() -> bool:
    """A browser of letters would take the terminal over."""
    return sys.platform == "darwin" or any(os.environ.get(name) for name in SCREENS)
