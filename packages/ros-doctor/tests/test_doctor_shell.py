"""The checks of the terminal and of the network's settings."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys

import pytest
from clinic import Clinic, assert_absent, assert_ill, assert_well

from ros_doctor.checks.network import LOOPBACK, multicast_problem
from ros_doctor.finding import Status
from skips import skip_without


def test_ill_startup_files(clinic: Clinic) -> None:
    clinic.file("/home/sam/.bashrc", "# mine\n\nsource ~/old_ws/install/setup.bash\n")
    assert_ill(clinic.look("startup-files"), "warning", "Line 3 of ~/.bashrc", "nano +3 ~/.bashrc")


def test_well_startup_files(clinic: Clinic) -> None:
    assert_well(clinic.look("startup-files"))
    clinic.apt(sourced=False).file("/home/sam/.bashrc", ". /opt/ros/jazzy/setup.bash\n")
    assert_well(clinic.look("startup-files"))


def test_ill_dead_prefixes(clinic: Clinic) -> None:
    finding = clinic.look("dead-prefixes", AMENT_PREFIX_PATH="/gone/install/chatter")
    assert_ill(finding, "warning", "/gone/install/chatter")


def test_well_dead_prefixes(clinic: Clinic) -> None:
    assert_well(clinic.look("dead-prefixes", AMENT_PREFIX_PATH=f"{clinic.root}/course/.venv:"))


def test_ill_overlay(clinic: Clinic) -> None:
    """A terminal that only builds is as the lessons want it, so this is no warning."""
    clinic.installed(clinic.package())
    finding = clinic.look("overlay")
    assert_ill(finding, "advice", "does not know", "install/setup.bash")
    assert "greeter" in finding.found and "where you only build, that is right" in finding.found


def test_ill_overlay__of_packages_that_were_built_later(clinic: Clinic) -> None:
    """A terminal that is for running, and was sourced before they were there: each is named."""
    prefix = clinic.installed(clinic.package())
    for name in ("waver", "bower"):
        clinic.file(f"/home/sam/roslings_ws/install/{name}/share/{name}/package.xml")
    finding = clinic.look("overlay", AMENT_PREFIX_PATH=str(prefix))
    assert_ill(finding, "warning", "built later: bower, waver", "install/setup.bash")


@pytest.mark.parametrize("merged", [False, True])
def test_well_overlay(clinic: Clinic, merged: bool) -> None:
    assert_absent(clinic.look("overlay"))
    prefix = clinic.installed(clinic.package())
    if merged:
        shutil.move(prefix / "share", prefix.parent / "share")
        prefix = prefix.parent
    assert_well(clinic.look("overlay", AMENT_PREFIX_PATH=str(prefix)))


EVENT = "[1.3] (greeter) Command: {{'cmd': ['python3'], 'env': {{'AMENT_PREFIX_PATH': '{}'}}}}\n"


def test_ill_build_terminal(clinic: Clinic) -> None:
    before = f"{clinic.machine.workspace}/install/greeter:/opt/ros/jazzy"
    clinic.file("/home/sam/roslings_ws/log/latest_build/events.log", EVENT.format(before))
    assert_ill(
        clinic.look("build-terminal"), "advice", "sourced the same workspace", "colcon build"
    )


def test_well_build_terminal(clinic: Clinic) -> None:
    assert_absent(clinic.look("build-terminal"))
    log = "/home/sam/roslings_ws/log/latest_build/events.log"
    clinic.file(log, EVENT.format("/opt/ros/jazzy"))
    assert_well(clinic.look("build-terminal"))


def test_ill_python_path(clinic: Clinic) -> None:
    clinic.file("/home/sam/rclpy.py")
    assert_ill(clinic.look("python-path"), "warning", "rclpy.py", "my_rclpy.py")


def test_well_python_path(clinic: Clinic) -> None:
    clinic.file("/home/sam/talker.py")
    assert_well(clinic.look("python-path"))


@pytest.mark.parametrize(
    ("value", "status"),
    [
        ("seven", "fault"),
        ("-1", "fault"),
        ("1.5", "fault"),
        ("300", "fault"),
        ("99999999999999999999", "fault"),
        ("150", "warning"),
    ],
)
def test_ill_domain_id(clinic: Clinic, value: str, status: str) -> None:
    assert_ill(clinic.look("domain-id", ROS_DOMAIN_ID=value), status, value, "export ROS_DOMAIN_ID")


def test_the_line_that_brings_a_wrong_value_back_is_named(clinic: Clinic) -> None:
    clinic.file("/home/sam/.bashrc", "# robots\nexport ROS_DOMAIN_ID=seven\n")
    mend = clinic.look("domain-id", ROS_DOMAIN_ID="seven").mend
    assert any("Delete line 2 of ~/.bashrc: export ROS_DOMAIN_ID=seven" in s.text for s in mend)


@pytest.mark.parametrize("value", ["", "0", "42", "101"])
def test_well_domain_id(clinic: Clinic, value: str) -> None:
    assert_well(clinic.look("domain-id", ROS_DOMAIN_ID=value))


def test_ill_localhost_only(clinic: Clinic) -> None:
    finding = clinic.look("localhost-only", ROS_LOCALHOST_ONLY="1")
    assert_ill(finding, "warning", "ignores the discovery range", "unset ROS_LOCALHOST_ONLY")


def test_ill_localhost_only__outdated(clinic: Clinic) -> None:
    assert_ill(clinic.look("localhost-only", ROS_LOCALHOST_ONLY="0"), "advice", "no effect")


def test_well_localhost_only(clinic: Clinic) -> None:
    assert_well(clinic.look("localhost-only"))


def test_ill_discovery_range(clinic: Clinic) -> None:
    finding = clinic.look("discovery-range", ROS_AUTOMATIC_DISCOVERY_RANGE="OFF")
    assert_ill(finding, "fault", "OFF", "RANGE=LOCALHOST")


def test_ill_discovery_range__small_letters(clinic: Clinic) -> None:
    finding = clinic.look("discovery-range", ROS_AUTOMATIC_DISCOVERY_RANGE="subnet")
    assert_ill(finding, "warning", "'subnet' is no discovery range", "RANGE=SUBNET")


@pytest.mark.parametrize("value", ["", "SUBNET", "LOCALHOST", "SYSTEM_DEFAULT"])
def test_well_discovery_range(clinic: Clinic, value: str) -> None:
    assert_well(clinic.look("discovery-range", ROS_AUTOMATIC_DISCOVERY_RANGE=value))


def test_ill_dds_settings(clinic: Clinic) -> None:
    finding = clinic.look("dds-settings", CYCLONEDDS_URI="file:///gone/cyclone.xml")
    assert_ill(finding, "warning", "/gone/cyclone.xml", "unset CYCLONEDDS_URI")


def test_ill_dds_settings__discovery_server(clinic: Clinic) -> None:
    finding = clinic.look("dds-settings", ROS_DISCOVERY_SERVER="192.0.2.7:11811")
    assert_ill(finding, "advice", "only while that server runs", "unset ROS_DISCOVERY_SERVER")


def test_well_dds_settings(clinic: Clinic) -> None:
    profile = clinic.file("/home/sam/profile.xml")
    assert_well(clinic.look("dds-settings", FASTRTPS_DEFAULT_PROFILES_FILE=str(profile)))
    assert_well(clinic.look("dds-settings", CYCLONEDDS_URI="<CycloneDDS/>"))


def test_ill_transport(clinic: Clinic) -> None:
    finding = clinic.look(
        "transport", FASTDDS_BUILTIN_TRANSPORTS="UDPv4", ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST"
    )
    assert_ill(finding, "warning", "messages get lost", "unset FASTDDS_BUILTIN_TRANSPORTS")


def test_well_transport(clinic: Clinic) -> None:
    assert_well(clinic.look("transport", FASTDDS_BUILTIN_TRANSPORTS="UDPv4"))


IN_A_DEAD_NETWORK = """
from ros_doctor.checks.network import LOOPBACK, multicast_problem
print(multicast_problem(LOOPBACK))
"""


def test_ill_multicast() -> None:
    """A new network namespace has a loopback that is down: a real packet cannot pass."""
    skip_without("unshare")
    ran = subprocess.run(
        ["unshare", "-Urn", sys.executable, "-c", IN_A_DEAD_NETWORK],
        env={**os.environ, "PYTHONPATH": ":".join(sys.path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert ran.stdout.strip(), ran.stderr


def test_ill_multicast__no_such_card(clinic: Clinic, monkeypatch: pytest.MonkeyPatch) -> None:
    """192.0.2.0/24 is for examples: no network card of a real machine has an address in it."""
    monkeypatch.setattr("ros_doctor.checks.network.LOOPBACK", "192.0.2.253")
    assert_ill(clinic.look("multicast"), "fault", "did not come back", "ip link set lo")
    clinic.program("ufw")
    assert_ill(clinic.look("multicast"), "fault", "did not come back", "ufw allow")
    clinic.file("/.dockerenv")
    assert_ill(clinic.look("multicast"), "warning", "did not come back")


def test_well_multicast(clinic: Clinic) -> None:
    """The loopback of the machine that runs the tests passes a packet or names the reason."""
    problem = multicast_problem(LOOPBACK)
    if problem:
        skip_without("loopback with multicast")
    assert_well(clinic.look("multicast"))


def test_ill_firewall(clinic: Clinic) -> None:
    clinic.file("/etc/ufw/ufw.conf", "# ufw\nENABLED=yes\n")
    assert_ill(clinic.look("firewall"), "advice", "ufw is on", "ufw allow")


def test_ill_firewall__firewalld(clinic: Clinic) -> None:
    clinic.file("/etc/systemd/system/multi-user.target.wants/firewalld.service")
    assert_ill(clinic.look("firewall"), "advice", "firewalld", "firewall-cmd")


def test_well_firewall(clinic: Clinic) -> None:
    clinic.file("/etc/ufw/ufw.conf", "ENABLED=no\n")
    assert_well(clinic.look("firewall"))
    assert_absent(clinic.change(system="Darwin").look("firewall"))


def wsl2(clinic: Clinic, mode: str) -> None:
    clinic.file("/proc/sys/kernel/osrelease", "5.15.153.1-microsoft-standard-WSL2\n")
    clinic.program("wslinfo", f'test "$1" = --networking-mode && echo {mode}')


def test_ill_wsl_network(clinic: Clinic) -> None:
    wsl2(clinic, "nat")
    assert_ill(clinic.look("wsl-network"), "advice", "'nat'", "networkingMode=mirrored")


def test_well_wsl_network(clinic: Clinic) -> None:
    assert_absent(clinic.look("wsl-network"))
    wsl2(clinic, "mirrored")
    assert_well(clinic.look("wsl-network"))


def test_an_old_wsl_is_not_guessed(clinic: Clinic) -> None:
    wsl2(clinic, "")
    clinic.program("wslinfo", "exit 1")
    assert clinic.look("wsl-network").status == Status.UNKNOWN


def start_daemon(clinic: Clinic, domain: str = "0", **env: str) -> None:
    words = ["python3", "-c", "from ros2cli.daemon.daemonize import main", "--ros-domain-id"]
    clinic.file("/proc/77/cmdline", "\0".join([*words, domain, ""]))
    clinic.file("/proc/77/environ", "\0".join(f"{k}={v}" for k, v in env.items()) + "\0")


def test_ill_daemon(clinic: Clinic) -> None:
    start_daemon(clinic, PATH="/usr/bin", ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET")
    finding = clinic.look("daemon", ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST")
    assert_ill(finding, "warning", "another ROS_AUTOMATIC_DISCOVERY_RANGE", "ros2 daemon stop")


def test_ill_daemon__another_middleware(clinic: Clinic) -> None:
    start_daemon(clinic, PATH="/usr/bin", RMW_IMPLEMENTATION="rmw_zenoh_cpp")
    assert_ill(clinic.look("daemon"), "warning", "another RMW_IMPLEMENTATION", "daemon stop")


def test_well_daemon(clinic: Clinic) -> None:
    assert_well(clinic.look("daemon"))
    start_daemon(clinic, domain="5", PATH="/usr/bin", RMW_IMPLEMENTATION="rmw_zenoh_cpp")
    assert_well(clinic.look("daemon"))
    assert_ill(clinic.look("daemon", ROS_DOMAIN_ID="5"), "warning", "RMW_IMPLEMENTATION")
