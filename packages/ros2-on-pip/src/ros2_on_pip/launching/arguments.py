"""The arguments that a launch description declares."""

from __future__ import annotations

from collections.abc import Iterator

from ros2_on_pip.launching.actions import DeclareLaunchArgument, RegisterEventHandler
from ros2_on_pip.launching.description import Entity


def arguments_of(entity: Entity) -> Iterator[DeclareLaunchArgument]:
    """The arguments that it declares, those in groups too; files that it includes are not read."""
    for inner in entity.inner():
        if isinstance(inner, DeclareLaunchArgument):
            yield inner
        elif not isinstance(inner, RegisterEventHandler):
            yield from arguments_of(inner)
