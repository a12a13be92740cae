"""Pictures of what each day adds to the rover: the screen of a real `./roslings my-rover`.

    .venv/bin/python tests/site/my_rover_wins_pictures.py          draws all anew
    .venv/bin/python tests/site/my_rover_wins_pictures.py 3 8      those of these days

The parts are the labs' solutions. The command runs in a terminal of 80 by 24 letters that knows no
letters but ASCII; in another one the page's own commands are typed. What its screen shows when the
day's part has done its work is the picture.
"""

from __future__ import annotations

import fcntl
import os
import re
import shlex
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from html import escape, unescape
from itertools import groupby
from pathlib import Path

import pytest

from ros2_on_pip.domain_lease import leased_domain
from roslings.course import lab, root
from roslings.verdict import Verdict
from roslings.workspace.best import keep_best
from roslings.workspace.progress import record
from roslings_my_rover.parts import (
    CABLE,
    EYES,
    GUARD,
    LIMITER,
    MAPPER,
    PACE,
    PILOT,
    SONAR,
    VOICE,
    WANDERER,
    RoverPart,
)

sys.path += [
    str(root() / each)
    for each in ("packages/roslings-my-rover/tests", "tests", "tests/days", "tests/labs")
]
from carried import put, surroundings, until
from terminals import end_session, take_terminal
from works import EDGE_PX, LINE_PX, NUMBER, STYLE, WIDE_PX

COLUMNS, LINES = 80, 24
KEY_EVERY_S = 0.1
HOME = "\x1b[H"
"""Each time that the screen is drawn begins with it."""
COLOURS = {31: "red", 32: "green", 33: "yellow", 34: "blue", 35: "magenta", 36: "cyan", 90: "grey"}
"""What `rich` makes of the map's styles, by ECMA-48."""
HUES = """
.red { fill: #ff8a80; } .yellow { fill: #ffe082; } .blue { fill: #82b1ff; }
.magenta { fill: #ea9df0; } .cyan { fill: #80deea; } .grey { fill: #9aa4b2; }
.green { fill: #69db7c; }
"""
TOKEN = re.compile(r"\x1b\[([0-9;]*)m|\x1b\[[0-9;?]*[a-zA-Z]|([^\x1b\r])")
DRIVE = "ros2 topic pub --rate 5 /cmd_vel geometry_msgs/msg/Twist"
REFERENCE = root() / "site/pages/reference/pictures"

ARROWS = "<>^v"
Line = list[tuple[str, str]]
"""Pieces of text, each with its colour; the usual one is empty."""


class Screen:
    """A running `./roslings my-rover` in a terminal of its own, and another one to type in."""

    def __init__(
        self, process: subprocess.Popen[bytes], terminal: int, environment: Mapping[str, str]
    ) -> None:
        self.process, self._environment = process, environment
        self._terminal, self._said = terminal, ""
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        while True:
            try:
                chunk = os.read(self._terminal, 65536)
            except OSError:  # the command has ended
                return
            self._said += chunk.decode("ascii", "replace")

    @property
    def lines(self) -> list[Line]:
        """The newest screen that is whole."""
        frames = self._said.split(HOME)
        newest = frames[-2] if len(frames) > 2 else ""
        return [_pieces(each) for each in newest.split("\n")[:LINES]]

    @property
    def text(self) -> str:
        """Its letters."""
        return "\n".join(map(plain, self.lines))

    def number(self, name: str) -> float:
        """One of the numbers beside the map."""
        found = re.search(rf"  {name} +(-?[\d.]+)", self.text)
        return float(found[1]) if found else 0.0

    def shows(self, condition: Callable[[], object]) -> None:
        """Wait until the screen is such."""
        until(condition, lambda: f"{self.text}\n{self._said[-2000:]}")

    def says(self, words: str) -> None:
        """Wait until these words stand there."""
        self.shows(lambda: words in self.text)

    def press(self, key: str) -> None:
        """A key of its terminal."""
        os.write(self._terminal, key.encode())

    def hold(self, key: str, condition: Callable[[], object]) -> None:
        """Keep a key down until something holds: a keyboard repeats it."""

        def pressed() -> bool:
            self.press(key)
            time.sleep(KEY_EVERY_S)
            return bool(condition())

        self.shows(pressed)

    def interrupt(self) -> list[str]:
        """Press Ctrl-C; what it says at its end."""
        self.process.send_signal(signal.SIGINT)
        assert self.process.wait(120) == 0, self._said[-2000:]
        self._reader.join(5)
        last = self._said.rpartition("\x1b[?1049l")[2]
        return [line.rstrip() for line in map(plain, map(_pieces, last.split("\n")))]

    @contextmanager
    def typing(self, line: str) -> Iterator[None]:
        """A command of ROS in another terminal, until the block ends."""
        process = self._started(line)
        try:
            yield
        finally:
            process.send_signal(signal.SIGINT)
            process.wait(30)

    def typed(self, line: str) -> None:
        """The same to its end."""
        assert self._started(line).wait(120) == 0, line

    def _started(self, line: str) -> subprocess.Popen[bytes]:
        words = [sys.executable, "-m", "ros2_on_pip", *shlex.split(line)[1:]]
        return subprocess.Popen(
            words,
            env=self._environment,
            cwd=self._environment["HOME"],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
        )


