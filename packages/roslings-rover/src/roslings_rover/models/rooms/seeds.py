"""Seeds of rooms: whole numbers of 64 bits."""

from __future__ import annotations

SEEDS = 1 << 64
"""So many rooms there are."""
LONGEST_SHOWN = 40


class NoSeed(ValueError):
    """What was given names no room."""

    def __init__(self, given: object) -> None:
        shown = str(given)[:LONGEST_SHOWN]
        super().__init__(
            f"'{shown}' names no room. Give a whole number from 0 to {SEEDS - 1}, for example 17"
        )


def seed_of(typed: str) -> int:
    """The seed that somebody typed. Raises NoSeed."""
    if not (typed.isascii() and typed.isdigit()):
        raise NoSeed(typed)
    digits = typed.lstrip("0") or "0"
    if len(digits) > len(str(SEEDS)):  # many digits take long to be read
        raise NoSeed(typed)
    return checked(int(digits))


def checked(seed: int) -> int:
    """The same seed. Raises NoSeed where there is no room of it."""
    if isinstance(seed, bool) or not isinstance(seed, int) or not 0 <= seed < SEEDS:
        raise NoSeed(seed)
    return seed
