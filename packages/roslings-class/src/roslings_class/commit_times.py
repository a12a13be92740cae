"""When the newest commit of a clone was made, as the commit says.

The clock is that of the computer on which it was made, which is the student's: who sets it back is
early. A platform's word stands before it.

A clone may hold what its author put there, so no program runs by its settings. `git` reads one
object of it (`GIT_OBJECT_DIRECTORY`), in an empty repository of ours, without a network. Facts of
git: gitrepository-layout(5), git-cat-file(1); a commit's second date is that of its committer.
"""

from __future__ import annotations

import os
import re
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime, timedelta, timezone
from pathlib import Path
from threading import Timer

MOST_BYTES = 64_000
"""Of a commit, and of a file of references, that are read."""
WITHIN_S = 60.0
_REFERENCE = re.compile(r"ref: (refs/heads/[\w./@+-]+)\s*")
_HASH = re.compile(r"[0-9a-f]{40}")
_COMMITTED = re.compile(rb"^committer [^\n]*> (\d{1,11}) ([+-]\d{4})$", re.MULTILINE)
_QUIET = {
    "GIT_CONFIG_NOSYSTEM": "1",
    "GIT_CONFIG_GLOBAL": os.devnull,
    "GIT_NO_LAZY_FETCH": "1",
    "GIT_ALLOW_PROTOCOL": "none",
    "GIT_TERMINAL_PROMPT": "0",
}


def commit_time(clone: Path) -> datetime | None:
    """The time of the commit that is checked out; None where this is no clone, or it has none."""
    folder = clone / ".git"
    if folder.is_symlink() or not (folder / "objects").is_dir():
        return None
    newest = _newest(folder)
    found = _COMMITTED.search(_commit(folder, newest)) if newest else None
    if found is None:
        return None
    seconds, offset = int(found[1]), found[2].decode()
    hours = timedelta(hours=int(offset[1:3]), minutes=int(offset[3:]))
    try:
        zone = timezone(-hours if offset[0] == "-" else hours)
        return datetime.fromtimestamp(seconds, zone)
    except (ValueError, OverflowError, OSError):
        return None


def _newest(folder: Path) -> str:
    """The name of the commit that HEAD means; empty where it means none."""
    head = _text(folder / "HEAD")
    reference = _REFERENCE.fullmatch(head)
    if reference is None or ".." in reference[1]:
        return head.strip() if _HASH.fullmatch(head.strip()) else ""
    loose = _text(folder / reference[1]).strip()
    return loose if _HASH.fullmatch(loose) else _packed(folder, reference[1])


def _packed(folder: Path, reference: str) -> str:
    lines = (line.split() for line in _text(folder / "packed-refs").splitlines())
    named = (line[0] for line in lines if len(line) == 2 and line[1] == reference)
    return next((name for name in named if _HASH.fullmatch(name)), "")


def _text(file: Path) -> str:
    """The start of a file; empty where there is none. No link is followed."""
    try:
        handle = os.open(file, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
        with os.fdopen(handle, "rb") as content:
            return content.read(MOST_BYTES).decode("utf-8", "replace")
    except OSError:
        return ""


def _commit(folder: Path, name: str) -> bytes:
    """The start of this commit; empty where git is not installed, or cannot read it."""
    with _empty_repository() as ours:
        objects = str(folder.absolute() / "objects")
        own = {**_own(), **_QUIET, "GIT_DIR": str(ours), "GIT_OBJECT_DIRECTORY": objects}
        try:
            with subprocess.Popen(
                ["git", "cat-file", "commit", name],
                stdin=subprocess.DEVNULL,
                cwd=ours,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                env=own,
            ) as git:
                return _start_of(git)
        except OSError:
            return b""


def _start_of(git: subprocess.Popen[bytes]) -> bytes:
    """No more than the bound, and no longer: an object may be a pipe that nobody writes."""
    assert git.stdout
    timer = Timer(WITHIN_S, git.kill)
    timer.start()
    try:
        return git.stdout.read(MOST_BYTES)
    finally:
        timer.cancel()
        git.kill()


def _own() -> dict[str, str]:
    """Our environment without what steers git."""
    return {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}


@contextmanager
def _empty_repository() -> Iterator[Path]:
    with tempfile.TemporaryDirectory(prefix="roslings-git-") as made:
        ours = Path(made)
        for name in ("objects", "refs"):
            (ours / name).mkdir()
        (ours / "HEAD").write_text("ref: refs/heads/none\n")
        yield ours
