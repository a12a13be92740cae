"""How nodes find each other: domain, discovery range, middleware settings, firewall, daemon."""

from __future__ import annotations

import re
import secrets
import socket
import struct
from dataclasses import dataclass
from pathlib import Path

from ros_doctor.finding import (
    Finding,
    advice,
    do,
    fault,
    not_applicable,
    ok,
    say,
    unknown,
    warning,
)
from ros_doctor.machine import Machine, exists
from ros_doctor.mends import lines_that_set, set_to, unset
from ros_doctor.registry import check
from ros_doctor.surroundings import container, wsl

LAST_SAFE_DOMAIN = 101  # https://docs.ros.org/en/jazzy/Concepts/Intermediate/About-Domain-ID.html
LAST_DOMAIN = 232  # its ports end at 65535
RANGES = ("SUBNET", "LOCALHOST", "SYSTEM_DEFAULT")
LOOPBACK = "127.0.0.1"
GROUP = "225.0.0.1"  # the group that `ros2 multicast` uses; here it stays inside this computer
PATIENCE_S = 0.3


@check(
    "domain-id",
    "ROS_DOMAIN_ID is a number from 0 to 101",
    looks_at="the variable ROS_DOMAIN_ID",
    lesson="01-install#domain",
    rows=(17,),
)
def domain_id(machine: Machine) -> Finding:
    """A node stops: 'ROS_DOMAIN_ID is not an integral number', or nodes never meet."""
    value = machine.env.get("ROS_DOMAIN_ID", "")
    if not value:
        return ok("It is not set: the domain is 0.")
    why = "Use the same number in every terminal of one robot:"
    mend = set_to(machine, "ROS_DOMAIN_ID", "0", why)
    if not re.fullmatch(r"\d{1,9}", value):
        return fault(f"ROS_DOMAIN_ID is '{value}'. It must be a whole number.", *mend)
    if int(value) > LAST_DOMAIN:
        return fault(f"ROS_DOMAIN_ID is {value}. The largest is {LAST_DOMAIN}.", *mend)
    if int(value) > LAST_SAFE_DOMAIN:
        return warning(
            f"ROS_DOMAIN_ID is {value}. Above {LAST_SAFE_DOMAIN}, its ports may be taken.",
            *mend,
        )
    return ok(f"The domain is {int(value)}.")


@check(
    "localhost-only",
    "The old variable ROS_LOCALHOST_ONLY is not set",
    looks_at="the variable ROS_LOCALHOST_ONLY",
    lesson="01-install#discovery",
    rows=(18,),
)
def localhost_only(machine: Machine) -> Finding:
    """The robot is invisible, and each node prints 'ROS_LOCALHOST_ONLY is deprecated'."""
    value = machine.env.get("ROS_LOCALHOST_ONLY", "")
    if not value:
        return ok("It is not set.")
    new = "LOCALHOST" if value == "1" else "SUBNET"
    mend = (
        *unset(machine, "ROS_LOCALHOST_ONLY"),
        do(f"export ROS_AUTOMATIC_DISCOVERY_RANGE={new}", "Say the same in Jazzy's words:"),
    )
    if value == "1":
        return warning("ROS_LOCALHOST_ONLY is 1. ROS then ignores the discovery range.", *mend)
    return advice(f"ROS_LOCALHOST_ONLY is {value}. It is outdated and has no effect.", *mend)


@check(
    "discovery-range",
    "Nodes may look for each other",
    looks_at="the variable ROS_AUTOMATIC_DISCOVERY_RANGE",
    lesson="01-install#discovery",
    rows=(19,),
)
def discovery_range(machine: Machine) -> Finding:
    """Two nodes run on one computer, and neither sees the other."""
    value = machine.env.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "")
    name = "ROS_AUTOMATIC_DISCOVERY_RANGE"
    mend = (
        do(f"export {name}=LOCALHOST", "On one computer:"),
        do(f"export {name}=SUBNET", "Or, with a robot in the same network:"),
        *lines_that_set(machine, name),
    )
    if value == "OFF":
        return fault("The discovery range is OFF: no node finds another.", *mend)
    if value and value not in RANGES:
        return warning(f"'{value}' is no discovery range. ROS takes LOCALHOST instead.", *mend)
    return ok(f"The range is {value or 'SUBNET (nothing is set)'}.")


