"""Watch a single script as an experiment would: in an arena, by the clock that is asked for.

python watching.py SCRIPT CLOCK HZ WITHIN      prints the runs as JSON, the believed one last
"""

from __future__ import annotations

import os
import stat
import subprocess
import sys
import tempfile
from pathlib import Path

from pydantic import TypeAdapter

from roslings.arena import Installed, Wall, choose_isolation, ros_environment
from roslings.arena.environment import base_environment
from roslings.course import NodeContract, RateContract, TopicContract
from roslings.course.grader import Clock
from roslings.evidence import ExperimentSeen
from roslings.experiment import Scene, experiment
from roslings.experiment.assignment import Assignment
from roslings.experiment.measuring import MeasuringContext, run_all

HERE = Path(__file__).parent
RATE = RateContract(hz=2.0, within=0.05)
TOPIC = TopicContract(topic="/chatter", type="std_msgs/msg/String", rate=RATE)
RUNS = TypeAdapter(list[ExperimentSeen])
PROGRAM = "talker"
NODE = NodeContract(node="/talker", executable=PROGRAM, publishes=(TOPIC,))


def watched(
    script: Path, clock: Clock = "auto", hz: float = 2.0, within: float = 0.05
) -> list[ExperimentSeen]:
    """Every run of `script` that its experiment needed; the last one counts."""
    wall = choose_isolation()
    words = [sys.executable, __file__, str(script), clock, wall.wall, str(hz), str(within)]
    done = subprocess.run(wall.command(words), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return RUNS.validate_json(done.stdout.splitlines()[-1])


def main(script: Path, clock: Clock, wall: Wall, limit: RateContract) -> None:
    """In a process of its own, behind the wall."""
    topic = TopicContract(topic="/chatter", type="std_msgs/msg/String", rate=limit)
    node = NodeContract(node="/talker", executable=PROGRAM, publishes=(topic,))

    @experiment(clock="auto")
    def talking(scene: Scene) -> None:
        """The talker alone."""
        with scene.run(node):
            scene.watch(topic)

    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder)
        order = Assignment(lab="p", seed=1, wall=wall, clock=clock, folder=home)
        order.make_folders()
        os.environ.update(ros_environment(order.wall), ROS_LOG_DIR=str(home / "log"))
        stage = MeasuringContext(installed(script, home), order, 2.0)
        runs = run_all(stage, [talking])["talking"]
    print(RUNS.dump_json(runs).decode())


def installed(script: Path, home: Path) -> Installed:
    """The script as an executable, without a package around it."""
    program = home / "programs" / PROGRAM
    program.parent.mkdir()
    program.write_text(f"#!{sys.executable}\n{script.read_text('utf-8')}", "utf-8")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    return Installed(program.parent, base_environment(home / "home"), program.parent)


if __name__ == "__main__":
    hz, within = float(sys.argv[4]), float(sys.argv[5])
    main(Path(sys.argv[1]), sys.argv[2], sys.argv[3], RateContract(hz=hz, within=within))  # type: ignore[arg-type]
