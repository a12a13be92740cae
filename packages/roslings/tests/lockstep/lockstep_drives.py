"""Drive a room beside real nodes: each is a file in `followers`, and a process of its own."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.domain_lease import leased_domain
from roslings.arena import ros_environment
from roslings.arena.companion import Surroundings
from roslings.arena.environment import base_environment
from roslings.lockstep import Budget, Drive, Plan, drive_beside

FOLLOWERS = Path(__file__).parent / "followers"
ROOM = 17
FOLLOWS_THE_CLOCK = ["--ros-args", "-p", "use_sim_time:=true"]
ENDS_WITHIN_S = 10.0


@dataclass(frozen=True)
class Crew:
    """Programs, and the nodes in them."""

    programs: tuple[str, ...]
    nodes: tuple[str, ...]
    parameters: tuple[str, ...] = ()
    """As `name:=value`."""


TIMER = Crew(("by_timer",), ("/follower",))
SCAN = Crew(("by_scan",), ("/follower",))
GOAL = Crew(("by_goal",), ("/driver", "/asker"))
AWAIT = Crew(("by_await",), ("/follower",))
CHAIN = Crew(("eye", "pilot"), ("/eye", "/pilot"))
CREWS = {"timer": TIMER, "scan": SCAN, "goal": GOAL, "await": AWAIT, "chain": CHAIN}


def driven(
    crew: Crew,
    *,
    length_s: float = 10.0,
    budget: Budget | None = None,
    scan_every_ticks: int = 4,
    discovery_s: float = 60.0,
) -> Drive:
    """One drive, with a domain of its own: nodes that were killed linger in discovery."""
    with tempfile.TemporaryDirectory() as folder, leased_domain() as domain:
        home = Path(folder)
        environment = {
            **base_environment(home),
            **ros_environment("domain"),
            "ROS_DOMAIN_ID": str(domain),
        }
        with started(crew, environment) as pids:
            plan = Plan(
                room=ROOM,
                pids=tuple(pids),
                nodes=crew.nodes,
                length_s=length_s,
                budget=budget or Budget(),
                scan_every_ticks=scan_every_ticks,
                discovery_s=discovery_s,
            )
            return drive_beside(plan, Surroundings(environment), home)


@contextmanager
def started(crew: Crew, environment: dict[str, str]) -> Iterator[Sequence[int]]:
    """Its programs, until the block ends."""
    more = [word for each in crew.parameters for word in ("-p", each)]
    with ExitStack() as ends:
        pids = []
        for program in crew.programs:
            file = FOLLOWERS / f"{program}.py"
            words = [sys.executable, str(file), *FOLLOWS_THE_CLOCK, *more]
            process = subprocess.Popen(words, env=environment, stderr=subprocess.DEVNULL)
            ends.callback(process.wait, ENDS_WITHIN_S)
            ends.callback(process.kill)
            pids.append(process.pid)
        yield pids
