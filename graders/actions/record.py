"""What is reckoned of a goal and of the robot that was to reach it."""

from __future__ import annotations

import math

from roslings.capabilities.actions.record import GoalSeen
from roslings.capabilities.robot.record import RobotDriveSeen


def stopped_after_s(goal: GoalSeen, drive: RobotDriveSeen) -> float | None:
    """From the request to cancel to the command after which the robot was never told to move.

    None where the last command tells it to move.
    """
    begin_ns, end_ns = goal.cancel_sent_ns or 0, goal.watched_until_ns or math.inf
    stopped_ns: int | None = begin_ns
    for command in drive.commands:
        if command.arrival_ns > end_ns:
            break
        if command.forward_m_s or command.turn_rad_s:
            stopped_ns = None
        elif stopped_ns is None:
            stopped_ns = max(command.arrival_ns, begin_ns)
    return None if stopped_ns is None else (stopped_ns - begin_ns) / 1e9
