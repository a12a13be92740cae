"""The node of a rover in a room from a seed: it also tells what stands and moves around it."""

from __future__ import annotations

from dataclasses import dataclass

from roslings_rover.camera.room_camera import RoomCamera
from roslings_rover.models.rooms import IN_WORDS, moving_in
from roslings_rover.rover.driven import DrivenRover
from roslings_rover.rover.frames import MAP_FRAME, FrameOptions
from roslings_rover.rover.in_room import STANDS_S, RoomRover
from roslings_rover.rover.messages import ODOM_FRAME
from roslings_rover.rover.room_markers import MOVING, ROOM, markers_of_moving, markers_of_room
from roslings_rover.rover.rover import Rover

MOVING_EVERY_S = 0.1
TOLD_S = 4.0
"""So long a bump stands on the screen."""


@dataclass
class RoomNode(DrivenRover):
    """Its rover is a RoomRover."""

    rover: RoomRover

    @property
    def title(self) -> str:
        """The room's seed is its name."""
        return f"Room {self.rover.room.seed}"

    @property
    def about_place(self) -> str:
        """Its seed, its kind, and how much moves."""
        room = self.rover.room
        things = "thing moves" if len(room.tracks) == 1 else "things move"
        return f"Room {room.seed}: {IN_WORDS[room.kind]}; {len(room.tracks)} {things} in it."

    @property
    def counted(self) -> dict[str, int]:
        """What the screen counts besides."""
        return {"bumps": len(self.rover.bumps)}

    @property
    def says_besides(self) -> tuple[str, ...]:
        """Topics that a rover elsewhere has not."""
        return (ROOM, MOVING)

    @property
    def bumped(self) -> str:
        """What has just happened, and what to do; empty after a moment."""
        bumps = self.rover.bumps
        if not bumps or self.rover.time_s - bumps[-1].time_s > TOLD_S:
            return ""
        what = "something that moves" if bumps[-1].moving else "something"
        told = f"Bump {len(bumps)}: the rover ran into {what}."
        return f"{told} It stands for {STANDS_S:g} s; then drive it back."

    @property
    def _room_frame(self) -> str:
        """In `odom` a room stands still only as long as the odometry is the truth."""
        truth_elsewhere = self.frames.drift_percent or self.frames.map_frame
        return MAP_FRAME if truth_elsewhere else ODOM_FRAME

    def _open_topics(self) -> None:
        super()._open_topics()
        from rclpy.qos import DurabilityPolicy, QoSProfile
        from visualization_msgs.msg import MarkerArray

        node = self._node
        self._camera = RoomCamera(self.rover.camera_model)
        kept = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self._room = node.create_publisher(MarkerArray, ROOM.lstrip("/"), kept)
        self._moving = node.create_publisher(MarkerArray, MOVING.lstrip("/"), 10)
        stamp = node.get_clock().now().to_msg()
        self._room.publish(markers_of_room(self.rover.world, stamp, self._room_frame))

    def _open_timers(self) -> None:
        super()._open_timers()
        told = self._node.create_timer(MOVING_EVERY_S, self._tell_what_moves)
        self._timers.append(told)

    def _tell_what_moves(self) -> None:
        if self._moving.get_subscription_count():
            stamp = self._node.get_clock().now().to_msg()
            self._moving.publish(
                markers_of_moving(moving_in(self.rover.world), stamp, self._room_frame)
            )


def node_for(
    rover: Rover,
    frames: FrameOptions = FrameOptions(),  # noqa: B008 - it cannot change
    *,
    by_keys: bool = False,
    listens: bool = False,
) -> DrivenRover:
    """The node that a rover needs where it is."""
    if isinstance(rover, RoomRover):
        return RoomNode(rover, frames=frames, by_keys=by_keys, listens=listens)
    return DrivenRover(rover, frames=frames, by_keys=by_keys, listens=listens)
