"""Other ways to run a node until Ctrl-C."""

from __future__ import annotations

from collections.abc import Iterator

import libcst as cst
import libcst.matchers as m

from roslings_prove.rewritten.source import Sources, dotted
from roslings_prove.rewritten.trees import (
    all_of,
    argument,
    code_of,
    expression,
    importing,
    keyword_of,
    statements,
    swapped,
    with_arguments,
)

THREADS = "MultiThreadedExecutor"
ROS = '''

@contextmanager
def ros(args):
    """ROS, as long as the block below `with` lasts."""
    rclpy.init(args=args)
    try:
        yield
    finally:
        rclpy.try_shutdown()
'''
LOOP = """node = 0
while rclpy.ok():
    rclpy.spin_once(node)
"""
LOOP_OF = """node = 0
executor = 1
executor.add_node(node)
while rclpy.ok():
    executor.spin_once()
"""


def _spins(tree: cst.CSTNode) -> list[cst.Call]:
    return [call for call in all_of(tree, cst.Call) if dotted(call.func) == "rclpy.spin"]


def multi_threaded(sources: Sources) -> Sources:
    """A MultiThreadedExecutor runs the callbacks."""

    def change(tree: cst.Module) -> cst.Module:
        plain = [call for call in _spins(tree) if not keyword_of(call, "executor")]
        if not plain:
            return tree
        executor = argument(expression(f"{THREADS}()"), "executor")
        more = {call: with_arguments(call, [*call.args, executor]) for call in plain}
        return importing(swapped(tree, more), "rclpy.executors", THREADS)

    return sources.mapped(change)


# --- a loop ------------------------------------------------------------------------------------


def a_loop_of_spin_once(sources: Sources) -> Sources:
    """`while rclpy.ok(): rclpy.spin_once(node)` in place of `rclpy.spin(node)`."""
    return sources.mapped(lambda tree: tree.visit(_Loops()))


class _Loops(cst.CSTTransformer):
    def leave_SimpleStatementLine(  # noqa: N802
        self, original_node: cst.SimpleStatementLine, updated_node: cst.SimpleStatementLine
    ) -> cst.SimpleStatementLine | cst.FlattenSentinel[cst.BaseStatement]:
        spins = _spins(original_node)
        if not spins or not m.matches(original_node, m.SimpleStatementLine([m.Expr(m.Call())])):
            return updated_node
        return cst.FlattenSentinel([*_loop(spins[0])])


def _loop(call: cst.Call) -> Iterator[cst.BaseStatement]:
    executor = keyword_of(call, "executor")
    values = [call.args[0].value, *([executor.value] if executor else [])]
    for line in statements(LOOP_OF if executor else LOOP):
        numbers = all_of(line, cst.Integer)
        yield swapped(line, {each: values[int(each.value)] for each in numbers})


# --- a block -----------------------------------------------------------------------------------


def a_with_block(sources: Sources) -> Sources:
    """`with ros(args):` begins and ends ROS."""

    def change(tree: cst.Module) -> cst.Module:
        new = tree.visit(_Blocks())
        if code_of(new) == code_of(tree):
            return tree
        at = next(n for n, line in enumerate(new.body) if isinstance(line, cst.FunctionDef))
        maker = cst.parse_module(ROS).body
        blank = [cst.EmptyLine(indent=False)] * 2
        maker = [maker[0].with_changes(leading_lines=blank)]
        whole = new.with_changes(body=[*new.body[:at], *maker, *new.body[at:]])
        return importing(whole, "contextlib", "contextmanager")

    return sources.mapped(change)


class _Blocks(cst.CSTTransformer):
    def leave_Try(self, original_node: cst.Try, updated_node: cst.Try) -> cst.Try:  # noqa: N802
        first = _only_call(original_node.body.body[0])
        end = original_node.finalbody
        if not first or dotted(first.func) != "rclpy.init" or not end or not _ends_ros(end):
            return updated_node
        if not original_node.handlers or not first.args:
            return updated_node
        block = cst.With(
            items=[cst.WithItem(cst.Call(cst.Name("ros"), [cst.Arg(first.args[0].value)]))],
            body=updated_node.body.with_changes(body=updated_node.body.body[1:]),
        )
        body = cst.IndentedBlock([block])
        return updated_node.with_changes(body=body, finalbody=None)


def _only_call(statement: cst.CSTNode) -> cst.Call | None:
    if m.matches(statement, m.SimpleStatementLine([m.Expr(m.Call())])):
        return all_of(statement, cst.Call)[0]
    return None


def _ends_ros(end: cst.Finally) -> bool:
    (first, *more) = end.body.body
    call = _only_call(first)
    return not more and call is not None and dotted(call.func) == "rclpy.try_shutdown"
