"""What a lab looks like when it works: typed in real terminals, and drawn.

    .venv/bin/python tests/labs/works.py topics      draws labs/topics/pictures/works.svg anew

`labs/NAME/works.yaml` says what is typed where, and which picture stands below the terminals.
"""

from __future__ import annotations

import io
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap
from base64 import b64decode, b64encode
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from html import escape, unescape
from itertools import accumulate
from pathlib import Path
from typing import Literal

import yaml
from pydantic import BaseModel, ConfigDict

from ros2_on_pip.domain_lease import leased_domain
from roslings.course import Lab, lab, root

sys.path += [str(root() / "tests"), str(root() / "tests" / "days")]
from terminals import PATIENCE_S, Terminal, opened, surroundings

COLUMNS, LINE_PX, WIDE_PX, EDGE_PX = 82, 18.0, 664.0, 12.0
PHOTO_PX = (480, 360)
PROMPT = "ready> "
STAMP = re.compile(r"\[\d{9,}\.\d+\]")
NUMBER = re.compile(r"-?\d+(\.\d+)?(e-?\d+)?")
STYLE = """
text { font: 12.5px ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; }
.window { fill: #1b1f27; } .bar { fill: #343b48; }
.title { fill: #c9d1dc; font-family: system-ui, sans-serif; } .said { fill: #e6e9ee; }
.typed { fill: #7ee08a; }
"""

TELL = """
from base64 import b64encode
found = picture()
print(found.kind, b64encode(found.still or found.content).decode())
"""
GRAPH = "from roslings_learn.notebook.graph import graph_picture as picture"
BALL = """
from roslings_learn.notebook import session
from roslings_learn.notebook.image import image_picture
def picture():
    with session() as ros:
        return image_picture(ros.collect("/ball/image", count=1, timeout_s=60)[0])
"""
DRIVE = """
import math
from roslings_learn.notebook import session
from roslings_learn.notebook.rover_map import path_picture
def apart_m(one, other):
    one, other = one.pose.pose.position, other.pose.pose.position
    return math.hypot(one.x - other.x, one.y - other.y)
def picture():
    way = []
    with session() as ros:
        way += ros.collect("/odom", count=1, timeout_s=60)
        print("ready", flush=True)
        rests = False
        while not (rests and apart_m(way[0], way[-1]) > 0.2):
            more = ros.collect("/odom", count=10, timeout_s=60)
            rests = apart_m(more[0], more[-1]) < 0.002
            way += more
    return path_picture(way)
"""
"""From the first message until the rover has moved, and stands for ten messages."""

CODE = {"graph": GRAPH, "ball": BALL, "drive": DRIVE}


class Strict(BaseModel):
    """A word that is not known is a slip of the pen."""

    model_config = ConfigDict(extra="forbid")


class Typed(Strict):
    """One command in one terminal."""

    terminal: int
    types: str
    own: str = ""
    """Typed behind it, and not drawn: a place for a device that no other test has."""
    until: str = ""
    """A regular expression, of what it shows when it works."""
    later: bool = False
    """That comes only when all is typed."""
    lines: int = 0
    """So many lines of what it says are drawn, the first ones."""
    last: int = 0
    """And so many of the last ones, behind three dots."""
    hidden: bool = False
    """It is typed, and not drawn."""


class Works(Strict):
    """All that is typed, in this order; the last command may end the picture of a drive."""

    terminals: list[Typed]
    picture: Literal["graph", "drive", "ball"] | None = None
    """None where the terminals show all."""
    alt: str
    """What the picture below the terminals shows, in a sentence; else what they show."""

    @classmethod
    def of(cls, lab: Lab) -> Works:
        """What the lab's file says."""
        return cls.model_validate(yaml.safe_load((lab.folder / "works.yaml").read_text("utf-8")))


@dataclass(frozen=True)
class Window:
    """A terminal as it stood there."""

    title: str
    typed: str
    said: list[str]

    @property
    def lines(self) -> list[tuple[str, str]]:
        """Each line with its kind; a long command goes on in the next line."""
        command = textwrap.wrap(f"$ {self.typed}", COLUMNS, subsequent_indent="    ")
        return [("typed", line) for line in command] + [("said", line) for line in self.said]

    @property
    def high_px(self) -> float:
        """With its title bar."""
        return 26 + LINE_PX * len(self.lines) + 8


