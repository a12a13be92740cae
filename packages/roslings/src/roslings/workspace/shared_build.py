"""One build for packages of equal content: colcon costs most of what a grading costs."""

from __future__ import annotations

import fcntl
import os
import shutil
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import IO

from pydantic import BaseModel

from roslings.arena import ArenaPlace, Installed, base_environment
from roslings.arena.kernel import cores
from roslings.evidence import BuildSeen
from roslings.workspace.build import BuildRoom, build
from roslings.workspace.build_cache import content_of, install_like, shared_setup_of
from roslings.workspace.foreign import NoRoom, copy_foreign

OF_ONE_RUN = ("HOME", "TMPDIR", "ROS_LOG_DIR")
"""Variables that name a run's own folders; the rest of a build's environment can be shared."""
WAITS_FOR_ITS_TURN_S = 20.0
"""Others' builds may be endless ones."""
LOOK_AGAIN_S = 0.05


class BuildResult(BaseModel):
    """What came of a build, kept beside it."""

    seen: BuildSeen
    programs: Path
    environment: dict[str, str]
    folder: Path

    def installed(self, home: Path) -> Installed:
        """The same installation, for nodes whose home is another."""
        own = {name: base_environment(home)[name] for name in OF_ONE_RUN}
        return Installed(self.programs, {**self.environment, **own}, self.folder)


def shared_build(
    builds: Path,
    source: Path,
    room: Path,
    place: ArenaPlace,
    within_s: float,
    from_cache: bool = False,
) -> tuple[BuildSeen, Installed | None]:
    """Build the package at `source`, or take the build of the same content from `builds`.

    It is built in `room`, as if that were its place in `builds`. An installation must not be moved,
    and what a stranger's build writes is bounded in `room` only. With `from_cache`, a package that
    differs from a built one in its modules alone is installed without colcon.
    """
    shared = builds / content_of(source, _built_with())
    with _held(shared):
        if from_cache and not _kept(shared).is_file():
            return _build_from_cache(shared, source, room, place, within_s)
        return _build_once(shared, source, room, place, within_s)


def _build_once(
    shared: Path, source: Path, room: Path, place: ArenaPlace, within_s: float
) -> tuple[BuildSeen, Installed | None]:
    """Build it, if nobody has."""
    if _kept(shared).is_file():
        built = BuildResult.model_validate_json(_kept(shared).read_text("utf-8"))
        built.seen.seconds = 0.0
        return built.seen, built.installed(place.home)
    with _turn(shared.parent):
        return _build_in(shared, source, room, place, within_s)


def _build_from_cache(
    shared: Path, source: Path, room: Path, place: ArenaPlace, within_s: float
) -> tuple[BuildSeen, Installed | None]:
    """Install it like the eldest of its family; the eldest itself is built."""
    with shared_setup_of(shared.parent, source, _built_with()) as shared_setup:
        if eldest := shared_setup.eldest:
            install_like(eldest / source.name, shared / source.name, source)
            found = _kept(eldest).read_text("utf-8").replace(str(eldest), str(shared))
            _kept(shared).write_text(found, "utf-8")
        seen, installed = _build_once(shared, source, room, place, within_s)
        if _kept(shared).is_file() and not eldest:
            shared_setup.remember(shared)
    return seen, installed


def _kept(shared: Path) -> Path:
    """Where is written what came of a build."""
    return shared / "built.json"


def _built_with() -> str:
    return f"{sys.executable} {os.environ.get('AMENT_PREFIX_PATH')}"


def _build_in(
    shared: Path, source: Path, room: Path, place: ArenaPlace, within_s: float
) -> tuple[BuildSeen, Installed | None]:
    own = BuildRoom(shared / source.name, source.name, lies_at=room if place.sandbox else None)
    shutil.rmtree(own.folder, ignore_errors=True)
    shutil.copytree(source, own.source, symlinks=True)
    seen, installed = build(own, place, within_s)
    if not installed:  # what failed may have failed by chance: it is not passed on
        return seen, installed
    try:
        if own.lies_at:
            copy_foreign(own.lies / "install", installed.folder)
    except OSError as error:
        seen, installed = _build_alone(source, room, place, within_s)
        seen.filled_its_disk |= isinstance(error, NoRoom) and error.by_itself
        return seen, installed
    built = BuildResult(
        seen=seen,
        programs=installed.programs,
        environment=installed.environment,
        folder=installed.folder,
    )
    _kept(shared).write_text(built.model_dump_json(), "utf-8")
    return seen, installed


def _build_alone(
    source: Path, room: Path, place: ArenaPlace, within_s: float
) -> tuple[BuildSeen, Installed | None]:
    """Build in `room` for one run only: nobody else gets it (no rights, too deep, too much)."""
    alone = BuildRoom(room / "alone", source.name)
    shutil.copytree(source, alone.source, symlinks=True)
    return build(alone, place, within_s)


@contextmanager
def _held(place: Path) -> Iterator[None]:
    """Nobody else builds the same meanwhile; who comes second finds it built."""
    place.mkdir(parents=True, exist_ok=True)
    with (place / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


@contextmanager
def _turn(builds: Path) -> Iterator[None]:
    """One build a processor at a time, as long as none of them takes long.

    More at once would end no sooner, and keep the processors from those whose nodes run.
    """
    until_s = time.monotonic() + WAITS_FOR_ITS_TURN_S
    with ExitStack() as opened:
        turns = [
            opened.enter_context((builds / f"turn-{number}").open("w")) for number in range(cores())
        ]
        while not any(map(_taken, turns)) and time.monotonic() < until_s:
            time.sleep(LOOK_AGAIN_S)
        yield


def _taken(turn: IO[str]) -> bool:
    try:
        fcntl.flock(turn, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True
