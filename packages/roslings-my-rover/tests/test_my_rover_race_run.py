"""The race as it is typed: with the launch file of day 8, with wrong ones, and without it."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from carried import Carried, carried, commands, put, surroundings, until
from test_my_rover_bad import typed
from test_my_rover_wins import workspace

from roslings.course import lab
from roslings_my_rover.parts import LIMITER, VOICE
from roslings_my_rover.race_view import SLOWER

__all__ = ["workspace"]
pytestmark = pytest.mark.slow
WITHIN_S = 45.0
"""Who drives as slowly as blue is at the finish after 15 s."""
MUTANTS = [
    pytest.param("blue_is_as_fast"),
    pytest.param("no_namespace", marks=pytest.mark.twice),
    pytest.param("green_for_blue", marks=pytest.mark.twice),
]


def with_launch_file(workspace: Path, mutant: str = "") -> Path:
    """Nothing but the package of day 8; its folder."""
    shutil.rmtree(workspace / "src", ignore_errors=True)
    put(workspace, LIMITER, mutant)
    return workspace / "src" / lab(LIMITER.lab).outline.package


def red_wins(race: Carried) -> bool:
    """By so much that one sees it: red may drive half as fast again as blue."""
    race.sees(lambda: re.search(r"wins: .* s\. \w+: |dead heat", race.heard))
    times = re.search(r"^Red wins: ([\d.]+) s\. Blue: ([\d.]+) s\.$", race.heard, re.M)
    return times is not None and 1.3 < float(times[2]) / float(times[1]) < 1.7


def test_red_wins_with_the_launch_file(workspace: Path) -> None:
    """Each with its name over it; nothing is left afterwards."""
    with_launch_file(workspace)
    with carried(workspace, "--race") as race:
        assert red_wins(race), race.heard
        assert re.search(r'^red: "red" x ', race.heard, re.M), race.heard
        assert re.search(r'^blue: "blue" x ', race.heard, re.M), race.heard
        assert race.interrupt() == 0
        assert "It went 6." in race.heard
        mark = str(workspace / ".roslings" / "my_rover")
        until(lambda: mark not in commands(), commands, 30.0)


@pytest.mark.parametrize("mutant", MUTANTS)
def test_with_a_wrong_one_it_does_not(workspace: Path, mutant: str) -> None:
    """Both limits alike, or a rover that nobody drives."""
    with_launch_file(workspace, mutant)
    with carried(workspace, "--race") as race:
        race.patience_s = WITHIN_S
        assert not red_wins(race), race.heard
        told = "A dead heat" if mutant == "blue_is_as_fast" else "The race waits: nobody hears /"
        assert told in race.heard


def test_without_the_package_there_is_no_race(workspace: Path) -> None:
    """The lab that begins it is named."""
    shutil.rmtree(workspace / "src", ignore_errors=True)
    put(workspace, VOICE)
    done = typed(workspace, "--race")
    assert done.returncode == 2 and f"start {LIMITER.lab}" in done.stderr


def test_a_parameter_that_is_set_on_the_way_changes_who_wins(workspace: Path) -> None:
    """As the map tells it: red becomes careful."""
    with_launch_file(workspace)
    with carried(workspace, "--race") as race:
        race.wait_for("^Go!")
        words = [sys.executable, "-m", "ros2_on_pip", *SLOWER.split()[1:]]
        environment = surroundings(race.domain, workspace)
        set_so = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)
        assert set_so.returncode == 0, set_so.stderr
        race.wait_for(r"^Blue wins: ")


def test_a_launch_file_that_ends_is_named(workspace: Path) -> None:
    """With its last line."""
    package = with_launch_file(workspace)
    file = package / "launch" / "bring_up.launch.py"
    text = file.read_text("utf-8")
    file.write_text(text.replace("PushRosNamespace(name)", "PushRosNamspace(name)"), "utf-8")
    with carried(workspace, "--race") as race:
        race.wait_for(r"bring_up\.launch\.py ended\. It said: .*PushRosNamspace")
        assert race.interrupt() == 0


def test_who_drives_a_rover_besides_is_named(workspace: Path) -> None:
    """With the topic of that rover."""
    from geometry_msgs.msg import Twist

    with_launch_file(workspace)
    with carried(workspace, "--race") as race:
        race.node.create_publisher(Twist, "/red/cmd_vel", 10)
        race.wait_for("/red/speed_limiter and /tester both say /red/cmd_vel")


@pytest.mark.parametrize("word", ["--keys", "--follow", "--bag", "--launch"])
def test_what_does_not_go_with_a_race_is_refused(workspace: Path, word: str) -> None:
    """Before anything is started."""
    done = typed(workspace, "--race", word)
    assert done.returncode == 2 and "--race goes with" in done.stderr
