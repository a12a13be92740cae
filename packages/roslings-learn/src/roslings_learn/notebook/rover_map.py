"""The rover's map below a cell: where it is now, or which way it went."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from roslings_learn.notebook.errors import NotebookTrouble
from roslings_learn.notebook.picture import NotebookPicture, show
from roslings_rover.models.differential_drive import Body, Pose
from roslings_rover.models.world import default_world
from roslings_rover.rover.moving_map import moving_map
from roslings_rover.rover.rover import RoverMoment

if TYPE_CHECKING:
    from roslings_my_rover.notebook import LiveMyRover
    from roslings_rover.rover.notebook import LiveRover

SAYS_EVERY_S = 0.1
"""So often a command is said: a rover forgets one after 1.5 s."""
PARTS_START_WITHIN_S = 60.0
"""All of them, on a busy computer."""


class NoWay(NotebookTrouble):
    """A drive needs places."""

    def __init__(self) -> None:
        super().__init__(
            "There is no place to draw. Give odometry: show_path(ros.collect('/odom', count=20))"
        )


def show_map(rover: LiveRover | LiveMyRover) -> None:
    """Show the map of a rover; its drive until now is seen once more.

    Takes what `ros.rover()` and `ros.my_rover()` gave. Of the latter, its parts are told, too.
    """
    still = rover.map(moves=False).encode()
    show(NotebookPicture(rover.map().encode(), "image/svg+xml", _map_in_words(rover), still=still))
    if lines := _about_parts(rover):
        print("\n".join(lines))


def show_my_rover(
    day: int | None = None,
    *,
    forward_m_s: float = 0.3,
    turn_rad_s: float = 0.0,
    for_s: float = 4.0,
    borrow: Collection[int] = (),
    todays: bool = False,
    follow: bool = False,
) -> None:
    """Build the rover of your own parts, let it drive for some seconds, and show its map.

    It is told the same speeds all the time, on /cmd_vel. Raises NoPart, CannotBorrow, RoverThere.
    """
    from geometry_msgs.msg import Twist

    from roslings_learn.notebook.session import any_session
    from roslings_my_rover.notebook import start

    command = Twist()
    command.linear.x, command.angular.z = forward_m_s, turn_rad_s
    times = max(1, round(for_s / SAYS_EVERY_S))
    with (
        any_session() as ros,
        start(day, borrow=borrow, todays=todays, follow=follow) as rover,
    ):
        ros.say(
            "/cmd_vel", command, count=times, every_s=SAYS_EVERY_S, timeout_s=PARTS_START_WITHIN_S
        )
        show_map(rover)


def _map_in_words(rover: LiveRover | LiveMyRover) -> str:
    pose, parts = rover.pose, _about_parts(rover)
    degrees = math.degrees(pose.heading_rad)
    where = f"It is at x {pose.x_m:.2f} m, y {pose.y_m:.2f} m, heading {degrees:.0f} degrees."
    if count := len(getattr(rover, "bumps", [])):
        where += f" It has bumped {count} times." if count > 1 else " It has bumped once."
    if not parts:
        return f"The rover's map. {where}"
    return f"Your rover's map. {where} {' '.join(' '.join(parts).split())}"


def _about_parts(rover: LiveRover | LiveMyRover) -> list[str]:
    """Lines on the parts of a rover that is made of some."""
    lines = getattr(rover, "parts", [])
    if not lines:
        return []
    says, news = getattr(rover, "says", ""), getattr(rover, "news", "")
    parts = ", ".join(" ".join(line.split()) for line in lines)
    said = [f'It says: "{says}".'] if says else []
    return [f"Its parts: {parts}.", *said, *filter(None, [news])]


def show_path(odometry: Sequence[Any]) -> None:
    """Show the drive that a list of nav_msgs/Odometry tells, on the rover's map.

    Also takes what `collect(..., stamps=True)` gave. Raises NoWay.
    """
    show(path_picture(odometry))


def path_picture(odometry: Sequence[Any]) -> NotebookPicture:
    """The picture that `show_path` shows. Raises NoWay."""
    trail = _trail([getattr(each, "message", each) for each in odometry])
    if not trail:
        raise NoWay
    moving, still = (_drawn(trail, moves).encode() for moves in (True, False))
    return NotebookPicture(moving, "image/svg+xml", _in_words(trail), still=still)


def _trail(messages: Sequence[Any]) -> list[RoverMoment]:
    """As their stamps tell; each 0.1 s after the one before where these do not grow."""
    times_s = [each.header.stamp.sec + each.header.stamp.nanosec * 1e-9 for each in messages]
    if any(later <= earlier for earlier, later in pairwise(times_s)):
        times_s = [0.1 * number for number in range(len(messages))]
    return [
        RoverMoment(time_s, _pose(each)) for time_s, each in zip(times_s, messages, strict=True)
    ]


def _pose(odometry: Any) -> Pose:
    return pose_of(odometry.pose.pose.position, odometry.pose.pose.orientation)


def pose_of(place: Any, turned: Any) -> Pose:
    """A point and a quaternion of a message, as a pose on flat ground."""
    return Pose(place.x, place.y, 2 * math.atan2(turned.z, turned.w))


def _in_words(trail: Sequence[RoverMoment]) -> str:
    places = [(each.pose.x_m, each.pose.y_m) for each in trail]
    (x0, y0), (x1, y1) = places[0], places[-1]
    way_m = sum(math.dist(a, b) for a, b in pairwise(places))
    return (
        f"A drive on the rover's map, {way_m:.2f} m long in {len(places)} places:"
        f" from x {x0:.2f} m, y {y0:.2f} m to x {x1:.2f} m, y {y1:.2f} m."
    )


def _drawn(trail: Sequence[RoverMoment], moves: bool) -> str:
    return moving_map(default_world(), trail, Body().radius_m, dots=True, moves=moves)
