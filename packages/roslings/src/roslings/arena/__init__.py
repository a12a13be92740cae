"""A place where someone else's nodes run and end; knows no messages and no points.

Namespace or leased domain, transport, discovery, environment, signals, orphans: these must agree
with each other, so they live together.
"""

from ros2_on_pip.domain_lease import NoFreeDomain
from ros2_on_pip.profiles import QUICK_DISCOVERY
from roslings.arena import kernel
from roslings.arena.arena import Arena, ArenaPlace, Installed, opened
from roslings.arena.companion import Companion, Plan
from roslings.arena.environment import (
    Wall,
    base_environment,
    ros_environment,
)
from roslings.arena.hosts import Host, Hosts, NoHosts, two_hosts
from roslings.arena.isolation import Isolation, choose_isolation, isolation_for_strangers
from roslings.arena.process import LONGEST_WAIT_S, CannotStart, Launch, Process
from roslings.arena.sandbox import Sandbox
from roslings.arena.users import Lack, NoFreeUser, User

__all__ = [
    "LONGEST_WAIT_S",
    "QUICK_DISCOVERY",
    "Arena",
    "ArenaPlace",
    "CannotStart",
    "Companion",
    "Host",
    "Hosts",
    "Installed",
    "Isolation",
    "Lack",
    "Launch",
    "NoFreeDomain",
    "NoFreeUser",
    "NoHosts",
    "Plan",
    "Process",
    "Sandbox",
    "User",
    "Wall",
    "base_environment",
    "choose_isolation",
    "isolation_for_strangers",
    "kernel",
    "opened",
    "ros_environment",
    "two_hosts",
]
