"""What each part adds, seen on the robot: with the part, with a wrong one, and without it."""

from __future__ import annotations

import math
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from carried import Carried, carried, goal, put, surroundings

from roslings.course import lab
from roslings_my_rover.parts import (
    CABLE,
    EYES,
    GUARD,
    LIMITER,
    MAPPER,
    PACE,
    PARTS,
    PILOT,
    SONAR,
    VOICE,
    WANDERER,
    RoverPart,
)
from roslings_rover.models.world import default_world

pytestmark = pytest.mark.slow
CHANCE_S = 25.0
"""What must not come is waited for so long: in that time the whole part has come to it twice."""
IN_VAIN_S = 6.0


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One for all: what was built for one test is not built again."""
    return tmp_path_factory.mktemp("ws")


def says_its_status(rover: Carried) -> bool:
    """Over its head, on the map."""
    said = re.compile(r'^"Robot status count: \d+" \(/robot_status\)$', re.M)
    return rover.sees(lambda: said.search(rover.heard))


def brakes_before_the_wall(rover: Carried) -> bool:
    """The bin ahead of it begins at 5.1 m, and it is 0.1 m to its rim: it stands well before."""
    stands = rover.drive(0.5, until_it=lambda: rover.pose[0] > 4 and not rover.pose[3])
    return stands and rover.pose[0] < 4.9


def drives_slowly(rover: Carried) -> bool:
    """After /set_max_speed: 0.3 m/s, of 0.5 that it is told."""
    from nav_msgs.msg import Odometry
    from std_srvs.srv import SetBool

    rover.call(SetBool, "/set_max_speed", data=True)
    odom = rover.hear(Odometry, "/odom")
    rover.drive(0.5, until_it=lambda: len(odom) > 100)
    return max(each.twist.twist.linear.x for each in odom[60:]) < 0.35


def drives_to_a_point(rover: Carried) -> bool:
    """By an action, with nobody at the keys."""
    with goal(rover, 1.5, 0.5) as there:
        rover.sees(lambda: there.ended)
    x_m, y_m, _, _ = rover.pose
    return abs(x_m - 1.5) < 0.25 and abs(y_m - 0.5) < 0.25


def goes_through_its_cable(rover: Carried) -> bool:
    """It drives; while the cable is pulled it stands; then it goes on."""
    if not rover.drive(0.3, until_it=lambda: rover.pose[3]):
        return False
    rover.press("p")
    rover.wait_for("The cable is pulled")
    stood = rover.drive(0.3, until_it=lambda: not rover.pose[3])
    rover.press("p")
    rover.wait_for("The cable is plugged in")
    return stood and rover.drive(0.3, until_it=lambda: rover.pose[3])


def follows_the_ball(rover: Carried) -> bool:
    """Until it touches it."""
    done = "The rover touches the red ball"
    return rover.sees(lambda: done in rover.heard)


def keeps_to_its_limit(rover: Carried) -> bool:
    """0.5 m/s by the limiter's own parameter; the motors alone could do 0.59."""
    from nav_msgs.msg import Odometry

    odom = rover.hear(Odometry, "/odom")
    rover.drive(2.0, until_it=lambda: len(driving(odom)) > 50)
    return 0.4 < max(driving(odom)[25:], default=0.0) < 0.53


def driving(odom: list[Any]) -> list[float]:
    """Its speeds, without those before it began."""
    speeds = (each.twist.twist.linear.x for each in odom)
    return [speed for speed in speeds if speed > 0.05]


def stops_at_the_button(rover: Carried) -> bool:
    """It begins stopped; Space lets it go, and Space stops it again."""
    from std_srvs.srv import SetBool

    if rover.drive(0.3, until_it=lambda: rover.pose[3], within_s=IN_VAIN_S):
        return False
    rover.wait_for_service(SetBool, "/press")
    rover.press(" ")
    rover.wait_for("stop is released")
    if not rover.drive(0.3, until_it=lambda: rover.pose[3]):
        return False
    rover.press(" ")
    rover.wait_for("stop is pressed")
    return rover.drive(0.3, until_it=lambda: not rover.pose[3])


def wanders(rover: Carried) -> bool:
    """By itself, and in a room where two ways of three lead into something: it touches nothing."""
    far_m = 2.5
    went = rover.sees(lambda: "Bump" in rover.heard or math.hypot(*rover.pose[:2]) > far_m)
    return went and "Bump" not in rover.heard


def draws_the_room(rover: Carried) -> bool:
    """After Ctrl-C, what it has seen from one place stands there in letters."""
    from nav_msgs.msg import OccupancyGrid

    maps = rover.hear(OccupancyGrid, "/map")
    if not rover.drive(0.0, 0.5, until_it=lambda: len(maps) > 3):
        return False
    rover.interrupt()
    return walls_drawn(rover) > 300


