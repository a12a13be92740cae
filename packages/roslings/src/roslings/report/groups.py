"""The checks of a verdict, put together by what became of them."""

from __future__ import annotations

from collections.abc import Sequence

from ros2_on_pip.language import said
from roslings.verdict import CheckOutcome, CheckResult, Verdict


def of_outcome(verdict: Verdict, outcome: CheckOutcome) -> list[CheckResult]:
    """Those that ended so, in their order."""
    return [check for check in verdict.checks if check.outcome == outcome]


def by_reason(checks: Sequence[CheckResult]) -> list[tuple[str, list[CheckResult]]]:
    """Checks that were not judged, put together where the reason is the same."""
    groups: dict[str, list[CheckResult]] = {}
    for check in checks:
        groups.setdefault(check.why or said("verdict.not_said", "not said"), []).append(check)
    return list(groups.items())
