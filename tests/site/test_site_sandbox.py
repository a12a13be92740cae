"""What the page on grading tells of the sandbox are the numbers that hold."""

from __future__ import annotations

from roslings.arena.bounds import BUSY_A_PROCESSOR, MB, Bounds
from roslings.arena.isolation import ROOM_BYTES
from roslings.course import lab, root
from roslings.workspace.build import NEIGHBOURS_MOST

WORDS = " ".join((root() / "site/pages/teachers/grading.md").read_text("utf-8").split())
NUMBERS = {1: "once", 2: "two times", 3: "three times", 4: "four times"}


def test_each_bound_is_told_as_it_is() -> None:
    """The whole table."""
    bounds = Bounds()
    for row in (
        f"| processes and threads | {bounds.tasks} |",
        f"| memory | {bounds.memory_bytes // (1024 * MB)} GB together |",
        f"| its home, `/tmp` | {bounds.home_bytes // MB} MB each, {bounds.files:,} files |",
        f"| what it builds | {ROOM_BYTES // MB} MB,",
        f"| time of the processors | {bounds.cpu_s} s together, of one processor |",
        f"| one file | {bounds.file_bytes // MB} MB |",
    ):
        assert row in WORDS


def test_the_share_and_the_time_of_a_build_are_told() -> None:
    """With the card's default."""
    assert f"more than {BUSY_A_PROCESSOR} busy threads for each processor" in WORDS
    built = lab("topics").card.builds_within_s
    assert f"A build may take {built:g} s, or `builds_within_s` of the card." in WORDS
    assert f"stands still, up to {NUMBERS[NEIGHBOURS_MOST]} as long" in WORDS
