"""A camera that a program opens by a path: pictures come through a Unix socket.

Whoever connects first gets one byte, the number of an error (0: none), as opening a device file
answers. Then each letter that comes in is answered by one picture: rows of blue, green and red.
No more than one program has the camera at a time: others get EBUSY.
"""

from __future__ import annotations

import errno
import socket
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from types import TracebackType

from roslings_rover.camera.frame import Frame
from roslings_rover.device_access import lend

Film = Callable[[int], Frame]
"""The n-th picture, from 0."""

PICTURES_A_SECOND = 30.0
LOOK_EVERY_S = 0.1


class SocketCamera:
    """A camera behind the path `path`; leaving the `with` block takes it away.

    `film` draws the pictures, 640 by 480, and is called in the camera's own thread. No more than
    PICTURES_A_SECOND are given, as by a real camera: whoever is quicker waits.
    """

    def __init__(self, path: Path, film: Film) -> None:
        self.path = path
        self.refuses = 0
        """The number of the error that opening it answers with: `errno.EACCES`, say."""
        self.given = 0
        """Pictures that were given so far."""
        self.late_ns = 0
        """For so long, all pictures together, whoever asked waited for more than the camera's pace.
        A picture goes in pieces, and each waits for this thread to be run."""
        self._film = film
        self._listener: socket.socket | None = None
        self._answering: threading.Thread | None = None
        self._serving: list[threading.Thread] = []
        self._user: socket.socket | None = None

    def __enter__(self) -> SocketCamera:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.unplug()

    @property
    def there(self) -> bool:
        """It is plugged in."""
        return self._listener is not None

    def plug_in(self) -> None:
        """The camera is there, for all who know its path. Raises OSError."""
        listener = socket.socket(socket.AF_UNIX)
        listener.settimeout(LOOK_EVERY_S)
        self.path.unlink(missing_ok=True)
        listener.bind(str(self.path))
        lend(self.path, self.path.parent)
        listener.listen()
        self._listener = listener
        self._answering = _started(self._answer, listener)

    def unplug(self) -> None:
        """The camera is gone, for its user too."""
        listener, self._listener = self._listener, None
        if listener and self._answering:
            self.path.unlink(missing_ok=True)
            _shut(listener)
            self._answering.join()  # first: it starts the others
        if user := self._user:
            _shut(user)
        while self._serving:
            self._serving.pop().join()

    def _answer(self, listener: socket.socket) -> None:
        """Greet whoever comes, until the camera is unplugged."""
        with listener:
            while self._listener is listener:
                with suppress(OSError):  # nobody came, or went at once
                    caller, _ = listener.accept()
                    self._greet(caller)

    def _greet(self, caller: socket.socket) -> None:
        number = self.refuses or (errno.EBUSY if self._user else 0)
        caller.sendall(bytes([number]))
        if number:
            caller.close()
        else:
            self._user = caller
            self._serving.append(_started(self._serve, caller))

    def _serve(self, user: socket.socket) -> None:
        """Give pictures until the user or the camera goes."""
        next_s = time.monotonic()
        with user, suppress(OSError):
            user.settimeout(None)
            while user.recv(1) and self._listener:
                due_s = max(next_s, time.monotonic())
                picture = self._film(self.given).pixels().tobytes()
                time.sleep(max(0.0, next_s - time.monotonic()))
                next_s = time.monotonic() + 1 / PICTURES_A_SECOND
                user.sendall(picture)
                self.late_ns += round((time.monotonic() - due_s) * 1e9)
                self.given += 1
        self._user = None


def _started(work: Callable[[socket.socket], None], with_: socket.socket) -> threading.Thread:
    thread = threading.Thread(target=work, args=(with_,), name="camera", daemon=True)
    thread.start()
    return thread


def _shut(end: socket.socket) -> None:
    """Wake whoever waits for it."""
    with suppress(OSError):
        end.shutdown(socket.SHUT_RDWR)
