"""What goes wrong with a part: it is named, the rover goes on, and nothing is left behind."""

from __future__ import annotations

import fcntl
import os
import re
import shutil
import signal
import struct
import subprocess
import sys
import termios
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest
from carried import carried, commands, pid_of, put, surroundings, until
from test_my_rover_wins import carries, workspace

from ros2_on_pip.domain_lease import leased_domain
from roslings.course import lab
from roslings_my_rover.parts import CABLE, GUARD, LIMITER, PACE, PARTS, SONAR, VOICE, RoverPart

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
        rover.wait_for("minimal_publisher ended. It said: again")
        assert rover.drive(0.3, until_it=lambda: rover.pose[3])
        assert rover.interrupt() == 0


def test_a_second_one_is_told(workspace: Path) -> None:
    """Both would follow /cmd_vel."""
    carries(workspace)
    with carried(workspace) as rover, carried(workspace, domain=rover.domain) as second:
        second.wait_for("A second rover runs here")


STRAY = """
        from geometry_msgs.msg import Twist
        wrong = Twist()
        wrong.linear.x, wrong.angular.z = 0.4, 2.0
        links = ['/rover/limited', '/cmd_vel_raw', '/rover/motors']
        self.strays = [self.create_publisher(Twist, link, 10) for link in links]
        self.create_timer(0.05, lambda: [stray.publish(wrong) for stray in self.strays])
"""
"""What a part says on links that are another's: forward, and turn."""


@pytest.mark.parametrize(
    "parts",
    [(LIMITER, GUARD), (CABLE, GUARD), (LIMITER,)],
    ids=lambda parts: "-".join(part.name for part in parts),
)
def test_a_part_that_speaks_on_anothers_link_is_held_off(
    workspace: Path, parts: tuple[RoverPart, ...]
) -> None:
    """It is named, and the wheels never follow it, alone or beside a real command."""
    from geometry_msgs.msg import Twist
    from std_srvs.srv import SetBool

    carries(workspace, *parts)
    file = module_of(workspace, "nodes", "minimal_publisher.py")
    begun = "super().__init__('minimal_publisher')\n"
    file.write_text(file.read_text("utf-8").replace(begun, begun + STRAY), "utf-8")
    with carried(workspace, keys=True) as rover:
        strays = rover.hear(Twist, "/rover/motors")
        rover.wait_for("Held off: /minimal_publisher on /rover/limited")
        assert rover.sees(lambda: sum(each.angular.z == 2.0 for each in strays) > 100)
        assert "moving" not in rover.heard
        if GUARD in parts:
            rover.wait_for_service(SetBool, "/press")
            rover.press(" ")
            rover.wait_for("stop is released")
        assert rover.drive(0.3, until_it=lambda: rover.pose[0] > 0.5)
        x_m, y_m, heading_deg, _ = rover.pose
        assert abs(y_m) < 0.05 and abs(heading_deg) < 3, (x_m, y_m, heading_deg)
        assert rover.drive(0.0, until_it=lambda: not rover.pose[3])
        assert rover.interrupt() == 0


def test_a_stranger_on_a_link_is_named(workspace: Path) -> None:
    """Under the name that people know, and under the one that the rover has for it."""
    from geometry_msgs.msg import Twist

    carries(workspace, GUARD)
    with carried(workspace) as rover:
        own = rover.node.create_publisher(Twist, "/rover/motors", 10)
        rover.wait_for(r"Held off: /tester on /rover/motors\. Let it speak on /cmd_vel\.")
        rover.node.destroy_publisher(own)
        there = [name for name, _ in rover.node.get_topic_names_and_types()]
        (link,) = [name for name in there if name.startswith("/rover/motors_")]
        rover.node.create_publisher(Twist, link, 10)
        rover.wait_for("/guard and /tester both say /rover/motors. End what does not")


def test_the_entrance_is_free(workspace: Path) -> None:
    """Whoever speaks on /cmd_vel drives: nobody is named for it."""
    carries(workspace, LIMITER)
    with carried(workspace) as rover:
        assert rover.drive(0.3, until_it=lambda: rover.pose[0] > 0.6)
        assert "Held off" not in rover.heard and "both say" not in rover.heard


