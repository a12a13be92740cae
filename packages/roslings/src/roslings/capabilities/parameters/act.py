"""Experiments on how a node is started: what its parameters are, and several of it at once."""

from __future__ import annotations

from ros2_on_pip.near_names import nearest
from roslings.capabilities.parameters.calling import declared_by, parameters_of
from roslings.capabilities.parameters.record import ParametersSeen
from roslings.course import NodeContract
from roslings.experiment.on_the_wall import FIRST_MESSAGE_WITHIN_S
from roslings.experiment.scene import Scene
from roslings.seen.matching import own_endpoints


def list_parameters(scene: Scene, node: NodeContract) -> None:
    """Ask the node, or the one nearest to it, which parameters it has, and what they are."""
    near = nearest(node.node, scene.seen.graph.nodes)
    if near:
        lives = scene.arena.all_alive
        names = parameters_of(scene.probe, near.found, FIRST_MESSAGE_WITHIN_S, lives)
        scene.seen.recording(ParametersSeen).names[near.found] = names
        scene.seen.recording(ParametersSeen).declared += declared_by(
            scene.probe, near.found, names, FIRST_MESSAGE_WITHIN_S, lives
        )


def await_publishers(scene: Scene) -> None:
    """Wait until each node in the graph publishes something of its own."""

    def there() -> bool:
        ends = own_endpoints(scene.seen.graph)
        return {e.node for e in ends if e.kind == "publisher"} >= set(scene.seen.graph.nodes)

    scene.appears(there, "a publisher of each node")
