"""Other ways to read a parameter; the card says which ones act while the node runs."""

from __future__ import annotations

import re

import libcst as cst
import libcst.matchers as m

from roslings_prove.rewritten.source import Sources
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
    is_node,
    method,
    own_attribute,
    own_names,
    statements,
    swapped,
    with_body,
)

VALUES = {
    cst.Float: "double_value",
    cst.Integer: "integer_value",
    cst.SimpleString: "string_value",
}
CALL = m.Call(func=m.Attribute(attr=m.Name("declare_parameter") | m.Name("get_parameter")))
READ = m.Attribute(value=CALL, attr=m.Name("value"))
CALLBACK = '''def take_parameters(self, parameters):
    """Note the new values; called when somebody changes one."""
    for parameter in parameters:
{lines}
'''
AGREES = "    return SetParametersResult(successful=True)\n"
ON_SET, POST_SET = "add_on_set_parameters_callback", "add_post_set_parameters_callback"
NOTE = "        if parameter.name == {name}:\n            self.{kept} = parameter.value"


def _name(call: cst.Call) -> str:
    """The name of the parameter, as it stands in the program."""
    return code_of(call.args[0].value) if call.args else ""


def _reads(tree: cst.CSTNode, function: str) -> list[cst.Attribute]:
    """`self.get_parameter('x').value`."""
    found = [each for each in all_of(tree, cst.Attribute) if m.matches(each, READ)]
    return [each for each in found if called(_call(each)) == function]


def _call(read: cst.Attribute) -> cst.Call:
    return cst.ensure_type(read.value, cst.Call)


# --- the value, by its type --------------------------------------------------------------------


def values_by_type(sources: Sources) -> Sources:
    """`.get_parameter_value().double_value` for `.value`."""
    return sources.mapped(_by_type)


def _by_type(tree: cst.Module) -> cst.Module:
    kinds = {
        _name(call): VALUES[kind]
        for call in all_of(tree, cst.Call)
        if called(call) == "declare_parameter"
        and len(call.args) > 1
        and (kind := type(_constant(tree, call.args[1].value))) in VALUES
    }
    reads = [*_reads(tree, "get_parameter"), *_reads(tree, "declare_parameter")]
    return swapped(
        tree,
        {
            each: cst.Attribute(_long(_call(each)), cst.Name(kinds[_name(_call(each))]))
            for each in reads
            if _name(_call(each)) in kinds
        },
    )


def _long(call: cst.Call) -> cst.Call:
    return cst.Call(cst.Attribute(call, cst.Name("get_parameter_value")))


def _constant(tree: cst.Module, value: cst.BaseExpression) -> cst.BaseExpression:
    """What a constant of the module stands for."""
    for line in tree.body:
        for each in all_of(line, cst.Assign) if isinstance(line, cst.SimpleStatementLine) else ():
            if code_of(each.targets[0].target) == code_of(value):
                return each.value
    return value


# --- live --------------------------------------------------------------------------------------


def read_live(sources: Sources) -> Sources:
    """Where an attribute kept the value from the start, each use asks for the parameter."""
    return sources.mapped(lambda tree: swapped(tree, {x: _live(x) for x in classes(tree)}))


def _live(one: cst.ClassDef) -> cst.CSTNode:
    kept = _kept(one)
    others: dict[cst.CSTNode, cst.CSTNode] = {}
    for line in all_of(one, cst.SimpleStatementLine):
        for each in all_of(line, cst.Assign):
            if own_attribute(each.targets[0].target) in kept:
                plain = cst.Expr(cst.ensure_type(each.value, cst.Attribute).value)
                others[line] = line.with_changes(body=[plain])
    targets = [target for line in others for target in assigned(line)]
    for use in all_of(one, cst.Attribute):
        name = own_attribute(use)
        if name in kept and not any(use is target for target in targets):
            others[use] = expression(f"self.get_parameter({kept[name]}).value")
    for text in all_of(one, cst.FormattedString):
        for use in (x for x in all_of(text, cst.Attribute) if x in others):
            others[use] = _quoted_otherwise(text, cst.ensure_type(others[use], cst.Attribute))
    return swapped(one, others)


