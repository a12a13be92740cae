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

    @property
    def expected(self) -> str:
        """A managed node."""
        return f"{self.node} answers `ros2 lifecycle set {self.node} configure`"

    @property
    def measured(self) -> str:
        """That nobody answers."""
        return f"nobody answers on {self.node}/change_state"


@dataclass(eq=False)
class OtherState(Fault):
    """A transition leads to another state than the card's."""

    transition: str
    wanted: str
    found: str
    why = "Others believe that the node is where they have led it."
    hint = "Your on_ method for it must return TransitionCallbackReturn.SUCCESS."

    @property
    def expected(self) -> str:
        """The state."""
        return f"asked to {self.transition}, the node is then {self.wanted}"

    @property
    def measured(self) -> str:
        """The state that it told."""
        return f"it is {self.found}"
