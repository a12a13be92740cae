"""The pytest plugin that runs a grader's checks on evidence and collects their outcomes."""

from __future__ import annotations

import math
import types
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import pytest

from ros2_on_pip.language import template
from roslings.course import Lab
from roslings.evidence import UnreadablePart
from roslings.judge.check import check_of
from roslings.judge.dropped import LookedAt
from roslings.judge.faults import Fault, Inconclusive, NothingToJudge, PrintsWithoutEnd
from roslings.judge.faults.reasons import CheckAgain, FirstMend
from roslings.judge.floods import flood_in
from roslings.judge.grader_mistakes import nothing_called
from roslings.judge.outcome import words_for, words_for_mistake
from roslings.judge.remarks import begin_remarks
from roslings.judge.sheet import title_of
from roslings.judge.unrecorded import NotRecordedView
from roslings.judge.views import View
from roslings.verdict import CheckResult


class Collector:
    """Runs each check once its needs have passed, and writes down what came of it."""

    def __init__(self, lab: Lab, looks: LookedAt, there: Sequence[str] = ()) -> None:
        """`there` are the names that a check can ask for."""
        self.results: list[CheckResult] = []
        self.problems: list[str] = []
        self._roots: dict[str, str] = {}
        self._open: set[str] = set()
        """Checks that do not pass, and keep no other from being judged."""
        self._floods: dict[str, str] = {}
        """Executables that print without end, to the check that tells it."""
        self._nothing: dict[str, NothingToJudge] = {}
        """Checks that had nothing to look at, to the reason."""
        self._lab, self._looks, self._there = lab, looks, there

    @property
    def told(self) -> tuple[CheckResult, ...]:
        """All outcomes. Where no other check says why one had nothing to look at, it cannot tell.

        So on a busy computer, where something was not seen in time, a right package loses nothing.
        """
        if any(each.outcome in ("fail", "inconclusive") for each in self.results):
            return tuple(self.results)
        return tuple(map(self._or_again, self.results))

    def _or_again(self, result: CheckResult) -> CheckResult:
        reason = self._nothing.get(result.id)
        if reason is None:
            return result
        words = words_for(CheckAgain(reason), result.title)
        return result.model_copy(update=words)

    def pytest_addoption(self, parser: pytest.Parser) -> None:
        """How a failure is written: nobody reads pytest's own page, half of a judgement's time."""
        parser.addoption("--tb", dest="tbstyle", default="native")

    def pytest_runtest_setup(self, item: pytest.Item) -> None:
        """Skip a check whose need has not passed."""
        self._looks.begin()
        begin_remarks()
        for need in check_of(_function(item)).needs:
            root = self._root_of(need)
            if root is not None:
                self._roots[check_name(item)] = root
                pytest.skip(str(FirstMend(self._title_of(root))))

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_makereport(
        self, item: pytest.Item, call: pytest.CallInfo[None]
    ) -> Iterator[None]:
        """Turn what happened into one line of the verdict."""
        if call.when == "call" or (call.when == "setup" and call.excinfo):
            error = self._looks.outcome(call.excinfo.value if call.excinfo else None)
            self.results.append(self._result(item, self._explained(item, error)))
        return (yield)

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        """Remember why a grader could not be read."""
        if report.failed:
            self.problems.append(str(report.longrepr))

    def _root_of(self, need: str) -> str | None:
        """The check to mend first: what `need` itself waits for, else `need`; None if it passed."""
        passed = any(r.id == need and r.outcome == "pass" for r in self.results)
        return None if passed or need in self._open else self._roots.get(need, need)

    def _explained(self, item: pytest.Item, error: BaseException | None) -> BaseException | None:
        """The same, or where an earlier check found this mistake already: that it is the same.

        What could not be told beside such a mistake needs no telling either.
        """
        flood = flood_in(getattr(item, "funcargs", {}).values())
        if flood and not isinstance(error, pytest.skip.Exception):
            return self._told_once(item, flood, error)
        if not isinstance(error, Fault | Inconclusive | UnreadablePart):
            return error
        for name, kinds in check_of(_function(item)).explained_by.items():
            if any(r.id == name and r.fault in kinds for r in self.results):
                self._roots[check_name(item)] = name
                return FirstMend(self._title_of(name))
        return error

    def _told_once(
        self, item: pytest.Item, flood: PrintsWithoutEnd, error: BaseException | None
    ) -> BaseException | None:
        """The first check that looks at it tells it; what others miss beside it is the same."""
        told = self._floods.setdefault(flood.program, check_name(item))
        if told == check_name(item):
            return flood
        if error is None:
            return None
        self._roots[check_name(item)] = told
        return FirstMend(self._title_of(told))

    def _title_of(self, name: str) -> str:
        titles = {result.id: result.title for result in self.results}
        return titles.get(name, name)

    def _result(self, item: pytest.Item, error: BaseException | None) -> CheckResult:
        name = check_name(item)
        worth = self._lab.card.points.get(name, 0.0)
        hint = self._lab.hints.get(name)
        words: dict[str, Any] = {
            "id": name,
            "title": title_of(_function(item)),
            "points": _points(worth, error),
            "max_points": worth,
            "lesson": self._lab.lesson_of(name),
            "hidden": name in self._lab.hidden_checks,
            **self._words_for(item, error),
        }
        if isinstance(error, Fault) and not error.blocks:
            self._open.add(name)
        if isinstance(error, NothingToJudge) and not isinstance(error, FirstMend):
            self._nothing[name] = error
        if words["outcome"] == "fail" and hint:
            words["hints"] = steps_of(self._lab.name, name, hint.steps)
        return CheckResult(**words)

    def _words_for(self, item: pytest.Item, error: BaseException | None) -> dict[str, Any]:
        if isinstance(error, pytest.skip.Exception):
            return {"outcome": "skip", "why": str(error)}
        if isinstance(error, pytest.FixtureLookupError) and error.argname:
            mistake = nothing_called(error.argname, _function(item), self._there)
            return words_for_mistake(mistake)
        return words_for(error, title_of(_function(item)), self._lab.graders)


