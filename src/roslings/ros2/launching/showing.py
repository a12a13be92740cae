"""What `--show-args` and `--print` say about a launch file."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from roslings.ros2.launching.actions import DeclareLaunchArgument, RegisterEventHandler
from roslings.ros2.launching.description import Entity
from roslings.ros2.launching.substitution import described

if TYPE_CHECKING:
    from roslings.ros2.launching.context import LaunchContext

NOTHING_SAID = "no description given"


def arguments_of(entity: Entity) -> Iterator[DeclareLaunchArgument]:
    """The arguments that it declares, those in groups too; files that it includes are not read."""
    for inner in entity.inner():
        if isinstance(inner, DeclareLaunchArgument):
            yield inner
        elif not isinstance(inner, RegisterEventHandler):
            yield from arguments_of(inner)


def all_arguments(context: LaunchContext, entity: Entity) -> list[DeclareLaunchArgument]:
    """Those of the files that it includes too, each name once; a file that cannot be found before
    the launch runs is left out."""
    from roslings.ros2.launching.sources import IncludeLaunchDescription
    from roslings.ros2.problem import Problem

    found: dict[str, DeclareLaunchArgument] = {}
    for inner in entity.inner():
        deeper = inner
        if isinstance(inner, DeclareLaunchArgument):
            found.setdefault(inner.name, inner)
        if isinstance(inner, IncludeLaunchDescription):
            try:
                deeper = inner.source.get_launch_description(context)
            except Problem:
                continue
        for argument in all_arguments(context, deeper):
            found.setdefault(argument.name, argument)
    return list(found.values())


def argument_lines(declared: list[DeclareLaunchArgument]) -> list[str]:
    """The arguments of a launch file as the real tool lists them."""
    if not declared:
        return ["No arguments."]
    lines = ["Arguments (pass arguments as '<name>:=<value>'):"]
    for arg in declared:
        choices = f" Valid choices are: {arg.choices}" if arg.choices else ""
        lines += ["", f"    '{arg.name}':", f"        {arg.description or NOTHING_SAID}{choices}"]
        if arg.default_value is not None:
            lines.append(f"        (default: {described(arg.default_value)})")
    return lines


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
