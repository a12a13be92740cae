"""The parameters of a node: from dictionaries, files and single values to words of its command.

What becomes of which value is as in Jazzy's launch_ros. A text of the launch file stays a text.
What a substitution gives is read as YAML, so that `2` is a number, except where `value_type=str`
says otherwise.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any, get_args, get_origin

from ros2_on_pip.launching.substitution import (
    Parts,
    SomeSubstitutionsType,
    Substitution,
    SubstitutionFailure,
    is_substitution,
    parts_of,
    performed,
)
from ros2_on_pip.launching.text import parts_in
from ros2_on_pip.launching.typed import yaml_truth
from ros2_on_pip.launching.wrong_kind import WrongValueKind

if TYPE_CHECKING:
    from ros2_on_pip.launching.context import LaunchContext

PLAIN = (bool, int, float, str)
Words = tuple[str, str]
"""An option and its value: `-p name:=1`, or `--params-file FILE`."""


class ParameterValue:
    """A value that is read as one type."""

    def __init__(self, value: Any, *, value_type: Any = None) -> None:
        """A plain value must be of `value_type`; only a substitution is read.

        Raises TypeError, and ValueError for a type that no parameter has.
        """
        self.value, self.value_type = value, value_type
        if value_type is not None and {value_type, listed_by(value_type)}.isdisjoint(PLAIN):
            raise ValueError(f"value_type is bool, int, float, str, or a List of one: {value_type}")
        if isinstance(value, PLAIN) and value_type in PLAIN and not isinstance(value, value_type):
            raise WrongValueKind("value of ParameterValue", value_type, value)
        if not _is_value(value) and not _is_list_of_values(value):
            raise TypeError(f"{value!r} is no value of a parameter, and no list of values")

    def evaluate(self, context: LaunchContext) -> Any:
        """The value. Raises SubstitutionFailure."""
        if self.value_type in PLAIN and is_substitution(self.value):
            return self._read(performed(context, parts_of(self.value, "value")))
        found = value_of(context, self.value)
        kind = listed_by(self.value_type)
        return _list_of(kind, found) if kind else found

    def _read(self, text: str) -> Any:
        """As Python reads a number, and as YAML reads a truth. Raises SubstitutionFailure."""
        if self.value_type is bool:
            return yaml_truth(text, "a parameter of type bool")
        try:
            return self.value_type(text)
        except ValueError:
            name = self.value_type.__name__
            raise SubstitutionFailure(f"{text!r} is no value of type {name}") from None


def _is_value(value: Any) -> bool:
    return isinstance(value, PLAIN) or is_substitution(value)


def _is_list_of_values(value: Any) -> bool:
    return isinstance(value, list | tuple) and all(_is_value(one) for one in value)


def listed_by(value_type: Any) -> Any:
    """What `List[float]`, or `list[float]`, lists; None for any other type."""
    (kind,) = get_args(value_type) if get_origin(value_type) is list else (None,)
    return kind


def _list_of(kind: type[Any], value: Any) -> list[Any]:
    if isinstance(value, list) and all(isinstance(one, kind) for one in value):
        return value
    raise SubstitutionFailure(f"{value!r} is no list in which each value is {_CALLED[kind]}")


_CALLED = {
    bool: "true or false",
    int: "a whole number",
    float: "a number with a point",
    str: "a text",
}


class Parameter:
    """One parameter with its name."""

    def __init__(
        self,
        name: SomeSubstitutionsType,
        value: Any,
        *,
        value_type: Any = None,
        description: SomeSubstitutionsType = "",
    ) -> None:
        self.name = parts_of(name, "the name of a Parameter")
        self.value = ParameterValue(value, value_type=value_type)


class ParameterFile:
    """A parameter file, in which `$(...)` is filled in where that is wanted."""

    def __init__(
        self,
        param_file: SomeSubstitutionsType,
        *,
        allow_substs: bool = False,
    ) -> None:
        """Raises TypeError where `allow_substs` is no bool, but a substitution."""
        self.param_file = parts_of(param_file, "param_file of ParameterFile")
        if not isinstance(allow_substs, bool):
            raise TypeError(
                f"allow_substs of ParameterFile must be True or False, not {allow_substs!r}"
            )
        self.allow_substs = allow_substs

    def evaluate(self, context: LaunchContext) -> Path:
        """The file that the node reads. Raises SubstitutionFailure."""
        file = existing_file(performed(context, self.param_file))
        if not self.allow_substs:
            return file
        place = context.new_file(".yaml")
        place.write_text(performed(context, parts_in(file.read_text("utf-8"))), encoding="utf-8")
        return place


def existing_file(name: str) -> Path:
    """The parameter file `name`. Raises SubstitutionFailure where there is none."""
    file = Path(name).absolute()
    if not file.is_file():
        raise SubstitutionFailure(
            f"there is no parameter file {name}. A file of your package must be installed: add it"
            " to data_files in setup.py, and build again"
        )
    return file


def checked_parameters(parameters: Any) -> list[Any]:
    """The list as it stands. Raises TypeError where it is none, or holds something else."""
    if not isinstance(parameters, list):
        raise TypeError(
            "parameters must be a list of dictionaries and files: parameters=[{'rate': 2.0}],"
            f" and not {parameters!r}"
        )
    return [_checked(one) for one in parameters]


def _checked(one: Any) -> Any:
    if isinstance(one, Mapping | Parameter | ParameterFile):
        return one
    return ParameterFile(parts_of(one, "each of the parameters, which is no dictionary,"))


def parameter_words(context: LaunchContext, parameters: Iterable[Any], node: str) -> list[Words]:
    """What the command of a node says about its parameters, in order.

    `node` is the full name, or `/**` where it is not known. Raises SubstitutionFailure.
    """
    return [_words(context, one, node) for one in parameters]


def _words(context: LaunchContext, one: Any, node: str) -> Words:
    if isinstance(one, Parameter):
        return rule(context, one.name, one.value)
    if isinstance(one, ParameterFile):
        return "--params-file", str(one.evaluate(context))
    import yaml

    file = context.new_file(".yaml")
    tree = {node: {"ros__parameters": dict(flat(context, one))}}
    file.write_text(yaml.safe_dump(tree, default_flow_style=False), encoding="utf-8")
    return "--params-file", str(file)


def rule(context: LaunchContext, name: Parts, value: Any) -> Words:
    """`-p name:=value` with the value in YAML."""
    import yaml

    text = yaml.safe_dump(value_of(context, value), default_flow_style=True, width=10**6)
    return "-p", f"{performed(context, name)}:={text.removesuffix('...' + chr(10)).strip()}"


def flat(
    context: LaunchContext, tree: Mapping[Any, Any], prefix: str = ""
) -> Iterable[tuple[str, Any]]:
    """Names, joined by dots, and their values. Raises SubstitutionFailure."""
    for key, value in tree.items():
        name = prefix + performed(context, parts_of(key, "the name of a parameter"))
        if isinstance(value, Mapping):
            yield from flat(context, value, f"{name}.")
        else:
            yield name, _named_value(context, name, value)


def _named_value(context: LaunchContext, name: str, value: Any) -> Any:
    try:
        return value_of(context, value)
    except SubstitutionFailure as failure:
        raise SubstitutionFailure(f"parameter '{name}': {failure}") from None


def value_of(context: LaunchContext, value: Any) -> Any:
    """The value of a parameter. Raises SubstitutionFailure."""
    if isinstance(value, ParameterValue):
        return value.evaluate(context)
    if isinstance(value, PurePath):
        return str(value)
    if isinstance(value, PLAIN):
        return value
    if isinstance(value, Substitution):
        return _read(performed(context, [value]))
    if isinstance(value, Iterable) and not isinstance(value, Mapping | bytes):
        return _many(context, list(value))
    raise SubstitutionFailure(
        f"{value!r} is no value of a parameter: it is a bool, an int, a float, a str, or a list of"
        " one of them"
    )


def _many(context: LaunchContext, values: list[Any]) -> Any:
    """A list of values; texts and substitutions side by side are put together to one text."""
    if is_substitution(values):
        return _read(performed(context, parts_of(values, "each part of a value")))
    found = [_one_of_many(context, one) for one in values]
    if {type(one) for one in found} == {int, float}:
        return [float(one) for one in found]
    return _uniform(found)


def _one_of_many(context: LaunchContext, value: Any) -> Any:
    """A list inside a list is the parts of one text."""
    if isinstance(value, list | tuple):
        return _read(performed(context, parts_of(value, "each part of a value")))
    return value_of(context, value)


def _uniform(values: Any) -> list[Any]:
    kinds = {type(one) for one in values}
    if len(kinds) != 1 or not kinds <= set(PLAIN):
        raise SubstitutionFailure(
            f"{values!r}: a list as a parameter must not be empty, and all in it must have one"
            " type: bool, int, float or str"
        )
    return list(values)


def _read(text: str) -> Any:
    """What YAML makes of it. Raises SubstitutionFailure."""
    import yaml

    try:
        value = yaml.safe_load(text)
    except yaml.YAMLError:
        value = None
    if isinstance(value, PLAIN):
        return value
    if isinstance(value, list):
        return _uniform(value)
    if text.strip() == "":
        return ""
    raise SubstitutionFailure(
        f"'{text}' is no value of a parameter. If it is meant to be a text:"
        " ParameterValue(..., value_type=str) of launch_ros.parameter_descriptions"
    )