def _points(worth: float, error: BaseException | None) -> float:
    """All of them, or what a fault leaves: whole points, and never all."""
    if error is None:
        return worth
    share = error.earned if isinstance(error, Fault) else 0.0
    return max(0.0, min(float(math.floor(worth * share)), worth - 1))


def steps_of(lab: str, check: str, english: Sequence[str]) -> tuple[str, ...]:
    """The steps of a hint, in the language that is asked for: `hints.nodes.rate.1`."""
    names = (hint_id(lab, check, number) for number in range(1, len(english) + 1))
    return tuple(map(template, names, english))


def hint_id(lab: str, check: str, number: int) -> str:
    """The id of a step of a hint."""
    return f"hints.{lab}.{check}.{number}"


def _function(item: pytest.Item) -> Any:
    return getattr(item, "function", None)


def check_name(item: pytest.Item) -> str:
    """`rate` for the function `test_rate`."""
    return item.name.removeprefix("test_")


@dataclass(frozen=True)
class Evidences:
    """What checks can ask for by name; the views are there when `fill` has filled them."""

    names: tuple[str, ...]
    views: Mapping[str, View]
    fill: Callable[[], None]


def evidence_plugin(evidences: Evidences, collector: Collector) -> types.ModuleType:
    """A pytest plugin with one fixture for each thing that a check can ask for by name.

    The evidence is brought when every check is loaded, and none has run.
    """
    plugin: Any = types.ModuleType("roslings_evidence")
    for name in evidences.names:
        setattr(plugin, name, _fixture(name, evidences.views))

    def pytest_collection_finish() -> None:
        if not collector.problems:
            evidences.fill()

    plugin.pytest_collection_finish = pytest_collection_finish
    return plugin  # type: ignore[no-any-return]  # a module, with names of its own


def _fixture(name: str, views: Mapping[str, View]) -> Any:
    @pytest.fixture(name=name, scope="session")
    def give() -> View:
        view = views[name]
        if isinstance(view, NotRecordedView):
            view.refuse()
        return view

    return give
