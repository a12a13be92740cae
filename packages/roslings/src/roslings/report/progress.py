"""What goes on while a check runs: one live line on a terminal, short plain lines elsewhere."""

from __future__ import annotations

import sys
import time
from types import TracebackType
from typing import TYPE_CHECKING

from ros2_on_pip.safe_text import can_show, cut_to, harmless, in_encoding

if TYPE_CHECKING:
    from rich.console import Console
    from rich.live import Live
    from rich.text import Text

TURNING = "⠋⠙⠹⠸⠼⠴⠦⠧⠇⠏"
ASCII_TURNING = "|/-\\"
TURNS_PER_SECOND = 8


class ProgressLine:
    """Tells on standard error what is being done; `quiet` tells nothing.

    On a terminal a thread draws the line until the block ends: enter a namespace before.

        with ProgressLine() as progress:
            progress.step("Building chatter")
    """

    def __init__(self, console: Console | None = None, *, quiet: bool = False) -> None:
        self._console = console
        self._quiet = quiet
        self._text = ""
        self._started = time.monotonic()
        self._live: Live | None = None

    def __enter__(self) -> ProgressLine:
        self._started = time.monotonic()
        if not self._quiet:
            self._open()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._live is not None:
            self._live.stop()

    def step(self, text: str) -> None:
        """Say what comes now, e.g. `Building chatter`."""
        self._text = " ".join(harmless(text).split())
        if self._live is not None:
            self._live.refresh()
        elif not self._quiet and self._console is not None:
            self._say_plainly(self._console)

    def _open(self) -> None:
        from rich.console import Console
        from rich.live import Live

        if self._console is None:
            self._console = Console(file=sys.stderr)
        if self._console.is_terminal and not self._console.is_dumb_terminal:
            # Redirecting would send a verdict that goes to standard output to standard error.
            self._live = Live(
                console=self._console,
                get_renderable=self._line,
                refresh_per_second=TURNS_PER_SECOND,
                transient=True,
                redirect_stdout=False,
                redirect_stderr=False,
            )
            self._live.start()

    def _say_plainly(self, console: Console) -> None:
        console.file.write(in_encoding(self._text, console.encoding) + "\n")
        console.file.flush()

    def _line(self) -> Text:
        from rich.cells import cell_len
        from rich.text import Text

        assert self._console is not None
        elapsed = time.monotonic() - self._started
        turning = TURNING if can_show(TURNING, self._console.encoding) else ASCII_TURNING
        start = turning[int(elapsed * TURNS_PER_SECOND) % len(turning)] + " "
        end = f"  {elapsed:.0f} s"
        room = max(self._console.width - len(start) - len(end) - 1, 1)
        text = in_encoding(self._text, self._console.encoding)
        return Text(start + cut_to(text, room, cell_len, "...") + end, no_wrap=True)
