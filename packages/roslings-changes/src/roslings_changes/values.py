"""Wrong values: numbers, units, signs, comparisons, conditions, names and texts."""

from __future__ import annotations

import re
from collections.abc import Iterator

import libcst as cst

from roslings_changes.source import ModuleSource, New

UNIT = re.compile(r"\b(m|mm|cm|s|ms|seconds?|metres?|rad|degrees?|Hz|m/s|rad/s|points?)\b")
ANGLE = re.compile(r"\brad\b")
OFF_BY = (1.5, 0.5, 2, 10, 0.1)
FACTORS = (1000, 100)
DEGREES = 57.29578
TURNED = ("sin", "cos", "tan")
TURNING = ("atan", "atan2", "asin", "acos")
NAME = re.compile(r"[~/]?[A-Za-z]\w*(?:[/.]\w+)*")


# --- numbers -----------------------------------------------------------------------------------


def number(node: cst.CSTNode, source: ModuleSource) -> Iterator[New]:
    """A whole number is one off, or ten; any other is by a half, or its point is elsewhere."""
    if isinstance(node, cst.Integer) and not _is_depth(node, source):
        value = int(node.value, 0)
        yield from (
            cst.Integer(str(each)) for each in (value + 1, value - 1, value + 10) if each >= 0
        )
    if isinstance(node, cst.Float):
        seen = float(node.value)
        yield from (_float(seen * factor) for factor in OFF_BY) if seen else [_float(1.0)]


def _is_depth(node: cst.Integer, source: ModuleSource) -> bool:
    """The depth of a queue: nobody can tell whether there was room for one more."""
    arg = source.parent(node)
    call = source.parent(arg)
    match call:
        case cst.Call(func=cst.Attribute(attr=cst.Name(value="create_publisher"))):
            return call.args[-1] is arg
        case cst.Call(func=cst.Attribute(attr=cst.Name(value="create_subscription"))):
            return len(call.args) > 3 and call.args[3] is arg
    return False


def unit(node: cst.CSTNode, source: ModuleSource) -> Iterator[New]:
    """Milli for whole, centi for whole, degrees for radians, where something has a unit."""
    if isinstance(node, cst.Float | cst.Integer) and _has_unit(node, source):
        yield from _in_other_units(node, source)
    if isinstance(node, cst.Call) and (name := _called(node)) in TURNING:
        yield _degrees(node)
    elif isinstance(node, cst.Call) and name in TURNED:
        yield node.with_changes(args=[cst.Arg(_degrees(node.args[0].value))])
    if _is_quantity(node, source):
        yield from (_times(node, factor) for factor in FACTORS)


def _has_unit(node: cst.Float | cst.Integer, source: ModuleSource) -> bool:
    """A fraction of something, or a number behind which its unit is said."""
    if float(node.value) == 0:
        return False
    return isinstance(node, cst.Float) or bool(UNIT.search(source.comment(node)))


def _in_other_units(node: cst.Float | cst.Integer, source: ModuleSource) -> Iterator[New]:
    value = float(node.value)
    yield from (_float(value * factor) for factor in (*FACTORS, 1 / FACTORS[0]))
    if ANGLE.search(source.comment(node)):
        yield _float(value * DEGREES)


def _is_quantity(node: cst.CSTNode, source: ModuleSource) -> bool:
    """Something computed by multiplying or dividing, and no part of a larger such thing."""
    return _is_product(node) and not _is_product(source.parent(node))


def _is_product(node: cst.CSTNode) -> bool:
    match node:
        case cst.BinaryOperation(left=cst.SimpleString()):
            return False
        case cst.BinaryOperation(operator=cst.Multiply() | cst.Divide()):
            return True
    return False


def _times(node: cst.CSTNode, factor: int) -> New:
    assert isinstance(node, cst.BaseExpression)
    return cst.BinaryOperation(node, cst.Multiply(), cst.Integer(str(factor)))


def _called(node: cst.Call) -> str:
    """`atan2` of `math.atan2(...)`; empty for anything but a function of a module."""
    match node.func:
        case cst.Attribute(value=cst.Name(), attr=cst.Name(value=name)):
            return name
    return ""


def _degrees(value: cst.BaseExpression) -> cst.Call:
    return cst.Call(cst.Attribute(cst.Name("math"), cst.Name("degrees")), [cst.Arg(value)])


def _float(value: float) -> cst.Float:
    text = f"{value:.10g}"
    return cst.Float(text if re.search(r"[.e]", text) else f"{text}.0")


def sign(node: cst.CSTNode, source: ModuleSource) -> Iterator[New]:
    """Plus for minus, and the other way round."""
    match node:
        case cst.UnaryOperation(operator=cst.Minus()):
            yield node.expression
        case cst.Float() | cst.Integer() if float(node.value) and not _is_signed(node, source):
            yield cst.UnaryOperation(cst.Minus(), node)
        case cst.Add():
            yield cst.Subtract()
        case cst.Subtract():
            yield cst.Add()
        case cst.AddAssign():
            yield cst.SubtractAssign()
        case cst.SubtractAssign():
            yield cst.AddAssign()


