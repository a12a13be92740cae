"""Draw the rover's map after a short drive: `python site/pictures/draw_map.py FILE.svg`.

The first 15 minutes show it as `days/01-install/pictures/map.svg`.
"""

from __future__ import annotations

import sys
from pathlib import Path

from roslings_rover.models.differential_drive import Motion
from roslings_rover.rover.moving_map import moving_map
from roslings_rover.rover.rover import Rover, RoverMoment

DRIVE = ((Motion(0.5, 0.0), 2.0), (Motion(0.4, 0.6), 1.8), (Motion(0.5, 0.0), 1.2))
"""Each motion, and for how many seconds."""
STEP_S = 0.02


def main(picture: Path) -> None:
    """Drive, and write the map: the drive is over, and nothing moves."""
    rover = Rover(seed=0)
    for motion, for_s in DRIVE:
        rover.drive(motion)
        for _ in range(round(for_s / STEP_S)):
            rover.step(STEP_S)
    trail = [*rover.trail, RoverMoment(rover.time_s, rover.pose)]
    drawn = moving_map(rover.world, trail, rover.body.radius_m, moves=False)
    picture.write_text(drawn + "\n", "utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
