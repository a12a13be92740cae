"""The file that leads a browser of this user to the desk, with the key in it.

Nobody else may read it. A key in the words of a command stands in the list of processes, which
every user of the computer reads. So the browser is given the file's name only.
"""

from __future__ import annotations

import html
import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ros2_on_pip.absent import is_of_the_course

FILE = "open-the-desk.html"
PAGE = (
    '<!doctype html><html lang="en"><meta charset="utf-8"><title>roslings desk</title>'
    '<meta name="referrer" content="no-referrer">'
    '<meta http-equiv="refresh" content="0; url={url}"><p><a href="{url}">Open the desk</a></p>'
)


@contextmanager
def door(url: str) -> Iterator[Path]:
    """A file that leads to `url` as long as the block runs, mode 0600 in a folder of mode 0700."""
    with tempfile.TemporaryDirectory(prefix="roslings-desk-", dir=_place()) as folder:
        file = Path(folder) / FILE
        file.touch(0o600, exist_ok=False)
        file.write_text(PAGE.format(url=html.escape(url)), encoding="utf-8")
        yield file


def _place() -> Path | None:
    """In the course's folder: a browser that came as a snap sees no /tmp and no hidden folder."""
    if not is_of_the_course():
        return None
    place = Path(sys.prefix).parent / "build" / "desk"
    try:
        place.mkdir(parents=True, exist_ok=True)
    except OSError:
        return None
    return place if os.access(place, os.W_OK) else None
