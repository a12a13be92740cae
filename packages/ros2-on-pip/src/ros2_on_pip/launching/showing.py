"""What `--show-args` and `--print` say about a launch file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ros2_on_pip.launching.actions import DeclareLaunchArgument
from ros2_on_pip.launching.description import Entity
from ros2_on_pip.launching.sources import IncludeLaunchDescription
from ros2_on_pip.launching.substitution import described
from ros2_on_pip.problem import CommandProblem

if TYPE_CHECKING:
    from ros2_on_pip.launching.context import LaunchContext

NOTHING_SAID = "no description given"


@dataclass(frozen=True)
class ShownArgument:
    """An argument, and whether it counts only where a condition holds."""

    argument: DeclareLaunchArgument
    conditional: bool


def all_arguments(
    context: LaunchContext, entity: Entity, conditional: bool = False
) -> dict[str, ShownArgument]:
    """By name, those of the files that it includes too.

    A file that cannot be found before the launch runs is left out.
    """
    found: dict[str, ShownArgument] = {}
    for inner in entity.inner():
        here = conditional or getattr(inner, "condition", None) is not None
        if isinstance(inner, DeclareLaunchArgument):
            found.setdefault(inner.name, ShownArgument(inner, here))
        for name, shown in all_arguments(context, _opened(context, inner), here).items():
            found.setdefault(name, shown)
    return found


def _opened(context: LaunchContext, entity: Entity) -> Entity:
    """What an included file asks for; anything else as it is."""
    if not isinstance(entity, IncludeLaunchDescription):
        return entity
    try:
        return entity.source.get_launch_description(context)
    except CommandProblem:
        return entity


def argument_lines(shown: Iterable[ShownArgument]) -> list[str]:
    """The arguments of a launch file as the real tool lists them."""
    arguments = list(shown)
    lines = ["Arguments (pass arguments as '<name>:=<value>'):"]
    for each in arguments:
        arg, star = each.argument, "*" if each.conditional else ""
        lines += ["", f"    '{arg.name}':{star}", f"        {_description(arg)}"]
        if arg.default_value is not None:
            lines.append(f"        (default: {described(arg.default_value)})")
    if any(each.conditional for each in arguments):
        lines += ["", "* argument(s) which are only used if specific conditions occur"]
    return lines if arguments else [*lines, "", "  No arguments."]


def _description(arg: DeclareLaunchArgument) -> str:
    """What is said about it, and its choices."""
    if not arg.choices:
        return arg.description or NOTHING_SAID
    if not arg.description:
        return f"One of: {arg.choices}"
    return f"{arg.description.removesuffix('.')}. Valid choices are: {arg.choices}"


def tree_lines(entity: Entity) -> list[str]:
    """What a launch file asks for, as a tree."""
    return [entity.describe(), *_branches(entity)]


def _branches(entity: Entity) -> Iterator[str]:
    inner = entity.inner()
    for index, one in enumerate(inner):
        last = index == len(inner) - 1
        first, *rest = tree_lines(one)
        yield f"{'└' if last else '├'}── {first}"
        yield from (f"{' ' if last else '│'}   {line}" for line in rest)