@dataclass(frozen=True)
class Shot:
    """The picture below the terminals."""

    kind: str
    content: bytes

    @property
    def address(self) -> str:
        """All of it, so that no file is asked for."""
        return f"data:{self.kind};base64,{b64encode(self.content).decode()}"

    @property
    def size(self) -> tuple[float, float]:
        """As large as it says."""
        found = re.search(rb'viewBox="0 0 ([0-9.]+) ([0-9.]+)"', self.content)
        return (float(found[1]), float(found[2])) if found else PHOTO_PX

    def lighter(self) -> Shot:
        """A photo as JPEG: the noise of a camera is no use in the course's folder."""
        if self.kind != "image/png":
            return self
        from PIL import Image

        photo, file = Image.open(io.BytesIO(self.content)), io.BytesIO()
        photo.convert("RGB").resize(PHOTO_PX).save(file, "JPEG", quality=80)
        return Shot("image/jpeg", file.getvalue())


def seen(lab: Lab, home: Path) -> tuple[list[Window], Shot | None]:
    """What a student sees who has finished the lab: the terminals, and the picture below them."""
    works = Works.of(lab)
    numbers = sorted({each.terminal for each in works.terminals})
    with ExitStack() as stack, ExitStack() as leased:
        domain = leased.enter_context(leased_domain())
        terminals = {number: stack.enter_context(opened(home, domain)) for number in numbers}
        _make_ready(lab, home, terminals)
        *before, last = works.terminals
        _type(terminals, before, home)
        leased.close()  # nodes are in it now; the one who looks leases it, as a notebook does
        if works.picture is None:
            _type(terminals, [last], home)
            return _windows(works, terminals, home), None
        with _photographer(works.picture, home, domain) as photographer:
            _type(terminals, [last], home)
            return _windows(works, terminals, home), _shot(photographer)


def _windows(works: Works, terminals: dict[int, Terminal], home: Path) -> list[Window]:
    return [_window(terminals, each, home) for each in works.terminals if not each.hidden]


@contextmanager
def _photographer(picture: str, home: Path, domain: int) -> Iterator[subprocess.Popen[str]]:
    """A process of its own that looks; of a drive it sees the start, too."""
    code = CODE[picture] + TELL
    with subprocess.Popen(
        [sys.executable, "-c", code],
        env=surroundings(home, domain),
        cwd=home,
        stdout=subprocess.PIPE,
        text=True,
    ) as photographer:
        try:
            assert photographer.stdout
            if picture == "drive":
                assert photographer.stdout.readline() == "ready\n"
            yield photographer
        finally:
            photographer.kill()


def _shot(photographer: subprocess.Popen[str]) -> Shot:
    said, _ = photographer.communicate(timeout=PATIENCE_S)
    kind, content = said.splitlines()[-1].split()
    return Shot(kind, b64decode(content)).lighter()


def _make_ready(lab: Lab, home: Path, terminals: dict[int, Terminal]) -> None:
    """The steps of the task that come before anything is seen."""
    first = next(iter(terminals.values()))
    _to_its_end(first, f"./roslings start {lab.name}")
    own = home / "roslings_ws" / "src" / lab.card.package
    shutil.copytree(lab.solution, own, dirs_exist_ok=True, copy_function=shutil.copy)
    _to_its_end(first, "source setup.bash")
    _to_its_end(first, "cd ~/roslings_ws && colcon build && cd -")
    assert "1 package finished" in first.heard(), first
    for terminal in terminals.values():
        _to_its_end(terminal, "source setup.bash && source ~/roslings_ws/install/setup.bash")


def _to_its_end(terminal: Terminal, line: str) -> None:
    terminal.is_free()
    terminal.type(line)
    terminal.is_free()


def _type(terminals: dict[int, Terminal], commands: Sequence[Typed], home: Path) -> None:
    for each in commands:
        terminals[each.terminal].type(_own(f"{each.types} {each.own}", home))
        if not each.later:
            terminals[each.terminal].shows(each.until)


def _own(typed: str, home: Path) -> str:
    return typed.replace("/tmp/", f"{home}/")


