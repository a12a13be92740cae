"""What each part adds, seen on the robot: with the part, with a wrong one, and without it."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import pytest
from carried import Carried, carried, put, surroundings

from roslings.course import lab
from roslings_my_rover.parts import (
    CABLE,
    EYES,
    GUARD,
    LIMITER,
    PACE,
    PARTS,
    PILOT,
    SONAR,
    VOICE,
    Part,
)

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
    words = [sys.executable, "-m", "ros2_on_pip", "action", "send_goal", "/drive_to",
             "rover_interfaces/action/DriveTo", "{x: 1.5, y: 0.5, tolerance: 0.1}"]  # fmt: skip
    environment = surroundings(rover.domain, Path.cwd())
    with suppress(subprocess.TimeoutExpired):
        subprocess.run(
            words, env=environment, timeout=rover.patience_s, check=False, capture_output=True
        )
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
    rover.drive(2.0, until_it=lambda: len(odom) > 80)
    return 0.4 < max(each.twist.twist.linear.x for each in odom[40:]) < 0.53


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


@dataclass(frozen=True)
class Win:
    """What one sees of a part, and a wrong package in which one does not."""

    part: Part
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
]
IDS = [win.part.name for win in WINS]
LOOKED_FOR = [win for win in WINS if win.without and win.part is not VOICE]
AT_EACH_LANDING = (SONAR, GUARD)
"""The others are looked for in vain on demand: `-m twice`."""


def in_vain(wins: list[Win]) -> list[object]:
    """These, most of them on demand."""
    return [
        pytest.param(win, id=win.part.name,
                     marks=[] if win.part in AT_EACH_LANDING else pytest.mark.twice)
        for win in wins
    ]  # fmt: skip


def test_each_part_has_its_win() -> None:
    """None is forgotten."""
    assert [win.part for win in WINS] == list(PARTS)


def carries(workspace: Path, *parts: Part) -> None:
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


def test_all_parts_in_one_rover(workspace: Path) -> None:
    """It drives to a point, stops for the button, goes on, and survives a pulled cable."""
    carries(workspace, *PARTS)
    with carried(workspace, keys=True) as rover:
        assert stops_at_the_button(rover), rover.heard
        rover.press(" ")
        rover.wait_for("stop is released")
        assert goes_through_its_cable(rover), rover.heard
        assert says_its_status(rover)
        assert rover.interrupt() == 0
        assert re.search(r"^It went \d\.\d\d m\.$", rover.heard, re.M)


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
