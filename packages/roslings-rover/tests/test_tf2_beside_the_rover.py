"""`tf2_echo` and `view_frames` beside a rover that has driven: the same place as /odom says."""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest
import yaml
from program import environment, run, running

from ros2_on_pip.domain_lease import leased_domain
from skips import imported

A_MILLIMETRE = 0.001
BEND = "{linear: {x: 0.5}, angular: {z: 0.8}}"


@pytest.mark.slow
def test_the_echo_is_where_the_rover_is(tmp_path: Path) -> None:
    """Within a millimetre and a thousandth of a radian, after a bend; the tree is shown."""
    imported("tf2_msgs")
    with leased_domain() as domain:
        terminal = environment(domain, tmp_path)
        with running(["rover", "--view", "lines"], terminal, tmp_path) as rover:
            rover.wait_for("standing")
            pub = ["ros2", "topic", "pub", "--once", "/cmd_vel", "geometry_msgs/msg/Twist", BEND]
            assert run(pub, terminal, tmp_path).returncode == 0
            rover.wait_for(r"moving")
            rover.wait_for(r"x 0\.[1-9].*heading [1-9].* standing")
            told = run(["ros2", "topic", "echo", "--once", "/odom"], terminal, tmp_path).stdout
            steps = {
                frame: echoed(["odom", frame], terminal, tmp_path)
                for frame in ("base_link", "laser")
            }
            view = ["ros2", "run", "tf2_tools", "view_frames", "-t", "2", "-o", "frames"]
            shown = run(view, terminal, tmp_path).stdout
    pose = next(yaml.safe_load_all(told))["pose"]["pose"]
    place, facing = pose["position"], pose["orientation"]
    assert place["y"] != 0.0
    yaw_rad = 2 * math.atan2(facing["z"], facing["w"])
    for frame, height_m in (("base_link", 0.0), ("laser", 0.15)):
        shift, turn = steps[frame]
        assert shift == pytest.approx((place["x"], place["y"], height_m), abs=A_MILLIMETRE)
        assert turn[2] == pytest.approx(yaw_rad, abs=A_MILLIMETRE)
    assert re.search(r"^odom\n└─ base_link +\d+\.\d Hz, ", shown, re.MULTILINE)
    assert re.search(r"^   ├─ laser +static", shown, re.MULTILINE)
    assert re.search(r"^   └─ camera_optical +static", shown, re.MULTILINE)


def echoed(
    frames: list[str], terminal: dict[str, str], folder: Path
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """The step that `tf2_echo` prints: its translation, and its turn as roll, pitch and yaw."""
    words = ["ros2", "run", "tf2_ros", "tf2_echo", *frames, "10"]
    with running(words, terminal, folder) as echo:
        shift = echo.wait_for("^- Translation: ")
        turn = echo.wait_for(r"^- Rotation: in RPY \(radian\) ")
        assert echo.interrupt() == 0, echo.lines
    return numbers(shift), numbers(turn)


def numbers(line: str) -> tuple[float, ...]:
    """Those in its brackets."""
    return tuple(map(float, line.partition("[")[2].rstrip("]").split(",")))