def _window(terminals: dict[int, Terminal], each: Typed, home: Path) -> Window:
    terminal = terminals[each.terminal]
    terminal.shows(each.until)
    said = terminal.heard().replace("\r", "").replace(f"{home}/", "/tmp/")
    kept = [line for line in said.partition("\n")[2].splitlines() if line.strip()]
    if kept and kept[-1] == PROMPT:
        kept.pop()
    assert len(kept) >= each.lines + each.last, terminal
    end = ["...", *kept[-each.last :]] if each.last else []
    lines = [_short(STAMP.sub("[...]", line)) for line in [*kept[: each.lines], *end]]
    return Window(f"Terminal {each.terminal}", each.types, lines)


def _short(line: str) -> str:
    return line if len(line) <= COLUMNS else f"{line[: COLUMNS - 4]} ..."


# --- drawing ------------------------------------------------------------------------------------


def drawn(works: Works, windows: Sequence[Window], shot: Shot | None) -> str:
    """The SVG: the terminals below each other, and the picture on white below them."""
    tops = [*accumulate((each.high_px + EDGE_PX for each in windows), initial=EDGE_PX)]
    parts = [part for top, each in zip(tops, windows, strict=False) for part in _drawn(each, top)]
    total = tops[-1]
    if shot:
        high, below = _hung(shot, tops[-1])
        parts += below
        total += high + 3 * EDGE_PX
    return "\n".join(
        [
            '<svg class="terminal" xmlns="http://www.w3.org/2000/svg"'
            f' viewBox="0 0 {WIDE_PX:g} {total:g}"'
            f' width="{WIDE_PX:g}" height="{total:g}">',
            f"<title>{escape(works.alt)}</title>",
            f"<style>{STYLE}</style>",
            *parts,
            "</svg>\n",
        ]
    )


def _hung(shot: Shot, top_px: float) -> tuple[float, list[str]]:
    """How high the picture is as it is drawn, and its parts."""
    wide, high = shot.size
    scale = min(1.3, (WIDE_PX - 4 * EDGE_PX) / wide)
    wide, high = wide * scale, high * scale
    return high, [
        f'<rect x="{EDGE_PX:g}" y="{top_px:g}" width="{WIDE_PX - 2 * EDGE_PX:g}"'
        f' height="{high + 2 * EDGE_PX:g}" rx="8" fill="#fff" stroke="#c9d1dc"/>',
        f'<image x="{(WIDE_PX - wide) / 2:g}" y="{top_px + EDGE_PX:g}" width="{wide:g}"'
        f' height="{high:g}" href="{shot.address}"/>',
    ]


def _drawn(window: Window, top_px: float) -> Iterator[str]:
    x, wide = EDGE_PX, WIDE_PX - 2 * EDGE_PX
    yield (
        f'<rect class="window" x="{x:g}" y="{top_px:g}" width="{wide:g}"'
        f' height="{window.high_px:g}" rx="8"/>'
    )
    yield f'<path class="bar" d="M{x:g} {top_px + 22:g}v-14q0 -8 8 -8h{wide - 16:g}q8 0 8 8v14z"/>'
    yield f'<text class="title" x="{x + 10:g}" y="{top_px + 15:g}">{window.title}</text>'
    for number, (kind, line) in enumerate(window.lines):
        at = f'x="{x + 10:g}" y="{top_px + 39 + LINE_PX * number:g}"'
        yield f'<text class="{kind}" {at} xml:space="preserve">{escape(line)}</text>'


def texts_of(svg: str) -> list[str]:
    """What stands in the terminals of a drawing; numbers are another story each time."""
    return [NUMBER.sub("0", unescape(each)) for each in re.findall(r"<text.*?>(.*)</text>", svg)]


def main(names: Sequence[str]) -> None:
    """Draw the named labs anew."""
    for each in map(lab, names):
        with tempfile.TemporaryDirectory(prefix="roslings-") as home:
            windows, shot = seen(each, Path(home))
        file = each.folder / "pictures" / "works.svg"
        file.parent.mkdir(exist_ok=True)
        file.write_text(drawn(Works.of(each), windows, shot), "utf-8")
        print(file.relative_to(root()))


if __name__ == "__main__":
    main(sys.argv[1:])
