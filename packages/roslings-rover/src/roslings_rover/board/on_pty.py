"""A board on a serial port: in real time in a thread, or step by step in a test."""

from __future__ import annotations

import os
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from roslings_rover.board.port import Port
from roslings_rover.board.spoil import Spoiler
from roslings_rover.board.wire import Wire
from roslings_rover.chip import Chip
from roslings_rover.errors import DeviceTrouble

TURN_EVERY_S = 0.004
LONGEST_PAUSE_S = 0.1
"""Time that a busy computer withheld is not made up for: the board's clock then runs late."""


@dataclass(frozen=True)
class Chunk:
    """Bytes that were sent in one go, and when, by the board's clock and by this computer's."""

    board_s: float
    sent_ns: int
    content: bytes


class Board:
    """A chip at one end of a cable, and what happens on the cable.

    `to_host` and `to_board` spoil the line; `heard` and `told` hold what the host and the board
    sent, unspoiled, with the time. A context manager, whose end closes the port;
    `with board.running():` lets it live in real time.
    """

    def __init__(self, chip: Chip, name: Path | None = None, wire: Wire | None = None) -> None:
        """`name` is the path of the port; a new one in a folder of its own without it.

        On a `wire` to the host that takes time, lines arrive in pieces.
        """
        self.chip = chip
        self.to_host, self.to_board = Spoiler(), Spoiler()
        self._wire = wire or Wire()
        self.heard: list[Chunk] = []
        self.told: list[Chunk] = []
        self.sent_bytes = self.lost_bytes = 0
        self.trouble: DeviceTrouble | None = None
        """Why the chip lives no longer; its port is then unplugged."""
        self._folder = None if name else tempfile.TemporaryDirectory(prefix="rover-")
        self.port = Port(name or Path(self._folder.name if self._folder else "") / "ttyROVER")
        self._lock = threading.RLock()
        self._wake, self._waker = os.pipe()

    def __enter__(self) -> Board:
        self.port.plug_in()
        return self

    def __exit__(self, *_: object) -> None:
        with self._lock:
            self.port.unplug()
        os.close(self._wake)
        os.close(self._waker)
        if self._folder:
            self._folder.cleanup()

    @property
    def name(self) -> str:
        """The port that the host opens."""
        return str(self.port.name)

    def step(self, dt_s: float) -> None:
        """Carry bytes both ways, and let the board's time go on."""
        with self._lock:
            heard = self.port.read()
            self._note(self.heard, heard)
            self.chip.receive(self.to_board(heard))
            told = self.chip.step(dt_s)
            self._note(self.told, told)
            outgoing = self._wire(self.to_host(told), dt_s, self.port.is_read)
            written = self.port.write(outgoing)
            self.sent_bytes += written
            self.lost_bytes += len(outgoing) - written

    def _note(self, record: list[Chunk], content: bytes) -> None:
        if content:
            record.append(Chunk(self.chip.truth.time_s, time.monotonic_ns(), content))

    def unplug(self) -> None:
        """Pull the cable. The board lives on."""
        with self._lock:
            self.port.unplug()
            self._wire.cut()
            self._notice()

    def plug_in(self) -> None:
        """Put it back, under the same name."""
        with self._lock:
            self.port.plug_in()
            self._notice()

    @contextmanager
    def running(self) -> Iterator[Board]:
        """Real time passes for the board while the block runs."""
        ended = threading.Event()
        thread = threading.Thread(target=self._live, args=(ended.is_set,), name="board")
        thread.start()
        try:
            yield self
        finally:
            ended.set()
            self._notice()
            thread.join()

    def _live(self, ended: Callable[[], bool]) -> None:
        try:
            self._live_on(ended)
        except DeviceTrouble as trouble:
            self._end_of(trouble)
        except OSError as fault:
            self._end_of(DeviceTrouble(f"the board's cable cannot be used any more: {fault}"))

    def _end_of(self, trouble: DeviceTrouble) -> None:
        self.trouble = trouble
        self.unplug()

    def _live_on(self, ended: Callable[[], bool]) -> None:
        before_s = time.monotonic()
        while not ended():
            self.port.wait(before_s + TURN_EVERY_S - time.monotonic(), self._wake)
            self._forget_notice()
            now_s = time.monotonic()
            self.step(min(now_s - before_s, LONGEST_PAUSE_S))
            before_s = now_s

    def _notice(self) -> None:
        os.write(self._waker, b"!")

    def _forget_notice(self) -> None:
        os.set_blocking(self._wake, False)
        try:
            os.read(self._wake, 64)
        except BlockingIOError:
            return
