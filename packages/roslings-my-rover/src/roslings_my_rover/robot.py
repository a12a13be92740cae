"""The rover that carries a student's parts: what a part does, the robot itself no longer does."""

from __future__ import annotations

import math
import time
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from ros2_on_pip.interfaces import UnknownInterface, class_of
from roslings_my_rover.drawn_room import DrawnRoom, NotDrawable, drawn_room
from roslings_my_rover.mirror import Mirror
from roslings_my_rover.silence import Silence, Silent
from roslings_my_rover.wiring import (
    DRAWN_MAP,
    ENTRANCE,
    LINKS,
    ODOMETRY,
    OWNED,
    STATUS,
    RoverWiring,
    Steady,
)
from roslings_rover.models.differential_drive import Pose
from roslings_rover.rover.driven import DrivenRover
from roslings_rover.rover.frames import FrameOptions, camera_publisher
from roslings_rover.rover.in_room import RoomRover
from roslings_rover.rover.messages import ODOM_FRAME
from roslings_rover.rover.room_node import RoomNode
from roslings_rover.rover.rover import Rover
from roslings_rover.rover.subscriptions import LONGEST_SENTENCE, SENTENCE_LASTS_S, HeardSentence
from roslings_rover.rover.text_map import DrawnWalls

SPEED_OF_SOUND_M_S = 343.0
ECHO_EVERY_S = 0.1
MIRRORS_LOOK_EVERY_S = 0.2
SAYS_FRAMES = "frames"
"""The node of day 12, by its card."""
__all__ = ["STATUS", "MyRover"]


