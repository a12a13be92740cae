"""Experiments with managed nodes: ask for one transition after the other."""

from __future__ import annotations

from typing import Any

from graders.valve.contract import LifecycleWords
from graders.valve.record import LifecycleSeen, StepSeen

from ros2_on_pip.near_names import nearest
from roslings.capabilities.services.calling import Caller
from roslings.course import NodeContract
from roslings.experiment import Scene
from roslings.probe.content import message_class

ANSWERS_WITHIN_S = 5.0
CHANGE, GET = "lifecycle_msgs/srv/ChangeState", "lifecycle_msgs/srv/GetState"


def walk(scene: Scene, node: NodeContract) -> None:
    """Ask the node, or the nearest to it, for each transition of the card, in its order."""
    near = nearest(node.node, scene.seen.graph.nodes)
    for step in node.of(LifecycleWords).lifecycle if near else ():
        assert near is not None
        seen = StepSeen(node=near.found, transition=step.transition)
        scene.seen.recording(LifecycleSeen).steps.append(seen)
        answer = _ask(scene, f"{near.found}/change_state", CHANGE, _wish(step.transition))
        if answer is None:
            return  # who does not answer once will not answer the next time
        seen.accepted = bool(answer["success"])
        answer = _ask(scene, f"{near.found}/get_state", GET, message_class(GET).Request())
        seen.state = answer and answer["current_state"]["label"]


def _wish(transition: str) -> Any:
    request = message_class(CHANGE).Request()
    request.transition.label = transition
    return request


def _ask(scene: Scene, service: str, type_: str, message: Any) -> Any:
    """What a service answers; None where nobody does in time."""
    with Caller(scene.probe, service, type_) as caller:
        if not scene.until(lambda: caller.ready, ANSWERS_WITHIN_S):
            return None
        call = caller.send_message(message, {})
        scene.until_own(lambda: call.answered, ANSWERS_WITHIN_S)
        return call.seen.response if call.answered else None
