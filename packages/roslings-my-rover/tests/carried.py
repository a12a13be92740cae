"""A rover that runs in a process and a domain of its own, and hands that drive it."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Any

from ros2_on_pip.domain_lease import leased_domain
from roslings.course import lab
from roslings_my_rover.parts import RoverPart
from sources import python_path

PATIENCE_S = 120.0
"""Only a test that fails waits so long."""
POSE = re.compile(r"^x (-?[\d.]+) m, y (-?[\d.]+) m, heading (-?\d+) degrees, (\w+)$")


def until(
    condition: Callable[[], Any], missing: Callable[[], str], late_s: float = PATIENCE_S
) -> Any:
    """Ask again and again, until it holds; what it then is."""
    late_s += time.monotonic()
    while not (found := condition()):
        assert time.monotonic() < late_s, missing()
        time.sleep(0.02)
    return found


def put(workspace: Path, part: RoverPart, mutant: str = "") -> None:
    """The solution of the part's lab as the student's package, or a wrong one."""
    own = lab(part.lab)
    package = workspace / "src" / own.outline.package
    shutil.rmtree(package, ignore_errors=True)
    if mutant:
        next(each for each in own.mutants() if each.name == mutant).make(own.solution, package)
    else:
        shutil.copytree(own.solution, package)


class Carried:
    """A running `./roslings my-rover`, and a node of the test's beside it."""

    def __init__(self, process: subprocess.Popen[str], keys: int, domain: int) -> None:
        self.process, self.domain, self._keys = process, domain, keys
        self.lines = list[str]()
        self.patience_s = PATIENCE_S
        """What never comes is waited for so long."""
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def __enter__(self) -> Carried:
        import rclpy
        from geometry_msgs.msg import Twist
        from rclpy.executors import SingleThreadedExecutor
        from rclpy.signals import SignalHandlerOptions

        self._twist, self._context = Twist, rclpy.Context()
        rclpy.init(
            args=["--ros-args", "--disable-external-lib-logs"],
            context=self._context,
            domain_id=self.domain,
            signal_handler_options=SignalHandlerOptions.NO,
        )
        self.node = rclpy.create_node("tester", context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)
        self._commands = self.node.create_publisher(Twist, "/cmd_vel", 10)
        return self

    def __exit__(self, *_: object) -> None:
        self._executor.shutdown()
        self.node.destroy_node()
        self._context.try_shutdown()

    def _read(self) -> None:
        assert self.process.stdout
        for line in self.process.stdout:
            self.lines.append(line.rstrip("\n"))

    @property
    def heard(self) -> str:
        """All that it has printed."""
        return "\n".join(self.lines)

    def wait_for(self, pattern: str) -> str:
        """Wait for a line with `pattern`; the newest one."""

        def found() -> str | None:
            return next((each for each in self.lines[::-1] if re.search(pattern, each)), None)

        line: str = until(found, lambda: f"no line with {pattern!r} in\n{self.heard}")
        return line

    @property
    def pose(self) -> tuple[float, float, int, bool]:
        """Where it really is, by its own words: x, y in metres, degrees, and whether it moves."""
        found = next((m for line in self.lines[::-1] if (m := POSE.match(line))), None)
        if found is None:
            return 0.0, 0.0, 0, False
        return float(found[1]), float(found[2]), int(found[3]), found[4] == "moving"

    def press(self, key: str) -> None:
        """A key of its terminal."""
        os.write(self._keys, key.encode())

    def drive(
        self,
        forward_m_s: float,
        turn_rad_s: float = 0.0,
        *,
        until_it: Callable[[], bool],
        within_s: float | None = None,
    ) -> bool:
        """Say a command ten times a second until something holds; whether it ever did."""
        command = self._twist()
        command.linear.x, command.angular.z = forward_m_s, turn_rad_s
        late_s = time.monotonic() + (within_s or self.patience_s)
        while not until_it():
            if time.monotonic() > late_s:
                return False
            self._commands.publish(command)
            self.spin(0.1)
        return True

    def sees(self, condition: Callable[[], Any]) -> bool:
        """Whether it ever holds, with nobody at the keys."""
        late_s = time.monotonic() + self.patience_s
        while not (found := condition()) and time.monotonic() < late_s:
            self.spin(0.1)
        return bool(found)

    def spin(self, for_s: float) -> None:
        """Let what came be heard."""
        late_s = time.monotonic() + for_s
        while time.monotonic() < late_s:
            self._executor.spin_once(timeout_sec=0.02)

    def hear(self, cls: Any, topic: str) -> list[Any]:
        """The messages of a topic, as they come."""
        from rclpy.qos import qos_profile_sensor_data

        found: list[Any] = []
        self.node.create_subscription(cls, topic, found.append, qos_profile_sensor_data)
        return found

    def another_node(self, name: str) -> Any:
        """A node beside the tester, that does nothing."""
        import rclpy

        return rclpy.create_node(name, context=self._context)

    def wait_for_service(self, cls: Any, service: str) -> Any:
        """A client of it."""
        client = self.node.create_client(cls, service)
        until(client.service_is_ready, lambda: f"nobody serves {service}\n{self.heard}")
        return client

    def call(self, cls: Any, service: str, **words: Any) -> Any:
        """The answer of a service."""
        client = self.wait_for_service(cls, service)
        future = client.call_async(cls.Request(**words))
        until(lambda: self.spin(0.05) or future.done(), lambda: f"{service} never answers")
        return future.result()

    def interrupt(self) -> int:
        """Press Ctrl-C; the exit code."""
        self.process.send_signal(signal.SIGINT)
        code = self.process.wait(PATIENCE_S)
        self._reader.join(PATIENCE_S)
        return code


