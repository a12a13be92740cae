"""The words between host and board: one line each, closed by a checksum.

    $BODY*CRC\\n      CRC: four capital hexadecimal digits, CRC-16/XMODEM of BODY's bytes

| from | body | meaning |
| --- | --- | --- |
| host | `M,SEQ,LEFT,RIGHT` | drive the motors with PWM -255 to 255; SEQ 0 to 65535 |
| board | `A,SEQ` | the command SEQ was accepted, at once |
| board | `W,SEQ,MS,LEFT,RIGHT` | wheel speeds in mrad/s, every 20 ms; MS is the board's clock |
| board | `S,MS,ACCEPTED,REJECTED,STOPS` | counts since the start, once a second |

CRC-16/XMODEM (polynomial 0x1021, start 0) is `_crc_xmodem_update` of avr-libc and
`binascii.crc_hqx` of Python: both sides have it without a library.
"""

from __future__ import annotations

import binascii
import re
from dataclasses import dataclass, field
from typing import Literal

LONGEST_LINE = 60
"""Characters between `$` and the end of the line; a longer line is rejected."""

LARGEST_PWM = 255
LARGEST_SEQ = 65535
_LINE = re.compile(rb"([ -)+-~]+)\*([0-9A-F]{4})", re.ASCII)
_DRIVE = re.compile(r"M,(\d{1,5}),(-?\d{1,3}),(-?\d{1,3})", re.ASCII)
_SPEEDS = re.compile(r"W,(\d+),(\d+),(-?\d+),(-?\d+)", re.ASCII)


Badness = Literal["no_line", "checksum", "no_command", "too_large", "no_speeds"]
"""Why a line must not be used."""


class BadLine(Exception):
    """A line that must not be used: half, spoiled, or not of this protocol."""

    def __init__(self, kind: Badness, told: str) -> None:
        """`told` is for people."""
        self.kind = kind
        super().__init__(told)


def checksum(body: bytes) -> int:
    """CRC-16/XMODEM."""
    return binascii.crc_hqx(body, 0)


def framed(body: str) -> bytes:
    """The whole line for a body."""
    raw = body.encode("ascii")
    return b"$" + raw + b"*%04X\n" % checksum(raw)


def unframed(line: bytes) -> str:
    """The body of a line without its `$` and its end. Raises BadLine."""
    match = _LINE.fullmatch(line)
    if match is None:
        raise BadLine("no_line", f"this is no line: {line!r}")
    body, crc = match.groups()
    if checksum(body) != int(crc, 16):
        told = f"the checksum should be {checksum(body):04X}: {line!r}"
        raise BadLine("checksum", told)
    return body.decode("ascii")


@dataclass(frozen=True)
class DriveCommand:
    """A command: PWM for each motor, negative for backward."""

    seq: int
    left_pwm: int
    right_pwm: int

    def line(self) -> bytes:
        """As the host sends it."""
        return framed(f"M,{self.seq},{self.left_pwm},{self.right_pwm}")

    @staticmethod
    def read(body: str) -> DriveCommand:
        """Raises BadLine for another kind of line, and for a PWM that no motor has."""
        match = _DRIVE.fullmatch(body)
        if match is None:
            raise BadLine("no_command", f"this is no command: {body!r}")
        drive = DriveCommand(*map(int, match.groups()))
        if max(abs(drive.left_pwm), abs(drive.right_pwm)) > LARGEST_PWM or drive.seq > LARGEST_SEQ:
            raise BadLine("too_large", f"a number is too large: {body!r}")
        return drive


@dataclass(frozen=True)
class Speeds:
    """How fast the wheels turn, measured since the line before."""

    seq: int
    ms: int
    left_mrad_s: int
    right_mrad_s: int

    def line(self) -> bytes:
        """As the board sends it."""
        return framed(f"W,{self.seq},{self.ms},{self.left_mrad_s},{self.right_mrad_s}")

    @staticmethod
    def read(body: str) -> Speeds:
        """Raises BadLine for another kind of line."""
        match = _SPEEDS.fullmatch(body)
        if match is None:
            raise BadLine("no_speeds", f"these are no speeds: {body!r}")
        return Speeds(*map(int, match.groups()))


@dataclass
class LineReader:
    """Finds whole lines in bytes that come in pieces of any size.

    A `$` always begins a new line, so that what follows a half line is not lost with it. Bytes
    outside of a line are passed over.
    """

    rejected: int = 0
    _line: bytearray | None = field(default=None, repr=False)

    def feed(self, incoming: bytes) -> list[str]:
        """The bodies of the good lines that end in these bytes; the bad ones are counted."""
        found = (self._take(byte) for byte in incoming)
        return [body for body in found if body is not None]

    def _take(self, byte: int) -> str | None:
        if byte == ord("$"):
            self.rejected += self._line is not None
            self._line = bytearray()
        elif byte == ord("\n"):
            return self._end()
        elif self._line is not None and byte != ord("\r"):
            self._line.append(byte)
            self._bound()
        return None

    def _bound(self) -> None:
        if self._line is not None and len(self._line) > LONGEST_LINE:
            self.rejected += 1
            self._line = None

    def _end(self) -> str | None:
        line, self._line = self._line, None
        if line is None:
            return None
        try:
            return unframed(bytes(line))
        except BadLine:
            self.rejected += 1
            return None
