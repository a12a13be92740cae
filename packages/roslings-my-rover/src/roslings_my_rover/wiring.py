"""Which topic leads from which part to which: an absent part is passed by.

A command goes in at /cmd_vel, then through limiter, relay and guard to the motors; each link has
one publisher. The parts' own names come from their labs' cards. What is another one here is given
by a remapping, so no part knows that it is in a rover.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field

from roslings_my_rover.parts import CABLE, EYES, GUARD, LIMITER, PACE, SONAR, Part

ENTRANCE = "/cmd_vel"
LIMITED = "/rover/limited"
CHECKED = "/cmd_vel_raw"
"""What the guard of day 10 hears: its card names it, and asks for a deadline there."""
MOTORS = "/rover/motors"
LINKS = (LIMITED, CHECKED, MOTORS)
"""Inside of the rover: each has one publisher, and nobody else's command belongs there."""
BEFORE_THE_RELAY = (PACE, SONAR, GUARD)
"""Parts that nothing would follow, or that nothing would speak to, without the relay."""


@dataclass(frozen=True)
class Link:
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
class Robot:
    """What the rover itself does, and what a part does in its place."""

    hears: str = ENTRANCE
    """Where its motors get their commands; empty where the cable turns the wheels."""
    says_odom: bool = True
    shows_pictures: bool = True
    says_echo: bool = False
    believes: bool = False
    """It hears /odom, and shows where the part thinks that it is."""


@dataclass(frozen=True)
class Wiring:
    """All links of a rover of some parts."""

    robot: Robot
    programs: dict[str, Link] = field(default_factory=dict)
    """Of the parts' programs."""
    relay: Link | None = None


def wired(parts: Collection[Part], port: str = "", device: str = "") -> Wiring:
    """The wiring of these parts; `port` and `device` are where board and camera are."""
    programs = {name: Link() for part in parts for name in part.programs}
    link = ENTRANCE
    if LIMITER in parts:
        programs["speed_limiter"] = Link((("cmd_vel_in", link), ("cmd_vel", LIMITED)))
        link = LIMITED
    relay = None
    if any(part in parts for part in BEFORE_THE_RELAY):
        checked = CHECKED if GUARD in parts else MOTORS
        relay, link = Link((("commands", link), ("checked", checked))), checked
    if GUARD in parts:
        programs["guard"] = Link((("cmd_vel", MOTORS),))
        link = MOTORS
    if CABLE in parts:
        programs["serial_bridge"] = Link((("cmd_vel", link),), (("port", port),))
    if EYES in parts:
        programs["camera"] = Link(parameters=(("device", device),))
    robot = Robot(
        hears="" if CABLE in parts else link,
        says_odom=CABLE not in parts,
        shows_pictures=EYES not in parts,
        says_echo=SONAR in parts,
        believes=CABLE in parts,
    )
    return Wiring(robot, programs, relay)