def _pieces(said: str) -> Line:
    """One line of a screen; what lights its letters up is left out."""
    letters, colour = list[tuple[str, str]](), ""
    for codes, letter in TOKEN.findall(said):
        if letter:
            letters.append((letter, colour))
            continue
        for code in map(int, filter(None, codes.split(";"))):
            colour = "" if code == 0 else COLOURS.get(code, colour)
        colour = colour if codes else ""
    while letters and letters[-1][0] == " ":
        letters.pop()
    groups = groupby(letters, lambda each: each[1])
    return [("".join(letter for letter, _ in group), colour) for colour, group in groups]


def plain(line: Line) -> str:
    """Without its colours."""
    return "".join(piece for piece, _ in line)


@contextmanager
def started(home: Path, words: str) -> Iterator[Screen]:
    """`./roslings my-rover` and words, as soon as its map is there."""
    ours, theirs = os.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("4H", LINES, COLUMNS, 0, 0))
    with leased_domain() as domain:
        environment = {
            **surroundings(domain, home / "roslings_ws"),
            "HOME": str(home),
            "TERM": "xterm",
            "PYTHONIOENCODING": "ascii:replace",
        }
        process = subprocess.Popen(
            [sys.executable, "-m", "roslings", "my-rover", "--view", "terminal", *words.split()],
            env=environment,
            cwd=home,
            stdin=theirs,
            stdout=theirs,
            stderr=theirs,
            start_new_session=True,
            preexec_fn=take_terminal,
        )
        os.close(theirs)
        try:
            screen = Screen(process, ours, environment)
            screen.says("Ctrl-C ends it")
            yield screen
        finally:
            end_session(process)
            os.close(ours)


# --- what is typed ------------------------------------------------------------------------------


def _speaks(screen: Screen) -> None:
    screen.says("Robot status count")
    with screen.typing(f'{DRIVE} "{{linear: {{x: 0.4}}, angular: {{z: 0.25}}}}"'):
        screen.shows(lambda: screen.number("way") > 2)


def _brakes(screen: Screen) -> None:
    with screen.typing(f'{DRIVE} "{{linear: {{x: 0.5}}}}"'):
        screen.shows(lambda: screen.number("x") > 4 and screen.number("speed") == 0)


def _drives_slowly(screen: Screen) -> None:
    screen.typed('ros2 service call /set_max_speed std_srvs/srv/SetBool "{data: true}"')
    with screen.typing(f'{DRIVE} "{{linear: {{x: 0.5}}}}"'):
        screen.shows(lambda: screen.number("way") > 1.5)


def _drives_to_a_point(screen: Screen) -> None:
    goal = "{x: 1.5, y: 0.5, tolerance: 0.1}"
    screen.typed(f'ros2 action send_goal /drive_to rover_interfaces/action/DriveTo "{goal}"')
    screen.shows(lambda: screen.number("x") > 1.2 and screen.number("speed") == 0)


def _loses_its_cable(screen: Screen) -> None:
    screen.hold("i", lambda: screen.number("way") > 0.5)
    screen.hold("j", lambda: screen.number("heading") > 30)
    for far_m in (1.5, 1.7, 1.9, 2.1):
        screen.hold("i", lambda: screen.number("way") > far_m)  # noqa: B023 - it is asked here
        screen.press("p")
        screen.shows(lambda: _stands_without_cable(screen.text) and screen.number("speed") == 0)
        if _errs(screen):
            return
        screen.press("p")
        screen.says("The cable is plugged in")


def _stands_without_cable(text: str) -> bool:
    return "The cable is pulled" in text and "Robot status count" in text


def _errs(screen: Screen) -> bool:
    """A grey arrow stands beside the rover's."""
    pieces = (piece for line in screen.lines for piece in line)
    return any(colour == "grey" and set(text) & set(ARROWS) for text, colour in pieces)


def _touches_the_ball(screen: Screen) -> None:
    screen.says("The rover touches the red ball")


def _races(screen: Screen) -> None:
    screen.says("Red wins")


