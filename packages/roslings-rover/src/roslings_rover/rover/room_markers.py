"""A room as ROS shows things: visualization_msgs/msg/MarkerArray, which rviz2 draws, too.

`/room` has what stands there and is kept for whoever comes later; `/room/moving` has what moves.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from roslings_rover.models.rooms import MovingWorld
from roslings_rover.models.world import Box, Circle, World
from roslings_rover.rover.messages import ODOM_FRAME

ROOM, MOVING = "/room", "/room/moving"
MARKERS = "visualization_msgs/msg/MarkerArray"
FLOOR, THINGS = "floor", "things"
"""Of `ns` in a marker: the floor as far as the walls, and all that is on it."""
HIGH_M, FLOOR_HIGH_M = 0.5, 0.01
FLOOR_RGB, THING_RGB, MOVING_RGB = (0.9, 0.95, 0.94), (0.45, 0.5, 0.57), (0.76, 0.34, 0.1)
MOST_MARKERS = 1_000
LARGEST_M = 1_000.0


def markers_of_room(world: World, stamp: Any, frame: str = ODOM_FRAME) -> Any:
    """Its floor, and what stands on it; `frame` is one in which the room stands still."""
    from std_msgs.msg import Header
    from visualization_msgs.msg import MarkerArray

    header = Header(stamp=stamp, frame_id=frame)
    floor = _marker(0, world.room, header, FLOOR, FLOOR_RGB)
    floor.scale.z, floor.pose.position.z = FLOOR_HIGH_M, -FLOOR_HIGH_M / 2
    things = (
        _marker(number, shape, header, THINGS, THING_RGB)
        for number, shape in enumerate(world.obstacles)
    )
    return MarkerArray(markers=[floor, *things])


def markers_of_moving(moving: Sequence[Circle], stamp: Any, frame: str = ODOM_FRAME) -> Any:
    """What moves, where it is now."""
    from std_msgs.msg import Header
    from visualization_msgs.msg import MarkerArray

    header = Header(stamp=stamp, frame_id=frame)
    found = (_marker(n, each, header, THINGS, MOVING_RGB) for n, each in enumerate(moving))
    return MarkerArray(markers=list(found))


def _marker(
    number: int, shape: Circle | Box, header: Any, space: str, rgb: tuple[float, float, float]
) -> Any:
    from visualization_msgs.msg import Marker

    marker = Marker(header=header, ns=space, id=number, action=Marker.ADD)
    marker.type = Marker.CUBE if isinstance(shape, Box) else Marker.CYLINDER
    place, size = marker.pose.position, marker.scale
    if isinstance(shape, Box):
        place.x, place.y = (shape.west_m + shape.east_m) / 2, (shape.south_m + shape.north_m) / 2
        size.x, size.y = shape.east_m - shape.west_m, shape.north_m - shape.south_m
    else:
        place.x, place.y = shape.x_m, shape.y_m
        size.x = size.y = 2 * shape.radius_m
    marker.pose.orientation.w = 1.0
    place.z, size.z = HIGH_M / 2, HIGH_M
    marker.color.r, marker.color.g, marker.color.b = rgb
    marker.color.a = 1.0
    return marker


def world_in(room: Any, moving: Any = None) -> MovingWorld | None:
    """The world that messages of `/room` and `/room/moving` tell; None where it is none.

    Anybody may publish there, so nothing is believed before it was looked at.
    """
    floors = [s for s in _shapes(room, FLOOR) if isinstance(s, Box)]
    if len(floors) != 1:
        return None
    circles = tuple(s for s in _shapes(moving, THINGS) if isinstance(s, Circle)) if moving else ()
    return MovingWorld(floors[0], tuple(_shapes(room, THINGS)), moving=circles)


def _shapes(message: Any, space: str) -> Iterator[Circle | Box]:
    markers = (marker for marker in message.markers[:MOST_MARKERS] if marker.ns == space)
    return (shape for marker in markers if (shape := _shape(marker)))


def _shape(marker: Any) -> Circle | Box | None:
    x_m, y_m = marker.pose.position.x, marker.pose.position.y
    wide_m, high_m = marker.scale.x, marker.scale.y
    numbers = (x_m, y_m, wide_m, high_m)
    if not all(math.isfinite(number) and abs(number) < LARGEST_M for number in numbers):
        return None
    if min(wide_m, high_m) <= 0:
        return None
    if marker.type == marker.CUBE:
        return Box(x_m - wide_m / 2, y_m - high_m / 2, x_m + wide_m / 2, y_m + high_m / 2)
    return Circle(x_m, y_m, wide_m / 2) if marker.type == marker.CYLINDER else None
