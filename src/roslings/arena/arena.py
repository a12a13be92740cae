"""A place where someone else's nodes run and end."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from roslings.arena.environment import ros_environment
from roslings.arena.isolation import Wall
from roslings.arena.lease import leased_domain
from roslings.arena.process import Launch, Process
from roslings.arena.shared_memory import swept_shared_memory


@dataclass(frozen=True)
class Installed:
    """A built package: where its executables are, and the environment they need."""

    programs: Path
    environment: dict[str, str]


class Arena:
    """One ROS domain of its own, and the processes that run in it."""

    def __init__(
        self,
        installed: Installed,
        wall: Wall,
        domain_id: int,
        home: Path,
        on_change: Callable[[], None] = lambda: None,
    ) -> None:
        self.domain_id = domain_id
        self.processes: list[Process] = []
        self.on_change = on_change
        self._installed = installed
        self._wall = wall
        self._home = home

    @contextmanager
    def run(self, executable: str, arguments: Sequence[str] = ()) -> Iterator[Process]:
        """Run one of the package's executables until the block ends."""
        launch = Launch(
            command=[str(self._installed.programs / executable), *arguments],
            environment=self._environment(),
            folder=self._home,
            namespaces=self._wall == "namespace",
        )
        with Process(executable, launch, lambda: self.on_change()) as process:
            self.processes.append(process)
            yield process

    @property
    def home(self) -> Path:
        """The processes' home folder, gone when the run ends."""
        return self._home

    def all_alive(self) -> bool:
        """Every process that was started still runs."""
        return all(process.alive for process in self.processes)

    def _environment(self) -> dict[str, str]:
        return {
            **self._installed.environment,
            **ros_environment(self._wall),
            "ROS_DOMAIN_ID": str(self.domain_id),
        }


@contextmanager
def opened(installed: Installed, wall: Wall, home: Path) -> Iterator[Arena]:
    """An arena with a domain that nobody else uses. Raises NoFreeDomain.

    A domain of its own for each experiment: a node that was killed stays in its graph for 20 s.
    """
    with ExitStack() as stack:
        if wall == "domain":
            stack.enter_context(swept_shared_memory())
        yield Arena(installed, wall, stack.enter_context(leased_domain()), home)
