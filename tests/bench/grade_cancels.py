"""The grader that `actions.py` times: one goal is driven to its end, many are cancelled."""

from __future__ import annotations

import os

from graders.actions.act import Director
from graders.actions.floor import robot_beside, start_near
from roslings.capabilities.actions.act import timed_feedback
from roslings.capabilities.actions.contract import ActionWords
from roslings.course import lab
from roslings.experiment import Scene, experiment

CARD = lab("actions").card
SERVER = CARD.node("drive_server")
DRIVE_TO = SERVER.of(ActionWords).performs[0]
MIDDLE = {"x": 3.0, "y": 2.5, "tolerance": 0.1}


@experiment
def timing(scene: Scene) -> None:
    """The server, and goals that are cancelled on the way."""
    topics = SERVER.publishes[0], SERVER.subscribes[0]
    start = start_near(scene, MIDDLE["x"], MIDDLE["y"], 3.0, 3.1)
    with scene.run(SERVER) as process, robot_beside(scene, start, *topics) as robot:
        director = Director(scene, process, SERVER, DRIVE_TO, robot)
        for number in range(int(os.environ["ROSLINGS_BENCH_CANCELS"])):
            goal = {**MIDDLE, "x": robot.pose.x_m + (1.5 if robot.pose.x_m < 3 else -1.5)}
            director.cancel(f"cancelled {number}", goal, after_m=0.1)
        with timed_feedback(scene, DRIVE_TO):
            director.drive("driven", MIDDLE)