@dataclass
class MyRover(DrivenRover):
    """A driven rover whose links follow a wiring, which may change while it runs."""

    wiring: RoverWiring = field(default_factory=RoverWiring)
    told: str = ""
    """What has just happened to a part; a command does not wipe it away."""
    drawn: DrawnRoom | None = None
    """The room by the newest /map of its part, also when that is gone."""
    no_map: str = ""
    """Why the newest /map cannot be drawn."""
    _had_mapper: bool = False
    _camera_frame: Any = field(default=None, init=False, repr=False)
    """Says where the camera sits, while a part says the other frames."""
    _clash: str = ""
    _believed: Pose | None = None
    _status: HeardSentence | None = None
    _status_s: float = -math.inf
    _links: list[Any] = field(default_factory=list, repr=False)
    _mirrors: list[Mirror] = field(default_factory=list, repr=False)
    _silence: Silence = field(default_factory=lambda: Silence(time.monotonic), repr=False)

    @property
    def sentence(self) -> HeardSentence | None:
        """Its status, as long as somebody says it; of all sentences this one alone."""
        return self._status if time.monotonic() - self._status_s < SENTENCE_LASTS_S else None

    @property
    def believed(self) -> Pose | None:
        """Where the student's bridge thinks that the rover is; None where no bridge says it."""
        return self._believed if self.wiring.believes else None

    @property
    def drawn_walls(self) -> DrawnWalls | None:
        """Those that the part has drawn where the rover is: in another frame they lie elsewhere."""
        return self.drawn.walls_m if self.drawn and self.drawn.frame == ODOM_FRAME else None

    @property
    def lacks_tf(self) -> bool:
        """A part that says it is there: then it is not missed."""
        return self.wiring.says_frames and super().lacks_tf

    @property
    def about_frames(self) -> str:
        """Who says the frames when their part has ended; at most 80 columns."""
        if self.publishes_tf:
            return "Now the rover itself says /tf and /tf_static."
        return "" if self.lacks_tf else "Nobody says /tf now: you typed --no-tf."

    def silent(self, plugged: bool) -> tuple[Silent, ...]:
        """Whose messages are missing now."""
        return self._silence.look(plugged)

    def connect(self, wiring: RoverWiring) -> None:
        """Follow another wiring from now on; programs may have been started anew for it."""
        self._silence.expect(wiring.steady)
        if wiring != self.wiring or not self._links:
            self.wiring = wiring
            self._close_links()
            self._open_links()

    def _open_topics(self) -> None:
        super()._open_topics()
        from std_msgs.msg import String

        node = self._node
        self._node.destroy_subscription(self._subscription)
        self._node.destroy_publisher(self._odom)
        self._node.destroy_publisher(self._pictures)
        self._status_subscription = node.create_subscription(String, STATUS, self._take_status, 10)
        self._open_links()

    def _open_links(self) -> None:
        from geometry_msgs.msg import Twist
        from nav_msgs.msg import Odometry
        from rclpy.qos import qos_profile_sensor_data
        from sensor_msgs.msg import Image
        from std_msgs.msg import Float64

        node, wiring = self._node, self.wiring
        self._open_frames()
        if wiring.hears:
            self._links.append(node.create_subscription(Twist, wiring.hears, self._hear, 10))
        if wiring.believes:
            self._links.append(node.create_subscription(Odometry, "odom", self._take_odom, 10))
        if wiring.hears_map:
            self._had_mapper = True
            grid = class_of("nav_msgs/msg/OccupancyGrid", "msg")
            map_heard = node.create_subscription(
                grid, DRAWN_MAP, self._take_map, qos_profile_sensor_data
            )
            self._links.append(map_heard)
        for each in wiring.steady:
            if each.topic != ODOMETRY:  # that is heard to the last number
                with suppress(UnknownInterface):  # without its type its program has ended, too
                    self._links.append(self._listening(each))
        self._silence.expect(wiring.steady)
        self._mirrors = [Mirror(node, shown, link) for shown, link in wiring.links if shown != link]
        self._odom = node.create_publisher(Odometry, "odom", 10) if wiring.says_odom else None
        self._pictures = (
            node.create_publisher(Image, "camera/image_raw", qos_profile_sensor_data)
            if wiring.shows_pictures
            else None
        )
        self._echo = node.create_publisher(Float64, "sonar_echo", 10) if wiring.says_echo else None

    def _listening(self, steady: Steady) -> Any:
        """A subscription that only notes that something came; what asks for least gets all."""
        from rclpy.qos import qos_profile_sensor_data

        return self._node.create_subscription(
            class_of(steady.kind, "msg"),
            steady.link or steady.topic,
            lambda _: self._silence.hear(steady.topic),
            qos_profile_sensor_data,
            raw=True,
        )

    def _open_frames(self) -> None:
        """A part that says them is their only publisher, but for the camera: it knows of none."""
        if self.wiring.says_frames:
            self._close_camera_frame()
            super()._open_frames()
        else:
            self._close_frames()
            self._open_camera_frame()

    def _open_camera_frame(self) -> None:
        if self.frames.published and self._camera_frame is None:
            self._camera_frame = camera_publisher(self._node)

    def _close_camera_frame(self) -> None:
        if self._camera_frame is not None:
            self._node.destroy_publisher(self._camera_frame)
            self._camera_frame = None

    def _close_links(self) -> None:
        for each in self._links:
            self._node.destroy_subscription(each)
        self._links.clear()
        for mirror in self._mirrors:
            mirror.close()
        for publisher in (self._odom, self._pictures, self._echo):
            if publisher is not None:
                self._node.destroy_publisher(publisher)

    def _open_timers(self) -> None:
        super()._open_timers()
        self._timers += [
            self._node.create_timer(ECHO_EVERY_S, self._say_echo),
            self._node.create_timer(MIRRORS_LOOK_EVERY_S, self._look_at_mirrors),
        ]

    def _look_at_mirrors(self) -> None:
        for mirror in self._mirrors:
            mirror.look()

    def _step(self) -> None:
        """Where the board turns the wheels, it also lets the time go on."""
        if self.wiring.hears:
            super()._step()
        else:
            self._stepped_s = time.monotonic()
            self.look_for_balls()

    def _tell_where(self) -> None:
        if self._odom is not None:
            super()._tell_where()

    def _tell_frames(self, stamp: Any) -> None:
        """odom to base_link is what /odom says, whoever says that."""
        if self._frames is not None:
            self._frames.say(self.rover.pose, self.believed or self.rover.pose, stamp)

    def _show_picture(self) -> None:
        if self._pictures is not None:
            super()._show_picture()

    def _hear(self, twist: Any) -> None:
        super()._hear(twist)
        self.notice = self.notice or self.told or self._clash

    def _look_for_twins(self) -> None:
        """A command that comes from two is no command of either."""
        super()._look_for_twins()
        if self._clash and self.notice == self._clash:
            self.notice = ""
        owned = (*self.wiring.links, *zip(OWNED, OWNED, strict=True))
        found = (*map(self._held_off, LINKS), *map(self._clash_on, owned), self._second_frames())
        self._clash = next(filter(None, found), "")
        self.notice = self.notice or self._clash

    def _held_off(self, link: str) -> str:
        """Who says something under the name that people know: nobody in the rover hears it."""
        if any(link == name for _, name in self.wiring.links):
            return ""
        own, there = self._node.get_name(), self._node.get_publishers_info_by_topic(link)
        names = _listed(each.node_name for each in there if each.node_name != own)
        return names and f"Held off: {names} on {link}. Let it speak on {ENTRANCE}."

    def _clash_on(self, link: tuple[str, str]) -> str:
        shown, topic = link
        names = {each.node_name for each in self._node.get_publishers_info_by_topic(topic)}
        if len(names) < 2:
            return ""
        return f"{_listed(names)} both say {shown}. End what does not belong there."

    def _second_frames(self) -> str:
        """Who says the same frames once more: each step of the tree has one voice."""
        count = self._node.get_node_names().count(SAYS_FRAMES)
        if self.wiring.hears_map and count > 1:
            return f"Two nodes /{SAYS_FRAMES} say /tf: one is in your rover. End the other one."
        if self.publishes_tf and count and not self._had_mapper:
            return f"/{SAYS_FRAMES} and the rover both say /tf. Start the rover with --no-tf."
        return ""

    def _say_echo(self) -> None:
        """The seconds until the echo came back; NaN where none was understood."""
        if self._echo is None:
            return
        from std_msgs.msg import Float64

        range_m = self.rover.range().range_m
        seconds = 2 * range_m / SPEED_OF_SOUND_M_S if math.isfinite(range_m) else math.nan
        self._echo.publish(Float64(data=seconds))

    def _take_status(self, said: Any) -> None:
        line = "".join(letter for letter in " ".join(said.data.split()) if letter.isprintable())
        self._status = HeardSentence(line[:LONGEST_SENTENCE], STATUS)
        self._status_s = time.monotonic()

    def _take_map(self, grid: Any) -> None:
        try:
            self.drawn, self.no_map = drawn_room(grid), ""
        except NotDrawable as error:
            self.drawn, self.no_map = None, str(error)

    def _take_odom(self, told: Any) -> None:
        """A part may say anything: what is no number is no place."""
        place, turn = told.pose.pose.position, told.pose.pose.orientation
        heading = 2 * math.atan2(turn.z, turn.w)
        if all(map(math.isfinite, (place.x, place.y, heading))):
            self._believed = Pose(place.x, place.y, heading)
            self._tell_frames(told.header.stamp)
        self._silence.hear(ODOMETRY)


@dataclass
class MyRoomRover(MyRover, RoomNode):
    """The same in a room of a seed: it also tells what stands and moves there, and counts bumps."""

    rover: RoomRover


def node_for(
    rover: Rover,
    wiring: RoverWiring,
    *,
    tf: bool = True,
    by_keys: bool = False,
    more_keys: str = "",
) -> MyRover:
    """The node of a rover of parts, where it is."""
    frames = FrameOptions(tf)
    if isinstance(rover, RoomRover):
        return MyRoomRover(
            rover, frames=frames, by_keys=by_keys, wiring=wiring, more_keys=more_keys
        )
    return MyRover(rover, frames=frames, by_keys=by_keys, wiring=wiring, more_keys=more_keys)


def _listed(names: Iterable[str]) -> str:
    """`/guard and /tester`, each once."""
    return " and ".join(sorted({f"/{name}" for name in names}))
