"""Which wall held a submission, for who believes the result."""

from __future__ import annotations

from roslings.verdict import Verdict

HELD = {
    "namespaces": "Built and run in a sandbox of namespaces: out of reach were the grader, this"
    " result and every network.",
    "user": "Built and run as a user of its own: out of reach were the grader and this result."
    " This wall does not stop the network.",
    "none": "Built and run without a wall, by somebody who trusts this package.",
}


def held(verdict: Verdict) -> str:
    """One sentence or two; empty where nobody wrote it down."""
    return HELD.get(verdict.environment.wall or "", "")
