"""What can go wrong on a cable, to be switched on by whoever tests the other end."""

from __future__ import annotations

import random
import re
from dataclasses import dataclass, field

_LAST_NUMBER = re.compile(rb"\d(?=\d*\*[0-9A-F]{4}\n)")
"""The first digit of it."""


@dataclass
class Spoiler:
    """Spoils the bytes of one direction. All shares are 0 to 1, all switches may change at run.

    The same seed and the same bytes are spoiled in the same way.
    """

    seed: int = 0
    noise: float = 0.0
    """Share of bytes of which one bit is turned."""
    half_lines: float = 0.0
    """Share of lines of which the end is cut off."""
    wrong_checksums: float = 0.0
    """Share of lines whose last number before the checksum is another one, of as many digits.

    Their form is right: only who compares the checksum knows.
    """
    silent: bool = False
    """Nothing arrives."""
    babble: int = 0
    """So many bytes of nonsense are put in before each line."""
    spoiled_lines: int = 0
    _chance: random.Random = field(init=False, repr=False)
    _begun: bytes = field(default=b"", init=False, repr=False)

    def __post_init__(self) -> None:
        self._chance = random.Random(self.seed)

    def __call__(self, passing: bytes) -> bytes:
        """What arrives of these bytes, now; a line that has not ended waits for its end."""
        if self.silent:
            self._begun = b""
            return b""
        if not self._works_on_lines:
            passing, self._begun = self._begun + passing, b""
            return self._noisy(passing)
        *lines, self._begun = (self._begun + passing).split(b"\n")
        return b"".join(self._noisy(self._spoil(line + b"\n")) for line in lines)

    @property
    def _works_on_lines(self) -> bool:
        return bool(self.half_lines or self.wrong_checksums or self.babble)

    def _spoil(self, line: bytes) -> bytes:
        nonsense = bytes(self._chance.randrange(256) for _ in range(self.babble))
        if self._chance.random() < self.half_lines:
            self.spoiled_lines += 1
            line = line[: self._chance.randrange(1, max(2, len(line) - 1))]
        elif self._chance.random() < self.wrong_checksums:
            self.spoiled_lines += 1
            line = _LAST_NUMBER.sub(_another, line, count=1)
        return nonsense + line

    def _noisy(self, passing: bytes) -> bytes:
        if not self.noise:
            return passing
        return bytes(self._flipped(byte) for byte in passing)

    def _flipped(self, byte: int) -> int:
        if self._chance.random() >= self.noise:
            return byte
        return byte ^ (1 << self._chance.randrange(8))


def _another(digit: re.Match[bytes]) -> bytes:
    return b"%d" % ((int(digit[0]) + 5) % 10)
