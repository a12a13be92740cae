"""What can go wrong on the way to an environment, each with the next step."""

import errno
import sys
import textwrap
from pathlib import Path


class LauncherTrouble(Exception):
    """Something the user must know: one sentence, then what to do. Ends with exit code 2."""

    def __init__(self, what: str, *steps: str) -> None:
        self.what = what
        self.steps = steps
        super().__init__(what)

    def __str__(self) -> str:
        return "\n".join([wrapped(f"roslings: {self.what}"), *map(_step, self.steps)])


def disk_full(near: Path) -> LauncherTrouble:
    """The trouble of a full disk that `near` lies on."""
    return LauncherTrouble(
        f"The disk is full: {near}",
        "Free about 500 MB (look with: df -h .), and run the same command again.",
    )


def of_the_disk(error: OSError, root: Path) -> LauncherTrouble:
    """What the system refused while the environment in `root` was being changed."""
    if error.errno in (errno.ENOSPC, errno.EDQUOT):
        return disk_full(root)
    return LauncherTrouble(
        f"{error.strerror or error}: {error.filename or root}",
        "Give the folder to your own user with chown, or take a copy in your home folder.",
    )


def wrapped(text: str, first: str = "", later: str = "") -> str:
    """`text` in lines of at most 79 columns; a path is never cut."""
    return textwrap.fill(
        text,
        width=79,
        initial_indent=first,
        subsequent_indent=later,
        break_long_words=False,
        break_on_hyphens=False,
    )


def say(text: str) -> None:
    """One message to the user. Standard output belongs to the command, so it goes beside it."""
    print(text, file=sys.stderr, flush=True)


def _step(step: str) -> str:
    return wrapped(step, first="  Next: ", later="    ")
