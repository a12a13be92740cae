"""Leave no file in /dev/shm, where a killed node cannot tidy up after itself."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

SHARED_MEMORY = Path("/dev/shm")
PATTERNS = ("fastrtps_*", "sem.fastrtps_*", "fastdds_*", "sem.fastdds_*")


@contextmanager
def swept_shared_memory() -> Iterator[None]:
    """Remove what Fast DDS left during the block and no living process holds."""
    before = _files()
    try:
        yield
    finally:
        for path in _files() - before - _held():
            with suppress(OSError):
                path.unlink()


def _files() -> set[Path]:
    """Our own shared memory files."""
    found = (path for pattern in PATTERNS for path in SHARED_MEMORY.glob(pattern))
    return {path for path in found if _is_ours(path)}


def _is_ours(path: Path) -> bool:
    try:
        return path.stat().st_uid == os.getuid()
    except OSError:
        return False


def _held() -> set[Path]:
    """Shared memory files that a living process has mapped or open."""
    held: set[Path] = set()
    for process in Path("/proc").iterdir():
        if process.name.isdigit():
            held |= _mapped(process) | _open(process)
    return held


def _mapped(process: Path) -> set[Path]:
    try:
        lines = (process / "maps").read_text(errors="replace").splitlines()
    except OSError:
        return set()
    return {Path(line.split(maxsplit=5)[5]) for line in lines if " /dev/shm/" in line}


def _open(process: Path) -> set[Path]:
    held = set()
    with suppress(OSError):
        for link in (process / "fd").iterdir():
            with suppress(OSError):
                held.add(link.readlink())
    return held