def _quoted_otherwise(text: cst.FormattedString, read: cst.Attribute) -> cst.BaseExpression:
    """Before Python 3.12 a text inside of an f-string needs the other quotes."""
    other = "'" if text.end == '"' else '"'
    return expression(re.sub(r"""['"]""", other, code_of(read)))


def _kept(one: cst.ClassDef) -> dict[str, str]:
    """Attributes that hold a parameter's first value, and nothing else, to its name."""
    given = [own_attribute(target) for target in assigned(one)]
    return {
        name: _name(_call(read))
        for each in all_of(one, cst.Assign)
        for read in _reads(each, "declare_parameter")
        if each.value is read
        and (name := own_attribute(each.targets[0].target))
        and given.count(name) == 1
    }


# --- through a callback ------------------------------------------------------------------------


def noted_by_a_callback(sources: Sources) -> Sources:
    """Where each use asked for the parameter, a callback notes what it is changed to."""
    new = sources.mapped(_with_callbacks)
    return new.depending_on("rcl_interfaces") if new != sources else sources


def _with_callbacks(tree: cst.Module) -> cst.Module:
    changed: dict[cst.CSTNode, cst.CSTNode] = {
        one: _noting(one) for one in classes(tree) if is_node(one) and _read_later(one)
    }
    if not changed:
        return tree
    return importing(swapped(tree, changed), "rcl_interfaces.msg", "SetParametersResult")


def _read_later(one: cst.ClassDef) -> dict[str, str]:
    """Parameters that other methods than `__init__` read, to the attribute for their value."""
    begin = method(one, "__init__")
    declared = (
        {_name(call) for call in all_of(begin, cst.Call) if called(call) == "declare_parameter"}
        if begin
        else set()
    )
    named = [
        _name(_call(read))
        for each in functions(one)
        if each is not begin
        for read in _reads(each, "get_parameter")
    ]
    plain = {name: f"{name[1:-1]}_now" for name in named if name in declared and name[0] in "'\""}
    return {} if own_names(one) & {*plain.values(), "take_parameters"} else plain


def _noting(one: cst.ClassDef) -> cst.ClassDef:
    kept, begin = _read_later(one), method(one, "__init__")
    assert begin is not None
    others: dict[cst.CSTNode, cst.CSTNode] = {
        read: cst.Attribute(cst.Name("self"), cst.Name(kept[_name(_call(read))]))
        for each in functions(one)
        if each is not begin
        for read in _reads(each, "get_parameter")
        if _name(_call(read)) in kept
    }
    new = swapped(
        one, others | {begin: _with_first_values(begin, kept, POST_SET if _judges(one) else ON_SET)}
    )
    lines = "\n".join(NOTE.format(name=name, kept=attribute) for name, attribute in kept.items())
    agrees = "" if _judges(one) else AGREES
    (callback,) = statements(CALLBACK.format(lines=lines) + agrees)
    callback = callback.with_changes(leading_lines=[cst.EmptyLine(indent=False)])
    return with_body(new, [*body_of(new), callback])


def _judges(one: cst.ClassDef) -> bool:
    """It has a callback of its own, which may refuse: new values are noted after it then."""
    return any(called(call) == ON_SET for call in all_of(one, cst.Call))


def _with_first_values(
    begin: cst.FunctionDef, kept: dict[str, str], register: str
) -> cst.FunctionDef:
    """Each value is noted once behind its declaration, and the callback registered behind all."""
    lines: list[Statement] = []
    for line in body_of(begin):
        lines.append(line)
        for call in all_of(line, cst.Call):
            if called(call) == "declare_parameter" and _name(call) in kept:
                value = f"self.get_parameter({_name(call)}).value"
                lines += statements(f"self.{kept[_name(call)]} = {value}\n")
    return with_body(begin, [*lines, *statements(f"self.{register}(self.take_parameters)\n")])