@check(
    "dds-settings",
    "Settings of the middleware point to files that exist",
    looks_at="FASTRTPS_DEFAULT_PROFILES_FILE, FASTDDS_DEFAULT_PROFILES_FILE, CYCLONEDDS_URI,"
    " ROS_DISCOVERY_SERVER",
    lesson="reference/real-robot#network",
)
def dds_settings(machine: Machine) -> Finding:
    """Nodes behave differently in two terminals, or do not see each other in one."""
    for name in (
        "FASTRTPS_DEFAULT_PROFILES_FILE",
        "FASTDDS_DEFAULT_PROFILES_FILE",
        "CYCLONEDDS_URI",
    ):
        value = machine.env.get(name, "").removeprefix("file://")
        if value and "<" not in value and not exists(Path(value)):
            return warning(f"{name} names a file that is gone: {value}", *unset(machine, name))
    if machine.env.get("ROS_DISCOVERY_SERVER"):
        return advice(
            "ROS_DISCOVERY_SERVER is set. Nodes meet only while that server runs.",
            say("Do you use such a server? Then leave it. If not:"),
            *unset(machine, "ROS_DISCOVERY_SERVER"),
        )
    return ok("Nothing unusual is set.")


@check(
    "transport",
    "Discovery range and transport fit together",
    looks_at="FASTDDS_BUILTIN_TRANSPORTS and ROS_AUTOMATIC_DISCOVERY_RANGE",
    lesson="03-topics/step-by-step#same-machine",
)
def transport(machine: Machine) -> Finding:
    """ros2 topic list shows the topic, but ros2 topic echo prints nothing."""
    value = machine.env.get("FASTDDS_BUILTIN_TRANSPORTS", "")
    near = machine.env.get("ROS_AUTOMATIC_DISCOVERY_RANGE") == "LOCALHOST"
    if value not in ("", "DEFAULT") and near:
        return warning(
            f"FASTDDS_BUILTIN_TRANSPORTS is {value}. With the range LOCALHOST, messages get lost.",
            *unset(machine, "FASTDDS_BUILTIN_TRANSPORTS"),
        )
    return ok("They fit.")


@check(
    "multicast",
    "This computer hears its own multicast",
    looks_at="a real packet to oneself; it never leaves this computer",
    lesson="01-install#multicast",
    rows=(22,),
)
def multicast(machine: Machine) -> Finding:
    """Two nodes on one computer do not find each other."""
    problem = multicast_problem(LOOPBACK)
    if not problem:
        return ok("A packet to oneself came back.")
    mend = (
        do(
            "sudo ip link set lo up\nsudo ip link set lo multicast on\n"
            "sudo ip route add 224.0.0.0/4 dev lo",
            "Allow it on the inner network card:",
        ),
        *(FIREWALL_RULES if machine.which("ufw") else ()),
    )
    if container(machine):
        return warning(f"A packet to oneself did not come back ({problem}).", *mend)
    return fault(f"A packet to oneself did not come back ({problem}).", *mend)


FIREWALL_RULES = (
    do(
        "sudo ufw allow in proto udp to 224.0.0.0/4\nsudo ufw allow in proto udp from 224.0.0.0/4",
        "Let the firewall pass multicast:",
    ),
)


def multicast_problem(address: str) -> str:
    """Send one packet to a multicast group through the network card that has `address`.

    Time to live 0 keeps the packet inside this computer, whatever card it is.
    Returns "" when it came back, else the reason in a few words.
    """
    word = secrets.token_bytes(8)
    try:
        with _receiver(address) as receiver, _sender(address) as sender:
            receiver.settimeout(PATIENCE_S)
            sender.sendto(word, (GROUP, receiver.getsockname()[1]))
            while receiver.recv(64) != word:
                pass  # a stranger's packet to the same group and port
    except TimeoutError:
        return "it was lost"
    except OSError as problem:
        return problem.strerror or str(problem)
    return ""


def _receiver(address: str) -> socket.socket:
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        receiver.bind(("", 0))
        member = socket.inet_aton(GROUP) + socket.inet_aton(address)
        receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)
    except OSError:
        receiver.close()
        raise
    return receiver


def _sender(address: str) -> socket.socket:
    sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        card = socket.inet_aton(address)
        sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, card)
        sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, struct.pack("b", 0))
        sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_LOOP, 1)
    except OSError:
        sender.close()
        raise
    return sender


