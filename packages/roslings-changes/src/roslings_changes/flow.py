"""Wrong order of what is done: dropped, doubled, too early, too slow, broken off."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import libcst as cst

from roslings_changes.source import ModuleSource, New, is_documentation

LATE_S, FOR_EVER_S = 1.0, 1000.0
BREAKS_IN_CALL = (1, 2, 3, 5, 7, 10)
STOPS_IN_CALL = 3
CALLED_ONCE = ("__init__", "main")
NODE = "self()"
SAME_TWICE = ("__init__", "close", "try_shutdown", "spin", "spin_until_future_complete")
"""Calls that end something, or wait until it ends: the second one finds it so."""
SEEN_FROM_OUTSIDE = ("create_publisher", "create_subscription", "create_timer", "create_service")
"""What these make works on, though nobody has a name for it any more."""


def drop(node: cst.CSTNode, source: ModuleSource) -> Iterator[New]:
    """A statement is left out."""
    if _ends_ros(node):
        return
    if is_statement(node) or (isinstance(node, cst.If) and node.orelse is None):
        parent = source.parent(node)
        alone = isinstance(parent, cst.IndentedBlock) and len(parent.body) == 1
        yield cst.parse_statement("pass") if alone else cst.RemoveFromParent()


def double(node: cst.CSTNode, source: ModuleSource) -> Iterator[New]:
    """A statement that does something is there twice."""
    if isinstance(node, cst.SimpleStatementLine) and is_statement(node) and _does_more(node):
        plain = node.with_changes(leading_lines=[])
        yield cst.FlattenSentinel([node, plain])


def early_return(node: cst.CSTNode, source: ModuleSource) -> Iterator[New]:
    """A function ends before its end: before each statement but the last, which `drop` leaves.

    Or it does nothing from some call on.
    """
    if isinstance(node, cst.IndentedBlock) and (function := _function_of(node, source)):
        for at in range(_begin_of(node), len(node.body) - 1):
            yield _with(node, at, "return\n")
        if not _is_called_once(function):
            yield _with_at_begin(node, *_in_call(function, ">=", STOPS_IN_CALL, "return"))


def blocks(node: cst.CSTNode, source: ModuleSource) -> Iterator[New]:
    """A callback sleeps: a while each time, for ever, or for ever in some call."""
    function = _function_of(node, source)
    if isinstance(node, cst.IndentedBlock) and function and not _is_called_once(function):
        for seconds in (LATE_S, FOR_EVER_S):
            yield _with_at_begin(node, "import time\n", f"time.sleep({seconds})\n")
        sleep = f"time.sleep({FOR_EVER_S})"
        later = _in_call(function, "==", STOPS_IN_CALL, sleep)
        yield _with_at_begin(node, "import time\n", *later)


def breaks(node: cst.CSTNode, source: ModuleSource) -> Iterator[New]:
    """An exception in the n-th call of a function."""
    if isinstance(node, cst.IndentedBlock) and (function := _function_of(node, source)):
        yield _with_at_begin(node, f"{_raise(1)}\n")
        if not _is_called_once(function):
            for count in BREAKS_IN_CALL[1:]:
                yield _with_at_begin(node, *_in_call(function, "==", count, _raise(count)))


def too_early(node: cst.CSTNode, source: ModuleSource) -> Iterator[New]:
    """A value is used before it is there: before the statement that makes it, or None at first."""
    if isinstance(node, cst.IndentedBlock):
        for at, made in enumerate(node.body):
            for later in range(at + 1, len(node.body)):
                if any(
                    _touch(one, other)
                    for one in _made_in(made)
                    for other in _names_in(node.body[later])
                ):
                    yield node.with_changes(body=_moved(node.body, later, at))
    match node:
        case cst.Assign(
            targets=[cst.AssignTarget(cst.Attribute(value=cst.Name("self")))], value=value
        ) if _is_in_init(node, source) and not _calls(value):
            yield node.with_changes(value=cst.Name("None"))


def _moved(body: Sequence[cst.BaseStatement], later: int, at: int) -> list[cst.BaseStatement]:
    """The statement `later` put before the statement `at`."""
    rest = [*body[:later], *body[later + 1 :]]
    return [*rest[:at], body[later], *rest[at:]]


# --- what a statement is -----------------------------------------------------------------------


def is_statement(node: cst.CSTNode) -> bool:
    """A line that does something: no import, no docstring, no `pass`."""
    match node:
        case cst.SimpleStatementLine(body=[cst.Import() | cst.ImportFrom() | cst.Pass()]):
            return False
        case cst.SimpleStatementLine():
            return not is_documentation(node)
    return False


def _does_more(node: cst.SimpleStatementLine) -> bool:
    """Twice is not the same as once: it adds, or does something that does not end or only wait."""
    match node.body[0]:
        case cst.AugAssign():
            return True
        case cst.Expr(value=cst.Call() as call):
            return called(call) not in SAME_TWICE
        case cst.Assign(targets=[cst.AssignTarget(cst.Attribute())], value=cst.Call() as call):
            return called(call) in SEEN_FROM_OUTSIDE
    return False


def called(call: cst.Call) -> str:
    """The last part of what is called: `info` of `self.get_logger().info(...)`."""
    match call.func:
        case cst.Name(value=name) | cst.Attribute(attr=cst.Name(value=name)):
            return name
    return ""


def _ends_ros(node: cst.CSTNode) -> bool:
    """Where `main` ends: Ctrl-C has ended ROS already, and the process is over."""
    match node:
        case cst.SimpleStatementLine(body=[cst.Expr(value=cst.Call() as call)]):
            return called(call) == "try_shutdown"
    return False


def _calls(node: cst.CSTNode) -> bool:
    return isinstance(node, cst.Call) or any(map(_calls, node.children))


def _function_of(node: cst.CSTNode, source: ModuleSource) -> cst.FunctionDef | None:
    """The function whose whole body a node is."""
    if not isinstance(node, cst.IndentedBlock):
        return None
    parent = source.parent(node)
    return parent if isinstance(parent, cst.FunctionDef) else None


def _begin_of(block: cst.IndentedBlock) -> int:
    """Behind the docstring."""
    return int(is_documentation(block.body[0]))


def _with(block: cst.IndentedBlock, at: int, *lines: str) -> cst.IndentedBlock:
    """The block with statements put before its statement `at`."""
    new = [cst.parse_statement(line) for line in lines]
    return block.with_changes(body=[*block.body[:at], *new, *block.body[at:]])


def _with_at_begin(block: cst.IndentedBlock, *lines: str) -> cst.IndentedBlock:
    return _with(block, _begin_of(block), *lines)


def _is_called_once(function: cst.FunctionDef) -> bool:
    return function.name.value in CALLED_ONCE


def _in_call(function: cst.FunctionDef, how: str, count: int, does: str) -> tuple[str, ...]:
    """Statements that count the calls, and do something in one, or from one on."""
    params = function.params.params
    is_method = bool(params) and params[0].name.value == "self"
    keeper = "self" if is_method else function.name.value
    return (
        f"{keeper}.calls = getattr({keeper}, 'calls', 0) + 1\n",
        f"if {keeper}.calls {how} {count}:\n    {does}\n",
    )


def _raise(count: int) -> str:
    return f"raise RuntimeError('in call {count}')"


def _is_in_init(node: cst.CSTNode, source: ModuleSource) -> bool:
    function = next((each for each in source.around(node) if isinstance(each, cst.FunctionDef)), 0)
    return isinstance(function, cst.FunctionDef) and function.name.value == "__init__"


def _made_in(node: cst.CSTNode) -> set[str]:
    """What a statement makes or fills: `x`, `self.x`, `x.y`; the node itself as `self()`."""
    match node:
        case cst.SimpleStatementLine(
            body=[cst.Expr(cst.Call(cst.Attribute(cst.Call(cst.Name("super")))))]
        ):
            return {NODE}
        case cst.SimpleStatementLine(body=[cst.Assign(targets=targets)]):
            return {path for each in targets for path in _paths(each.target)}
        case cst.SimpleStatementLine(body=[cst.AugAssign(target=target)]):
            return set(_paths(target))
    return set()


def _paths(node: cst.CSTNode) -> Iterator[str]:
    """Each name with all its dots."""
    match node:
        case cst.Name(value=name):
            yield name
        case cst.Attribute(value=value, attr=cst.Name(value=name)):
            yield from (f"{path}.{name}" for path in _paths(value))
        case cst.Tuple(elements=elements):
            for each in elements:
                yield from _paths(each.value)


def _names_in(node: cst.CSTNode) -> set[str]:
    """Names that stand somewhere in it, with all their dots; a node that is asked as `self()`."""
    if isinstance(node, cst.Name | cst.Attribute) and (found := set(_paths(node))):
        return found
    asked = {NODE} if isinstance(node, cst.Call) and _asks_the_node(node) else set()
    return asked | {name for child in node.children for name in _names_in(child)}


def _asks_the_node(call: cst.Call) -> bool:
    """`self.create_timer(...)`, or the node given to somebody."""
    given = any(isinstance(arg.value, cst.Name) and arg.value.value == "self" for arg in call.args)
    return given or any(path.startswith("self.") for path in _paths(call.func))


def _touch(made: str, used: str) -> bool:
    """The same, or a part of the other: `x` and `x.y`, but not `x.y` and `x.z`."""
    return made == used or made.startswith(f"{used}.") or used.startswith(f"{made}.")