def _stops(screen: Screen) -> None:
    screen.typed('ros2 service call /press std_srvs/srv/SetBool "{data: true}"')  # it is there
    screen.press(" ")
    screen.says("Space: stop is released")
    screen.hold("i", lambda: screen.number("way") > 1)
    screen.press(" ")
    screen.shows(lambda: "stop is pressed" in screen.text and screen.number("speed") == 0)


def _wanders(screen: Screen) -> None:
    screen.shows(lambda: screen.number("way") > 4)
    assert "bumps" in screen.text and screen.number("bumps") == 0, screen.text


def _draws_the_room(screen: Screen) -> None:
    screen.says("its walls are green")
    screen.shows(lambda: screen.number("way") > 9)
    assert "bumps" in screen.text and screen.number("bumps") == 0, screen.text


def _keeps_a_bag(screen: Screen) -> None:
    with screen.typing(f'{DRIVE} "{{linear: {{x: 0.4}}}}"'):
        screen.shows(lambda: screen.number("way") > 2)


@dataclass(frozen=True)
class Win:
    """One picture: of which day, what is carried and typed, and what it shows, in a sentence."""

    day: int
    lab: str
    parts: tuple[RoverPart, ...]
    play: Callable[[Screen], None]
    alt: str
    words: str = ""

    @property
    def typed(self) -> str:
        """As the student types it."""
        return f"./roslings my-rover {self.words}".rstrip()

    @property
    def file(self) -> Path:
        """At the end of the lab's task."""
        return lab(self.lab).folder / "pictures" / "my-rover.svg"

    @property
    def copy(self) -> Path:
        """The same on the page that tells all days."""
        return REFERENCE / f"my-rover-{self.day:02}.svg"


WINS = (
    Win(
        2,
        "nodes",
        (VOICE,),
        _speaks,
        "The rover has driven a curve. Over it stand your words: Robot status count.",
    ),
    Win(
        3,
        "distance-sensor",
        (VOICE, SONAR),
        _brakes,
        "The rover has driven straight on. It stands before the bin, and its speed is 0.00 m/s.",
    ),
    Win(
        4,
        "services",
        (VOICE, PACE),
        _drives_slowly,
        "The rover drives at 0.30 m/s, though it is told 0.5.",
    ),
    Win(
        5,
        "actions",
        (VOICE, PILOT),
        _drives_to_a_point,
        "The rover has driven a curve to the point by itself, and stands beside the ball.",
    ),
    Win(
        6,
        "serial-bridge",
        (VOICE, CABLE),
        _loses_its_cable,
        "The rover stands. A grey arrow shows where its bridge thinks that it is. Below the map:"
        " The cable is pulled.",
        "--keys",
    ),
    Win(
        7,
        "pi-camera",
        (VOICE, EYES),
        _touches_the_ball,
        "The rover is at the ball. Below the map: The rover touches the red ball. Well done!",
        "--follow",
    ),
    Win(
        8,
        "bring-up",
        (LIMITER,),
        _races,
        "Red is at the finish, and blue is still on its way. Below the map: Red wins.",
        "--race",
    ),
    Win(
        9,
        "black-box",
        (VOICE,),
        _keeps_a_bag,
        "The rover says how far it went. Your program reads the bag, and its distance is the same.",
        "--bag",
    ),
    Win(
        10,
        "e-stop",
        (VOICE, GUARD),
        _stops,
        "The rover stands in the middle of its way. Below the map: Space: stop is pressed.",
        "--keys",
    ),
    Win(
        11,
        "wander",
        (VOICE, WANDERER),
        _wanders,
        "The map of a room. The rover has gone along a wall by itself, and the map counts no bump.",
        "--room 35",
    ),
    Win(
        12,
        "frames",
        (VOICE, WANDERER, MAPPER),
        _draws_the_room,
        "The map of a room, in which the walls that your node has drawn are green. After Ctrl-C the"
        " room stands there as your node has drawn it.",
        "--room 35",
    ),
)


@dataclass(frozen=True)
class Shot:
    """A terminal as it stood there."""

    typed: str
    lines: list[Line]


def seen(win: Win, home: Path) -> list[Shot]:
    """Run it, and look."""
    for part in win.parts:
        _has_passed(home / "roslings_ws", part)
    with started(home, win.words) as screen:
        win.play(screen)
        if win.day == 12:
            lines = _without_end(screen.lines)
            return [Shot(win.typed, lines), Shot(win.typed, _drawn_room(screen.interrupt()))]
        if win.day != 9:
            return [Shot(win.typed, _without_end(screen.lines))]
        told = screen.interrupt()
    went = next(number for number, line in enumerate(told) if line.startswith("It went"))
    return [
        Shot(win.typed, [[(line, "")] for line in told[went : went + 2]]),
        _read(home),
    ]


