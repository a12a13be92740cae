"""The picture of a rover that grows: its map in a terminal, as `./roslings my-rover` shows it.

    .venv/bin/python tests/site/my_rover_picture.py      draws it anew

Nothing is typed for it: the rover is driven without ROS, so it looks the same each time.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

from roslings.course import root
from roslings_my_rover.chosen import AbsentPart
from roslings_my_rover.parts import EYES, PARTS, day_number, labs_of_parts
from roslings_my_rover.robot import STATUS, MyRover
from roslings_rover.models.differential_drive import Motion
from roslings_rover.rover.map_display import without_gaps
from roslings_rover.rover.rover import Rover
from roslings_rover.rover.subscriptions import HeardSentence
from roslings_rover.rover.text_map import ASCII, cells
from roslings_rover.rover.words import beside

sys.path += [str(root() / "tests" / "labs"), str(root() / "tests")]
from works import Window, Works, drawn

PICTURE = root() / "site/pages/reference/pictures/my-rover.svg"
WIDE, HIGH = 46, 20
WAY = ((0.45, 0.0, 2.0), (0.3, 0.6, 2.2), (0.45, 0.0, 4.0))
"""Metres and radians a second, and for how many seconds: a curve past the ball."""
REMARKS = {"pace": "60 of 100"}
ALT = (
    "The map of a rover in a terminal. It has driven a curve. Over it stands Robot status count:"
    " 42. Beside it: voice, sonar, pace 60 of 100, pilot, cable; no eyes yet: day 7."
)


def rover() -> MyRover:
    """It has five parts, and has driven a little."""
    node = MyRover(Rover())
    for forward_m_s, turn_rad_s, seconds in WAY:
        node.rover.drive(Motion(forward_m_s, turn_rad_s))
        for _ in range(round(seconds * 50)):
            node.rover.step(0.02)
    node.about_parts = tuple(_parts())
    return node


def _parts() -> Iterator[str]:
    labs = labs_of_parts()
    for part in PARTS:
        if PARTS.index(part) >= PARTS.index(EYES):
            yield AbsentPart(part, labs[part.name]).line
        else:
            yield f"{part.name:8} {REMARKS.get(part.name, '')}".rstrip()
    assert day_number(labs["eyes"]) == 7


def screen() -> list[str]:
    """The lines of the terminal."""
    node = rover()
    said = HeardSentence("Robot status count: 42", STATUS)
    rows = cells(node.rover, WIDE, HIGH, ASCII, f'"{said.text}"')
    words = without_gaps(beside(node), len(rows))
    words += [""] * (len(rows) - len(words))
    lines = ("".join(cell.letter for cell in row) for row in rows)
    return [f"{line}  {word}".rstrip() for line, word in zip(lines, words, strict=False)]


def picture() -> str:
    """As SVG."""
    window = Window("Your rover", "./roslings my-rover", screen())
    return drawn(Works(terminals=[], alt=ALT), [window], None)


def main() -> None:
    """Draw it anew."""
    PICTURE.write_text(picture(), "utf-8")
    print(PICTURE.relative_to(Path.cwd()))


if __name__ == "__main__":
    main()
