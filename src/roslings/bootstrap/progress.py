"""The one line that moves while pip downloads; nothing moves where nobody looks."""

import re
import sys
import time
from collections.abc import Iterable

_BAR = 30
_EVERY_S = 0.1


class DownloadLine:
    """Counts what pip downloads, from the lines of `--progress-bar=raw`."""

    def __init__(self, total_mb: float | None) -> None:
        self._total_mb = total_mb
        self._done = 0  # bytes of the files that are complete
        self._now = 0  # bytes of the file on its way
        self._shown_s = 0.0
        self._moves = sys.stderr.isatty()

    def follow(self, lines: Iterable[str]) -> None:
        """Reads pip's lines to the end, and leaves the terminal's line empty."""
        try:
            for line in lines:
                self._count(line)
                self._show()
        finally:
            self._write("")

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