def walls_drawn(rover: Carried) -> int:
    """How many cells of walls, as it says at its end."""
    return int(re.findall(r"^Your mapper has drawn (\d+) cells of walls", rover.heard, re.M)[0])


@dataclass(frozen=True)
class Win:
    """What one sees of a part, and a wrong package in which one does not."""

    part: RoverPart
    seen: Callable[[Carried], bool]
    mutant: str
    words: tuple[str, ...] = ()
    keys: bool = False
    without: bool = True
    """Whether it can be looked for without the part."""


WINS = [
    Win(VOICE, says_its_status, "topic_private"),
    Win(SONAR, brakes_before_the_wall, "echo_misspelt"),
    Win(PACE, drives_slowly, "state_topic_misspelt", without=False),
    Win(PILOT, drives_to_a_point, "topic_misspelt"),
    Win(CABLE, goes_through_its_cable, "listens_elsewhere", keys=True, without=False),
    Win(EYES, follows_the_ball, "topic_misspelt", ("--follow",)),
    Win(LIMITER, keeps_to_its_limit, "forward_without_limit"),
    Win(GUARD, stops_at_the_button, "button_topic_misspelt", keys=True),
    Win(WANDERER, wanders, "commands_misspelt", ("--room", "35")),
    Win(MAPPER, draws_the_room, "map_misspelt", ("--room", "35")),
]
IDS = [win.part.name for win in WINS]
LOOKED_FOR = [win for win in WINS if win.without and win.part is not VOICE]
AT_EACH_LANDING = (SONAR, GUARD)
"""The others are looked for in vain on demand: `-m twice`."""


def in_vain(wins: list[Win]) -> list[object]:
    """These, most of them on demand."""
    return [
        pytest.param(
            win, id=win.part.name, marks=[] if win.part in AT_EACH_LANDING else pytest.mark.twice
        )
        for win in wins
    ]


def test_each_part_has_its_win() -> None:
    """None is forgotten."""
    assert [win.part for win in WINS] == list(PARTS)


def carries(workspace: Path, *parts: RoverPart) -> None:
    """Nothing but these; the voice always, so that there is a rover."""
    shutil.rmtree(workspace / "src", ignore_errors=True)
    for part in {VOICE, *parts}:
        put(workspace, part)


@pytest.mark.parametrize("win", WINS, ids=IDS)
def test_with_the_part_it_is_seen(workspace: Path, win: Win) -> None:
    """By the reference package."""
    carries(workspace, win.part)
    with carried(workspace, *win.words, keys=win.keys) as rover:
        assert win.seen(rover), rover.heard
        assert rover.interrupt() == 0
        assert "Your rover is at" in rover.heard


@pytest.mark.parametrize("win", in_vain(WINS))
def test_with_a_wrong_part_it_is_not(workspace: Path, win: Win) -> None:
    """One sees that something is wrong."""
    carries(workspace, win.part)
    put(workspace, win.part, win.mutant)
    with carried(workspace, *win.words, keys=win.keys) as rover:
        rover.patience_s = CHANCE_S
        assert not win.seen(rover), rover.heard


@pytest.mark.parametrize("win", in_vain(LOOKED_FOR))
def test_without_the_part_it_is_not(workspace: Path, win: Win) -> None:
    """It is the part that does it."""
    carries(workspace)
    with carried(workspace, *win.words, keys=win.keys) as rover:
        rover.patience_s = CHANCE_S
        assert not win.seen(rover), rover.heard


def test_it_draws_the_room_that_it_drives_through(workspace: Path) -> None:
    """By the parts of two days, with nobody at the keys: its own scans lead it, and are drawn."""
    carries(workspace, WANDERER, MAPPER)
    with carried(workspace, "--room", "35") as rover:
        assert wanders(rover), rover.heard
        assert rover.interrupt() == 0
        assert " ended" not in rover.heard and "hangs?" not in rover.heard, rover.heard
        assert "type is missing" not in rover.heard  # of /tf, which the part says
    assert walls_drawn(rover) > 600, rover.heard
    _, _, drawn = rover.heard.rpartition("free ones:\n")
    lines = drawn.splitlines()
    assert len(lines) > 10 and max(map(len, lines)) <= 80, drawn
    assert set("".join(lines)) <= set(" ·▀▄█"), drawn


def near(rover: Carried, x_m: float, y_m: float, within_m: float = 0.3) -> bool:
    """Whether it really is there."""
    return math.dist(rover.pose[:2], (x_m, y_m)) < within_m


