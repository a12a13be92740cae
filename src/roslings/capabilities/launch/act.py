"""Experiments with a launch file: start it with our own `ros2 launch`, as the student would."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from roslings.arena import Process
from roslings.capabilities.launch.contract import LaunchContract
from roslings.capabilities.launch.record import LABEL
from roslings.experiment.scene import COMES_UP_WITHIN_S, Scene

ENGINE = Path(__file__).parents[2]
ROS2 = ENGINE / "ros2" / "start.py"
NEXT_NODE_S = 4.0
"""A launch starts its nodes at once; so much later than the one before, none comes any more."""

CREW_ENDS_WITHIN_S = 8.0
"""The launch waits 5 s for its nodes before it becomes stern with them."""


@contextmanager
def launched(scene: Scene, package: str, contract: LaunchContract) -> Iterator[Process]:
    """Launch the file, wait for its nodes; press Ctrl-C when the block ends."""
    words = [str(ROS2), "ros2", "launch", package, contract.name]
    with scene.arena.run(sys.executable, words, [ENGINE]) as process:
        process.seen.executable = f"{LABEL} {package} {contract.name}"
        scene.seen.processes[LABEL] = process.seen
        count = len(contract.starts)
        scene.until(lambda: bool(scene.seen.graph.nodes), COMES_UP_WITHIN_S)
        scene.appears(lambda: len(scene.seen.graph.nodes) >= count, f"{count} nodes", NEXT_NODE_S)
        yield process
        process.interrupt(CREW_ENDS_WITHIN_S)
