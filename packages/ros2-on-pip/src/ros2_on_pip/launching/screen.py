"""What a launch says: on the screen, and in its log files."""

from __future__ import annotations

import os
import socket
import time
from collections.abc import Iterable
from contextlib import ExitStack
from datetime import datetime
from pathlib import Path
from types import TracebackType
from typing import TextIO


def log_root() -> Path:
    """The folder that log files go to, as rcl_logging has it."""
    if folder := os.environ.get("ROS_LOG_DIR"):
        return Path(folder).expanduser()
    home = os.environ.get("ROS_HOME")
    return (Path(home).expanduser() if home else Path.home() / ".ros") / "log"


class LaunchOutput:
    """Takes every line of a launch."""

    def __init__(self) -> None:
        stamp = datetime.now().strftime("%Y-%m-%d-%H-%M-%S-%f")
        self.folder = log_root() / f"{stamp}-{socket.gethostname()}-{os.getpid()}"
        self.nobody_reads = False
        self._files: dict[str, TextIO] = {}
        self._open = ExitStack()

    def __enter__(self) -> LaunchOutput:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._open.close()

    def say(self, line: str) -> None:
        """A line of the launch itself."""
        self._show(line)
        self._write("launch.log", line)

    def pass_on(self, name: str, line: str, targets: Iterable[str]) -> None:
        """A line that the process `name` wrote."""
        shown = f"[{name}] {line}"
        for target in targets:
            if target == "screen":
                self._show(shown)
            else:
                self._write("launch.log" if target == "log" else f"{name}.log", shown)

    def _show(self, line: str) -> None:
        if self.nobody_reads:
            return
        try:
            print(line, flush=True)
        except BrokenPipeError:
            self.nobody_reads = True

    def _write(self, name: str, line: str) -> None:
        """Into a file; where none can be written, the launch goes on without."""
        try:
            self._file(name).write(f"{time.time():.7f} {line}\n")
        except OSError:
            self._files[name] = self._nowhere()

    def _file(self, name: str) -> TextIO:
        if name not in self._files:
            self.folder.mkdir(parents=True, exist_ok=True)
            file = (self.folder / name).open("a", encoding="utf-8", buffering=1)
            self._files[name] = self._open.enter_context(file)
        return self._files[name]

    def _nowhere(self) -> TextIO:
        return self._open.enter_context(Path(os.devnull).open("w", encoding="utf-8"))
