"""The arguments that a launch description declares."""

from __future__ import annotations

from collections.abc import Iterator

from ros2_on_pip.launching.actions import (
    DeclareLaunchArgument,
    RegisterEventHandler,
    TimerAction,
)
from ros2_on_pip.launching.description import Action, Entity

LATER = (RegisterEventHandler, TimerAction)


def required_arguments_of(entity: Entity) -> Iterator[DeclareLaunchArgument]:
    """Those that whoever carries it out must give: declared in any case, and without a default.

    Those in groups too; of two with one name the first counts, and files that it includes are not
    read. What stands behind a condition, or is done later, may never be asked for.
    """
    seen = set()
    for argument in _declared_in(entity):
        if argument.name not in seen and argument.default_value is None and _is_sure(argument):
            yield argument
        seen.add(argument.name)


def _declared_in(entity: Entity) -> Iterator[DeclareLaunchArgument]:
    for inner in entity.inner():
        if isinstance(inner, DeclareLaunchArgument):
            yield inner
        elif not isinstance(inner, LATER) and _is_sure(inner):
            yield from _declared_in(inner)


def _is_sure(entity: Entity) -> bool:
    return not isinstance(entity, Action) or entity.condition is None
