"""What every attack has at hand; a copy of it lies in each rogue's package.

It knows the machine as well as an attacker could, marks its processes so that a witness outside
finds them, and says `GOT` and a word when it reached what it must not reach.
"""

import contextlib
import json
import os
import sys
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

KNOWN = json.loads("@known@")
MARK = KNOWN["mark"]
PLACE = KNOWN["place"]


def mark() -> None:
    """Let the witness find this process and its children; the name stays until an exec."""
    with contextlib.suppress(OSError), open("/proc/self/comm", "w") as comm:  # noqa: PTH123
        comm.write(MARK)


def got(what: str) -> None:
    """Say that something was reached; a build ends there, so that the words are its last."""
    print(f"\nGOT {what}", file=sys.stderr, flush=True)
    if PLACE == "build":
        sys.exit(f"GOT {what}")


def attempt(what: str, act: Callable[[], object]) -> None:
    """Try it; what returns false or raises was held off."""
    try:
        reached = act()
    except Exception as error:
        print(f"held off: {what}: {error}", file=sys.stderr, flush=True)
        return
    if reached is not False:
        got(what)


def tries(act: Callable[[], object]) -> None:
    """Try it. Whether it reached more than a copy of its own is seen outside: points and files."""
    with contextlib.suppress(Exception):
        act()


def inside(folder: str, most: int = 20_000) -> Iterator[str]:
    """Every file below a folder that can be seen."""
    for at, _, names in os.walk(folder):
        for name in names:
            yield os.path.join(at, name)  # noqa: PTH118
            most -= 1
            if most <= 0:
                return


def reads(path: str) -> bool:
    """The file's bytes come."""
    with open(path, "rb") as file:  # noqa: PTH123
        return bool(file.read(16))


def holds_secret(path: str) -> bool:
    """The file's bytes come, and the instructor's secret is in them."""
    with open(path, "rb") as file:  # noqa: PTH123
        return KNOWN["secret"].encode() in file.read(1_000_000)


def opens(path: str) -> bool:
    """The file can be written. Nothing is: where it could, that is told, and no more harm done."""
    os.close(os.open(path, os.O_WRONLY | os.O_APPEND))
    return True


def leaves(folder: str) -> bool:
    """A file of ours in a folder. Not told as reached: the witness outside looks for it."""
    path = os.path.join(folder, KNOWN["token"])  # noqa: PTH118
    with open(path, "w") as file:  # noqa: PTH123
        file.write(KNOWN["name"])
    return False


def processes() -> list[int]:
    """All that can be seen."""
    return [int(name) for name in os.listdir("/proc") if name.isdigit()]  # noqa: PTH208


def words_of(pid: int) -> str:
    """A process's command line; empty where it cannot be read."""
    try:
        with open(f"/proc/{pid}/cmdline", "rb") as file:  # noqa: PTH123
            return file.read().replace(b"\0", b" ").decode(errors="replace")
    except OSError:
        return ""


def sees_the_machine() -> bool:
    """The test that watches us, or another submission's processes, are in sight."""
    return any(KNOWN["witness"] in words_of(pid) for pid in processes())


def beside(work: Callable[[], Any]) -> None:
    """Run it in a thread, while the node goes on."""
    threading.Thread(target=work, daemon=True).start()


def wait(seconds: float) -> None:
    """Sleep."""
    time.sleep(seconds)
