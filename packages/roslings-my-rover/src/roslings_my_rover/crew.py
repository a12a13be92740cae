"""The programs of the parts while they run: started as they are wired, and when one ends, anew.

A part that ends is named with its last line. The rover goes on without it: the others get the
wiring of a rover that never had it. Only a stop keeps its place: without it nothing drives.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from roslings.arena import Installed, Launch, Process
from roslings_my_rover import follow, relay
from roslings_my_rover.installing import BuiltPart
from roslings_my_rover.parts import RoverPart
from roslings_my_rover.wiring import StartArguments, Wiring, new_mark, wired

RELAY, FOLLOWER, RECORDER = "relay", "follower", "recorder"
RECORDED = ("/odom", "/cmd_vel", "/rover/motors", "/obstacle", "/robot_status", "/ball")
"""What the bag of a drive holds: what was wanted, what was done, and why."""
LONGEST_LINE = 80
RECORDS_WITHIN_S = 20.0


@dataclass(frozen=True)
class EndedPart:
    """A part that is not there any more."""

    part: RoverPart
    program: str
    last_line: str

    @property
    def line(self) -> str:
        """What the map says of it, at most 80 columns."""
        words = self.last_line.strip()
        line = f"{self.program} ended. It said: {words}" if words else f"{self.program} ended."
        return line if len(line) <= LONGEST_LINE else f"{line[: LONGEST_LINE - 3]}..."


@dataclass
class _Running:
    """One program, and how it was started."""

    link: StartArguments
    process: Process
    stack: ExitStack


@dataclass
class Crew:
    """All programs beside the rover."""

    built: Sequence[BuiltPart]
    environment: Mapping[str, str]
    """What ROS needs to know besides: the domain, and how far one hears."""
    home: Path
    port: str = ""
    device: str = ""
    follows: bool = False
    wanders: bool = False
    """Whether parts run that drive by themselves."""
    bag: Path | None = None
    """A new folder for what was said; None: nothing is kept."""
    mark: str = field(default_factory=new_mark)
    """Behind the names of its links."""
    ended: list[EndedPart] = field(default_factory=list)
    _running: dict[str, _Running] = field(default_factory=dict)

    @property
    def parts(self) -> list[RoverPart]:
        """Those that are there now."""
        gone = {each.part for each in self.ended if not each.part.holds_its_place}
        return [each.chosen.part for each in self.built if each.chosen.part not in gone]

    @property
    def wiring(self) -> Wiring:
        """As it is with the parts that are there now."""
        return wired(self.parts, self.port, self.device, self.mark)

    def look(self) -> list[EndedPart]:
        """Those that have ended since the last look; the others are wired without them."""
        news = list(self._gone())
        self.ended += news
        if news:
            self.start()
        return news

    def start(self) -> None:
        """Start what is wanted and not there, and end what is there and not wanted so."""
        wanted = self._wanted()
        for name in [*self._running]:
            if name not in wanted or self._running[name].link != wanted[name]:
                self._running.pop(name).stack.close()
        for name, link in wanted.items():
            if name not in self._running:
                self._running[name] = self._started(name, link)

    def follow(self, follows: bool) -> None:
        """Let it follow the ball from now on, or no longer."""
        self.follows = follows
        self.start()

    def end(self) -> None:
        """All of them, the last one first."""
        while self._running:
            self._running.popitem()[1].stack.close()

    def _wanted(self) -> dict[str, StartArguments]:
        wiring = self.wiring
        own = {RELAY: wiring.relay} if wiring.relay else {}
        follower = {FOLLOWER: StartArguments()} if self.follows else {}
        recorder = {RECORDER: StartArguments()} if self.bag else {}
        programs = {n: link for n, link in wiring.programs.items() if n not in self._resting}
        return {**recorder, **own, **programs, **follower}

    @property
    def _resting(self) -> set[str]:
        parts = [part for part in self.parts if not self.runs(part)]
        return {program for part in parts for program in part.programs}

    def runs(self, part: RoverPart) -> bool:
        """Whether the programs of this part are wanted now."""
        return self.wanders or not part.only_in_rooms

    def _gone(self) -> Iterator[EndedPart]:
        known = {each.program for each in self.ended}
        for each in self.built:
            for name in each.chosen.part.programs:
                running = self._running.get(name)
                if running and not running.process.alive and name not in known:
                    lines = [line.text for line in running.process.lines() if line.text.strip()]
                    yield EndedPart(each.chosen.part, name, lines[-1] if lines else "")
                    break

    def _started(self, name: str, link: StartArguments) -> _Running:
        command, installed = self._command(name)
        environment = {**(installed.environment if installed else {}), **self.environment}
        launch = Launch([*command, *link.arguments], environment, self.home, namespaces=False)
        stack = ExitStack()
        process = stack.enter_context(Process(name, launch))
        if name == RECORDER:
            process.wait_until(lambda: _records(process), RECORDS_WITHIN_S)
        return _Running(link, process, stack)

    def _command(self, name: str) -> tuple[list[str], Installed | None]:
        """Of a part's program, or of one of ours, with the environment of any part."""
        for each in self.built:
            if name in each.chosen.part.programs:
                return [str(each.program(name))], each.installed
        return self._own_command(name), self.built[0].installed

    def _own_command(self, name: str) -> list[str]:
        if name == RECORDER:
            words = ["bag", "record", "-o", str(self.bag), "--topics", *RECORDED]
            return [sys.executable, "-m", "ros2_on_pip", *words]
        module = {RELAY: relay, FOLLOWER: follow}[name]
        return [sys.executable, str(module.__file__)]


def _records(process: Process) -> bool:
    """What is said before that is lost."""
    return any("Recording..." in line.text for line in process.lines())


@contextmanager
def working(crew: Crew) -> Iterator[Crew]:
    """All are started; at the end of the block all have ended."""
    try:
        crew.start()
        yield crew
    finally:
        crew.end()
