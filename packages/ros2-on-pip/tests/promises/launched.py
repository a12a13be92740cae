"""Launches in the process of the test, by the names that a launch file imports."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from inside import surroundings_of
from launch_shop import package
from terminal import Shell

from ros2_on_pip.launching import provided
from ros2_on_pip.launching.context import Around, LaunchContext
from ros2_on_pip.launching.planned import Planned
from ros2_on_pip.launching.reading import description_in
from ros2_on_pip.launching.screen import LaunchOutput
from ros2_on_pip.launching.service import LaunchService


def of(module: str) -> Any:
    """What `import MODULE` gives a launch file."""
    return SimpleNamespace(**provided.modules()[module])


base = of("launch")
actions = of("launch.actions")
conditions = of("launch.conditions")
events = of("launch.events")
handlers = of("launch.event_handlers")
process_events = of("launch.events.process")
sources = of("launch.launch_description_sources")
subs = of("launch.substitutions")
ros = of("launch_ros.actions")
ros_subs = of("launch_ros.substitutions")
described = of("launch_ros.parameter_descriptions")


@dataclass(frozen=True)
class Launch:
    """One launch, and the folder in which its package `mine` has the executable `teller`."""

    context: LaunchContext
    screen: LaunchOutput
    folder: Path

    def again(self) -> Launch:
        """A second one, in which nothing has happened either."""
        around = Around(self.screen, self.folder, description_in)
        return Launch(LaunchContext(around=around), self.screen, self.folder)

    def filled(self, substitution: Any) -> str:
        """The text of a substitution. Raises SubstitutionFailure."""
        text: str = self.context.perform_substitution(substitution)
        return text

    def visit(self, *entities: Any) -> None:
        """Carry them out; a process is planned, and does not start. Raises BadLaunchFile."""
        self.context.visit(base.LaunchDescription(list(entities)))

    def plan(self, *entities: Any) -> Planned:
        """The last process that they start."""
        self.visit(*entities)
        return self.context.planned[-1]

    def run(self, *entities: Any) -> int:
        """Carry them out until all is over; the exit code. Raises BadLaunchFile."""
        service = LaunchService(self.context, self.screen)
        return service.run(base.LaunchDescription(list(entities)), lambda: None)

    def included(self, name: str, text: str) -> Any:
        """What includes a launch file with this text."""
        (self.folder / name).write_text(text)
        return actions.IncludeLaunchDescription(str(self.folder / name))


@pytest.fixture
def launch(tmp_path: Path) -> Iterator[Launch]:
    """One in which nothing has happened yet; its environment ends with it."""
    own = {"ROS_LOG_DIR": str(tmp_path / "log")}
    shell = package(Shell({**os.environ, **own}, tmp_path), tmp_path)
    with surroundings_of(shell), LaunchOutput() as screen:
        yield Launch(
            LaunchContext(around=Around(screen, tmp_path, description_in)), screen, tmp_path
        )


def logged(out: pytest.CaptureFixture[str]) -> list[str]:
    """What LogInfo has said since it was last asked for."""
    lines = out.readouterr().out.splitlines()
    return [line.partition("[launch.user]: ")[2] for line in lines if "[launch.user]" in line]