@check(
    "firewall",
    "No firewall stands between you and a robot",
    looks_at="/etc/ufw/ufw.conf and the start list of firewalld",
    lesson="reference/real-robot#network",
    rows=(22,),
)
def firewall(machine: Machine) -> Finding:
    """The robot answers to ping, but its topics do not appear on your laptop."""
    if not machine.linux:
        return not_applicable("the doctor knows only the firewalls of Linux")
    if re.search(r"^ENABLED=yes", machine.read("/etc/ufw/ufw.conf"), re.M):
        return advice(
            "The firewall ufw is on. It may stop the nodes of other computers.",
            say("Do this only if you use a robot or a second computer."),
            *FIREWALL_RULES,
        )
    wants = machine.path("/etc/systemd/system/multi-user.target.wants/firewalld.service")
    if wants.is_symlink() or exists(wants):
        return advice(
            "The firewall firewalld is on. It may stop the nodes of other computers.",
            say("Do this only if you use a robot or a second computer."),
            do("sudo firewall-cmd --add-port=7400-32900/udp"),
        )
    return ok("ufw and firewalld are off.")


@check(
    "wsl-network",
    "WSL shares the network of Windows",
    looks_at="wslinfo --networking-mode",
    lesson="01-install#windows",
    rows=(23,),
    live=True,
)
def wsl_network(machine: Machine) -> Finding:
    """The robot sees other laptops, but never the one with WSL."""
    if wsl(machine) != 2:
        return not_applicable("this is not WSL 2")
    ran = machine.run("wslinfo", "--networking-mode")
    mode = ran.output.strip() if ran and ran.code == 0 else ""
    if mode == "mirrored":
        return ok("The network is mirrored.")
    if not mode:
        return unknown("this WSL is too old to tell its network mode: run wsl --update in Windows")
    return advice(
        f"The network mode is '{mode}'. Labs work, but a robot cannot reach you.",
        say("In Windows 11, open the file .wslconfig in your user folder (%UserProfile%)."),
        say("Write these two lines into it:"),
        do("[wsl2]\nnetworkingMode=mirrored"),
        do("wsl --shutdown", "In PowerShell, restart WSL:"),
    )


@dataclass(frozen=True)
class Daemon:
    """A running helper process of the `ros2` commands: its number and its variables."""

    pid: int
    env: dict[str, str]
    domain: str


# What the daemon was started with and does not notice when it changes.
DAEMON_VARIABLES = (
    "RMW_IMPLEMENTATION",
    "ROS_AUTOMATIC_DISCOVERY_RANGE",
    "ROS_LOCALHOST_ONLY",
    "ROS_STATIC_PEERS",
    "ROS_DISCOVERY_SERVER",
)


def daemons(machine: Machine) -> list[Daemon]:
    """Return the running ros2 daemons that this user may look at."""
    found = []
    for folder in sorted(machine.path("/proc").glob("[0-9]*")):
        command = read_bytes(folder / "cmdline").split("\0")
        if any("ros2cli.daemon" in word or "_ros2_daemon" in word for word in command):
            pairs = (line.partition("=") for line in read_bytes(folder / "environ").split("\0"))
            env = {name: value for name, _, value in pairs if name}
            found.append(Daemon(int(folder.name), env, _domain_of(command, env)))
    return found


def read_bytes(path: Path) -> str:
    """Return a file of /proc, whose texts are parted by zeros; "" where it may not be read."""
    try:
        return path.read_bytes().decode(errors="replace")
    except OSError:
        return ""


def _domain_of(command: list[str], env: dict[str, str]) -> str:
    if "--ros-domain-id" in command[:-1]:
        return command[command.index("--ros-domain-id") + 1]
    return env.get("ROS_DOMAIN_ID", "") or "0"


@check(
    "daemon",
    "The ros2 daemon has the same settings as this terminal",
    looks_at="the running daemon of your domain, and the variables it was started with",
    lesson="reference/faq#a-list-shows-nodes-that-have-ended",
    rows=(20, 21),
)
def daemon(machine: Machine) -> Finding:
    """ros2 node list shows nodes that have ended, or none of those that run."""
    if not exists(machine.path("/proc")):
        return not_applicable("only Linux lists its programs in /proc")
    domain = machine.env.get("ROS_DOMAIN_ID", "") or "0"
    mine = [one for one in daemons(machine) if one.domain == domain]
    if not mine:
        return ok("No daemon runs; ros2 starts one when it needs it.")
    stale = [
        name
        for name in DAEMON_VARIABLES
        if mine[0].env and mine[0].env.get(name, "") != machine.env.get(name, "")
    ]
    if not stale:
        return ok("The daemon has the same settings.")
    return warning(
        f"The daemon was started with another {stale[0]}.",
        do("ros2 daemon stop", "Stop it. The next ros2 command starts a fresh one:"),
    )
