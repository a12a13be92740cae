"""The camera that a node needs which is left running."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack

from roslings.arena import Arena
from roslings.capabilities.parameters.contract import ParameterWords
from roslings.course import Card, NodeContract

IMAGE = "sensor_msgs/msg/Image"
PICTURES = 4


def camera_for(
    node: NodeContract, card: Card, arena: Arena, running: ExitStack
) -> Mapping[str, str]:
    """A camera before which a ball goes round, for a node with `device` that publishes images."""
    names = {parameter.name for parameter in node.of(ParameterWords).parameters}
    if "device" not in names or not any(topic.type == IMAGE for topic in node.publishes):
        return {}
    from roslings_rover.camera import SocketCamera, SyntheticCamera
    from roslings_rover.camera.live import ROUND_PICTURES, ball_at

    painter = SyntheticCamera(encoding="bgr8")
    places = range(0, ROUND_PICTURES, ROUND_PICTURES // PICTURES)
    film = [painter.frame([ball_at(place, 5, painter.camera_model)]) for place in places]
    camera = SocketCamera(arena.devices / "camera", lambda number: film[number % len(film)])
    running.enter_context(camera).plug_in()
    return {"device": str(camera.path)}
