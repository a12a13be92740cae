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
    MendStep,
    advice,
    do,
    fault,
    not_applicable,
    ok,
    say,
    unknown,
    warning,
)
from ros_doctor.machine import ExaminedMachine, exists
from ros_doctor.mends import lines_that_set, set_to, unset
from ros_doctor.registry import check
from ros_doctor.surroundings import container, wsl
from ros_doctor.texts import said

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
def domain_id(machine: ExaminedMachine) -> Finding:
    """A node stops: 'ROS_DOMAIN_ID is not an integral number', or nodes never meet."""
    value = machine.env.get("ROS_DOMAIN_ID", "")
    if not value:
        return ok(said("doctor.network.domain_id.ok", "It is not set: the domain is 0."))
    why = said(
        "doctor.network.domain_id.why", "Use the same number in every terminal of one robot:"
    )
    mend = set_to(machine, "ROS_DOMAIN_ID", "0", why)
    if not re.fullmatch(r"\d{1,9}", value):
        return fault(
            said(
                "doctor.network.domain_id.fault",
                "ROS_DOMAIN_ID is '{value}'. It must be a whole number.",
                value=value,
            ),
            *mend,
        )
    if int(value) > LAST_DOMAIN:
        return fault(
            said(
                "doctor.network.domain_id.fault_2",
                "ROS_DOMAIN_ID is {value}. The largest is {last_domain}.",
                value=value,
                last_domain=LAST_DOMAIN,
            ),
            *mend,
        )
    if int(value) > LAST_SAFE_DOMAIN:
        return warning(
            said(
                "doctor.network.domain_id.warning",
                "ROS_DOMAIN_ID is {value}. Above {last_safe_domain}, its ports may be taken.",
                value=value,
                last_safe_domain=LAST_SAFE_DOMAIN,
            ),
            *mend,
        )
    return ok(said("doctor.network.domain_id.ok_2", "The domain is {value}.", value=int(value)))


@check(
    "localhost-only",
    "The old variable ROS_LOCALHOST_ONLY is not set",
    looks_at="the variable ROS_LOCALHOST_ONLY",
    lesson="01-install#discovery",
    rows=(18,),
)
def localhost_only(machine: ExaminedMachine) -> Finding:
    """The robot is invisible, and each node prints 'ROS_LOCALHOST_ONLY is deprecated'."""
    value = machine.env.get("ROS_LOCALHOST_ONLY", "")
    if not value:
        return ok(said("doctor.network.localhost_only.ok", "It is not set."))
    new = "LOCALHOST" if value == "1" else "SUBNET"
    mend = (
        *unset(machine, "ROS_LOCALHOST_ONLY"),
        do(
            f"export ROS_AUTOMATIC_DISCOVERY_RANGE={new}",
            said("doctor.network.localhost_only.do", "Say the same in Jazzy's words:"),
        ),
    )
    if value == "1":
        return warning(
            said(
                "doctor.network.localhost_only.warning",
                "ROS_LOCALHOST_ONLY is 1. ROS then ignores the discovery range.",
            ),
            *mend,
        )
    return advice(
        said(
            "doctor.network.localhost_only.advice",
            "ROS_LOCALHOST_ONLY is {value}. It is outdated and has no effect.",
            value=value,
        ),
        *mend,
    )


@check(
    "discovery-range",
    "Nodes may look for each other",
    looks_at="the variable ROS_AUTOMATIC_DISCOVERY_RANGE",
    lesson="01-install#discovery",
    rows=(19,),
)
def discovery_range(machine: ExaminedMachine) -> Finding:
    """Two nodes run on one computer, and neither sees the other."""
    value = machine.env.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "")
    name = "ROS_AUTOMATIC_DISCOVERY_RANGE"
    mend = (
        do(
            f"export {name}=LOCALHOST",
            said("doctor.network.discovery_range.do", "On one computer:"),
        ),
        do(
            f"export {name}=SUBNET",
            said("doctor.network.discovery_range.do_2", "Or, with a robot in the same network:"),
        ),
        *lines_that_set(machine, name),
    )
    if value == "OFF":
        return fault(
            said(
                "doctor.network.discovery_range.fault",
                "The discovery range is OFF: no node finds another.",
            ),
            *mend,
        )
    if value and value not in RANGES:
        return warning(
            said(
                "doctor.network.discovery_range.warning",
                "'{value}' is no discovery range. ROS takes LOCALHOST instead.",
                value=value,
            ),
            *mend,
        )
    return ok(
        said(
            "doctor.network.discovery_range.ok",
            "The range is {value}.",
            value=value or said("doctor.network.discovery_range.unset", "SUBNET (nothing is set)"),
        )
    )


