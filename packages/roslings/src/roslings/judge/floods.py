"""What prints without end is ended, and whatever check misses something of it then tells why.

Not one demand looks for that. A node, a program with one task and a launch are asked different
things, and none of them can do its work so.
"""

from __future__ import annotations

from collections.abc import Iterable

from roslings.evidence import ProcessSeen
from roslings.judge.demands import lifetime_s
from roslings.judge.faults import PrintsWithoutEnd
from roslings.judge.views import ExperimentView

LAST_LINES = 6
"""One is as the other."""


def flood_in(views: Iterable[object]) -> PrintsWithoutEnd | None:
    """Of the experiments among these: the first process that was ended because it printed on."""
    seen = (view.seen for view in views if isinstance(view, ExperimentView))
    processes = (process for each in seen for process in each.processes.values())
    found = next((process for process in processes if process.prints_without_end), None)
    return _fault(found) if found else None


def _fault(seen: ProcessSeen) -> PrintsWithoutEnd:
    return PrintsWithoutEnd(
        seen.executable,
        seen.output_lines,
        seen.output_bytes / 1e6,
        lifetime_s(seen),
        log=tuple(line.text for line in seen.lines[-LAST_LINES:]),
    )
