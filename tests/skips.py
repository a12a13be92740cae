"""A test skips by a name of `machine.py` only, and only where the probe finds nothing there.

    pytestmark = needs("Chromium")         before its fixtures are made
    skip_without("/dev/net/tun")           in a test or a fixture, where not each case needs it
    rclpy = imported("rclpy")              a module that is not in every environment

Every other skip fails: one without such a name, an expected failure, an empty list of cases, and
one by a name whose probe says that it is there.
"""

from __future__ import annotations

import importlib
import re
from collections.abc import Generator
from typing import Any, TypeVar

import pytest

from machine import TABLE, lack_of

PLUGIN = "skips-have-reasons"
AReport = TypeVar("AReport", pytest.TestReport, pytest.CollectReport)
NAMED = re.compile(r"(?:Skipped: )?no (?P<name>.+?): .", re.DOTALL)


def needs(*names: str) -> pytest.MarkDecorator:
    """Mark for what is skipped where one of these is missing. Nothing is tried before it runs."""
    return pytest.mark.needs(*names)


def skip_without(*names: str) -> None:
    """Skip where the probe of one of these finds nothing; else go on."""
    for name in names:
        if why := lack_of(name):
            pytest.skip(f"no {name}: {why}", allow_module_level=True)


def imported(name: str) -> Any:
    """The module, where its package is in this environment."""
    skip_without(f"module {name.partition('.')[0]}")
    return importlib.import_module(name)


def hold_to_reasons(config: pytest.Config) -> None:
    """From now on; the lessons and the other tests each ask for it, and may run together."""
    config.addinivalue_line("markers", "needs(*names): skipped where one is missing: machine.py")
    if not config.pluginmanager.has_plugin(PLUGIN):
        config.pluginmanager.register(Reasons(), PLUGIN)


class Reasons:
    """Looks at each skip, where the test runs."""

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_setup(self, item: pytest.Item) -> None:
        """What a mark names; before anything dear is made ready."""
        for mark in item.iter_markers("needs"):
            skip_without(*mark.args)

    @pytest.hookimpl(wrapper=True, tryfirst=True)
    def pytest_runtest_makereport(self) -> Generator[None, pytest.TestReport, pytest.TestReport]:
        """Of a test's phase."""
        return judged((yield))

    @pytest.hookimpl(wrapper=True, tryfirst=True)
    def pytest_make_collect_report(
        self,
    ) -> Generator[None, pytest.CollectReport, pytest.CollectReport]:
        """Of a whole file."""
        return judged((yield))


def judged(report: AReport) -> AReport:
    """A skip has its name in `lack` for `costs.py`, or is a failure."""
    if hasattr(report, "wasxfail"):
        return _failed(report, f"a failure that is expected ({report.wasxfail})")
    if report.outcome != "skipped":
        return report
    words = report.longrepr[2] if isinstance(report.longrepr, tuple) else str(report.longrepr)
    found = NAMED.match(words)
    if not found or found["name"] not in TABLE:
        return _failed(report, f"{words!r} is no reason of tests/machine.py")
    if not lack_of(found["name"]):
        return _failed(report, f"{words!r}, but the probe finds it here")
    report.__dict__["lack"] = found["name"]
    return report


def _failed(report: AReport, why: str) -> AReport:
    report.outcome = "failed"
    report.longrepr = f"{report.nodeid} may not be skipped: {why}"
    report.__dict__.pop("wasxfail", None)
    return report
