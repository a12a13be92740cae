"""Who drives: a node of the package, or a launch file with several.

Each drive starts them afresh, in a domain of its own.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

import ros2_on_pip
from roslings.arena import Host, Process
from roslings.capabilities.rooms.contract import RoomWords
from roslings.capabilities.rooms.processes import executables_below, marked
from roslings.capabilities.rooms.record import Side
from roslings.course import NodeContract
from roslings.course.contract import Plain
from roslings.experiment import Scene
from roslings.experiment.start import SIMULATED, Start

ROS2 = Path(ros2_on_pip.__file__).parent
MARK = "_roslings_drive_"
INCLUDES = """
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import SetParameter
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    file = PathJoinSubstitution([FindPackageShare({package!r}), {file!r}])
    source = AnyLaunchDescriptionSource(file)
    return LaunchDescription([
        *(SetParameter(name, value) for name, value in {parameters!r}.items()),
        IncludeLaunchDescription(source, launch_arguments={arguments!r}.items()),
    ])
"""
"""A launch file around the student's: what is set before counts for all nodes in it."""


@dataclass(frozen=True)
class DriveDomain(Host):
    """This computer, and a ROS domain for one drive: nodes that ended linger in the last one."""

    domain: int = 0

    @property
    def environment(self) -> dict[str, str]:
        """What its nodes are told."""
        return {"ROS_DOMAIN_ID": str(self.domain)}

    @contextmanager
    def entered(self) -> Iterator[None]:
        """Its network is the arena's."""
        yield

    @classmethod
    def numbered(cls, domain: int) -> DriveDomain:
        """The domain with this number."""
        return cls(name="", address="", peer="", network=-1, domain=domain)


class RoomDriver(Protocol):
    """What is started for a drive."""

    @property
    def label(self) -> str:
        """What its process is called."""

    @property
    def nodes(self) -> Sequence[str]:
        """The full names of its nodes."""

    def begun(
        self, scene: Scene, side: Side, domain: DriveDomain, mark: str, simulated: bool
    ) -> AbstractContextManager[Process]:
        """Start it, until the block ends; `simulated` makes all its nodes follow /clock."""

    def pids(self, mark: str) -> tuple[int, ...]:
        """The processes of its nodes; none where /proc hides them."""


@dataclass(frozen=True)
class NodeDriver:
    """A node of the package, with parameters.

    >>> drive_rooms(scene, NodeDriver(WANDER), own_rooms(ROOMS), ROOMS)
    """

    node: NodeContract
    parameters: Mapping[str, Plain] = field(default_factory=dict)

    @property
    def label(self) -> str:
        """Its executable."""
        return self.node.executable

    @property
    def nodes(self) -> Sequence[str]:
        """The one."""
        return (self.node.node,)

    @contextmanager
    def begun(
        self, scene: Scene, side: Side, domain: DriveDomain, mark: str, simulated: bool
    ) -> Iterator[Process]:
        """Start it in this domain. The mark is a rule for a name that nobody uses."""
        start = Start(parameters={**self.parameters, **_side(self.node, side)})
        words = start.arguments([f"{mark}:={mark}"], simulated)
        with scene.arena.run(self.node.executable, words, host=domain) as process:
            yield process

    def pids(self, mark: str) -> tuple[int, ...]:
        """Itself."""
        return marked(mark)


@dataclass(frozen=True)
class LaunchDriver:
    """A launch file of the package: use_sim_time is put on all of its nodes.

    The side is told to all nodes as their card says, and to the file where it has an argument for
    it. What a file gives a node by itself, nothing from outside can change.

    >>> LaunchDriver(CARD.package, "launch/wander.launch.py", [LOOKER, DRIVER])
    """

    package: str
    file: str
    """From the package's share folder on."""
    started: Sequence[NodeContract]
    arguments: Mapping[str, str] = field(default_factory=dict)
    side_argument: str = ""

    @property
    def label(self) -> str:
        """As somebody would type it."""
        return f"ros2 launch {self.package} {self.file.rpartition('/')[2]}"

    @property
    def nodes(self) -> Sequence[str]:
        """All that the card has."""
        return tuple(each.node for each in self.started)

    @contextmanager
    def begun(
        self, scene: Scene, side: Side, domain: DriveDomain, mark: str, simulated: bool
    ) -> Iterator[Process]:
        """Launch a file of ours, which includes the student's. Its name has the mark."""
        file = scene.arena.devices / f"{mark}.launch.py"
        sides = [_side(each, side) for each in self.started]
        parameters = {name: value for each in sides for name, value in each.items()}
        told = {self.side_argument: side} if self.side_argument else {}
        text = INCLUDES.format(
            package=self.package,
            file=self.file,
            parameters={**parameters, **(SIMULATED if simulated else {})},
            arguments={**self.arguments, **told},
        )
        file.write_text(text, "utf-8")
        file.chmod(0o644)
        words = [str(ROS2 / "start.py"), "launch", str(file)]
        with scene.arena.run(sys.executable, words, [ROS2], host=domain) as process:
            process.seen.executable = self.label
            yield process

    def pids(self, mark: str) -> tuple[int, ...]:
        """What the launch has started of the package, not the launch itself."""
        return executables_below(marked(mark), self.package)


def _side(node: NodeContract, side: Side) -> dict[str, Plain]:
    """The parameter that says the side; none for a node whose card names none."""
    rooms = node.of(RoomWords).rooms
    return {rooms.wall.side_parameter: side} if rooms and rooms.wall else {}
