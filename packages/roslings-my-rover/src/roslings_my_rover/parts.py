"""The parts of a student's rover: a day's package, its programs, what the rover can by it."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.course import Lab, all_labs


@dataclass(frozen=True)
class RoverPart:
    """What one lab adds to the rover."""

    name: str
    """As people call it: `no eyes yet`."""
    lab: str
    programs: tuple[str, ...]
    """Executables that run in the rover."""
    can: str
    """What the rover does by it that it did not before."""
    holds_its_place: bool = False
    """Whether nothing takes its place when it ends: a stop that is gone is no reason to drive."""
    only_in_rooms: bool = False
    """Whether it drives by itself: it runs in a room of a seed alone, with nobody at the keys."""


VOICE = RoverPart("voice", "nodes", ("minimal_publisher",), "says its status over its head")
SONAR = RoverPart(
    "sonar",
    "distance-sensor",
    ("distance_sensor", "distance_subscriber"),
    "brakes before a wall",
)
PACE = RoverPart("pace", "services", ("motor_controller",), "drives slowly when it is told to")
PILOT = RoverPart("pilot", "actions", ("drive_server",), "drives to a point by itself")
CABLE = RoverPart(
    "cable", "serial-bridge", ("serial_bridge",), "drives its wheels through the Arduino"
)
EYES = RoverPart("eyes", "pi-camera", ("camera", "ball_finder"), "sees the ball")
LIMITER = RoverPart(
    "limiter", "bring-up", ("speed_limiter", "beacon"), "keeps to a limit of its own"
)
GUARD = RoverPart(
    "guard",
    "e-stop",
    ("e_stop_button", "guard"),
    "stops when the button is pressed",
    holds_its_place=True,
)
WANDERER = RoverPart(
    "wanderer",
    "wander",
    ("wander",),
    "goes along the walls of a room that it has never seen",
    only_in_rooms=True,
)
MAPPER = RoverPart("mapper", "frames", ("frames",), "draws the room that its laser has seen")
PARTS = (VOICE, SONAR, PACE, PILOT, CABLE, EYES, LIMITER, GUARD, WANDERER, MAPPER)
"""In the order of the days. The talker and the black box are no parts: one only chats, the other
reads what the rover has left behind."""


def part_called(name: str) -> RoverPart:
    """Raises KeyError."""
    return {part.name: part for part in PARTS}[name]


def labs_of_parts() -> dict[str, Lab]:
    """Part's name to its lab, those that this course has."""
    labs = {lab.name: lab for lab in all_labs()}
    return {part.name: labs[part.lab] for part in PARTS if part.lab in labs}


def day_number(lab: Lab) -> int:
    """5, of `05-actions`."""
    return int(lab.outline.day.partition("-")[0])
