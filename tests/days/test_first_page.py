"""The first page of day 1, replayed literally: each command in the terminal that the page names."""

from __future__ import annotations

import json
import math
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from terminals import Terminal, opened

from ros2_on_pip.domain_lease import leased_domain
from roslings.course import root
from roslings.evidence import evidence_json, read_json
from roslings_rover.rover import default_world
from script_groups import groups_of_commands

PAGE = root() / "days" / "01-install" / "first-15-minutes.md"
MOST_COMMANDS = 9
POINTS_THERE = 6.0
"""Degrees. The ball and the rover are so large that this is near enough from the start."""
READY = "ROS 2 jazzy is ready in this terminal"
"""What `source setup.bash` says."""
UP, LEFT, RIGHT = "\x1b[A", "\x1b[D", "\x1b[C"
"""What a terminal sends for these arrows."""

PLACE = re.compile(r"^Terminal (\d), in the roslings folder:\n\n```bash\n(.*?)^```$", re.M | re.S)
EDIT = re.compile(r"^```diff\n-(.*)\n\+(.*)\n```$", re.M)
ANY_BLOCK = re.compile(r"^```(\w*)$", re.M)
FILE = re.compile(r"Open the file `~/([^`]+)`")
LINES = re.compile(r"[Ii]n\s+line\s+(\d+)|change\s+line\s+(\d+)")


@dataclass(frozen=True)
class Commands:
    """A block that the student types."""

    terminal: int
    lines: tuple[str, ...]


@dataclass(frozen=True)
class Change:
    """A line that the student changes in an editor."""

    file: str
    number: int
    old: str
    new: str

    @property
    def undone(self) -> Change:
        """The same change, backwards."""
        return Change(self.file, self.number, self.new, self.old)

    def make(self, home: Path) -> None:
        """Change the line in the file."""
        path = home / self.file
        path.write_text(self.made_in(path.read_text("utf-8")), "utf-8")

    def made_in(self, text: str) -> str:
        """The text with it; the page says which line, and what stands there before."""
        lines = text.splitlines()
        assert lines[self.number - 1] == self.old, f"line {self.number} is another one"
        lines[self.number - 1] = self.new
        return "\n".join([*lines, ""])


def page() -> str:
    """The page as it is committed."""
    return PAGE.read_text("utf-8")


def commands() -> list[Commands]:
    """Every block for a terminal, in the page's order."""
    blocks = PLACE.findall(page())
    return [Commands(int(number), tuple(text.splitlines())) for number, text in blocks]


def changes() -> list[Change]:
    """Every change of a file, in the page's order."""
    (file,) = FILE.findall(page())
    numbers = [int(one or other) for one, other in LINES.findall(page())]
    return [
        Change(file, number, old, new)
        for number, (old, new) in zip(numbers, EDIT.findall(page()), strict=True)
    ]


@dataclass
class Reader:
    """Who follows the page: a home, terminals, and the blocks that are still to be typed."""

    home: Path
    open_terminal: Callable[[int], Terminal]
    """By its number on the page."""
    terminals: dict[int, Terminal] = field(default_factory=dict)
    blocks: list[Commands] = field(default_factory=commands)
    edits: list[Change] = field(default_factory=changes)
    made: list[Change] = field(default_factory=list)

    def types(self) -> Terminal:
        """Type the page's next block; the last of its lines may go on running."""
        block = self.blocks.pop(0)
        if block.terminal not in self.terminals:
            self.terminals[block.terminal] = self.open_terminal(block.terminal)
            self.terminals[block.terminal].is_free()
        terminal = self.terminals[block.terminal]
        for line in block.lines[:-1]:
            terminal.type(line)
            terminal.is_free()
        terminal.type(block.lines[-1])
        return terminal

    def edits_the_file(self) -> None:
        """Make the page's next change."""
        self.made.append(self.edits.pop(0))
        self.made[-1].make(self.home)

    def takes_the_edit_back(self) -> None:
        """Put the letter back."""
        self.made.pop().undone.make(self.home)


@pytest.fixture
def reader(tmp_path: Path) -> Iterator[Reader]:
    """Somebody with an empty home, in the course's folder."""
    with leased_domain() as domain, ExitStack() as terminals:
        yield Reader(tmp_path, lambda _: terminals.enter_context(opened(tmp_path, domain)))


def place_of(rover: Terminal) -> float:
    """The x that the map shows now, in metres."""
    found = re.findall(r"\bx +(-?\d+\.\d\d) m", rover.heard())
    return float(found[-1]) if found else 0.0


def stands(rover: Terminal) -> bool:
    """The speed that the map shows now."""
    return re.findall(r"\bspeed +(-?\d+\.\d\d) m/s", rover.heard())[-1:] == ["0.00"]


