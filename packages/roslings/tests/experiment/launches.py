"""Launch a file of a package `mine` as an experiment does: in an arena, behind the wall.

python launches.py FILE WALL      prints what was seen as JSON
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

from roslings.arena import Installed, Wall, choose_isolation, ros_environment
from roslings.arena.environment import base_environment
from roslings.capabilities.launch.act import launched
from roslings.capabilities.launch.contract import LaunchContract
from roslings.evidence import ExperimentSeen
from roslings.experiment import Scene, experiment
from roslings.experiment.assignment import Assignment
from roslings.experiment.measuring import MeasuringContext, run_all

NAMES = ("left", "right")
NODE = f"""\
#!{sys.executable}
from contextlib import suppress

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

rclpy.init()
node = Node("nameless")
with suppress(KeyboardInterrupt, ExternalShutdownException):
    rclpy.spin(node)
rclpy.try_shutdown()
"""


def seen_of(file: Path) -> ExperimentSeen:
    """What an experiment sees of the launch of `file`."""
    wall = choose_isolation()
    words = wall.command([sys.executable, __file__, str(file), wall.wall])
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return ExperimentSeen.model_validate_json(done.stdout.splitlines()[-1])


def main(file: Path, wall: Wall) -> None:
    """In a process of its own, behind the wall."""
    contract = LaunchContract(file=f"launch/{file.name}", starts=NAMES)

    @experiment
    def together(scene: Scene) -> None:
        """The launch file alone."""
        with launched(scene, "mine", contract):
            pass

    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder)
        order = Assignment(lab="p", seed=1, wall=wall, folder=home)
        order.make_folders()
        os.environ.update(ros_environment(order.wall), ROS_LOG_DIR=str(home / "log"))
        stage = MeasuringContext(installed(file, home), order, 2.0)
        (seen,) = run_all(stage, [together])["together"]
    print(seen.model_dump_json())


def installed(file: Path, home: Path) -> Installed:
    """A package with one executable and the launch file."""
    prefix = home / "prefix"
    marker = prefix / "share" / "ament_index" / "resource_index" / "packages" / "mine"
    program, launch = prefix / "lib" / "mine" / "it", prefix / "share" / "mine" / file.name
    for place in (marker, program, launch):
        place.parent.mkdir(parents=True, exist_ok=True)
    marker.touch()
    program.write_text(NODE, "utf-8")
    program.chmod(0o755)
    launch.write_text(file.read_text("utf-8"), "utf-8")
    environment = base_environment(home / "home") | {"AMENT_PREFIX_PATH": str(prefix)}
    return Installed(program.parent, environment, prefix)


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2])  # type: ignore[arg-type]
