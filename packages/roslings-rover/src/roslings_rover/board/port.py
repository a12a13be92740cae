"""A serial port without hardware: a pseudo-terminal, found under a name that stays."""

from __future__ import annotations

import errno
import fcntl
import os
import select
import termios
import tty
from contextlib import suppress
from pathlib import Path

from roslings_rover.device_access import lend

MOST_AT_ONCE = 4096
SPEEDS = {
    value: int(name[1:])
    for name, value in vars(termios).items()
    if name.startswith("B") and name[1:].isdigit()
}
"""The kernel's number for a speed to bits a second."""
SIZE_OF_INT = 4
OUTPUT_SPEED = 5
"""Where `tcgetattr` tells it."""


class Port:
    """The board's end of a cable. `name` is what the host opens; it is gone while unplugged."""

    def __init__(self, name: Path) -> None:
        self.name = name
        self._ours = self._theirs = -1
        self._unset = -1
        """The speed that it has before anybody has asked for one."""

    def __enter__(self) -> Port:
        self.plug_in()
        return self

    def __exit__(self, *_: object) -> None:
        self.unplug()

    @property
    def plugged_in(self) -> bool:
        """The cable is in."""
        return self._ours >= 0

    @property
    def host_bits_s(self) -> int | None:
        """The speed to which the host has set its end; None where it has set none.

        A pseudo-terminal carries bytes at any speed, and remembers what was asked for.
        """
        speed = self._speed() if self.plugged_in else self._unset
        return None if speed == self._unset else SPEEDS.get(speed)

    @property
    def is_read(self) -> bool:
        """The host has read all that was sent so far."""
        if not self.plugged_in:
            return True
        waiting = fcntl.ioctl(self._theirs, termios.FIONREAD, bytes(SIZE_OF_INT))
        return not any(waiting)

    def _speed(self) -> int:
        speed: int = termios.tcgetattr(self._theirs)[OUTPUT_SPEED]
        return speed

    def plug_in(self) -> None:
        """Make the port appear. Raises OSError where its name cannot be made."""
        if self.plugged_in:
            return
        self._ours, self._theirs = os.openpty()
        tty.setraw(self._theirs)  # bytes pass as they are, and nothing is echoed
        os.set_blocking(self._ours, False)
        self._unset = self._speed()
        lend(Path(os.ttyname(self._theirs)), self.name.parent)
        self.name.unlink(missing_ok=True)
        self.name.symlink_to(os.ttyname(self._theirs))

    def unplug(self) -> None:
        """Make it vanish: who has it open reads and writes an error from now on."""
        if not self.plugged_in:
            return
        self.name.unlink(missing_ok=True)  # first: a stale name would open a stranger's port
        os.close(self._ours)
        os.close(self._theirs)
        self._ours = self._theirs = -1

    def read(self) -> bytes:
        """What the host wrote; nothing where it wrote nothing."""
        try:
            return os.read(self._ours, MOST_AT_ONCE) if self.plugged_in else b""
        except OSError as error:
            if error.errno in (errno.EAGAIN, errno.EIO):
                return b""
            raise

    def write(self, outgoing: bytes) -> int:
        """Send to the host; what nobody reads is lost once the buffer is full, as on a wire.

        Returns the number of bytes that were not lost.
        """
        try:
            return os.write(self._ours, outgoing) if self.plugged_in and outgoing else 0
        except BlockingIOError:
            return 0

    def wait(self, within_s: float, wake: int) -> None:
        """Wait until the host wrote, until the descriptor `wake` can be read, or so long."""
        ours = self._ours
        watched = [wake] if ours < 0 else [wake, ours]
        with suppress(OSError):  # the cable is pulled by another thread, in this very moment
            select.select(watched, [], [], max(0.0, within_s))
