"""Another way to work on a goal: a loop that sleeps, on a thread of its own."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import libcst as cst

from roslings_prove.rewritten.source import Sources
from roslings_prove.rewritten.spinning import multi_threaded
from roslings_prove.rewritten.trees import (
    Statement,
    all_of,
    assigned,
    body_of,
    called,
    classes,
    code_of,
    expression,
    functions,
    importing,
    method,
    own_attribute,
    swapped,
    with_body,
)


@dataclass(frozen=True)
class TimedFuture:
    """A future of a node that a timer sets, and makes anew each time."""

    future: str
    period: str
    """In seconds, as the code has it."""
    wakes: str
    """The method that the timer calls."""


def a_goal_that_sleeps(sources: Sources) -> Sources:
    """The loop of a goal sleeps, and the node has several threads, where it awaits a tick.

    Day 5 taught it so until there was `/clock`: who wrote it then has a right package.
    """

    def change(tree: cst.Module) -> cst.Module:
        ticks = {one: tick for one in classes(tree) if (tick := _tick_of(one))}
        if not ticks:
            return tree
        changed = {one: with_body(one, [*_sleeping(one, tick)]) for one, tick in ticks.items()}
        return importing(swapped(tree, changed), "time")

    new = sources.mapped(change)
    return sources if new == sources else multi_threaded(new)


def _tick_of(one: cst.ClassDef) -> TimedFuture | None:
    """What loops of a class await; None where they await something else, too."""
    awaited = {own_attribute(each.expression) for each in all_of(one, cst.Await)}
    found = [tick for tick in _ticks(one) if {tick.future} == awaited]
    return found[0] if len(found) == 1 else None


def _ticks(one: cst.ClassDef) -> Iterator[TimedFuture]:
    for call in all_of(one, cst.Call):
        if called(call) == "create_timer" and len(call.args) == 2:
            period, wakes = (arg.value for arg in call.args)
            name = own_attribute(wakes)
            for target in assigned(method(one, name) or cst.Pass()):
                if future := own_attribute(target):
                    yield TimedFuture(future, code_of(period), name)


def _sleeping(one: cst.ClassDef, tick: TimedFuture) -> Iterator[Statement]:
    """The statements of the class, without the timer and what it calls."""
    for each in body_of(one):
        if each not in functions(one):
            yield each
        elif isinstance(each, cst.FunctionDef) and each.name.value != tick.wakes:
            yield _without_tick(each, tick)


def _without_tick(function: cst.FunctionDef, tick: TimedFuture) -> cst.FunctionDef:
    lines = [line for line in body_of(function) if not _makes(line, tick)]
    awaits = all_of(function, cst.Await)
    if not awaits:
        return function if len(lines) == len(body_of(function)) else with_body(function, lines)
    sleeps = {each: expression(f"time.sleep({tick.period})") for each in awaits}
    return swapped(function, sleeps).with_changes(asynchronous=None)


def _makes(line: Statement, tick: TimedFuture) -> bool:
    """The line makes the future, or the timer."""
    if not isinstance(line, cst.SimpleStatementLine):
        return False
    timers = [each for each in all_of(line, cst.Call) if called(each) == "create_timer"]
    given = {own_attribute(arg.value) for timer in timers for arg in timer.args}
    return tick.wakes in given or tick.future in {own_attribute(each) for each in assigned(line)}