@check(
    "dds-settings",
    "Settings of the middleware point to files that exist",
    looks_at="FASTRTPS_DEFAULT_PROFILES_FILE, FASTDDS_DEFAULT_PROFILES_FILE, CYCLONEDDS_URI,"
    " ROS_DISCOVERY_SERVER",
    lesson="reference/real-robot#network",
)
def dds_settings(machine: ExaminedMachine) -> Finding:
    """Nodes behave differently in two terminals, or do not see each other in one."""
    for name in (
        "FASTRTPS_DEFAULT_PROFILES_FILE",
        "FASTDDS_DEFAULT_PROFILES_FILE",
        "CYCLONEDDS_URI",
    ):
        value = machine.env.get(name, "").removeprefix("file://")
        if value and "<" not in value and not exists(Path(value)):
            return warning(
                said(
                    "doctor.network.dds_settings.warning",
                    "{name} names a file that is gone: {value}",
                    name=name,
                    value=value,
                ),
                *unset(machine, name),
            )
    if machine.env.get("ROS_DISCOVERY_SERVER"):
        return advice(
            said(
                "doctor.network.dds_settings.advice",
                "ROS_DISCOVERY_SERVER is set. Nodes meet only while that server runs.",
            ),
            say(
                said(
                    "doctor.network.dds_settings.say",
                    "Do you use such a server? Then leave it. If not:",
                )
            ),
            *unset(machine, "ROS_DISCOVERY_SERVER"),
        )
    return ok(said("doctor.network.dds_settings.ok", "Nothing unusual is set."))


@check(
    "transport",
    "Discovery range and transport fit together",
    looks_at="FASTDDS_BUILTIN_TRANSPORTS and ROS_AUTOMATIC_DISCOVERY_RANGE",
    lesson="03-topics/step-by-step#same-machine",
)
def transport(machine: ExaminedMachine) -> Finding:
    """ros2 topic list shows the topic, but ros2 topic echo prints nothing."""
    value = machine.env.get("FASTDDS_BUILTIN_TRANSPORTS", "")
    near = machine.env.get("ROS_AUTOMATIC_DISCOVERY_RANGE") == "LOCALHOST"
    if value not in ("", "DEFAULT") and near:
        return warning(
            said(
                "doctor.network.transport.warning",
                "FASTDDS_BUILTIN_TRANSPORTS is {value}. With the range LOCALHOST, "
                "messages get lost.",
                value=value,
            ),
            *unset(machine, "FASTDDS_BUILTIN_TRANSPORTS"),
        )
    return ok(said("doctor.network.transport.ok", "They fit."))


@check(
    "multicast",
    "This computer hears its own multicast",
    looks_at="a real packet to oneself; it never leaves this computer",
    lesson="01-install#multicast",
    rows=(22,),
)
def multicast(machine: ExaminedMachine) -> Finding:
    """Two nodes on one computer do not find each other."""
    problem = multicast_problem(LOOPBACK)
    if not problem:
        return ok(said("doctor.network.multicast.ok", "A packet to oneself came back."))
    mend = (
        do(
            "sudo ip link set lo up\nsudo ip link set lo multicast on\n"
            "sudo ip route add 224.0.0.0/4 dev lo",
            said("doctor.network.multicast.do", "Allow it on the inner network card:"),
        ),
        *((firewall_rules(),) if machine.which("ufw") else ()),
    )
    if container(machine):
        return warning(
            said(
                "doctor.network.multicast.warning",
                "A packet to oneself did not come back ({problem}).",
                problem=problem,
            ),
            *mend,
        )
    return fault(
        said(
            "doctor.network.multicast.fault",
            "A packet to oneself did not come back ({problem}).",
            problem=problem,
        ),
        *mend,
    )


