"""A place where someone else's nodes run and end; knows no messages and no points.

Namespace or leased domain, transport, discovery, environment, signals, orphans: these must agree
with each other, so they live together.
"""

from roslings.arena import kernel
from roslings.arena.arena import Arena, Installed, Place, opened
from roslings.arena.environment import (
    QUICK_DISCOVERY,
    Wall,
    base_environment,
    ros_environment,
)
from roslings.arena.isolation import Isolation, Lack, choose_isolation
from roslings.arena.lease import NoFreeDomain
from roslings.arena.process import LONGEST_WAIT_S, CannotStart, Launch, Process
from roslings.arena.sandbox import Sandbox

__all__ = [
    "LONGEST_WAIT_S",
    "QUICK_DISCOVERY",
    "Arena",
    "CannotStart",
    "Installed",
    "Isolation",
    "Lack",
    "Launch",
    "NoFreeDomain",
    "Place",
    "Process",
    "Sandbox",
    "Wall",
    "base_environment",
    "choose_isolation",
    "kernel",
    "opened",
    "ros_environment",
]
