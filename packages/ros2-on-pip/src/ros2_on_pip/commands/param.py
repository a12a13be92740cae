"""`ros2 param`: the parameters of running nodes."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ros2_on_pip.commands.node import NodeNotFound
from ros2_on_pip.names import absolute
from ros2_on_pip.problem import CommandProblem, did_you_mean
from ros2_on_pip.shared_options import in_node, node_options
from ros2_on_pip.words import FAILED, OK, Verbs, add, seconds

if TYPE_CHECKING:
    from ros2_on_pip.discovery import DirectNode


class BadPattern(CommandProblem):
    """`--filter` is no regular expression."""

    def __init__(self, text: str, fault: Exception) -> None:
        super().__init__(
            f"--filter '{text}' is no regular expression: {fault}. A plain name is one too."
        )


class NoSuchParameter(CommandProblem):
    """The node has not declared the parameter."""

    def __init__(self, name: str, there: list[str]) -> None:
        super().__init__(
            f"Parameter not set: the node has no '{name}'.{did_you_mean(name, there)}\n"
            f"It has: {', '.join(there) or 'none'}"
        )


def declare(command: argparse.ArgumentParser) -> None:
    """The verbs."""
    verbs = Verbs(command)
    listing = verbs("list", "Output a list of available parameters", list_parameters)
    in_node(listing, nargs="?")
    listing.add_argument(
        "--param-prefixes", nargs="+", default=[], help="Only list parameters with these prefixes"
    )
    listing.add_argument(
        "--param-type", action="store_true", help="Print parameter types with parameter names"
    )
    listing.add_argument(
        "--filter",
        metavar="REGEX",
        help="Only list parameters whose names begin with what the regular expression matches",
    )
    get = verbs("get", "Get parameter", show_value)
    in_node(get)
    _parameter_name(get)
    get.add_argument("--hide-type", action="store_true", help="Hide the type information")
    setting = verbs("set", "Set parameter", set_value)
    in_node(setting)
    _parameter_name(setting)
    setting.add_argument("value", help="Value of the parameter")
    describe = verbs("describe", "Show descriptive information about declared parameters", tell)
    in_node(describe)
    add(
        describe,
        "parameter_names",
        nargs="+",
        complete=complete_parameters,
        help="Names of the parameters",
    )
    dump = verbs("dump", "Show all of the parameters of a node in a YAML file format", show_all)
    in_node(dump)
    load = verbs("load", "Load parameter file for a node", load_file)
    in_node(load)
    load.add_argument("parameter_file", type=Path, help="Parameter file")
    load.add_argument(
        "--no-use-wildcard",
        action="store_true",
        help="Do not load what stands below a pattern such as /**, which is for many nodes",
    )
    delete = verbs("delete", "Delete parameter", delete_parameter)
    in_node(delete)
    _parameter_name(delete)
    for verb in (get, setting, describe, dump, load, delete):
        verb.add_argument(
            "--timeout",
            type=seconds,
            metavar="N",
            default=0.0,
            help="Wait for N seconds until node becomes available",
        )
    for verb in (listing, get, setting, describe, dump, load, delete):
        node_options(verb)


def _parameter_name(parser: argparse.ArgumentParser) -> None:
    add(parser, "parameter_name", complete=complete_parameters, help="Name of the parameter")


def complete_parameters(parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """The parameters of the node just typed, for the Tab key."""
    from ros2_on_pip.parameters import names_of

    with _seen(parsed_args) as (direct_node, node):
        return names_of(direct_node, node)


@contextmanager
def _seen(options: argparse.Namespace) -> Iterator[tuple[DirectNode, str]]:
    """Our eye and the full name of the node in `options`. Raises NodeNotFound."""
    from ros2_on_pip.discovery import DirectNode

    node = absolute(options.node_name)
    with DirectNode.asked_by(options, speaks=True) as direct_node:

        def running() -> list[str]:
            return direct_node.nodes(hidden=options.include_hidden_nodes)

        direct_node.settle()
        if not direct_node.until(lambda: node in running(), getattr(options, "timeout", 0.0)):
            raise NodeNotFound(options.node_name, running(), "Node not found:")
        yield direct_node, node


def list_parameters(options: argparse.Namespace) -> int:
    """`ros2 param list [NODE]`."""
    if options.filter is not None:
        checked_pattern(options.filter)
    if options.node_name:
        with _seen(options) as (direct_node, node):
            print("".join(_name_lines(direct_node, node, options)), end="")
        return OK
    from ros2_on_pip.discovery import DirectNode
    from ros2_on_pip.parameters import SERVICE

    with DirectNode.asked_by(options, speaks=True) as direct_node:
        services = direct_node.settle().services()
        nodes = sorted(set(direct_node.nodes(hidden=options.include_hidden_nodes)))
        for node in nodes:
            if f"{node}/{SERVICE}" in services:
                _print_block(direct_node, node, options)
    return OK


def checked_pattern(text: str) -> None:
    """Raises BadPattern."""
    try:
        re.compile(text)
    except re.error as fault:
        raise BadPattern(text, fault) from None


def _print_block(direct_node: DirectNode, node: str, options: argparse.Namespace) -> None:
    """One node of many: that it does not answer is said, and the next one comes."""
    try:
        lines = _name_lines(direct_node, node, options)
    except CommandProblem as problem:
        print(problem, file=sys.stderr)
        return
    if lines:
        print("".join([f"{node}:\n", *lines]), end="")


def _name_lines(direct_node: DirectNode, node: str, options: argparse.Namespace) -> list[str]:
    from ros2_on_pip.parameters import descriptors_of, names_of, word_of

    pattern = options.filter or ""
    names = [n for n in names_of(direct_node, node, options.param_prefixes) if re.match(pattern, n)]
    types = (
        {d.name: f" (type: {word_of(d.type)})" for d in descriptors_of(direct_node, node, names)}
        if options.param_type
        else {}
    )
    return [f"  {name}{types.get(name, '')}\n" for name in names]


def show_value(options: argparse.Namespace) -> int:
    """`ros2 param get NODE NAME`."""
    from ros2_on_pip.parameters import WORDS, names_of, plain, values_of

    with _seen(options) as (direct_node, node):
        found = values_of(direct_node, node, [options.parameter_name])
        if found and found[0].type in WORDS:
            label = "" if options.hide_type else f"{WORDS[found[0].type][1]} "
            print(f"{label}{plain(found[0])}")
        elif options.parameter_name in names_of(direct_node, node):
            print("Parameter not set", file=sys.stderr)
            return FAILED
        else:
            raise _unknown(direct_node, node, options.parameter_name)
    return OK


def _unknown(direct_node: DirectNode, node: str, name: str) -> NoSuchParameter:
    from ros2_on_pip.parameters import names_of

    return NoSuchParameter(name, names_of(direct_node, node))


def set_value(options: argparse.Namespace) -> int:
    """`ros2 param set NODE NAME VALUE`."""
    from ros2_on_pip.parameters import set_on

    value = _typed(options.value)
    with _seen(options) as (direct_node, node):
        (result,) = set_on(direct_node, node, {options.parameter_name: value})
        if not result.successful:
            _explain(direct_node, node, options.parameter_name, result.reason)
            return FAILED
    print("Set parameter successful" + (f": {result.reason}" if result.reason else ""))
    return OK


def _typed(text: str) -> Any:
    """What YAML makes of a value; what is no YAML is a text."""
    import yaml

    try:
        value = yaml.safe_load(text)
    except yaml.YAMLError:
        return text
    return value if isinstance(value, bool | int | float | list) else text


def _explain(direct_node: DirectNode, node: str, name: str, reason: str) -> None:
    """The node's own words, and a near miss where the name is wrong."""
    from ros2_on_pip.parameters import names_of

    names = names_of(direct_node, node)
    if name not in names:  # rclpy's own words leave the name out here
        reason = f"the node has not declared '{name}'.{did_you_mean(name, names)}"
    print(f"Setting parameter failed: {reason}", file=sys.stderr)


