"""A place where someone else's nodes run and end."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, nullcontext
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from ros2_on_pip.domain_lease import leased_domain
from roslings.arena.companion import BEGIN, Companion, Plan, Surroundings
from roslings.arena.environment import Wall, base_environment, ros_environment
from roslings.arena.hosts import Host
from roslings.arena.kernel import waits
from roslings.arena.process import Launch, Process
from roslings.arena.sandbox import Sandbox
from roslings.arena.shared_memory import swept_shared_memory
from roslings.arena.users import User, give, let_in


@dataclass(frozen=True)
class Installed:
    """A built package: where its executables are, and the environment they need."""

    programs: Path
    environment: dict[str, str]
    folder: Path
    """Where all of it lies."""


@dataclass(frozen=True)
class ArenaPlace:
    """Where processes live: behind which walls, with which folders."""

    wall: Wall
    home: Path
    """The processes' HOME; in a sandbox each has an empty one of its own here."""
    devices: Path
    """Where devices appear that the processes may use."""
    sandbox: Sandbox | None = None
    paced: bool = False
    """Whether messages go through the network that are larger than its buffers."""
    user: User | None = None
    """Who the processes are; None where they are ourselves."""

    @property
    def other(self) -> int | None:
        """The number of the leased user who the processes are outside, if there is one."""
        if self.user:
            return self.user.uid
        return self.sandbox.other if self.sandbox else None

    def give(self, folder: Path) -> None:
        """Let the processes write what we have put into a folder."""
        if self.other is not None:
            give(folder, self.other)

    def let_in(self, folder: Path) -> None:
        """Let the processes use the devices in a folder of ours."""
        if self.other is not None:
            let_in(folder, self.other)

    def around(self, installed: Installed, shown: Sequence[Path]) -> Sandbox | None:
        """What stands around one process."""
        if self.sandbox is None:
            return None
        seen = self.sandbox.showing(installed.folder, self.devices, *shown)
        return replace(seen, home=self.home)


class Arena:
    """One ROS domain of its own, and the processes that run in it."""

    def __init__(
        self,
        installed: Installed,
        place: ArenaPlace,
        domain_id: int,
        on_change: Callable[[], None] = lambda: None,
    ) -> None:
        self.domain_id = domain_id
        self.processes: list[Process] = []
        self.on_change = on_change
        self.devices_late_ns: dict[str, Callable[[], int]] = {}
        """By device that knows it: for how long it has kept its user waiting."""
        self._installed = installed
        self._place = place

    @contextmanager
    def run(
        self,
        executable: str,
        arguments: Sequence[str] = (),
        shown: Sequence[Path] = (),
        host: Host | None = None,
    ) -> Iterator[Process]:
        """Run one of the package's executables until the block ends.

        `shown` is what it needs to see besides, where there is a sandbox; `host` is the computer
        that it runs on, where there are several.
        """
        launch = Launch(
            command=[str(self._installed.programs / executable), *arguments],
            environment={**self._environment(), **(host.environment if host else {})},
            folder=self._place.home,
            namespaces=self._place.wall == "namespace",
            sandbox=self._place.around(self._installed, shown),
            user=self._place.user and self._place.user.showing(self._installed.folder, *shown),
        )
        with ExitStack() as stack:
            with host.entered() if host else nullcontext():
                process = Process(executable, launch, lambda: self.on_change())
                stack.enter_context(process)
            self.processes.append(process)
            yield process

    def companion(
        self, program: Path, plan: Plan, changed: Callable[[], None], host: Host | None = None
    ) -> Companion:
        """A program of a grader's own beside the nodes; it runs while a block `with` it lasts.

        It may import what the environment has, and nothing of the course: in a sandbox it sees
        its own file alone. Peers of another host are told to who must reach it, not to it.
        """
        place = self._place
        shown = place.sandbox and place.sandbox.showing(program, BEGIN)
        sandbox = shown and replace(shown, home=place.home)
        environment = {
            **base_environment(place.home),
            **ros_environment(place.wall, place.paced),
            **(host.environment if host else {}),
            "ROS_STATIC_PEERS": "",
            "ROS_DOMAIN_ID": str(self.domain_id),
        }
        return Companion(program, plan, Surroundings(environment, sandbox, host), changed)

    @property
    def devices(self) -> Path:
        """Where a device must appear for the processes to see it."""
        return self._place.devices

    def sees(self, device: Path) -> bool:
        """The processes could open this device of the computer's own."""
        return self._place.sandbox is None and device.exists()

    def waited_s(self) -> float:
        """The longest time that a thread of theirs was ready to run and no processor was free."""
        waits_ns = (ns for each in self.processes for ns in each.waits_ns().values())
        return max(waits_ns, default=0) / 1e9

    def devices_waits_ns(self) -> dict[str, int]:
        """As `waits_ns`, of this process, which plays the devices; empty without any.

        A thread of ours may be ready and wait for another one of ours, of which the kernel knows
        nothing. A device that tells of it stands among the threads.
        """
        if not any(self.devices.iterdir()):
            return {}
        late = {name: late_ns() for name, late_ns in self.devices_late_ns.items()}
        return {**waits([os.getpid()]), **late}

    def all_alive(self) -> bool:
        """Every process that was started still runs."""
        return all(process.alive for process in self.processes)

    def _environment(self) -> dict[str, str]:
        return {
            **self._installed.environment,
            **ros_environment(self._place.wall, self._place.paced),
            "ROS_DOMAIN_ID": str(self.domain_id),
        }


@contextmanager
def opened(installed: Installed, place: ArenaPlace) -> Iterator[Arena]:
    """An arena with a domain that nobody else uses. Raises NoFreeDomain.

    A domain of its own for each experiment: a node that was killed stays in its graph for 20 s.
    """
    with ExitStack() as stack:
        if place.wall == "domain":
            stack.enter_context(swept_shared_memory())
        devices = stack.enter_context(TemporaryDirectory(dir=place.devices))
        place.let_in(Path(devices))
        own = replace(place, devices=Path(devices))  # another arena may be open beside it
        yield Arena(installed, own, stack.enter_context(leased_domain()))
