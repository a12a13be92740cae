"""Where the seconds of a check went, as a small table: so that the next slow thing is seen."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

from ros2_on_pip.language import Text, said
from roslings.evidence import GradingSpan, Part
from roslings.verdict import Timings

if TYPE_CHECKING:
    from rich.console import Console

WORDS: dict[Part, Text] = {
    "reading": Text("timings.reading", "start, read"),
    "building": Text("timings.building", "build"),
    "starting": Text("timings.starting", "nodes start"),
    "watching": Text("timings.watching", "watch"),
    "ending": Text("timings.ending", "Ctrl-C"),
    "judging": Text("timings.judging", "judge"),
}
COLUMNS: tuple[tuple[Text | str, Literal["left", "right"]], ...] = (
    (Text("timings.at", "at s"), "right"),
    (Text("timings.took", "took s"), "right"),
    (Text("timings.part", "part"), "left"),
    (Text("timings.of", "of"), "left"),
    ("", "left"),
)
BAR = 28
NS_PER_S = 10**9
SHORTEST_S = 0.02
"""Shorter parts are left out of the table."""


def print_timings(timeline: Sequence[GradingSpan], seconds: Timings, console: Console) -> None:
    """Print when each part began, how long it took, and a bar of it; below, what they add up to.

    Parts of several experiments go on at once; in the sums each moment counts once.
    """
    from rich.table import Table

    table = Table(
        box=None,
        pad_edge=False,
        title=f"\n{said('timings.title', 'Where the seconds went')}",
        title_justify="left",
    )
    for name, justify in COLUMNS:
        table.add_column(str(name), justify=justify, no_wrap=True)
    began_ns = min((span.began_ns for span in timeline), default=0)
    for span in sorted(timeline, key=lambda span: span.began_ns):
        at_s, took_s = (span.began_ns - began_ns) / NS_PER_S, _took_s(span)
        if took_s >= SHORTEST_S:
            bar = _bar(at_s, took_s, seconds.total)
            table.add_row(f"{at_s:.2f}", f"{took_s:.2f}", str(WORDS[span.part]), span.of[:16], bar)
    console.print(table)
    console.print(_sum(seconds), highlight=False)


def _took_s(span: GradingSpan) -> float:
    return (span.ended_ns - span.began_ns) / NS_PER_S


def _bar(at_s: float, took_s: float, total_s: float) -> str:
    """The part as a stretch of the whole."""
    scale = BAR / max(total_s, SHORTEST_S)
    return " " * round(at_s * scale) + "#" * max(1, round(took_s * scale))


def _sum(seconds: Timings) -> str:
    parts = {
        said("timings.start", "start and read"): seconds.reading,
        str(WORDS["building"]): seconds.build,
        str(WORDS["starting"]): seconds.discovery,
        str(WORDS["watching"]): seconds.watching,
        str(WORDS["ending"]): seconds.ending,
        str(WORDS["judging"]): seconds.judging,
        said("timings.rest", "rest"): seconds.rest,
    }
    words = " + ".join(f"{name} {part:.2f}" for name, part in parts.items())
    return f"{words}\n= {seconds.total:.2f} s"