def test_a_part_that_hangs_is_told(workspace: Path) -> None:
    """A callback that never ends: the program is there, and says nothing. The rover goes on."""
    from std_srvs.srv import SetBool

    carries(workspace, PACE)
    file = module_of(workspace, "services", "motor_controller.py")
    begun = "def set_max_speed(self, request, response):\n"
    endless = "        import time\n        while True:\n            time.sleep(1)\n"
    file.write_text(file.read_text("utf-8").replace(begun, begun + endless), "utf-8")
    with carried(workspace) as rover:
        client = rover.wait_for_service(SetBool, "/set_max_speed")
        assert rover.drive(0.3, until_it=lambda: rover.pose[3])
        assert "hangs?" not in rover.heard
        client.call_async(SetBool.Request(data=True))
        rover.wait_for(r"^motor_controller hangs\? It says nothing on /motor_state any more\.")
        assert rover.drive(0.3, until_it=lambda: rover.pose[3])
        assert rover.interrupt() == 0


def test_a_part_that_was_stopped_and_goes_on_is_told_once(workspace: Path) -> None:
    """A guard that stands still: so does the rover, and afterwards both go on."""
    from std_srvs.srv import SetBool

    carries(workspace, GUARD)
    with carried(workspace, keys=True) as rover:
        rover.wait_for_service(SetBool, "/press")
        rover.press(" ")
        rover.wait_for("stop is released")
        assert rover.drive(0.3, until_it=lambda: rover.pose[3])
        guard = pid_of(workspace, "guard")
        os.kill(guard, signal.SIGSTOP)
        try:
            rover.wait_for(r"guard hangs\? It says nothing on /rover/motors any more")
            assert rover.drive(0.3, until_it=lambda: not rover.pose[3])
        finally:
            os.kill(guard, signal.SIGCONT)
        assert rover.drive(0.3, until_it=lambda: rover.pose[3])
        assert rover.heard.count("guard hangs?") == 1


FLOOD = """
        import threading
        def flood():
            while rclpy.ok():
                self.publisher.publish(String(data='again'))
        threading.Thread(target=flood, daemon=True).start()
"""


def test_a_part_that_floods_holds_nobody_up(workspace: Path) -> None:
    """As many messages as a processor makes: the map goes on, and so does the rover."""
    carries(workspace, LIMITER)
    file = module_of(workspace, "nodes", "minimal_publisher.py")
    begun = "self.count = 0\n"
    file.write_text(file.read_text("utf-8").replace(begun, begun + FLOOD, 1), "utf-8")
    with carried(workspace) as rover:
        rover.wait_for('^"again"')
        assert rover.drive(0.3, until_it=lambda: rover.pose[3])
        assert rover.drive(0.0, until_it=lambda: not rover.pose[3])
        assert rover.interrupt() == 0


def test_ctrl_c_while_it_builds_ends_it(tmp_path: Path) -> None:
    """What is being built comes to its end, and nothing runs afterwards."""
    carries(tmp_path, *PARTS)
    with carried(tmp_path, ready="^Building voice") as rover:
        assert rover.interrupt() == 130
        assert "Stopped." in rover.heard and "Traceback" not in rover.heard
        assert str(tmp_path / ".roslings" / "my_rover") not in commands()


def test_a_package_in_a_folder_of_another_name_is_carried(workspace: Path) -> None:
    """colcon goes by the name in package.xml, and a folder is soon renamed."""
    carries(workspace)
    package = workspace / "src" / lab("nodes").outline.package
    package.rename(package.with_name("my_first_one"))
    with carried(workspace) as rover:
        rover.wait_for("Robot status count")


def test_keys_of_absent_parts_say_so(workspace: Path) -> None:
    """Space, p and f: which part is missing."""
    carries(workspace)
    with carried(workspace, keys=True) as rover:
        for key, words in {" ": "no guard", "p": "no bridge", "f": "no eyes"}.items():
            rover.press(key)
            rover.wait_for(f"{words} (is|are) in your rover")


def test_what_lies_in_the_bags_place_is_left(workspace: Path) -> None:
    """Before anything is built; with the command that helps."""
    carries(workspace)
    place = workspace / "my_rover_bag"
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir()
    (place / "notes.txt").write_text("mine")
    done = typed(workspace, "--bag")
    assert done.returncode == 2 and "mv ~/my_rover_bag ~/my_rover_bag_2" in done.stderr
    assert "Building" not in done.stderr and (place / "notes.txt").read_text() == "mine"
    shutil.rmtree(place)


