"""The parameters of other nodes: read, set, described, from and to YAML."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from ros2_on_pip.calling import ask
from ros2_on_pip.discovery import DirectNode

WORDS = {
    1: ("boolean", "Boolean value is:", "bool_value"),
    2: ("integer", "Integer value is:", "integer_value"),
    3: ("double", "Double value is:", "double_value"),
    4: ("string", "String value is:", "string_value"),
    5: ("byte array", "Byte values are:", "byte_array_value"),
    6: ("boolean array", "Boolean values are:", "bool_array_value"),
    7: ("integer array", "Integer values are:", "integer_array_value"),
    8: ("double array", "Double values are:", "double_array_value"),
    9: ("string array", "String values are:", "string_array_value"),
}
"""rcl_interfaces/msg/ParameterType to: its name, the words before a value, the value's field."""

NOT_SET = "not set"
SERVICE = "list_parameters"
BOOL, INTEGER, DOUBLE, STRING, BOOLS, INTEGERS, DOUBLES, STRINGS = 1, 2, 3, 4, 6, 7, 8, 9


def names_of(direct_node: DirectNode, node: str, prefixes: Iterable[str] = ()) -> list[str]:
    """The names of a node's parameters, in order. Raises ServiceSilent."""
    from rcl_interfaces.srv import ListParameters

    request = ListParameters.Request(prefixes=list(prefixes))
    answer = ask(direct_node, ListParameters, f"{node}/list_parameters", request)
    return sorted(answer.result.names)


def values_of(direct_node: DirectNode, node: str, names: list[str]) -> list[Any]:
    """The values of parameters, as rcl_interfaces/msg/ParameterValue. Raises ServiceSilent."""
    from rcl_interfaces.srv import GetParameters

    request = GetParameters.Request(names=names)
    return list(ask(direct_node, GetParameters, f"{node}/get_parameters", request).values)


def descriptors_of(direct_node: DirectNode, node: str, names: list[str]) -> list[Any]:
    """What a node says about its parameters. Raises ServiceSilent."""
    from rcl_interfaces.srv import DescribeParameters

    request = DescribeParameters.Request(names=names)
    answer = ask(direct_node, DescribeParameters, f"{node}/describe_parameters", request)
    return list(answer.descriptors)


def set_on(direct_node: DirectNode, node: str, values: Mapping[str, Any]) -> list[Any]:
    """Set parameters, one by one; the results, in order. Raises ServiceSilent."""
    from rcl_interfaces.msg import Parameter
    from rcl_interfaces.srv import SetParameters

    parameters = [Parameter(name=name, value=message_of(v)) for name, v in values.items()]
    request = SetParameters.Request(parameters=parameters)
    return list(ask(direct_node, SetParameters, f"{node}/set_parameters", request).results)


def delete_on(direct_node: DirectNode, node: str, name: str) -> Any:
    """Set one parameter to "not set", which takes its declaration away. Raises ServiceSilent."""
    from rcl_interfaces.msg import Parameter
    from rcl_interfaces.srv import SetParameters

    request = SetParameters.Request(parameters=[Parameter(name=name)])
    (result,) = ask(
        direct_node, SetParameters, f"{node}/set_parameters", request, again=False
    ).results
    return result


def plain(value: Any) -> Any:
    """A ParameterValue as Python has it; None where it is not set."""
    if value.type not in WORDS:
        return None
    found = getattr(value, WORDS[value.type][2])
    return found if isinstance(found, bool | int | float | str) else list(found)


def message_of(value: Any) -> Any:
    """A ParameterValue for what YAML said."""
    from rcl_interfaces.msg import ParameterValue

    kind = kind_of(value)
    message = ParameterValue(type=kind)
    if kind == DOUBLES:
        value = [float(one) for one in value]
    setattr(message, WORDS[kind][2], str(value) if kind == STRING else value)
    return message


def kind_of(value: Any) -> int:
    """The parameter type that a value of YAML becomes; what has none of its own is a text."""
    if isinstance(value, list) and value:
        return _kind_of_list(value)
    kinds = ((bool, BOOL), (int, INTEGER), (float, DOUBLE))
    return next((kind for cls, kind in kinds if isinstance(value, cls)), STRING)


def _kind_of_list(values: list[Any]) -> int:
    kinds = {kind_of(one) for one in values}
    many = {BOOL: BOOLS, INTEGER: INTEGERS, DOUBLE: DOUBLES, STRING: STRINGS}
    if kinds == {INTEGER, DOUBLE}:
        return DOUBLES
    return many.get(kinds.pop(), STRING) if len(kinds) == 1 else STRING


def word_of(kind: int) -> str:
    """What a type is called."""
    return WORDS[kind][0] if kind in WORDS else NOT_SET


def nested(values: Mapping[str, Any]) -> dict[str, Any]:
    """`{"a.b": 1}` as `{"a": {"b": 1}}`, the way a parameter file has it."""
    tree: dict[str, Any] = {}
    for name, value in values.items():
        *branches, leaf = name.split(".")
        place = tree
        for branch in branches:
            place = place.setdefault(branch, {})
        place[leaf] = value
    return tree


def flat(tree: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """`{"a": {"b": 1}}` as `{"a.b": 1}`."""
    values: dict[str, Any] = {}
    for name, value in tree.items():
        full = f"{prefix}{name}"
        values |= flat(value, f"{full}.") if isinstance(value, Mapping) else {full: value}
    return values