def drive_to_the_ball(rover: Terminal) -> None:
    """As somebody does who looks at the map: turn until the arrow points there, then ahead.

    The map is always a little late: so one key at a time, and a look when the rover rests.
    """
    (ball,) = default_world().balls
    rover.press("c" * 8)  # turn slowly

    def there() -> bool:
        x_m, y_m, heading = before = where_is(rover)
        way = math.degrees(math.atan2(ball.y_m - y_m, ball.x_m - x_m))
        off = (way - heading + 180) % 360 - 180
        rover.press(UP if abs(off) < POINTS_THERE else LEFT if off > 0 else RIGHT)
        rover.until(lambda: touches(rover) or has_moved(rover, before), "it does not move")
        return touches(rover)

    rover.until(there, "it did not come to the ball")


def touches(rover: Terminal) -> bool:
    """As the page promises."""
    return "touches the red ball" in rover.heard()


def has_moved(rover: Terminal, before: tuple[float, float, float]) -> bool:
    """It is at another place or has another heading, and rests there."""
    turns = re.findall(r"\bturn +(-?\d+\.\d\d) rad/s", rover.heard())[-1:]
    return where_is(rover) != before and stands(rover) and turns == ["0.00"]


def where_is(rover: Terminal) -> tuple[float, float, float]:
    """Metres and degrees, as the map shows them now."""
    shown = {
        name: re.findall(rf"\b{name} +(-?\d+(?:\.\d+)?) {unit}", rover.heard())
        for name, unit in (("x", "m"), ("y", "m"), ("heading", "degrees"))
    }
    x_m, y_m, heading = (float(found[-1]) if found else 0.0 for found in shown.values())
    return x_m, y_m, heading


def test_the_page_has_at_most_nine_commands_and_places_for_all() -> None:
    """No block without its terminal and folder."""
    typed = [line for block in commands() for line in block.lines]
    assert 0 < len(typed) <= MOST_COMMANDS
    kinds = [kind for kind in ANY_BLOCK.findall(page()) if kind]
    assert sorted(kinds) == ["bash"] * len(commands()) + ["diff"] * len(changes())


@pytest.mark.slow
def test_20_seconds_of_robot_time_are_judged(tmp_path: Path) -> None:
    """What the page says of its check. A busy computer goes by the wall, and says so."""
    kept = tmp_path / "kept"
    words = [
        sys.executable,
        "-m",
        "roslings",
        "check",
        "example",
        "--solution",
        "--evidence",
        str(kept),
    ]
    subprocess.run(words, cwd=root(), env={**os.environ, "HOME": str(tmp_path)}, check=False)
    evidence = read_json((kept / "evidence.json").read_bytes())
    telling = json.loads(evidence_json(evidence))["experiments"]["telling"]
    if telling["clock"] == "sim":
        assert telling["ticks"][-1]["sim_ns"] > 20e9
    else:
        assert telling["not_believed"]


@pytest.mark.slow
def test_the_page_holds_what_it_promises(reader: Reader) -> None:
    """The robot drives; a wrong letter is found by name; one's own program is in the picture."""
    follow_the_page(reader)


def follow_the_page(reader: Reader) -> None:
    """From its first command to its last; each promise is waited for."""
    rover = reader.types()
    rover.shows("Keys: arrow up drives")
    rover.press(UP)
    rover.until(lambda: place_of(rover) > 0.1, "it did not drive")
    rover.until(lambda: stands(rover), "it did not stop")
    by_keys_m = place_of(rover)
    driver = reader.types()
    driver.shows("publishing #1")
    assert READY in driver.said_before()
    rover.until(lambda: place_of(rover) > by_keys_m, "it did not drive on")
    driver.is_free()
    reader.types().is_free()
    reader.edits_the_file()
    reader.types().shows(r"there is no /alive, but /alve[^$]*Score +\d\d of 100")
    driver.is_free()
    reader.takes_the_edit_back()
    reader.types().tells("100 of 100")
    assert not re.search(r" pack\b", driver.heard())
    driver.is_free()
    reader.edits_the_file()
    own = reader.types()
    own.shows(r"\[maria\]: Telling")
    reader.types().shows(r"(?s)Nodes\s+/keyboard\s+/maria\s+/rover\s.*from  /maria")
    drive_to_the_ball(rover)
    rover.shows("The rover touches the red ball. Well done!")
    for terminal in (rover, own):
        terminal.press_ctrl_c()
        terminal.is_free()
    reader.types().shows(r"the rover has touched the ball\.\s+Next +\./roslings lab 1 ")
    assert not reader.blocks
    assert not reader.edits


def test_one_download_is_enough_for_the_page() -> None:
    """What its first command installs, all others find there."""
    groups = groups_of_commands()
    typed = [line.split() for block in commands() for line in block.lines]
    first, *later = (words for words in typed if words[0] in ("./roslings", "ros2"))
    there = groups[first[1]]
    assert {"ros2", "check", "graph"} <= groups.keys()
    for words in later:
        name = words[0] if words[0] == "ros2" else "".join(words[1:2])
        assert groups.get(name, set()) <= there, words
