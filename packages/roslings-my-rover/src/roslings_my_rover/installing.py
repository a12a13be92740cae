"""Build the parts with colcon, each once: what has not changed is taken as it was built."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from roslings.arena import ArenaPlace, Installed
from roslings.arena.kernel import cores
from roslings.experiment.run_folder import run_folder
from roslings.workspace.shared_build import shared_build
from roslings.workspace.student import stage, workspace_root
from roslings_my_rover.chosen import ChosenPart

BUILDS = Path(".roslings/my_rover")


@dataclass(frozen=True)
class BrokenPart:
    """A part that does not build, or that lacks a program."""

    chosen: ChosenPart
    because: str

    @property
    def line(self) -> str:
        """`sonar is left out: it does not build. ...`."""
        return f"{self.chosen.part.name} is left out: {self.because}"


@dataclass(frozen=True)
class BuiltPart:
    """A part whose programs can be started."""

    chosen: ChosenPart
    installed: Installed

    def program(self, name: str) -> Path:
        """The file of an executable."""
        return self.installed.programs / name


def build_all(
    parts: Sequence[ChosenPart], home: Path, tell: Callable[[str], None]
) -> tuple[list[BuiltPart], list[BrokenPart]]:
    """Build each, one a processor; those that cannot be built or started, with the reason.

    Raises CannotRead and DiskFull.
    """
    built, broken = list[BuiltPart](), list[BrokenPart]()
    with ThreadPoolExecutor(cores()) as pool:
        made = [(each, pool.submit(_build, each, home)) for each in parts]
        try:
            for each, future in made:
                tell(f"Building {each.part.name} ({each.lab.name})")
                found = future.result()
                (built if isinstance(found, BuiltPart) else broken).append(found)  # type: ignore[arg-type]
        except BaseException:  # Ctrl-C: only what is being built comes to its end
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return built, broken


def _under_its_name(each: ChosenPart, room: Path) -> Path:
    """The package, in a folder that has its name: a student may have renamed the folder."""
    name = each.lab.outline.package
    return each.package if each.package.name == name else stage(each.package, room / "own" / name)


def _build(each: ChosenPart, home: Path) -> BuiltPart | BrokenPart:
    place = ArenaPlace("domain", home, home)
    builds = workspace_root() / BUILDS
    builds.mkdir(parents=True, exist_ok=True)
    with run_folder() as room:
        source = _under_its_name(each, room)
        seen, installed = shared_build(builds, source, room, place, each.lab.card.builds_within_s)
    if installed is None:
        last = next((line for line in reversed(seen.output) if line.strip()), "colcon failed")
        return BrokenPart(each, f"it does not build. {last.strip()}")
    missing = [name for name in each.part.programs if not (installed.programs / name).is_file()]
    if missing:
        return BrokenPart(each, f"it has no executable {missing[0]!r}.")
    return BuiltPart(each, installed)