def _is_signed(node: cst.CSTNode, source: ModuleSource) -> bool:
    """It has a sign, or is added by `+=`, whose own sign is changed."""
    return isinstance(source.parent(node), cst.UnaryOperation | cst.AugAssign)


def arithmetic(node: cst.CSTNode, source: ModuleSource) -> Iterator[New]:
    """Times for divided by, and the other way round."""
    match node:
        case cst.Multiply():
            yield cst.Divide()
        case cst.Divide():
            yield cst.Multiply()


# --- comparisons and conditions ----------------------------------------------------------------

OTHERS: dict[type[cst.BaseCompOp], tuple[type[cst.BaseCompOp], ...]] = {
    cst.LessThan: (cst.LessThanEqual, cst.GreaterThan),
    cst.LessThanEqual: (cst.LessThan, cst.GreaterThanEqual),
    cst.GreaterThan: (cst.GreaterThanEqual, cst.LessThan),
    cst.GreaterThanEqual: (cst.GreaterThan, cst.LessThanEqual),
    cst.Equal: (cst.NotEqual,),
    cst.NotEqual: (cst.Equal,),
    cst.Is: (cst.IsNot,),
    cst.IsNot: (cst.Is,),
    cst.In: (cst.NotIn,),
    cst.NotIn: (cst.In,),
}


def comparison(node: cst.CSTNode, source: ModuleSource) -> Iterator[New]:
    """The edge counted or not counted, and the other way round."""
    if isinstance(node, cst.BaseCompOp):
        yield from (other() for other in OTHERS.get(type(node), ()))


def condition(node: cst.CSTNode, source: ModuleSource) -> Iterator[New]:
    """`and` for `or`, a `not` lost, one too many, and yes for no."""
    match node:
        case cst.And():
            yield cst.Or()
        case cst.Or():
            yield cst.And()
        case cst.UnaryOperation(operator=cst.Not()):
            yield node.expression
        case cst.Name(value="True" | "False"):
            yield cst.Name(str(node.value != "True"))
        case cst.If(test=test) | cst.While(test=test) | cst.IfExp(test=test):
            if not isinstance(test, cst.Comparison | cst.UnaryOperation):
                yield node.with_changes(test=_not(test))


def _not(test: cst.BaseExpression) -> cst.UnaryOperation:
    if isinstance(test, cst.BooleanOperation):
        test = test.with_changes(lpar=[cst.LeftParen()], rpar=[cst.RightParen()])
    return cst.UnaryOperation(cst.Not(), test)


# --- names and texts ---------------------------------------------------------------------------


def name(node: cst.CSTNode, source: ModuleSource) -> Iterator[New]:
    """A text that is a name: a letter lost, added or in another case, two swapped."""
    if isinstance(node, cst.SimpleString) and NAME.fullmatch(node.raw_value):
        text = node.raw_value
        yield from (_said(node, each) for each in _misspelt(text))
        if not _is_encoding(node, source):
            yield _said(node, _in_other_case(text))


def _is_encoding(node: cst.SimpleString, source: ModuleSource) -> bool:
    """Python takes its name in small and large letters alike."""
    arg = source.parent(node)
    call = source.parent(arg) if isinstance(arg, cst.Arg) else None
    match call:
        case cst.Call(func=cst.Attribute(attr=cst.Name(value="encode" | "decode"))):
            return True
    return False


def _misspelt(text: str) -> Iterator[str]:
    middle = len(text) // 2
    yield text[:-1]
    yield f"{text}s"
    yield f"{text}_"
    yield text[: middle - 1] + text[middle] + text[middle - 1] + text[middle + 1 :]


def text(node: cst.CSTNode, source: ModuleSource) -> Iterator[New]:
    """Another text: a part lost, a blank added, another case, the `f` forgotten.

    A text that no card names is the author's own; `choice` leaves it out.
    """
    if isinstance(node, cst.SimpleString) and not NAME.fullmatch(node.raw_value):
        yield from (_said(node, each) for each in _garbled(node.raw_value))
    if isinstance(node, cst.FormattedStringText):
        yield from (cst.FormattedStringText(each) for each in _garbled(node.value))
    if isinstance(node, cst.FormattedString):
        plain = cst.Module([]).code_for_node(node).lstrip("fF")
        yield cst.SimpleString(plain)


def _garbled(text: str) -> Iterator[str]:
    yield ""
    yield text.partition(" ")[2]
    middle = len(text) // 2
    yield text[:middle] + text[middle + 1 :]
    yield text.replace(" ", "  ", 1)
    yield _in_other_case(text)


def _in_other_case(text: str) -> str:
    """The first letter."""
    found = re.search(r"[A-Za-z]", text)
    at = found.start() if found else 0
    return text[:at] + text[at : at + 1].swapcase() + text[at + 1 :]


def _said(node: cst.SimpleString, text: str) -> cst.SimpleString:
    return node.with_changes(value=f"{node.prefix}{node.quote}{text}{node.quote}")
