"""Drive a room beside real nodes: each is a file in `followers`, and a process of its own."""

from __future__ import annotations

import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.domain_lease import leased_domain
from roslings.arena import ros_environment
from roslings.arena.companion import Surroundings
from roslings.arena.environment import base_environment
from roslings.lockstep import (
    DriveBudget,
    LockstepDrive,
    LockstepPlan,
    RealTimePlan,
    drive_beside,
)

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
TICK = Crew(("by_tick",), ("/driver",))
AWAIT = Crew(("by_await",), ("/follower",))
CHAIN = Crew(("eye", "pilot"), ("/eye", "/pilot"))
CREWS = {"timer": TIMER, "scan": SCAN, "goal": GOAL, "tick": TICK, "await": AWAIT, "chain": CHAIN}


def driven(
    crew: Crew,
    *,
    length_s: float = 10.0,
    budget: DriveBudget | None = None,
    scan_every_ticks: int = 4,
    discovery_s: float = 60.0,
) -> LockstepDrive:
    """One drive, with a domain of its own: nodes that were killed linger in discovery."""
    with in_a_domain() as (home, environment), started(crew, environment) as pids:
        plan = LockstepPlan(
            room=ROOM,
            pids=tuple(pids),
            nodes=crew.nodes,
            length_s=length_s,
            budget=budget or DriveBudget(),
            scan_every_ticks=scan_every_ticks,
            discovery_s=discovery_s,
        )
        return drive_beside(plan, Surroundings(environment), home)


def driven_in_real_time(
    crew: Crew,
    *,
    length_s: float = 5.0,
    discovery_s: float = 60.0,
    called_off: threading.Event | None = None,
) -> LockstepDrive:
    """The same by the wall clock, which the nodes follow, too."""
    with in_a_domain() as (home, environment), started(crew, environment, simulated=False):
        plan = RealTimePlan(room=ROOM, length_s=length_s, discovery_s=discovery_s)
        return drive_beside(plan, Surroundings(environment), home, called_off)


@contextmanager
def in_a_domain() -> Iterator[tuple[Path, dict[str, str]]]:
    """A folder, and the environment of all that runs."""
    with tempfile.TemporaryDirectory() as folder, leased_domain() as domain:
        home = Path(folder)
        yield (
            home,
            {
                **base_environment(home),
                **ros_environment("domain"),
                "ROS_DOMAIN_ID": str(domain),
            },
        )


@contextmanager
def started(
    crew: Crew, environment: dict[str, str], simulated: bool = True
) -> Iterator[Sequence[int]]:
    """Its programs, until the block ends."""
    given = [word for each in crew.parameters for word in ("-p", each)]
    more = [*(FOLLOWS_THE_CLOCK if simulated else ["--ros-args"]), *given]
    with ExitStack() as ends:
        pids = []
        for program in crew.programs:
            file = FOLLOWERS / f"{program}.py"
            words = [sys.executable, str(file), *more]
            process = subprocess.Popen(words, env=environment, stderr=subprocess.DEVNULL)
            ends.callback(process.wait, ENDS_WITHIN_S)
            ends.callback(process.kill)
            pids.append(process.pid)
        yield pids