def firewall_rules() -> MendStep:
    """Return how to let multicast pass through ufw."""
    return do(
        "sudo ufw allow in proto udp to 224.0.0.0/4\nsudo ufw allow in proto udp from 224.0.0.0/4",
        said("doctor.network.firewall_rules.do", "Let the firewall pass multicast:"),
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
        return said("doctor.network.multicast.lost", "it was lost")
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
def firewall(machine: ExaminedMachine) -> Finding:
    """The robot answers to ping, but its topics do not appear on your laptop."""
    if not machine.linux:
        return not_applicable(
            said(
                "doctor.network.firewall.not_applicable",
                "the doctor knows only the firewalls of Linux",
            )
        )
    if re.search(r"^ENABLED=yes", machine.read("/etc/ufw/ufw.conf"), re.M):
        return advice(
            said(
                "doctor.network.firewall.advice",
                "The firewall ufw is on. It may stop the nodes of other computers.",
            ),
            say(
                said(
                    "doctor.network.firewall.say",
                    "Do this only if you use a robot or a second computer.",
                )
            ),
            firewall_rules(),
        )
    wants = machine.path("/etc/systemd/system/multi-user.target.wants/firewalld.service")
    if wants.is_symlink() or exists(wants):
        return advice(
            said(
                "doctor.network.firewall.advice_2",
                "The firewall firewalld is on. It may stop the nodes of other computers.",
            ),
            say(
                said(
                    "doctor.network.firewall.say_2",
                    "Do this only if you use a robot or a second computer.",
                )
            ),
            do("sudo firewall-cmd --add-port=7400-32900/udp"),
        )
    return ok(said("doctor.network.firewall.ok", "ufw and firewalld are off."))


@check(
    "wsl-network",
    "WSL shares the network of Windows",
    looks_at="wslinfo --networking-mode",
    lesson="01-install#windows",
    rows=(23,),
    live=True,
)
def wsl_network(machine: ExaminedMachine) -> Finding:
    """The robot sees other laptops, but never the one with WSL."""
    if wsl(machine) != 2:
        return not_applicable(
            said("doctor.network.wsl_network.not_applicable", "this is not WSL 2")
        )
    ran = machine.run("wslinfo", "--networking-mode")
    mode = ran.output.strip() if ran and ran.code == 0 else ""
    if mode == "mirrored":
        return ok(said("doctor.network.wsl_network.ok", "The network is mirrored."))
    if not mode:
        return unknown(
            said(
                "doctor.network.wsl_network.unknown",
                "this WSL is too old to tell its network mode: run wsl --update in Windows",
            )
        )
    return advice(
        said(
            "doctor.network.wsl_network.advice",
            "The network mode is '{mode}'. Labs work, but a robot cannot reach you.",
            mode=mode,
        ),
        say(
            said(
                "doctor.network.wsl_network.say",
                "In Windows 11, open the file .wslconfig in your user folder (%UserProfile%).",
            )
        ),
        say(said("doctor.network.wsl_network.say_2", "Write these two lines into it:")),
        do("[wsl2]\nnetworkingMode=mirrored"),
        do("wsl --shutdown", said("doctor.network.wsl_network.do", "In PowerShell, restart WSL:")),
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


def daemons(machine: ExaminedMachine) -> list[Daemon]:
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
def daemon(machine: ExaminedMachine) -> Finding:
    """ros2 node list shows nodes that have ended, or none of those that run."""
    if not exists(machine.path("/proc")):
        return not_applicable(
            said("doctor.network.daemon.not_applicable", "only Linux lists its programs in /proc")
        )
    domain = machine.env.get("ROS_DOMAIN_ID", "") or "0"
    mine = [one for one in daemons(machine) if one.domain == domain]
    if not mine:
        return ok(
            said("doctor.network.daemon.ok", "No daemon runs; ros2 starts one when it needs it.")
        )
    stale = [
        name
        for name in DAEMON_VARIABLES
        if mine[0].env and mine[0].env.get(name, "") != machine.env.get(name, "")
    ]
    if not stale:
        return ok(said("doctor.network.daemon.ok_2", "The daemon has the same settings."))
    return warning(
        said(
            "doctor.network.daemon.warning",
            "The daemon was started with another {stale}.",
            stale=stale[0],
        ),
        do(
            "ros2 daemon stop",
            said("doctor.network.daemon.do", "Stop it. The next ros2 command starts a fresh one:"),
        ),
    )
