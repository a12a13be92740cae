"""Which value of a parameter wins, as rcl itself decides: what day 8 and the lab bring-up tell.

Files and commands are given to a real node, and the node says what it got. For launch files, the
words come from our `Node`, as `ros2 launch` would give them to the program.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from pathlib import Path

import pytest

from ros2_on_pip.launching.context import Around, LaunchContext
from ros2_on_pip.launching.node import Node
from ros2_on_pip.launching.reading import description_in
from ros2_on_pip.launching.screen import LaunchOutput
from skips import imported

FULL, ALL = "/red/speed_limiter", "/**"
FILES = {
    "for all": (ALL,),
    "for all, then for one": (ALL, FULL),
    "for one": (FULL,),
    "for one, then for all": (FULL, ALL),
}
"""The sections of a file, in their order. All say the opposite of what the command says."""

WINS = {
    ("-p", "for all"): True,
    ("-p", "for all, then for one"): False,
    ("-p", "for one"): True,
    ("-p", "for one, then for all"): True,
    ("no name", "for all"): True,
    ("no name", "for all, then for one"): False,
    ("no name", "for one"): True,
    ("no name", "for one, then for all"): True,
    ("both names", "for all"): True,
    ("both names", "for all, then for one"): True,
    ("both names", "for one"): True,
    ("both names", "for one, then for all"): False,
    ("pushed", "for all"): True,
    ("pushed", "for all, then for one"): True,
    ("pushed", "for one"): True,
    ("pushed", "for one, then for all"): False,
}
"""How the command says it, and which file it is held against. A section that comes again keeps its
first place: so a name wins over a file that begins with what holds for all, and only there."""


@pytest.fixture(autouse=True)
def on_this_computer(monkeypatch: pytest.MonkeyPatch) -> None:
    """No node of these tests looks beyond it."""
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")


def file_with(folder: Path, sections: Sequence[str], value: bool) -> Path:
    """A parameter file that says the same in each of its sections."""
    text = "".join(f"{each}:\n  ros__parameters: {{careful: {value}}}\n" for each in sections)
    file = folder / "values.yaml"
    file.write_text(text, "utf-8")
    return file


def words_of(how: str, file: Path, value: bool, folder: Path) -> list[str]:
    """What the program gets, without its own name."""
    if how == "-p":
        said = ["--params-file", str(file), "-p", f"careful:={str(value).lower()}"]
        return ["--ros-args", "-r", "__ns:=/red", *said]
    context = LaunchContext(around=Around(LaunchOutput(), folder, description_in))
    if how != "both names":
        context.launch_configurations["ros_namespace"] = "/red"
    names = {"name": "speed_limiter"} if how != "no name" else {}
    space = {"namespace": "red"} if how == "both names" else {}
    node = Node(executable="it", parameters=[str(file), {"careful": value}], **names, **space)
    return node.command(context)[1:]


def got(words: Sequence[str]) -> bool:
    """What a node of the limiter's name makes of them."""
    rclpy = imported("rclpy")
    context = rclpy.context.Context()
    rclpy.init(args=["it", *words], context=context)
    try:
        node = rclpy.create_node("speed_limiter", context=context)
        return bool(node.declare_parameter("careful", False).value)
    finally:
        rclpy.shutdown(context=context)


@pytest.mark.parametrize("value", [True, False])
@pytest.mark.parametrize(("how", "file"), WINS, ids=" against ".join)
def test_what_wins(how: str, file: str, value: bool, tmp_path: Path) -> None:
    """True over false, and false over true."""
    words = words_of(how, file_with(tmp_path, FILES[file], not value), value, tmp_path)
    assert got(words) is (value if WINS[how, file] else not value)


def test_the_table_is_whole() -> None:
    """Each way to say it against each file."""
    assert set(WINS) == set(itertools.product({how for how, _ in WINS}, FILES))
