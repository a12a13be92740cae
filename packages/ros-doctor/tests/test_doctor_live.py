"""The live checks, with real ROS processes. They stay on this computer."""

from __future__ import annotations

import contextlib
import subprocess
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from clinic import Clinic, assert_absent, assert_ill, assert_well

from ros_doctor.examine import examine
from ros_doctor.finding import Finding, Status
from ros_doctor.live import conversation
from ros_doctor.machine import ExaminedMachine, this_machine
from ros_doctor.registry import find_check
from ros_doctor.ros import Ros, find_ros
from skips import needs

REAL = this_machine()
ROS = find_ros(REAL)
with_ros = needs("module rclpy")


def look(machine: ExaminedMachine, id: str) -> Finding:
    return examine(machine, [find_check(id)]).results[0].finding


def quiet_machine(domain: int) -> ExaminedMachine:
    """Return the real machine, with a domain of its own and no settings of the caller's."""
    kept = {k: v for k, v in REAL.env.items() if not k.startswith(("ROS_", "RMW_", "FAST"))}
    distro = {"ROS_DISTRO": REAL.env["ROS_DISTRO"]} if "ROS_DISTRO" in REAL.env else {}
    near = {"ROS_DOMAIN_ID": str(domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    return replace(REAL, env=kept | distro | near)


@pytest.fixture
def machine() -> ExaminedMachine:
    return quiet_machine(conversation.free_domain(REAL))


@with_ros
def test_well_talk(machine: ExaminedMachine) -> None:
    assert_well(look(machine, "talk"))


def test_without_ros_there_is_no_talk(clinic: Clinic) -> None:
    assert_absent(clinic.look("qos"))
    assert_absent(clinic.no_ros().look("talk"))
    assert_absent(clinic.look("qos"))


@pytest.mark.slow
@with_ros
def test_ill_talk(machine: ExaminedMachine) -> None:
    """A middleware that is not installed ends each node; the check repeats what it said."""
    ill = replace(machine, env={**machine.env, "RMW_IMPLEMENTATION": "rmw_of_nobody"})
    assert_ill(look(ill, "talk"), "fault", "ended with an error")


@pytest.mark.slow
def test_ill_talk__messages_are_missing(clinic: Clinic) -> None:
    error = "ModuleNotFoundError: No module named 'std_msgs'"
    clinic.program("python", f'echo "{error}" >&2; exit 1', folder="/course/.venv/bin")
    assert_ill(clinic.look("talk"), "fault", "standard messages", "./roslings check")


@pytest.mark.slow
def test_ill_talk__nothing_arrives(clinic: Clinic, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two programs that run and say nothing, as where the network swallows every message."""
    monkeypatch.setattr("ros_doctor.checks.live.SPEAKING_FOR_S", 0.3)
    clinic.program("python", "read leash", folder="/course/.venv/bin")
    assert_ill(clinic.look("talk"), "fault", "no message arrived", "--only talk")


def test_talk_waits_for_its_causes(clinic: Clinic) -> None:
    checks = [find_check(id) for id in ("middleware", "talk")]
    clinic.set(RMW_IMPLEMENTATION="rmw_of_nobody")
    talk = examine(clinic.machine, checks).results[1].finding
    assert talk.status == Status.UNKNOWN
    assert talk.found == "first mend middleware"


CLASH = """
import select, sys
import rclpy
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String
rclpy.init(args=[])
kind = sys.argv[1]
node = rclpy.create_node("eager_" + kind)
reliable = QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE)
effort = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
if kind == "talker":
    node.create_publisher(String, "/scan", effort)
else:
    node.create_subscription(String, "/scan", print, reliable if kind == "listener" else effort)
print("ready", flush=True)
select.select([sys.stdin], [], [])
rclpy.try_shutdown()
"""


@contextlib.contextmanager
def node(ros: Ros, machine: ExaminedMachine, kind: str, logs: Path) -> Iterator[None]:
    env = conversation.quiet(machine, ros, logs, machine.env["ROS_DOMAIN_ID"])
    running = subprocess.Popen(
        [str(ros.python), "-c", CLASH, kind],
        env=env,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert running.stdout is not None
    assert running.stdin is not None
    try:
        assert running.stdout.readline() == "ready\n"
        yield
    finally:
        running.stdin.close()
        running.wait(10)
        running.stdout.close()


@pytest.mark.slow
@with_ros
def test_ill_qos(machine: ExaminedMachine, tmp_path: Path) -> None:
    assert ROS is not None
    with node(ROS, machine, "talker", tmp_path), node(ROS, machine, "listener", tmp_path):
        finding = look(machine, "qos")
    assert_ill(finding, "warning", "On /scan, eager_listener cannot hear eager_talker", "sensor")


@pytest.mark.slow
@with_ros
def test_well_qos(machine: ExaminedMachine, tmp_path: Path) -> None:
    assert ROS is not None
    with node(ROS, machine, "talker", tmp_path), node(ROS, machine, "patient", tmp_path):
        assert_well(look(machine, "qos"))


@pytest.mark.slow
def test_an_observer_that_fails_is_not_guessed(clinic: Clinic) -> None:
    hold_ports(clinic, 7410)
    clinic.program("python", "exit 1", folder="/course/.venv/bin")
    assert clinic.look("qos").status == Status.UNKNOWN


@pytest.mark.slow
@with_ros
def test_nothing_is_left_behind(machine: ExaminedMachine, tmp_path: Path) -> None:
    """No process and no file remains of a proof. Its processes are known by their HOME."""
    env = {**machine.env, "HOME": str(tmp_path)}
    assert_well(look(replace(machine, env=env), "talk"))
    assert list(tmp_path.iterdir()) == []
    assert [pid for pid in Path("/proc").glob("[0-9]*") if str(tmp_path) in _environ(pid)] == []


def _environ(process: Path) -> str:
    try:
        return (process / "environ").read_text(errors="replace")
    except OSError:  # another user's, or it has just ended
        return ""


@pytest.mark.slow
def test_the_leash_ends_a_program_that_does_not_want_to_end(clinic: Clinic) -> None:
    """A stubborn program is ended by force when the block is left."""
    ros = find_ros(clinic.machine)
    assert ros is not None
    clinic.program("python", "trap '' INT TERM; exec sleep 60", "/course/.venv/bin")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(conversation, "ENDING_S", 0.2)
        with conversation.process(ros, dict(REAL.env), "hear.py") as running:
            assert running.poll() is None
    assert running.returncode == -9


def hold_ports(clinic: Clinic, *ports: int) -> None:
    lines = [f"  1: 00000000:{port:04X} 00000000:0000 07" for port in ports]
    clinic.file("/proc/net/udp", "\n".join(["  sl  local_address", *lines, ""]))


def test_a_free_domain_is_not_one_in_use(clinic: Clinic) -> None:
    """Ports of domain 1 to 100 are taken, so 101 is left."""
    hold_ports(clinic, *(7400 + 250 * domain for domain in range(1, 101)))
    assert conversation.free_domain(clinic.machine) == 101


def test_running_programs_are_counted_by_their_ports(clinic: Clinic) -> None:
    """Each holds two ports of its own; the two below 10 are common to all."""
    hold_ports(clinic, 53, 8650, 8651, 8660, 8661, 8662, 8663, 8910)
    assert conversation.participants(clinic.machine, 5) == 2
    assert conversation.participants(clinic.machine, 6) == 1
    assert conversation.participants(clinic.machine, 7) == 0
