"""The one line that moves while something takes long; where nobody looks, a line now and then."""

import re
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager

_BAR = 30
_EVERY_S = 0.1
_PLAIN_EVERY_S = 10.0
"""Where standard error is no terminal: often enough to see that something goes on."""


class DownloadLine:
    """Counts what pip downloads, from the lines of `--progress-bar=raw`.

    A context manager: one pip follows another, and the line stays until the last of them has ended.
    """

    def __init__(self, total_mb: float | None) -> None:
        self._total_mb = total_mb
        self._done = 0  # bytes of the files that are complete
        self._now = 0  # bytes of the file on its way
        self._shown_s = 0.0
        self._moves = sys.stderr.isatty()

    def __enter__(self) -> "DownloadLine":
        self._show()
        return self

    def __exit__(self, *_: object) -> None:
        self._write("")

    def follow(self, lines: Iterable[str]) -> None:
        """Reads the lines of one pip to the end."""
        for line in lines:
            self._count(line)
            self._show()

    def _count(self, line: str) -> None:
        if found := re.match(r"Progress (\d+) of", line):
            self._now = int(found[1])
        else:
            self._done, self._now = self._done + self._now, 0

    def _show(self) -> None:
        now_s = time.monotonic()
        if now_s - self._shown_s >= _EVERY_S:
            self._shown_s = now_s
            self._write(self._line((self._done + self._now) / 1e6))

    def _line(self, mb: float) -> str:
        if not self._total_mb:
            return f"  {mb:.0f} MB"
        full = min(_BAR, round(_BAR * mb / self._total_mb))
        return f"  [{'#' * full}{'.' * (_BAR - full)}] {mb:.0f} of {self._total_mb:.0f} MB"

    def _write(self, line: str) -> None:
        if self._moves:
            print(f"\r\033[K{line}", end="", file=sys.stderr, flush=True)


@contextmanager
def going_on(told: Callable[[], str]) -> Iterator[None]:
    """A block that takes long: says `told()` and for how many seconds it has been at work."""
    ended = threading.Event()
    teller = threading.Thread(target=_tell, args=(told, ended), daemon=True)
    teller.start()
    try:
        yield
    finally:
        ended.set()
        teller.join()


def _tell(told: Callable[[], str], ended: threading.Event) -> None:
    moves, began_s = sys.stderr.isatty(), time.monotonic()
    while not ended.wait(_EVERY_S * 5 if moves else _PLAIN_EVERY_S):
        line = f"  {told()}, {time.monotonic() - began_s:.0f} s"
        print(
            f"\r\033[K{line}" if moves else line,
            end="" if moves else "\n",
            file=sys.stderr,
            flush=True,
        )
    if moves:
        print("\r\033[K", end="", file=sys.stderr, flush=True)
