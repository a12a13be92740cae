"""Open the student's package in an editor."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.label_column import wrapped
from ros2_on_pip.language import said
from ros2_on_pip.typed_paths import shown

TO_DO = re.compile(r"#\s*TODO\b")
OF_A_TERMINAL = ("micro", "nano", "vim", "nvim", "vi", "emacs", "joe", "mcedit")
"""Editors that need no window, the easiest first: they are offered where none is set."""
TAKE_A_LINE = (*OF_A_TERMINAL, "kate", "gedit", "kwrite")
"""They go to a line that stands before the file as `+N`."""
WITHOUT_A_WINDOW = {"emacs": "-nw"}


@dataclass(frozen=True)
class FileLine:
    """A line of a file."""

    file: Path
    line: int = 1


def edit(package: Path) -> None:
    """Open the first file that has something to do; say where it is where no editor is known."""
    place = first_to_do(package)
    command = editor_for(place, package)
    if command is None:
        text, file = "Open {file}, line {line}, in your editor.", shown(place.file)
        told = said("watch.open", text, file=file, line=place.line)
        print("", *wrapped(told), sep="\n", flush=True)
        return
    subprocess.run(command, check=False)


def first_to_do(package: Path) -> FileLine:
    """The first line with a TODO; else the first file of the package's own code."""
    files = sorted(_code_of(package)) if package.is_dir() else [package]
    for file in files:
        lines = file.read_text("utf-8", "replace").splitlines()
        for number, line in enumerate(lines, start=1):
            if TO_DO.search(line):
                return FileLine(file, number)
    return FileLine(files[0]) if files else FileLine(package)


def is_there() -> bool:
    """Whether some editor can be opened here."""
    return editor_for(FileLine(Path("file")), Path()) is not None


def editor_for(place: FileLine, package: Path) -> list[str] | None:
    """VS Code where this is its terminal, or where nothing else is set; else $VISUAL or $EDITOR.

    Where neither is there, the first editor of a terminal that is installed.
    """
    set_one = os.environ.get("VISUAL") or os.environ.get("EDITOR")
    code = shutil.which("code")
    if code and (os.environ.get("TERM_PROGRAM") == "vscode" or not set_one):
        return [code, str(package), "--goto", f"{place.file}:{place.line}"]
    if set_one and (words := shlex.split(set_one)) and shutil.which(words[0]):
        return _at_the_line(words, place)
    there = next((name for name in OF_A_TERMINAL if shutil.which(name)), None)
    return _at_the_line([there], place) if there else None


def _at_the_line(words: list[str], place: FileLine) -> list[str]:
    """What opens the file there; which word leads another editor to a line, nobody knows."""
    name = Path(words[0]).name
    if len(words) == 1 and name in WITHOUT_A_WINDOW:
        words = [*words, WITHOUT_A_WINDOW[name]]
    line = [f"+{place.line}"] if name in TAKE_A_LINE else []
    return [*words, *line, str(place.file)]


def _code_of(package: Path) -> Iterator[Path]:
    hidden = ("test", "build", "install", "log")
    for file in package.rglob("*.py"):
        inside = file.relative_to(package).parts
        if inside[0] not in hidden and file.name not in ("__init__.py", "setup.py"):
            yield file
