"""Where the seconds of a check went: they add up, and the table shows each part."""

from __future__ import annotations

import io
import os
import random
import subprocess
import sys
import time

import pytest
from rich.console import Console

from roslings.commands.check import READY, began_ns
from roslings.evidence import GradingSpan, Part
from roslings.report.timings import print_timings
from roslings.seen.timeline import FIRST, noted, process_began_ns, shares_s
from roslings.verdict import Timings

S = 10**9


def span(part: Part, began_s: float, ended_s: float, of: str = "") -> GradingSpan:
    """A stretch, in seconds."""
    return GradingSpan(part=part, of=of, began_ns=round(began_s * S), ended_ns=round(ended_s * S))


def test_parts_that_overlap_count_once() -> None:
    """Two nodes start at once, and one is watched while the other still starts."""
    timeline = [span("starting", 1, 3), span("starting", 1, 2), span("watching", 2.5, 4)]
    shares = shares_s(timeline, 0, 5 * S)
    assert shares["starting"] == pytest.approx(1.5)
    assert shares["watching"] == pytest.approx(1.5)
    assert shares[None] == pytest.approx(2.0)


@pytest.mark.parametrize("seed", range(20))
def test_the_shares_add_up(seed: int) -> None:
    """Whatever overlaps, begins before the first moment, or ends after the last."""
    dice = random.Random(seed)
    timeline = [
        span(dice.choice(FIRST), began_s := dice.uniform(-1, 10), began_s + dice.uniform(0, 5))
        for _ in range(dice.randrange(1, 30))
    ]
    assert sum(shares_s(timeline, 0, 9 * S).values()) == pytest.approx(9.0)


def test_what_ends_in_an_error_is_noted_as_well() -> None:
    """An experiment that breaks off took its time, too."""
    timeline = list[GradingSpan]()
    with pytest.raises(ValueError, match="broken"), noted(timeline, "watching", "talking"):
        raise ValueError("broken")
    assert [(each.part, each.of) for each in timeline] == [("watching", "talking")]
    assert timeline[0].ended_ns >= timeline[0].began_ns


def test_a_process_knows_when_it_began() -> None:
    """Between the moments before and after its start, to the hundredth that the kernel keeps."""
    before_ns = time.monotonic_ns()
    source = "from roslings.seen.timeline import process_began_ns; print(process_began_ns())"
    done = subprocess.run(
        [sys.executable, "-c", source], capture_output=True, text=True, check=True
    )
    tick_ns = S // os.sysconf("SC_CLK_TCK")
    assert before_ns - 2 * tick_ns <= int(done.stdout) <= time.monotonic_ns()
    assert process_began_ns() < before_ns


def test_what_was_installed_before_is_no_part_of_a_check() -> None:
    """A process that waited for an installation counts from its end; a later one, from its own."""
    now_ns, uptime_s = time.monotonic_ns(), time.clock_gettime(time.CLOCK_BOOTTIME)
    began = began_ns({READY: f"{uptime_s - 0.01:.2f}"})  # as the kernel, which rounds down
    assert process_began_ns() < began <= time.monotonic_ns()
    assert abs(began - now_ns) < 10 * S
    for written in ("1.00", "", "soon", "inf", "nan"):
        assert abs(began_ns({READY: written}) - process_began_ns()) < S / 2
    assert abs(began_ns({}) - process_began_ns()) < S / 2


def test_the_table_has_a_row_for_each_part_and_their_sum() -> None:
    """Within 80 columns, with a bar where the part lies in the whole."""
    timeline = [
        span("reading", 0, 0.3, "chatter"),
        span("building", 0.3, 1.5, "chatter"),
        span("starting", 1.5, 1.9, "an_experiment_with_a_long_name"),
        span("watching", 1.9, 1.905),
    ]
    seconds = Timings(reading=0.3, build=1.2, discovery=0.4, judging=0.1, total=2.0)
    console = Console(file=io.StringIO(), width=80, color_system=None)
    print_timings(timeline, seconds, console)
    text = console.file.getvalue()  # type: ignore[attr-defined]
    lines = [line for line in text.splitlines() if line.strip()]
    assert all(len(line) <= 80 for line in lines)
    assert [line.split()[:2] for line in lines[2:5]] == [
        ["0.00", "0.30"],
        ["0.30", "1.20"],
        ["1.50", "0.40"],
    ]
    assert lines[3].count("#") == round(1.2 / 2.0 * 28)
    assert lines[-1] == "= 2.00 s"
    assert "watch 0.00" in text  # too short for a row, and in the sum
