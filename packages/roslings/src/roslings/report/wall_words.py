"""Which wall held a submission, for who believes the result."""

from __future__ import annotations

from ros2_on_pip.language import Text
from roslings.verdict import Verdict

HELD = {
    "namespaces": Text(
        "wall.namespaces",
        "Built and run in a sandbox of namespaces: out of reach were the grader, this"
        " result and every network.",
    ),
    "user": Text(
        "wall.user",
        "Built and run as a user of its own: out of reach were the grader and this result."
        " This wall does not stop the network.",
    ),
    "none": Text("wall.none", "Built and run without a wall, by somebody who trusts this package."),
}


def held(verdict: Verdict) -> str:
    """One sentence or two; empty where nobody wrote it down."""
    return str(HELD.get(verdict.environment.wall or "", ""))