def tell(options: argparse.Namespace) -> int:
    """`ros2 param describe NODE NAME...`."""
    from ros2_on_pip.parameters import descriptors_of

    with _seen(options) as (direct_node, node):
        for descriptor in descriptors_of(direct_node, node, options.parameter_names):
            if not descriptor.type:
                raise _unknown(direct_node, node, descriptor.name)
            print("\n".join(description_lines(descriptor)))
    return OK


def description_lines(descriptor: Any) -> list[str]:
    """A descriptor as the real tool shows it."""
    from ros2_on_pip.parameters import word_of

    lines = [f"Parameter name: {descriptor.name}", f"  Type: {word_of(descriptor.type)}"]
    if descriptor.description:
        lines.append(f"  Description: {descriptor.description}")
    lines.append("  Constraints:")
    if descriptor.read_only:
        lines.append("    Read only: true")
    for span in [*descriptor.floating_point_range, *descriptor.integer_range][:1]:
        lines += [f"    Min value: {span.from_value}", f"    Max value: {span.to_value}"]
        lines += [f"    Step: {span.step}"] if span.step else []
    if descriptor.additional_constraints:
        lines.append(f"    Additional constraints: {descriptor.additional_constraints}")
    return lines


def show_all(options: argparse.Namespace) -> int:
    """`ros2 param dump NODE`."""
    import yaml

    from ros2_on_pip.parameter_file import INSIDE
    from ros2_on_pip.parameters import names_of, nested, plain, values_of

    with _seen(options) as (direct_node, node):
        names = names_of(direct_node, node)
        values = map(plain, values_of(direct_node, node, names)) if names else []
        tree = nested(dict(zip(names, values, strict=False)))
    print(yaml.safe_dump({node: {INSIDE: tree}}, default_flow_style=False))
    return OK


def load_file(options: argparse.Namespace) -> int:
    """`ros2 param load NODE FILE`."""
    from ros2_on_pip.parameter_file import values_for
    from ros2_on_pip.parameters import set_on

    node = absolute(options.node_name)
    values = values_for(options.parameter_file, node, wildcards=not options.no_use_wildcard)
    with _seen(options) as (direct_node, node):
        results = set_on(direct_node, node, values)
    for name, result in zip(values, results, strict=True):
        reason = f": {result.reason}" if result.reason else ""
        done = "Set" if result.successful else "Setting"
        outcome = "successful" if result.successful else "failed"
        where = sys.stdout if result.successful else sys.stderr
        print(f"{done} parameter {name} {outcome}{reason}", file=where)
    return OK if all(result.successful for result in results) else FAILED


def delete_parameter(options: argparse.Namespace) -> int:
    """`ros2 param delete NODE NAME`."""
    from ros2_on_pip.parameters import delete_on, names_of

    with _seen(options) as (direct_node, node):
        if options.parameter_name not in names_of(direct_node, node):
            raise _unknown(direct_node, node, options.parameter_name)
        result = delete_on(direct_node, node, options.parameter_name)
    reason = f": {result.reason}" if result.reason else ""
    done = "Deleted parameter successfully" if result.successful else "Deleting parameter failed"
    print(f"{done}{reason}", file=sys.stdout if result.successful else sys.stderr)
    return OK if result.successful else FAILED
