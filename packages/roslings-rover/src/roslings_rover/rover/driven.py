"""The rover's node, for somebody who drives it and looks at its map."""

from __future__ import annotations

from dataclasses import dataclass

from roslings_rover.models.differential_drive import Pose
from roslings_rover.models.world import Ball
from roslings_rover.rover.node import RoverNode
from roslings_rover.rover.text_map import DrawnWalls

LOOK_FOR_DRIVERS_EVERY_S = 0.5
LEAVES_M = 0.3
"""So far from a ball that it has touched, it has left it."""


@dataclass
class DrivenRover(RoverNode):
    """Knows besides who drives it, and which ball it has come to."""

    driver: str = ""
    """Another node that may drive it now."""
    reached: Ball | None = None
    """The ball that it has touched, and not left since."""
    next_step: str = ""
    """What whoever has reached a ball does next."""
    more_keys: str = ""
    """What other keys do; at most 80 columns."""
    about_parts: tuple[str, ...] = ()
    """What there is to say of the parts that it is made of; at most 32 columns each."""

    @property
    def title(self) -> str:
        """What stands above all that is told of it; at most 32 columns."""
        return "The rover"

    @property
    def about_place(self) -> str:
        """Where it is; empty in the course's own room."""
        return ""

    @property
    def counted(self) -> dict[str, int]:
        """What is counted besides its way, by a short name."""
        return {}

    @property
    def says_besides(self) -> tuple[str, ...]:
        """Topics that it publishes only where it is now."""
        return ()

    @property
    def bumped(self) -> str:
        """What it has just run into, where that counts; at most 80 columns."""
        return ""

    @property
    def believed(self) -> Pose | None:
        """Where somebody thinks that it is; None where nobody errs.

        Its own odometry, where that drifts.
        """
        return self.odometer.pose if self.frames.drift_percent else None

    @property
    def drawn_walls(self) -> DrawnWalls | None:
        """What somebody has drawn of the room; None where nobody draws."""
        return None

    def _open_timers(self) -> None:
        super()._open_timers()
        look = self._node.create_timer(LOOK_FOR_DRIVERS_EVERY_S, self._look_for_drivers)
        self._timers.append(look)

    def _step(self) -> None:
        super()._step()
        self.look_for_balls()

    def look_for_balls(self) -> None:
        """A touch counts until it has gone away: nobody need go on to push."""
        rover = self.rover
        if ball := rover.touched_ball:
            self.reached = ball
        elif self.reached:
            gap_m = self.reached.shape.gap(rover.pose.x_m, rover.pose.y_m) - rover.body.radius_m
            self.reached = self.reached if gap_m < LEAVES_M else None

    def _look_for_drivers(self) -> None:
        """Command lines have hidden names, that begin with an underscore: they soon end."""
        there = self._node.get_publishers_info_by_topic("cmd_vel")
        names = [
            f"{each.node_namespace.rstrip('/')}/{each.node_name}"
            for each in there
            if not each.node_name.startswith("_")
        ]
        self.driver = min(names, default="")