@pytest.mark.parametrize("columns", [60, 80])
def test_the_map_fits_into_a_small_terminal(workspace: Path, columns: int) -> None:
    """Map, parts and what has happened; no line is longer than the terminal is wide."""
    carries(workspace, LIMITER)
    file = module_of(workspace, "bring-up", "beacon.py")
    text = file.read_text("utf-8").replace(
        "def main(", f"raise RuntimeError('{'burnt ' * 9}')\n\n\ndef main("
    )
    file.write_text(text, "utf-8")
    with screen(workspace, columns, lines=22) as shown:

        def with_words(words: str) -> list[str]:
            return now.splitlines() if words in (now := shown()) else []

        rows = until(lambda: with_words("burnt burnt"), shown)
        assert max(map(len, rows)) <= columns, rows
        for words in ("x          0.00 m", "limiter  has ended", "no guard yet: day 10"):
            assert any(words in row for row in rows), (words, rows)
        ending = " ".join(row.strip() for row in rows[-3:])
        assert re.search(r"beacon ended\. It said: RuntimeError: (burnt ){6}", ending), rows
        until(lambda: with_words("Robot status count"), shown)


@contextmanager
def screen(workspace: Path, columns: int, lines: int) -> Iterator[Callable[[], str]]:
    """What a terminal of this size shows now."""
    ours, theirs = os.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", lines, columns, 0, 0))
    with leased_domain() as domain:
        process = subprocess.Popen(
            [sys.executable, "-m", "roslings", "my-rover", "--view", "terminal"],
            env={**surroundings(domain, workspace), "TERM": "xterm-256color"},
            cwd=workspace,
            stdin=theirs,
            stdout=theirs,
            stderr=theirs,
            start_new_session=True,
        )
        os.close(theirs)
        written = bytearray()
        reader = threading.Thread(target=_read, args=(ours, written), daemon=True)
        reader.start()
        try:
            yield lambda: _newest_screen(written.decode("utf-8", "replace"))
            process.send_signal(signal.SIGINT)
            assert process.wait(60) == 0
        finally:
            process.kill()
            process.wait()
            reader.join()
            os.close(ours)


def _read(terminal: int, into: bytearray) -> None:
    with suppress(OSError):  # the other end is closed
        while piece := os.read(terminal, 65536):
            into += piece


def _newest_screen(written: str) -> str:
    """The last whole one: each is drawn anew from the upper left corner."""
    drawn = written.split("\x1b[H")
    newest = drawn[-2] if len(drawn) > 2 else ""
    return re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", newest).replace("\r", "")


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
        assert rover.drive(0.3, until_it=lambda: "e_stop_button ended" in rover.heard)

        def stands_though_it_is_told_to_drive() -> bool:
            rover.drive(0.3, until_it=lambda: not rover.pose[3])
            return not rover.drive(0.3, until_it=lambda: rover.pose[3], within_s=5.0)

        # On a busy computer it may also stand for a moment in the lease of the button that is gone.
        assert any(stands_though_it_is_told_to_drive() for _ in range(3)), rover.heard


def test_nothing_is_left_when_it_is_killed(workspace: Path) -> None:
    """No program of a part outlives the command."""
    carries(workspace, CABLE)
    with carried(workspace) as rover:
        rover.wait_for("Robot status count")
        rover.process.kill()
        rover.process.wait()
        mark = str(workspace / ".roslings" / "my_rover")
        until(lambda: mark not in commands(), commands, 30.0)


def typed(workspace: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """The command to its end."""
    return subprocess.run(
        [sys.executable, "-m", "roslings", "my-rover", *words],
        env=surroundings(1, workspace),
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
        cwd=workspace,
    )


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
    assert len(lines) == len(PARTS) and max(map(len, lines)) <= 80
    assert re.match(r"day  2  voice    says its status over its head  \(never checked\)", lines[0])
    assert "start pi-camera" in done.stdout


def test_keys_without_a_terminal_are_refused(workspace: Path) -> None:
    """Before anything is started."""
    put(workspace, VOICE)
    done = typed(workspace, "--keys")
    assert done.returncode != 0 and "--keys" in done.stderr
