"""`--needed FILE`: pytest leaves out what `.ci/needs.py chosen --to FILE` has left out.

Only tests that a record speaks of: slow ones that the gate runs, and lessons. What is left out is
told at the end, and stands in the file of `--costs`.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from costs import COSTS, Costs, without_group
from needed.left_out import LeftOut, read, told

PLUGIN = "left-out-by-needs"
LESSON = ".ipynb"


def add_needed_option(parser: pytest.Parser) -> None:
    """`--needed`; the lessons and the other tests each bring it, and may run together."""
    with suppress(ValueError):  # it is there already
        parser.addoption(
            "--needed",
            metavar="FILE",
            type=Path,
            help="leave out what FILE names: .ci/needs.py chosen --to FILE",
        )


def leave_out(config: pytest.Config) -> None:
    """Where it was asked for, once."""
    file = config.getoption("--needed")
    if file and not config.pluginmanager.has_plugin(PLUGIN):
        config.pluginmanager.register(LeavesOut(read(file.absolute())), PLUGIN)


def is_recorded(item: pytest.Item) -> bool:
    """Whether the record of its file speaks of it."""
    if item.path.suffix == LESSON:
        return True
    return bool(item.get_closest_marker("slow")) and not item.get_closest_marker("twice")


class LeavesOut:
    """Takes them out of a run, and tells of them."""

    def __init__(self, left_out: Mapping[str, LeftOut]) -> None:
        self._left_out = left_out
        self.tests: dict[str, str] = {}
        """Test to why it was left out."""

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(
        self, config: pytest.Config, items: list[pytest.Item]
    ) -> None:
        """In each process that runs tests: all of them choose alike."""
        gone = dict(self._gone(config.rootpath, items))
        if gone:
            config.hook.pytest_deselected(items=list(gone))
            items[:] = [item for item in items if item not in gone]
        self.tests |= {without_group(item.nodeid): why for item, why in gone.items()}

    def _gone(self, root: Path, items: Sequence[pytest.Item]) -> Iterator[tuple[pytest.Item, str]]:
        """Each that is left out, and why."""
        for file, left in self._left_out.items():
            own = [item for item in items if item.path == root / file and is_recorded(item)]
            named = {without_group(item.nodeid): item for item in own}
            stay = {*left.drawn(named.keys()), *left.skipped}
            yield from ((item, left.outcome) for name, item in named.items() if name not in stay)

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node: Any) -> None:
        """A worker of pytest-xdist has ended: what it left out, all have left out."""
        self.tests |= getattr(node, "workeroutput", {}).get(PLUGIN, {})

    @pytest.hookimpl(wrapper=True, tryfirst=True)
    def pytest_sessionfinish(self, session: pytest.Session) -> Generator[None, None, None]:
        """Where nothing else was asked for, all has passed."""
        config = session.config
        if hasattr(config, "workeroutput"):
            config.workeroutput[PLUGIN] = self.tests
        if isinstance(costs := config.pluginmanager.get_plugin(COSTS), Costs):
            costs.leave_out(self.tests)
        if self.tests and session.exitstatus == pytest.ExitCode.NO_TESTS_COLLECTED:
            session.exitstatus = pytest.ExitCode.OK
        yield

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        """How many, and why."""
        for line in told(self.tests.values()):
            terminalreporter.write_line(f"Left out: {line}.")
