"""Lines of a cable are kept without their checksums, and come back with them."""

from __future__ import annotations

import random

import pytest

from roslings.capabilities.serial.record import BoardSeen, CableLine, sealed, unsealed
from roslings.record.columns import IN_COLUMNS
from roslings_rover.models.board_lines import framed

GOOD = framed("W,232,4660,-2618,2618").decode().rstrip("\n")
TEXTS = (
    "",
    "*",
    "$*",
    "$*0000",
    "$",
    GOOD,
    GOOD[:-1],
    GOOD[:-4],
    f"{GOOD[:-4]}\n",
    f"{GOOD[:-4]}\n\n",
    GOOD.lower(),
    f"{GOOD}\n",
    GOOD[1:],
    f"x{GOOD}",
    "noise \xe4*",
    "$\xe4*0000",
    "a*b*",
    "\n",
    "*\n*",
)


@pytest.mark.parametrize("text", TEXTS)
def test_a_line_comes_back_with_its_checksum(text: str) -> None:
    """Right or wrong, whole or half."""
    assert sealed(unsealed(text)) == text


def test_no_two_lines_are_kept_as_one() -> None:
    """Whatever noise made of a line: spoiled, cut, or joined with another."""
    noise = random.Random(7)
    texts = {*TEXTS}
    for _ in range(2000):
        line = [*GOOD]
        line[noise.randrange(len(line))] = noise.choice("*$\n0F,\xff")
        texts.add("".join(line)[: noise.choice((len(line), noise.randrange(len(line))))])
    assert len({unsealed(text) for text in texts}) == len(texts)
    assert all(sealed(unsealed(text)) == text for text in texts)


def test_the_checksum_is_not_kept_where_it_is_right() -> None:
    """A board that tells nothing new for a minute takes next to nothing."""
    told = [
        CableLine(
            board_s=n / 50, sent_ns=n * 20_000_000, text=framed(f"W,{n},{n * 20},0,0").decode()[:-1]
        )
        for n in range(3000)
    ]
    seen = BoardSeen(told=told)
    content = seen.model_dump_json(context=IN_COLUMNS)
    assert len(content) < 1000 < len(seen.model_dump_json()) / 100
    assert BoardSeen.model_validate_json(content) == seen
