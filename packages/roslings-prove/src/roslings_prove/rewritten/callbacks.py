"""Other ways to have a callback called."""

from __future__ import annotations

import libcst as cst
import libcst.matchers as m

from roslings_prove.rewritten.source import Sources
from roslings_prove.rewritten.spinning import THREADS
from roslings_prove.rewritten.trees import (
    TAKES_CALLBACKS,
    Statement,
    all_of,
    argument,
    body_of,
    callbacks,
    called,
    called_here,
    classes,
    code_of,
    functions,
    importing,
    is_node,
    keyword_of,
    method,
    own_attribute,
    own_names,
    statements,
    swapped,
    with_arguments,
    with_body,
)

GROUP = "ReentrantCallbackGroup"
LOOP = '''def work(self):
    """Do it again and again, at a steady rate, on a thread of its own."""
    try:
        while rclpy.ok():
            self.{name}()
            self.rate.sleep()
    except Exception:
        if rclpy.ok():
            raise  # once ROS has ended, there is nothing left to do
'''


def reentrant_groups(sources: Sources) -> Sources:
    """Timers, services and subscriptions share a reentrant group; one thread runs them, as before.

    With more threads, a program would have to guard what its callbacks share.
    """

    if any(THREADS in text for text in sources.texts.values()):
        return sources

    def change(tree: cst.Module) -> cst.Module:
        changed = {one: _grouped(one) for one in classes(tree) if is_node(one)}
        new = swapped(tree, changed)
        is_other = code_of(new) != code_of(tree)
        return importing(new, "rclpy.callback_groups", GROUP) if is_other else tree

    return sources.mapped(change)


def _grouped(one: cst.ClassDef) -> cst.ClassDef:
    begin = method(one, "__init__")
    if begin is None:
        return one
    plain = [
        call
        for call in all_of(begin, cst.Call)
        if called(call) in TAKES_CALLBACKS and not keyword_of(call, "callback_group")
    ]
    if not plain:
        return one
    group = argument(cst.Name("group"), "callback_group")
    others = {call: with_arguments(call, [*call.args, group]) for call in plain}
    new = swapped(begin, others)
    body = body_of(new)
    at = next(n for n, line in enumerate(body) if "super()" in code_of(line)) + 1
    line = statements(f"group = {GROUP}()\n")
    return swapped(one, {begin: with_body(new, [*body[:at], *line, *body[at:]])})


# --- async -------------------------------------------------------------------------------------


def async_callbacks(sources: Sources) -> Sources:
    """`async def`, for all that nobody but the executor calls."""

    def change(tree: cst.Module) -> cst.Module:
        plain = [
            each
            for one in classes(tree)
            for each in functions(one)
            if each.name.value in callbacks(one) - called_here(one)
        ]
        later = cst.Asynchronous()
        return swapped(tree, {each: each.with_changes(asynchronous=later) for each in plain})

    return sources.mapped(change)


# --- a rate ------------------------------------------------------------------------------------


def a_rate_in_a_thread(sources: Sources) -> Sources:
    """A loop that sleeps by `create_rate`, in place of the only timer of a node."""

    def change(tree: cst.Module) -> cst.Module:
        changed = {one: _looping(one) for one in classes(tree) if _has_one_timer(one)}
        if not changed:
            return tree
        return importing(importing(swapped(tree, changed), "threading"), "rclpy")

    return sources.mapped(change)


def _timers(tree: cst.CSTNode) -> list[cst.Call]:
    return [call for call in all_of(tree, cst.Call) if called(call) == "create_timer"]


def _has_one_timer(one: cst.ClassDef) -> bool:
    begin = method(one, "__init__")
    if begin is None or len(_timers(one)) != 1 or len(_timers(begin)) != 1:
        return False
    (timer,) = _timers(begin)
    plain = len(timer.args) == 2 and own_attribute(timer.args[1].value) in own_names(one)
    taken = {"rate", "work"} & own_names(one)
    if not plain or taken or _uses_timer(one, begin):
        return False
    return not _sets_a_future(one, own_attribute(timer.args[1].value))


def _sets_a_future(one: cst.ClassDef, name: str) -> bool:
    """Who sets it on another thread does not wake the executor: what awaits it goes on late."""
    function = method(one, name)
    calls = all_of(function, cst.Call) if function else []
    return any(called(call) == "set_result" for call in calls)


def _uses_timer(one: cst.ClassDef, begin: cst.FunctionDef) -> bool:
    """It does something with the timer that a rate cannot do."""
    kept = {
        own_attribute(x.target)
        for line in body_of(begin)
        if _timers(line)
        for x in all_of(line, cst.AssignTarget)
    }
    said = [own_attribute(each) for each in all_of(one, cst.Attribute)]
    return any(said.count(name) > 1 for name in kept if name)


def _looping(one: cst.ClassDef) -> cst.ClassDef:
    begin = method(one, "__init__")
    assert begin is not None
    (timer,) = _timers(begin)
    period, name = timer.args[0].value, own_attribute(timer.args[1].value)
    rate = f"self.rate = self.create_rate(1 / {_whole(period)})\n"
    lines: list[Statement] = []
    for line in body_of(begin):
        lines += statements(rate) if _timers(line) else [line]
    start = "threading.Thread(target=self.work, daemon=True).start()\n"
    (loop,) = statements(LOOP.format(name=name))
    loop = loop.with_changes(leading_lines=[cst.EmptyLine(indent=False)])
    body: list[Statement] = []
    for each in body_of(one):
        is_begin = each is begin
        body.append(with_body(begin, [*lines, *statements(start)]) if is_begin else each)
        body += [loop] if is_begin else []
    return with_body(one, body)


def _whole(period: cst.BaseExpression) -> str:
    """In brackets, where a division would take it apart."""
    is_plain = m.matches(period, m.Name() | m.Attribute() | m.Integer() | m.Float())
    return code_of(period) if is_plain else f"({code_of(period)})"
