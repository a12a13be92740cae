"""What can be wrong with a managed node, in words."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.judge.faults import Fault


@dataclass(eq=False)
class NotManaged(Fault):
    """The node has no states that others could change."""

    node: str
    why = "Who starts a robot configures all of its nodes first, and then activates them."
    hint = "Derive your class from LifecycleNode of rclpy.lifecycle, not from Node."
    expected = "{node} answers `ros2 lifecycle set {node} configure`"
    measured = "nobody answers on {node}/change_state"


@dataclass(eq=False)
class OtherState(Fault):
    """A transition leads to another state than the card's."""

    transition: str
    wanted: str
    found: str
    why = "Others believe that the node is where they have led it."
    hint = "Your on_ method for it must return TransitionCallbackReturn.SUCCESS."
    expected = "asked to {transition}, the node is then {wanted}"
    measured = "it is {found}"
