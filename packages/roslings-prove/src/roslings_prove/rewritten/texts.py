"""The same texts, written in other ways; and print where the card leaves that free."""

from __future__ import annotations

import re
from collections.abc import Callable

import libcst as cst
import libcst.matchers as m

from roslings_prove.rewritten.source import SETUP, Sources
from roslings_prove.rewritten.trees import (
    all_of,
    called,
    classes,
    code_of,
    expression,
    importing,
    is_node,
    names_in,
    statements,
    swapped,
)

PLAIN = re.compile(r"^([bBrRuU]?)'([^'\"\\\n]*)'$", re.DOTALL)
LOGS = ("debug", "info", "warning", "error", "fatal")
PERCENT = re.compile(r"^\.\d+f$")
"""What stands behind the colon of an f-string and means the same behind a percent sign."""


def double_quotes(sources: Sources) -> Sources:
    """`"chatter"` for `'chatter'`, in setup.py too."""
    setup = cst.parse_module(sources.texts[SETUP]).visit(_DoubleQuotes())
    changed = {**sources.texts, SETUP: setup.code}
    return Sources(sources.card, changed).mapped(lambda tree: tree.visit(_DoubleQuotes()))


class _DoubleQuotes(cst.CSTTransformer):
    def leave_SimpleString(  # noqa: N802
        self, original_node: cst.SimpleString, updated_node: cst.SimpleString
    ) -> cst.SimpleString:
        found = PLAIN.match(original_node.value)
        return updated_node.with_changes(value=f'{found[1]}"{found[2]}"') if found else updated_node

    def visit_FormattedString(self, node: cst.FormattedString) -> bool:  # noqa: N802
        return False

    def leave_FormattedString(  # noqa: N802
        self, original_node: cst.FormattedString, updated_node: cst.FormattedString
    ) -> cst.FormattedString:
        inside = "".join(map(code_of, original_node.parts))
        if original_node.start != "f'" or re.search(r"['\"\\]", inside):
            return updated_node
        return updated_node.with_changes(start='f"', end='"')


def other_quotes_in_lines(sources: Sources) -> Sources:
    """`f'I heard: "{x}"'` for `f"I heard: '{x}'"`: what is written has other quotes, too."""
    return sources.mapped(lambda tree: tree.visit(_OtherQuotes()))


class _OtherQuotes(cst.CSTTransformer):
    def leave_FormattedString(  # noqa: N802
        self, original_node: cst.FormattedString, updated_node: cst.FormattedString
    ) -> cst.FormattedString:
        if original_node.start != 'f"' or not all(map(_takes_other_quotes, updated_node.parts)):
            return updated_node
        parts = [_with_other_quotes(part) for part in updated_node.parts]
        return updated_node.with_changes(start="f'", parts=parts, end="'")


def _takes_other_quotes(part: cst.BaseFormattedStringContent) -> bool:
    """Before Python 3.12, a value between the braces has none of the text's own quotes."""
    return isinstance(part, cst.FormattedStringText) or not re.search(r"['\"\\]", code_of(part))


def _with_other_quotes(part: cst.BaseFormattedStringContent) -> cst.BaseFormattedStringContent:
    if isinstance(part, cst.FormattedStringText):
        return part.with_changes(value=part.value.replace("'", '"'))
    return part


# --- texts with values in them -----------------------------------------------------------------


def format_for_f_strings(sources: Sources) -> Sources:
    """`'{} m'.format(x)` for `f'{x} m'`."""
    return sources.mapped(lambda tree: tree.visit(_Formatted(_by_format)))


def percent_for_f_strings(sources: Sources) -> Sources:
    """`'%s m' % (x,)` for `f'{x} m'`."""
    return sources.mapped(lambda tree: tree.visit(_Formatted(_by_percent)).visit(_Bare()))


class _Formatted(cst.CSTTransformer):
    def __init__(self, way: Callable[[cst.FormattedString], str]) -> None:
        super().__init__()
        self.way = way

    def visit_ConcatenatedString(self, node: cst.ConcatenatedString) -> bool:  # noqa: N802
        return False

    def leave_FormattedString(  # noqa: N802
        self, original_node: cst.FormattedString, updated_node: cst.FormattedString
    ) -> cst.BaseExpression:
        other = self.way(original_node)
        return expression(other) if other else updated_node


class _Bare(cst.CSTTransformer):
    """No second pair of brackets around what stands alone between two."""

    def leave_Arg(self, original_node: cst.Arg, updated_node: cst.Arg) -> cst.Arg:  # noqa: N802
        value = updated_node.value
        if m.matches(value, m.BinaryOperation(operator=m.Modulo())):
            return updated_node.with_changes(value=value.with_changes(lpar=(), rpar=()))
        return updated_node