def stands_before_the_ball(rover: Carried) -> bool:
    """It looks at the ball, and stands as near as the sonar's part lets it."""
    (ball,) = default_world().balls
    x_m, y_m, heading_deg, moves = rover.pose
    way_m = math.dist((x_m, y_m), (ball.x_m, ball.y_m))
    bearing_deg = math.degrees(math.atan2(ball.y_m - y_m, ball.x_m - x_m)) - heading_deg
    return not moves and way_m < 0.6 and abs(math.remainder(bearing_deg, 360)) < 10


def test_all_days_in_one_rover(workspace: Path) -> None:
    """All parts at once: past the box, through the stop and the pulled cable, and to the ball.

    The point (3, 5) lies behind the box, and (1, 0.8) before the ball. Day 1 only chats; day 9
    tells the metres afterwards.
    """
    from geometry_msgs.msg import Twist
    from std_srvs.srv import SetBool

    carries(workspace, *PARTS)
    with carried(workspace, "--bag", keys=True) as rover:
        rover.wait_for_service(SetBool, "/press")
        said = rover.hear(Twist, "/cmd_vel")
        with goal(rover, 3.0, 5.0) as past_the_box:
            assert rover.sees(lambda: not past_the_box.ended and len(said) > 20), rover.heard
            assert rover.pose[:2] == (0, 0)  # it begins stopped, whatever the pilot says
            rover.press(" ")
            assert rover.sees(lambda: rover.pose[3]), rover.heard
            rover.press(" ")
            assert rover.sees(lambda: not rover.pose[3]), rover.heard
            stood, before = rover.pose, len(said)
            assert rover.sees(lambda: len(said) > before + 20), rover.heard
            assert near(rover, *stood[:2], within_m=0.05) and not rover.pose[3]
            rover.press(" ")
            assert rover.sees(lambda: past_the_box.ended), rover.heard
            assert past_the_box.reached
        assert rover.sees(lambda: near(rover, 3.0, 5.0)), rover.heard
        with goal(rover, 0.0, 1.0) as back:
            assert rover.sees(lambda: not back.ended and rover.pose[3]), rover.heard
            rover.press("p")
            rover.wait_for("The cable is pulled")
            assert rover.sees(lambda: not rover.pose[3]), rover.heard
            assert not back.ended  # in the middle of its way
            rover.press("p")
            rover.wait_for("The cable is plugged in")
            assert rover.sees(lambda: back.ended), rover.heard
            assert back.reached
        with goal(rover, 1.0, 0.8) as before_the_ball:
            assert rover.sees(lambda: before_the_ball.ended), rover.heard
            assert before_the_ball.reached
        assert rover.sees(lambda: near(rover, 1.0, 0.8, 0.6)), rover.heard
        assert not stands_before_the_ball(rover)
        rover.press("f")
        rover.wait_for("It follows the ball")
        assert rover.sees(lambda: stands_before_the_ball(rover)), rover.heard
        rover.press("f")
        rover.wait_for("It no longer follows the ball")
        assert says_its_status(rover)
        assert rover.interrupt() == 0
        assert " ended" not in rover.heard, rover.heard
        went_m = float(re.findall(r"^It went ([\d.]+) m\.$", rover.heard, re.M)[0])
    told = read_drive(workspace / "my_rover_bag")
    metres = float(re.findall(r"^distance: ([\d.]+) m$", told, re.M)[0])
    assert metres == pytest.approx(went_m, rel=0.06) and went_m > 10, told
    assert float(re.findall(r"^top speed: ([\d.]+) m/s$", told, re.M)[0]) < 0.6, told
    assert re.search(r"^topic /rover/motors: \d{3,} messages", told, re.M), told


def test_the_program_of_day_9_tells_the_metres_of_the_drive(workspace: Path) -> None:
    """From the bag that the rover keeps; a second drive takes the place of the first."""
    carries(workspace)
    for seconds in (3, 1):
        with carried(workspace, "--bag") as rover:
            assert rover.drive(0.3, until_it=lambda: rover.pose[3])
            rover.drive(0.3, until_it=lambda: False, within_s=seconds)
            assert rover.interrupt() == 0
            went = float(re.findall(r"^It went ([\d.]+) m\.$", rover.heard, re.M)[0])
            assert "The bag of this drive: ~/my_rover_bag" in rover.heard
        told = read_drive(workspace / "my_rover_bag")
        metres = float(re.findall(r"^distance: ([\d.]+) m$", told, re.M)[0])
        assert metres == pytest.approx(went, abs=0.1), told
        assert went > 0.2


def read_drive(bag: Path) -> str:
    """What the solution of day 9 says of it."""
    folder = lab("black-box").solution
    words = [sys.executable, "-m", "black_box.read_drive", str(bag)]
    environment = surroundings(0, bag.parent)
    environment = {**environment, "PYTHONPATH": f"{folder}:{environment['PYTHONPATH']}"}
    done = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout
