"""A place where someone else's nodes run and end; knows no messages and no points.

Namespace or leased domain, transport, discovery, environment, signals, orphans: these must agree
with each other, so they live together.
"""

from roslings.arena import kernel
from roslings.arena.arena import Arena, Installed, opened
from roslings.arena.environment import QUICK_DISCOVERY, base_environment, ros_environment
from roslings.arena.isolation import Isolation, Wall, choose_isolation
from roslings.arena.lease import NoFreeDomain
from roslings.arena.process import Launch, Process
from roslings.arena.sandbox import sandbox_missing

__all__ = [
    "QUICK_DISCOVERY",
    "Arena",
    "Installed",
    "Isolation",
    "Launch",
    "NoFreeDomain",
    "Process",
    "Wall",
    "base_environment",
    "choose_isolation",
    "kernel",
    "opened",
    "ros_environment",
    "sandbox_missing",
]