def _values(text: cst.FormattedString) -> list[str]:
    return [
        code_of(x.expression) for x in text.parts if isinstance(x, cst.FormattedStringExpression)
    ]


def _can_be_other(text: cst.FormattedString) -> bool:
    return text.start.lower() == "f" + text.end and bool(_values(text))


def _by_format(text: cst.FormattedString) -> str:
    if not _can_be_other(text):
        return ""
    pieces = "".join(_format_piece(each) for each in text.parts)
    return f"{text.end}{pieces}{text.end}.format({', '.join(_values(text))})"


def _format_piece(part: cst.BaseFormattedStringContent) -> str:
    if isinstance(part, cst.FormattedStringExpression):
        return f"{{{_conversion(part)}{_spec(part)}}}"
    return code_of(part)


def _conversion(part: cst.FormattedStringExpression) -> str:
    return f"!{part.conversion}" if part.conversion else ""


def _spec(part: cst.FormattedStringExpression) -> str:
    return ":" + "".join(map(code_of, part.format_spec)) if part.format_spec else ""


def _by_percent(text: cst.FormattedString) -> str:
    pieces = [_percent_piece(each) for each in text.parts]
    if not _can_be_other(text) or None in pieces:
        return ""
    values = _values(text)
    listed = f"({values[0]},)" if len(values) == 1 else f"({', '.join(values)})"
    return f"({text.end}{''.join(each or '' for each in pieces)}{text.end} % {listed})"


def _percent_piece(part: cst.BaseFormattedStringContent) -> str | None:
    """The same behind a percent sign; None where there is no such thing."""
    if not isinstance(part, cst.FormattedStringExpression):
        return code_of(part).replace("%", "%%").replace("{{", "{").replace("}}", "}")
    spec = _spec(part).removeprefix(":")
    if spec and not (PERCENT.match(spec) and not part.conversion):
        return None
    return f"%{spec}" if spec else f"%{part.conversion or 's'}"


# --- print -------------------------------------------------------------------------------------


def print_for_the_logger(sources: Sources) -> Sources:
    """`print(...)` for `self.get_logger().info(...)`, where the card leaves that free."""
    asks = any(node.log for node in sources.card.nodes)
    allows = any("print()" in words for words in sources.card.not_judged)
    if asks and not allows:
        return sources

    def change(tree: cst.Module) -> cst.Module:
        logs = [call for call in all_of(tree, cst.Call) if _is_log(call)]
        return swapped(tree, {call: call.with_changes(func=cst.Name("print")) for call in logs})

    return sources.mapped(change)


WRITER = '''@cache
def writer():
    """The node that writes all lines."""
    if not rclpy.ok():
        rclpy.init()
    return rclpy.create_node('writer')
'''


def logger_for_print(sources: Sources) -> Sources:
    """The logger of a node for `print(...)`, in a program without one, where the card allows it."""
    if not any("get_logger()" in words for words in sources.card.not_judged):
        return sources

    def change(tree: cst.Module) -> cst.Module:
        prints = [call for call in all_of(tree, cst.Call) if _is_print(call)]
        has_node = any(map(is_node, classes(tree)))
        if not prints or has_node or "writer" in {name.value for name in names_in(tree)}:
            return tree
        log = expression("writer().get_logger().info")
        logging = swapped(tree, {call: call.with_changes(func=log) for call in prints})
        return importing(importing(_with_writer(logging), "functools", "cache"), "rclpy")

    return sources.mapped(change)


def _is_print(call: cst.Call) -> bool:
    """Of one text: a logger takes nothing else."""
    text = m.Arg(m.FormattedString() | m.SimpleString(), keyword=None, star="")
    return m.matches(call, m.Call(m.Name("print"), [text]))


def _with_writer(tree: cst.Module) -> cst.Module:
    at = next(n for n, each in enumerate(tree.body) if isinstance(each, cst.FunctionDef))
    (writer,) = statements(WRITER)
    blank = [cst.EmptyLine(indent=False)] * 2
    return tree.with_changes(
        body=[*tree.body[:at], writer.with_changes(leading_lines=blank), *tree.body[at:]]
    )


def _is_log(call: cst.Call) -> bool:
    logger = m.Attribute(m.Call(m.Attribute(attr=m.Name("get_logger"))))
    return called(call) in LOGS and m.matches(call.func, logger) and len(call.args) == 1
