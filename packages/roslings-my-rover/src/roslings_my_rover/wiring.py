"""Which topic leads from which part to which: an absent part is passed by.

A command goes in at /cmd_vel, then through limiter, relay and guard to the motors; each link has
one publisher. The parts' own names come from their labs' cards. What is another one here is given
by a remapping, so no part knows that it is in a rover.

While a rover runs, its links have a mark behind their names that nobody knows beforehand. So
whoever speaks on /rover/motors, by mistake or on purpose, speaks to nobody.
"""

from __future__ import annotations

import secrets
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field

from roslings_my_rover.parts import (
    CABLE,
    EYES,
    GUARD,
    LIMITER,
    MAPPER,
    PACE,
    SONAR,
    VOICE,
    RoverPart,
)
from roslings_rover.rover.frames import LASER_ON_BODY, TF

ENTRANCE = "/cmd_vel"
LIMITED = "/rover/limited"
CHECKED = "/cmd_vel_raw"
"""What the guard of day 10 hears: its card names it, and asks for a deadline there."""
MOTORS = "/rover/motors"
LINKS = (LIMITED, CHECKED, MOTORS)
"""Inside of the rover: each has one publisher, and nobody else's command belongs there."""
STATUS, DISTANCE, OBSTACLE = "/robot_status", "/distance_sensor/distance", "/obstacle"
MOTOR_STATE, ODOMETRY, BEACON, DRAWN_MAP = "/motor_state", "/odom", "/beacon", "/map"
OWNED = (OBSTACLE, MOTOR_STATE, ODOMETRY, "/e_stop")
"""Others act by these, so two who speak there are told; one from a terminal may try it alone."""
BEFORE_THE_RELAY = (PACE, SONAR, GUARD)
"""Parts that nothing would follow, or that nothing would speak to, without the relay."""


@dataclass(frozen=True)
class StartArguments:
    """How one program is started: its remappings, name to name, and its parameters."""

    remaps: tuple[tuple[str, str], ...] = ()
    parameters: tuple[tuple[str, str], ...] = ()

    @property
    def arguments(self) -> list[str]:
        """As ROS's command line takes them."""
        if not (self.remaps or self.parameters):
            return []
        words = ["--ros-args"]
        for source, target in self.remaps:
            words += ["-r", f"{source}:={target}"]
        for name, value in self.parameters:
            words += ["-p", f"{name}:={value}"]
        return words


@dataclass(frozen=True)
class Steady:
    """What a program says again and again as long as it works, by its lab's card."""

    program: str
    topic: str
    kind: str
    """The type, `std_msgs/msg/String`."""
    link: str = ""
    """The topic's name in this rover, where it is one of the links."""
    by_cable: bool = False
    """Only while the cable is plugged in."""


@dataclass(frozen=True)
class RoverWiring:
    """What the rover itself does, and what a part does in its place."""

    hears: str = ENTRANCE
    """Where its motors get their commands; empty where the cable turns the wheels."""
    says_odom: bool = True
    shows_pictures: bool = True
    says_echo: bool = False
    says_frames: bool = True
    """On /tf and /tf_static, where their type is there."""
    hears_map: bool = False
    """It shows on its own map what the part has drawn on /map."""
    believes: bool = False
    """It hears /odom, and shows where the part thinks that it is."""
    links: tuple[tuple[str, str], ...] = ()
    """Each link in use: the name that people know, and the one that it has in this rover."""
    steady: tuple[Steady, ...] = ()
    """What it must hear again and again: a program that is silent hangs."""


@dataclass(frozen=True)
class Wiring:
    """All links of a rover of some parts."""

    robot: RoverWiring
    programs: dict[str, StartArguments] = field(default_factory=dict)
    """Of the parts' programs."""
    relay: StartArguments | None = None


def new_mark() -> str:
    """What stands behind the names of one rover's links; nobody can guess it."""
    return f"_{secrets.token_hex(3)}"


def wired(parts: Collection[RoverPart], port: str = "", device: str = "", mark: str = "") -> Wiring:
    """The wiring of these parts; `port` and `device` are where board and camera are.

    Without a mark the links have the names that people know.
    """
    programs = {name: StartArguments() for part in parts for name in part.programs}
    link, used = ENTRANCE, list[str]()
    if LIMITER in parts:
        programs["speed_limiter"] = StartArguments(
            (("cmd_vel_in", link), ("cmd_vel", LIMITED + mark))
        )
        link = LIMITED + mark
        used.append(LIMITED)
    relay = None
    if any(part in parts for part in BEFORE_THE_RELAY):
        checked = CHECKED if GUARD in parts else MOTORS
        relay = StartArguments((("commands", link), ("checked", checked + mark)))
        link = checked + mark
        used.append(checked)
    if GUARD in parts:
        raw = ((CHECKED.strip("/"), CHECKED + mark),) if mark else ()
        programs["guard"] = StartArguments((*raw, ("cmd_vel", MOTORS + mark)))
        link = MOTORS + mark
        used.append(MOTORS)
    if CABLE in parts:
        programs["serial_bridge"] = StartArguments((("cmd_vel", link),), (("port", port),))
    if EYES in parts:
        programs["camera"] = StartArguments(parameters=(("device", device),))
    if MAPPER in parts:
        programs["frames"] = StartArguments(parameters=tuple(_of_the_laser()))
    robot = RoverWiring(
        hears="" if CABLE in parts else link,
        says_odom=CABLE not in parts,
        shows_pictures=EYES not in parts,
        says_echo=SONAR in parts,
        says_frames=MAPPER not in parts,
        hears_map=MAPPER in parts,
        believes=CABLE in parts,
        links=tuple((each, each + mark) for each in used),
        steady=tuple(_steady(parts, mark)),
    )
    return Wiring(robot, programs, relay)


def _of_the_laser() -> Iterator[tuple[str, str]]:
    """Where it sits, as the card of day 12 calls it; each with a point, which makes it a double."""
    place = LASER_ON_BODY
    yield "laser_x", str(place.x_m)
    yield "laser_y", str(place.y_m)
    yield "laser_yaw", str(place.heading_rad)


def _steady(parts: Collection[RoverPart], mark: str) -> Iterator[Steady]:
    """Of the small messages: pictures are looked at by who needs them."""
    if VOICE in parts:
        yield Steady("minimal_publisher", STATUS, "std_msgs/msg/String")
    if SONAR in parts:
        yield Steady("distance_sensor", DISTANCE, "sensor_msgs/msg/Range")
        yield Steady("distance_subscriber", OBSTACLE, "std_msgs/msg/Bool")
    if PACE in parts:
        yield Steady("motor_controller", MOTOR_STATE, "std_msgs/msg/Float64")
    if CABLE in parts:
        yield Steady("serial_bridge", ODOMETRY, "nav_msgs/msg/Odometry", by_cable=True)
    if LIMITER in parts:
        yield Steady("beacon", BEACON, "std_msgs/msg/String")
    if GUARD in parts:
        yield Steady("guard", MOTORS, "geometry_msgs/msg/Twist", link=MOTORS + mark)
    if MAPPER in parts:
        # It says a step for each odometry, which a pulled cable holds up.
        yield Steady("frames", TF, "tf2_msgs/msg/TFMessage", by_cable=CABLE in parts)
