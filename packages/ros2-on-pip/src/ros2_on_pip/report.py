"""`ros2 doctor --report`: the sections that every bug template asks for, in the real one's form.

What the real one reads from the internet (the newest version of each package) is not known here,
and the section says so.
"""

from __future__ import annotations

import platform
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ros2_on_pip.problem import CommandProblem

if TYPE_CHECKING:
    from ros2_on_pip.discovery import DirectNode

Item = tuple[str, object]
NOT_ASKED = "not known here: it stands in rosdistro, on the internet, which is not asked"
OF_EVERY_NODE = ("/parameter_events", "/rosout")
GAP = 4


@dataclass(frozen=True)
class Section:
    """A part of the report: its title, and what it says."""

    title: str
    items: tuple[Item, ...]

    def lines(self) -> list[str]:
        """The title, and one line for each item; all values begin at one column."""
        width = max((len(name) for name, _ in self.items), default=0) + GAP
        return ["", f"   {self.title}", *(f"{name:{width}}: {said}" for name, said in self.items)]


@dataclass(frozen=True)
class ReportPart:
    """How one section is made, and the themes of our checks that it belongs to."""

    title: str
    themes: tuple[str, ...]
    items: Callable[[DirectNode], Iterator[Item]]
    of_packages: bool = False

    def section(self, direct_node: DirectNode) -> Section:
        """The section; what cannot be looked at is said in its place."""
        try:
            return Section(self.title, tuple(self.items(direct_node)))
        except (ImportError, OSError, CommandProblem) as fault:
            return Section(self.title, (("error", str(fault).splitlines()[0]),))


def sections(parts: list[ReportPart]) -> list[Section]:
    """What is to be said now, with one look at the nodes that run."""
    from ros2_on_pip.discovery import DirectNode

    try:
        with DirectNode() as direct_node:
            direct_node.settle()
            return [part.section(direct_node) for part in parts]
    except (
        CommandProblem
    ) as fault:  # no node of ours can be opened: what needs none is told all the same
        return [part.section(_Blind(fault)) for part in parts]  # type: ignore[arg-type]  # it raises


class _Blind:
    """In place of our node where ROS does not start: it says why as soon as it is asked."""

    def __init__(self, fault: CommandProblem) -> None:
        self._fault = fault

    def __getattr__(self, name: str) -> Any:
        raise self._fault


def _network(_: DirectNode) -> Iterator[Item]:
    from ros2_on_pip.network_cards import cards

    for card in cards():
        said = {
            "inet": card.inet4[-1] if card.inet4 else "",
            "inet4": list(card.inet4),
            "ether": card.ether,
            "inet6": list(card.inet6),
            "netmask": card.netmask,
            "device": card.name,
            "flags": ",".join(card.flags).upper(),
            "mtu": card.mtu,
            "broadcast": card.broadcast,
        }
        yield from ((name, value) for name, value in said.items() if value)


def _packages(_: DirectNode) -> Iterator[Item]:
    from ros2_on_pip.packages import packages

    yield "latest", NOT_ASKED
    for name in sorted(packages()):
        yield name, f"latest=N/A, local={_version(name) or 'N/A'}"


def _version(package: str) -> str:
    from xml.etree import ElementTree

    from ros2_on_pip.packages import share_of

    try:
        root = ElementTree.parse(share_of(package) / "package.xml").getroot()
    except (OSError, ElementTree.ParseError):
        return ""
    return (root.findtext("version") or "").strip()


def _platform(_: DirectNode) -> Iterator[Item]:
    yield "system", platform.system()
    yield "platform info", platform.platform()
    yield "release", platform.release()
    yield "processor", platform.processor() or platform.machine()


def _qos(direct_node: DirectNode) -> Iterator[Item]:
    from rclpy.qos import QoSCompatibility, qos_check_compatible

    none = True
    for topic in _topics(direct_node):
        for publisher in direct_node.publishers(topic):
            for subscription in direct_node.subscriptions(topic):
                none = False
                fits, why = qos_check_compatible(publisher.qos_profile, subscription.qos_profile)
                yield "topic [type]", f"{topic} [{publisher.topic_type}]"
                yield "publisher node", publisher.node_name
                yield "subscriber node", subscription.node_name
                yield "compatibility status", "OK" if fits == QoSCompatibility.OK else why
    if none:
        yield "compatibility status", "No publisher/subscriber pairs found"


def _middleware(_: DirectNode) -> Iterator[Item]:
    from rclpy.utilities import get_rmw_implementation_identifier

    yield "middleware name", get_rmw_implementation_identifier()


def _ros(_: DirectNode) -> Iterator[Item]:
    yield "distribution name", "jazzy"
    yield "distribution type", "ros2"
    yield "distribution status", NOT_ASKED
    yield "release platforms", NOT_ASKED
    yield "installed as", f"{_kind_of_installation()}, Python {platform.python_version()}"
    yield "ros2 command", "that of ros2-on-pip, not ros2cli"


def _kind_of_installation() -> str:
    import rclpy

    place = Path(rclpy.__file__)
    if place.is_relative_to(sys.prefix):
        return "Python packages (wheels)"
    return "apt" if place.is_relative_to("/opt/ros/jazzy") else "built from source"


def _topic_list(direct_node: DirectNode) -> Iterator[Item]:
    for topic in _topics(direct_node) or ["none"]:
        yield "topic", topic
        yield "publisher count", len(direct_node.publishers(topic)) if topic != "none" else 0
        yield "subscriber count", len(direct_node.subscriptions(topic)) if topic != "none" else 0


def _topics(direct_node: DirectNode) -> list[str]:
    return [name for name in direct_node.topics(hidden=False) if name not in OF_EVERY_NODE]


PARTS = (
    ReportPart("NETWORK CONFIGURATION", ("network",), _network),
    ReportPart("PACKAGE VERSIONS", ("install",), _packages, of_packages=True),
    ReportPart("PLATFORM INFORMATION", ("computer",), _platform),
    ReportPart("QOS COMPATIBILITY LIST", ("live",), _qos),
    ReportPart("RMW MIDDLEWARE", ("install", "live"), _middleware),
    ReportPart("ROS 2 INFORMATION", ("install", "shell"), _ros),
    ReportPart("TOPIC LIST", ("live",), _topic_list),
)
"""In the order of the real one."""
