"""What goes wrong with a part: it is named, the rover goes on, and nothing is left behind."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from carried import carried, put, surroundings, until
from test_my_rover_wins import carries, workspace

from roslings.course import lab
from roslings_my_rover.parts import CABLE, GUARD, LIMITER, SONAR, VOICE

__all__ = ["workspace"]
pytestmark = pytest.mark.slow


def module_of(workspace: Path, name: str, file: str) -> Path:
    """A file of a student's package."""
    return next((workspace / "src" / lab(name).outline.package).rglob(file))


def test_a_part_that_crashes_is_named_and_passed_by(workspace: Path) -> None:
    """With its last line; the command then goes straight to the motors."""
    carries(workspace, LIMITER)
    file = module_of(workspace, "bring-up", "speed_limiter.py")
    file.write_text(
        file.read_text("utf-8").replace("def main(", "raise RuntimeError('burnt')\n\n\ndef main("),
        "utf-8",
    )
    with carried(workspace) as rover:
        rover.wait_for(r"speed_limiter ended\. It said: RuntimeError: burnt")
        assert rover.drive(0.5, until_it=lambda: rover.pose[3])
        assert rover.interrupt() == 0
        assert rover.heard.count("speed_limiter ended") == 2  # when it did, and at the end


def test_a_part_that_prints_without_end_holds_nobody_up(workspace: Path) -> None:
    """The rover drives, and ends at Ctrl-C."""
    carries(workspace)
    file = module_of(workspace, "nodes", "minimal_publisher.py")
    text = file.read_text("utf-8")
    endless = "while True:\n    print('again', flush=True)\n\n\ndef main("
    file.write_text(text.replace("def main(", endless), "utf-8")
    with carried(workspace) as rover:
        assert rover.drive(0.3, until_it=lambda: rover.pose[3])
        assert rover.interrupt() == 0


def test_a_second_one_is_told(workspace: Path) -> None:
    """Both would follow /cmd_vel."""
    carries(workspace)
    with carried(workspace) as rover, carried(workspace, domain=rover.domain) as second:
        second.wait_for("A second rover runs here")


def test_who_speaks_on_anothers_link_is_named(workspace: Path) -> None:
    """With the link, and both who speak there."""
    from geometry_msgs.msg import Twist

    carries(workspace, GUARD)
    with carried(workspace) as rover:
        rover.node.create_publisher(Twist, "/rover/motors", 10)
        rover.wait_for("/guard and /tester both say /rover/motors")


def test_a_part_that_does_not_build_is_left_out(workspace: Path) -> None:
    """With the reason; the others run."""
    carries(workspace, SONAR)
    file = workspace / "src" / lab("distance-sensor").outline.package / "setup.py"
    file.write_text(file.read_text("utf-8").replace("setup(", "setpu(", 1), "utf-8")
    with carried(workspace) as rover:
        rover.wait_for(r"^sonar is left out: it does not build\. .*setpu")
        rover.wait_for("Robot status count")


def test_a_stop_that_ends_is_no_reason_to_drive(workspace: Path) -> None:
    """The button is killed: the guard stops the rover, and it stays stopped."""
    from std_srvs.srv import SetBool

    carries(workspace, GUARD)
    with carried(workspace, keys=True) as rover:
        rover.wait_for_service(SetBool, "/press")
        rover.press(" ")
        rover.wait_for("stop is released")
        assert rover.drive(0.3, until_it=lambda: rover.pose[3])
        os.kill(pid_of(workspace, "e_stop_button"), signal.SIGKILL)
        rover.wait_for(r"e_stop_button ended")
        assert rover.drive(0.3, until_it=lambda: not rover.pose[3])
        assert not rover.drive(0.3, until_it=lambda: rover.pose[3], within_s=5.0)


def pid_of(workspace: Path, program: str) -> int:
    """A program of a part, as it was built for this workspace."""
    words = ["ps", "-ww", "-eo", "pid,args"]
    found = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    (line,) = [
        line for line in found.splitlines()
        if str(workspace) in line and f"/{program}" in line
    ]  # fmt: skip
    return int(line.split()[0])


def test_nothing_is_left_when_it_is_killed(workspace: Path) -> None:
    """No program of a part outlives the command."""
    carries(workspace, CABLE)
    with carried(workspace) as rover:
        rover.wait_for("Robot status count")
        rover.process.kill()
        rover.process.wait()
        mark = str(workspace / ".roslings" / "my_rover")
        until(lambda: mark not in _commands(), _commands, 30.0)


def _commands() -> str:
    words = ["ps", "-ww", "-eo", "args"]
    return subprocess.run(words, capture_output=True, text=True, check=True).stdout


def typed(workspace: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """The command to its end."""
    return subprocess.run(
        [sys.executable, "-m", "roslings", "my-rover", *words], env=surroundings(1, workspace),
        stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False, cwd=workspace,
    )  # fmt: skip


def test_without_any_part_the_next_step_is_said(workspace: Path) -> None:
    """And what drives already."""
    shutil.rmtree(workspace / "src", ignore_errors=True)
    done = typed(workspace)
    assert done.returncode == 2
    assert "start nodes" in done.stderr and "./roslings rover" in done.stderr


def test_parts_are_told_without_starting_any(workspace: Path) -> None:
    """At most 80 columns; what is not there names its lab."""
    carries(workspace)
    done = typed(workspace, "--parts")
    assert done.returncode == 0
    lines = done.stdout.splitlines()
    assert len(lines) == 8 and max(map(len, lines)) <= 80
    assert re.match(r"day  2  voice    says its status over its head  \(never checked\)", lines[0])
    assert "start pi-camera" in done.stdout


def test_keys_without_a_terminal_are_refused(workspace: Path) -> None:
    """Before anything is started."""
    put(workspace, VOICE)
    done = typed(workspace, "--keys")
    assert done.returncode != 0 and "--keys" in done.stderr