READY = r"^The rovers? (is|are) ready|^roslings:|^No part"


@contextmanager
def carried(
    workspace: Path, *words: str, keys: bool = False, domain: int | None = None, ready: str = READY
) -> Iterator[Carried]:
    """The rover of this workspace, as soon as it is ready; nothing of it is left afterwards.

    On a domain of its own, unless one is given.
    """
    with nullcontext(domain) if domain is not None else leased_domain() as domain:
        ours, theirs = os.openpty()
        process = subprocess.Popen(
            [
                sys.executable,
                "-m",
                "roslings",
                "my-rover",
                "--view",
                "lines",
                *(["--keys"] if keys else []),
                *words,
            ],
            env=surroundings(domain, workspace),
            cwd=workspace,
            text=True,
            start_new_session=True,
            stdin=theirs,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        os.close(theirs)
        try:
            with Carried(process, ours, domain) as found:
                found.wait_for(ready)
                yield found
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGTERM)
                try:
                    process.wait(20)
                except subprocess.TimeoutExpired:
                    os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            os.close(ours)


class Goal:
    """`ros2 action send_goal`, which ends when the rover's pilot says that it is there.

    A pilot that does not know yet where the rover is refuses: then it is asked again.
    """

    def __init__(self, domain: int, x_m: float, y_m: float) -> None:
        self._domain = domain
        self._where = f"{{x: {x_m}, y: {y_m}, tolerance: 0.1}}"
        self._said: str | None = None
        self._process = self._send()

    def _send(self) -> subprocess.Popen[str]:
        words = [
            sys.executable,
            "-m",
            "ros2_on_pip",
            "action",
            "send_goal",
            "/drive_to",
            "rover_interfaces/action/DriveTo",
            self._where,
        ]
        return subprocess.Popen(
            words,
            env=surroundings(self._domain, Path.cwd()),
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )

    @property
    def ended(self) -> bool:
        """Whether it is over; look at it again and again."""
        if self._process.poll() is None:
            return False
        if self._said is None:
            self._said = self._process.communicate()[0]
        if "rejected" in self._said:
            self._said, self._process = None, self._send()
            return False
        return True

    @property
    def reached(self) -> bool:
        """Whether it has ended well, as the command told it."""
        return self.ended and self._process.returncode == 0 and "SUCCEEDED" in (self._said or "")

    def close(self) -> None:
        """End the command; the pilot goes on."""
        if self._said is None:
            self._process.kill()
            self._process.communicate()


@contextmanager
def goal(rover: Carried, x_m: float, y_m: float) -> Iterator[Goal]:
    """Send the rover to a point."""
    sent = Goal(rover.domain, x_m, y_m)
    try:
        yield sent
    finally:
        sent.close()


def pid_of(workspace: Path, program: str) -> int:
    """A program of a part, as it was built for this workspace."""
    (line,) = [
        line
        for line in commands().splitlines()
        if str(workspace) in line and re.search(rf"/{program}(\s|$)", line)
    ]
    return int(line.split()[0])


def commands() -> str:
    """All that runs on this computer: a line each, its pid first."""
    words = ["ps", "-ww", "-eo", "pid,args"]
    return subprocess.run(words, capture_output=True, text=True, check=True).stdout


def surroundings(domain: int, workspace: Path) -> Mapping[str, str]:
    """A new terminal of this workspace's student."""
    kept = {
        k: os.environ[k]
        for k in (
            "PATH",
            "LD_LIBRARY_PATH",
            "LANG",
            "ROSLINGS_COURSE",
            "AMENT_PREFIX_PATH",
            "_ROS_WHEELS_BOOTSTRAP_COMPLETE",
        )
        if k in os.environ
    }
    return kept | {
        "ROS_DOMAIN_ID": str(domain),
        "HOME": str(workspace),
        "ROSLINGS_WS": str(workspace),
        "PYTHONPATH": python_path(),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }
