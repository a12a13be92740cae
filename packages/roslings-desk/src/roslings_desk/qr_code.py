"""A QR code in the letters of a terminal."""

from __future__ import annotations

from itertools import zip_longest

from ros2_on_pip.safe_text import can_show

BORDER = 2
BLACK_ON_WHITE, USUAL = "\x1b[30;107m", "\x1b[0m"
"""A terminal may be dark or light; a code is dark on light."""
HALVES = {(0, 0): " ", (1, 0): "\u2580", (0, 1): "\u2584", (1, 1): "\u2588"}
"""Two modules, one above the other, to the letter that shows them."""


def qr_lines(text: str, encoding: str, coloured: bool) -> list[str]:
    """The code of `text`, line by line; in colours for a terminal, in plain letters for a file."""
    import segno

    code = segno.make(text, error="m", micro=False)
    rows = [list(row) for row in code.matrix_iter(border=BORDER)]
    lines = _halves(rows) if can_show("".join(HALVES.values()), encoding) else _wide(rows)
    return [f"{BLACK_ON_WHITE}{line}{USUAL}" for line in lines] if coloured else lines


def _halves(rows: list[list[int]]) -> list[str]:
    nothing = [0] * len(rows[0])
    pairs = zip_longest(rows[::2], rows[1::2], fillvalue=nothing)
    return ["".join(HALVES[pair] for pair in zip(*both, strict=True)) for both in pairs]


def _wide(rows: list[list[int]]) -> list[str]:
    """Where the encoding has no blocks."""
    return ["".join("##" if each else "  " for each in row) for row in rows]