def _drawn_room(told: Sequence[str]) -> list[Line]:
    """What is said at the end, from the place of the rover on; its last lines are the room."""
    begin = next(number for number, line in enumerate(told) if line.startswith("Your rover"))
    return _without_end([[(line, "")] for line in told[begin:]])


def _has_passed(workspace: Path, part: RoverPart) -> None:
    """Its package is there, and `check` has given it all points."""
    put(workspace, part)
    own = lab(part.lab)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROSLINGS_WS", str(workspace))
        record(Verdict.model_construct(lab=own.name, checks=(), score=100.0, outcome="pass"))
        keep_best(own, workspace / "src" / own.outline.package, 100.0)


def _read(home: Path) -> Shot:
    """What the solution of day 9 says of the bag: its first line, and its last two."""
    from test_my_rover_wins import read_drive

    lines = read_drive(home / "roslings_ws/my_rover_bag").splitlines()
    told = [lines[0], "...", *lines[-2:]]
    bag = "~/roslings_ws/my_rover_bag"
    return Shot(f"ros2 run black_box read_drive {bag}", [[(line, "")] for line in told])


def _without_end(lines: Sequence[Line]) -> list[Line]:
    """Without the empty lines at the bottom of the screen."""
    filled = [number for number, line in enumerate(lines) if plain(line)]
    return list(lines[: max(filled) + 1])


# --- drawing ------------------------------------------------------------------------------------


def drawn(alt: str, shots: Sequence[Shot]) -> str:
    """The SVG: each terminal with what was typed, one below the other."""
    parts, top = list[str](), EDGE_PX
    for shot in shots:
        high = 16 + LINE_PX * (len(shot.lines) + 1)
        parts += [*_terminal(shot, top, high)]
        top += high + EDGE_PX
    return "\n".join(
        [
            '<svg class="terminal" xmlns="http://www.w3.org/2000/svg"'
            f' viewBox="0 0 {WIDE_PX:g} {top:g}" width="{WIDE_PX:g}" height="{top:g}">',
            f"<title>{escape(alt)}</title>",
            f"<style>{STYLE}{HUES}</style>",
            *parts,
            "</svg>\n",
        ]
    )


def _terminal(shot: Shot, top_px: float, high_px: float) -> Iterator[str]:
    yield (
        f'<rect class="window" x="{EDGE_PX:g}" y="{top_px:g}" width="{WIDE_PX - 2 * EDGE_PX:g}"'
        f' height="{high_px:g}" rx="8"/>'
    )
    for number, line in enumerate([[(f"$ {shot.typed}", "typed")], *shot.lines]):
        inside = "".join(_piece(*each) for each in line)
        at = f'x="{EDGE_PX + 10:g}" y="{top_px + 21 + LINE_PX * number:g}"'
        yield f'<text class="said" {at} xml:space="preserve">{inside}</text>'


def _piece(text: str, colour: str) -> str:
    return f'<tspan class="{colour}">{escape(text)}</tspan>' if colour else escape(text)


def shots_of(svg: str) -> list[Shot]:
    """What stands in the terminals of a drawing."""
    found = list[Shot]()
    for inside in re.findall(r'<text class="said".*?>(.*)</text>', svg):
        line = [
            (unescape(coloured or usual), colour)
            for colour, coloured, usual in re.findall(
                r'<tspan class="(\w+)">(.*?)</tspan>|([^<]+)', inside
            )
        ]
        if line and line[0][1] == "typed":
            found.append(Shot(line[0][0].removeprefix("$ "), []))
        else:
            found[-1].lines.append(line)
    return found


def words_of(shots: Sequence[Shot]) -> list[str]:
    """All words beside and below the maps, of numbers only that they are there.

    The map itself is left out, and the drawn room: each drive is a little different.
    """
    lines = [plain(line) for shot in shots for line in shot.lines]
    beside = [re.sub(r"^[|+].*[|+]|^[#. ]+$", "", line) for line in lines]
    return [" ".join(NUMBER.sub("0", line).split()) for line in beside if line.strip()]


def kinds_of(shots: Sequence[Shot]) -> set[str]:
    """The colours: of a way, of words over the rover, of the ball."""
    return {colour for shot in shots for line in shot.lines for _, colour in line}


def main(days: Sequence[str]) -> None:
    """Draw these anew, or all."""
    for win in WINS:
        if days and str(win.day) not in days:
            continue
        with tempfile.TemporaryDirectory(prefix="roslings-") as home:
            svg = drawn(win.alt, seen(win, Path(home)))
        for file in (win.file, win.copy):
            file.write_text(svg, "utf-8")
            print(file.relative_to(root()))


if __name__ == "__main__":
    main(sys.argv[1:])
