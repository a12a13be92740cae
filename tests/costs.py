"""What each test cost, and what came of it: seconds by the clock, and seconds of a processor.

`--costs FILE` adds one line of JSON a test to FILE. `.ci/summary.py` and `.ci/again.py` read it.
"""

from __future__ import annotations

import json
import resource
from collections.abc import Generator, Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import pytest

COSTS = "costs-of-tests"


@dataclass
class Cost:
    """Of one test, its fixtures too."""

    test: str
    outcome: str = "passed"
    lack: str = ""
    """Of a skipped one: what the machine has not (`machine.py`)."""
    wall_s: float = 0.0
    cpu_s: float = 0.0
    """Of the process that ran it, and of every child that it has waited for."""


def add_costs_option(parser: pytest.Parser) -> None:
    """`--costs`; the lessons and the other tests each bring it, and may run together."""
    with suppress(ValueError):  # it is there already
        parser.addoption(
            "--costs", metavar="FILE", type=Path, help="add what each test cost to FILE"
        )


def note_costs(config: pytest.Config) -> None:
    """Where it was asked for, once."""
    file = config.getoption("--costs")
    if file and not config.pluginmanager.has_plugin(COSTS):
        config.pluginmanager.register(Costs(file.absolute()), COSTS)


def cpu_s() -> float:
    """Of this process so far, and of its children."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(each.ru_utime + each.ru_stime for each in used)


def without_group(name: str) -> str:
    """A test's own name: pytest-xdist writes `@GROUP` behind that of one that is grouped."""
    own, _, group = name.rpartition("@")
    return name if "]" in group or not own else own


class Costs:
    """Adds up what the phases of each test cost."""

    def __init__(self, file: Path) -> None:
        self._file = file
        self._costs: dict[str, Cost] = {}
        self._at_work: set[str] = set()
        self._before_s = 0.0

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self) -> Generator[None, object, object]:
        """In the process that runs the test."""
        self._before_s = cpu_s()
        return (yield)

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_makereport(self) -> Generator[None, pytest.TestReport, pytest.TestReport]:
        """There too, after each phase."""
        report = yield
        now_s = cpu_s()
        report.cpu_s = now_s - self._before_s  # type: ignore[attr-defined]
        self._before_s = now_s
        return report

    def pytest_runtest_logreport(self, report: Any) -> None:
        """In the process that prints."""
        name = without_group(report.nodeid)
        cost = self._costs.setdefault(name, Cost(name))
        self._at_work ^= {name} if report.when != "call" else set()
        cost.wall_s += report.duration
        cost.cpu_s += getattr(report, "cpu_s", 0.0)
        if report.outcome != "passed":
            cost.outcome = report.outcome
            cost.lack = getattr(report, "lack", "")

    def pytest_collectreport(self, report: Any) -> None:
        """A whole file that was skipped is one line."""
        if report.skipped:
            lack = getattr(report, "lack", "")
            self._costs[report.nodeid] = Cost(report.nodeid, report.outcome, lack)

    def leave_out(self, tests: Mapping[str, str]) -> None:
        """Tests that were not run, each with the word that tells why (`needed/left_out.py`)."""
        self._costs |= {name: Cost(name, outcome) for name, outcome in tests.items()}

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        """Name what was broken off: it may be what hung."""
        for name in sorted(self._at_work):
            terminalreporter.write_line(f"BROKEN OFF {name}")

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """Write all down. A test that was broken off has not passed."""
        for name in self._at_work:
            self._costs[name].outcome = "failed"
        if not hasattr(session.config, "workerinput"):
            with self._file.open("a", encoding="utf-8") as out:
                for cost in self._costs.values():
                    print(json.dumps(asdict(cost)), file=out)
