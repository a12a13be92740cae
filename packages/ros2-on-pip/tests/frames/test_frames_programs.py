"""`ros2 run tf2_ros ...` and `tf2_tools view_frames`: what they print, and how they end."""

from __future__ import annotations

import re
import stat
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from xml.etree import ElementTree

import pytest
from frame_messages import SECOND_NS, step
from terminal import Running, Shell

from ros2_on_pip.frames_heard import FramesHeard
from ros2_on_pip.frames_shown import graphviz, svg, words
from skips import needs

PUBLISH = ("run", "tf2_ros", "static_transform_publisher")
LASER = ("--x", "0.10", "--z", "0.15", "--frame-id", "base_link", "--child-frame-id", "laser")


@contextmanager
def published(shell: Shell, *options: str) -> Iterator[Running]:
    """A publisher that has said it."""
    with shell.start(*PUBLISH, *options) as running:
        running.wait_for("from '.+' to '.+'")
        yield running


@pytest.mark.slow
@needs("module tf2_msgs")
def test_what_one_says_the_other_prints(empty: Shell) -> None:
    """As the page on frames has both; Ctrl-C ends them without a word."""
    with (
        published(empty, *LASER) as publisher,
        empty.start("run", "tf2_ros", "tf2_echo", "base_link", "laser", "20") as echo,
    ):
        echo.wait_for(r"^  0\.000  0\.000  0\.000  1\.000$", times=2)
        assert echo.interrupt() == 0
        assert publisher.interrupt() == 0
        assert "Spinning until stopped - publishing transform" in publisher.text
        block = echo.text[echo.text.index("At time") :].splitlines()
    assert block[:10] == [
        "At time 0.000000000",
        "- Translation: [0.100, 0.000, 0.150]",
        "- Rotation: in Quaternion (xyzw) [0.000, 0.000, 0.000, 1.000]",
        "- Rotation: in RPY (radian) [0.000, 0.000, 0.000]",
        "- Rotation: in RPY (degree) [0.000, 0.000, 0.000]",
        "- Matrix:",
        "  1.000  0.000  0.000  0.100",
        "  0.000  1.000  0.000  0.000",
        "  0.000  0.000  1.000  0.150",
        "  0.000  0.000  0.000  1.000",
    ]
    assert "Traceback" not in publisher.text + echo.text


@pytest.mark.slow
@needs("module tf2_msgs")
def test_an_echo_of_nothing_says_what_it_waits_for(empty: Shell) -> None:
    """In the real one's words."""
    with empty.start("run", "tf2_ros", "tf2_echo", "map", "laser") as echo:
        echo.wait_for(
            r"\[tf2_echo\]: Waiting for transform map ->  laser: Invalid frame ID \"map\" passed to"
            r" canTransform argument target_frame - frame does not exist$"
        )
        assert echo.interrupt() == 0


@pytest.mark.slow
@needs("module tf2_msgs")
@pytest.mark.parametrize(
    ("options", "rpy"),
    [
        (("--yaw", "0.5", "--pitch", "-0.25", *LASER), "[0.000, -0.250, 0.500]"),
        (("--qz", "1", "--qw", "0", *LASER), "[0.000, 0.000, 3.142]"),
        (
            ("0.1", "0", "-0.15", "0.5", "-0.25", "0", "base_link", "laser"),
            "[0.000, -0.250, 0.500]",
        ),
        (("0", "0", "0", "0", "0", "1", "0", "base_link", "laser"), "[0.000, 0.000, 3.142]"),
    ],
)
def test_each_way_to_write_a_rotation(empty: Shell, options: tuple[str, ...], rpy: str) -> None:
    """By angles and by a quaternion, in the new form and in the old one."""
    with (
        published(empty, *options),
        empty.start("run", "tf2_ros", "tf2_echo", "base_link", "laser") as echo,
    ):
        echo.wait_for(rf"^- Rotation: in RPY \(radian\) {re.escape(rpy)}$")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("options", "says"),
    [
        ((), "Not enough arguments to parse"),
        (("--x", "far", *LASER), "argument --x: invalid float value: 'far'"),
        (("--yaw", "1", "--qz", "1", *LASER), "Cannot specify both quaternion and Euler rotations"),
        (("1", "2", "3"), "Extra unparsed arguments on command-line"),
        (("0", "0", "0", "0", "0", "0", "a", "b", "--x", "1"), "Cannot specify both new-style"),
        (("0", "0", "0", "0", "0", "left", "a", "b"), "Failed to parse roll argument as float"),
        (("--frame-id", "a"), "Child frame id must not be empty"),
        (("--child-frame-id", "a"), "Frame id must not be empty"),
        (("--frame-id", "a", "--child-frame-id", "a"), "child_frame_id cannot equal frame_id"),
        (("--qz", "90", *LASER), "The quaternion's length is not 1"),
    ],
)
def test_what_makes_no_transform(empty: Shell, options: tuple[str, ...], says: str) -> None:
    """The error first, then how it is written; exit 1."""
    ran = empty(*PUBLISH, *options)
    assert ran.code == 1
    assert f"error parsing command line arguments: {says}" in ran.err
    assert "usage: static_transform_publisher" in ran.err


@pytest.mark.slow
@pytest.mark.parametrize("options", [(), ("a",), ("a", "b", "fast"), ("a", "b", "0"), ("a",) * 4])
def test_an_echo_of_wrong_words(empty: Shell, options: tuple[str, ...]) -> None:
    """How it is used."""
    ran = empty("run", "tf2_ros", "tf2_echo", *options)
    assert ran.code == 1
    assert ran.out.startswith("Usage: tf2_echo source_frame target_frame [echo_rate]")


@pytest.mark.slow
@needs("module tf2_msgs")
def test_the_monitor(empty: Shell) -> None:
    """Of all frames, and of a chain; it names who publishes."""
    with (
        published(empty, *LASER),
        empty.start("run", "tf2_ros", "tf2_monitor") as every,
        empty.start("run", "tf2_ros", "tf2_monitor", "base_link", "laser") as chain,
    ):
        name = r"/static_transform_publisher_\w+"
        every.wait_for(rf"^Frame: laser, published by {name}, static$")
        every.wait_for(rf"^Node: {name}, on /tf_static$")
        chain.wait_for("^Chain is: laser -> base_link$")
        assert every.interrupt() == 0
        assert chain.interrupt() == 0
    assert empty("run", "tf2_ros", "tf2_monitor", "laser").code == 1


@pytest.mark.slow
@needs("module tf2_msgs")
def test_view_frames(empty: Shell) -> None:
    """The tree in words, and a picture of it."""
    with published(empty, *LASER):
        ran = empty("run", "tf2_tools", "view_frames", "-t", "3", "-o", "mine")
    assert ran.code == 0
    assert re.search(r"^base_link\n└─ laser +static$", ran.out, re.MULTILINE)
    assert "Picture: mine.svg" in ran.out
    picture = ElementTree.parse(empty.folder / "mine.svg")
    texts = [element.text for element in picture.iter() if element.tag.endswith("text")]
    assert sorted(filter(None, texts)) == ["base_link", "laser", "static"]
    assert '"base_link" -> "laser"' in (empty.folder / "mine.gv").read_text("utf-8")


@pytest.mark.slow
@needs("module tf2_msgs")
def test_view_frames_where_nobody_says_anything(empty: Shell) -> None:
    """It names the next step, and writes nothing."""
    ran = empty("run", "tf2_tools", "view_frames", "-t", "0.1")
    assert ran.code == 1
    assert "ros2 topic info -v /tf" in ran.err
    assert list(empty.folder.glob("frames_*")) == []


@pytest.mark.slow
@needs("module tf2_msgs")
def test_from_a_launch_file(empty: Shell) -> None:
    """As most robots start it."""
    (empty.folder / "laser.launch.xml").write_text(
        '<launch><node pkg="tf2_ros" exec="static_transform_publisher" name="laser_place"'
        ' args="--x 0.1 --frame-id base_link --child-frame-id laser"/></launch>'
    )
    with empty.start("launch", "laser.launch.xml") as launched:
        launched.wait_for(r"\[laser_place\]: Spinning until stopped")
        assert "/laser_place" in empty("node", "list").lines


@pytest.mark.slow
def test_without_the_type_each_says_what_to_do(empty: Shell) -> None:
    """One line, exit 1."""
    nothing = empty.folder / "without" / "tf2_msgs"
    nothing.mkdir(parents=True)
    (nothing / "__init__.py").write_text("raise ImportError('tf2_msgs is not built')")
    path = f"{nothing.parent}:{empty.environment['PYTHONPATH']}"
    for command in (
        (*PUBLISH, *LASER),
        ("run", "tf2_ros", "tf2_echo", "a", "b"),
        ("run", "tf2_ros", "tf2_monitor"),
        ("run", "tf2_tools", "view_frames"),
    ):
        ran = empty(*command, PYTHONPATH=path)
        assert ran.code == 1
        assert "/tf has the type tf2_msgs/msg/TFMessage. " in ran.err
        assert "Traceback" not in ran.err


# Stands for rclpy, which makes a RuntimeError of a Ctrl-C that comes while a message is unpacked.
UNPACKS = """
import os, signal, sys
from ros2_on_pip import tf_program

def act(words):
    try:
        if words:
            os.kill(os.getpid(), signal.SIGINT)
            while True:
                pass
    except KeyboardInterrupt:
        pass
    raise RuntimeError("Unable to convert call argument '0' to Python object")

sys.exit(tf_program.run(act))
"""


@pytest.mark.slow
@pytest.mark.parametrize(("words", "code"), [(["interrupted"], 0), ([], 1)])
def test_ctrl_c_while_a_message_is_unpacked(empty: Shell, words: list[str], code: int) -> None:
    """It is no error; the same words without a Ctrl-C are one."""
    with empty.program([sys.executable, "-c", UNPACKS, *words]) as running:
        assert running.wait() == code, running.text
        assert ("RuntimeError" in running.text) == bool(code)


def test_they_are_packages(empty: Shell) -> None:
    """As `ros2 pkg` lists them."""
    assert empty("pkg", "executables", "tf2_ros").lines == [
        "tf2_ros static_transform_publisher",
        "tf2_ros tf2_echo",
        "tf2_ros tf2_monitor",
    ]
    assert empty("pkg", "executables", "tf2_tools").lines == ["tf2_tools view_frames"]
    ran = empty("run", "tf2_ros", "tf2_eco")
    assert ran.code == 1
    assert "Did you mean tf2_echo?" in ran.err


def test_those_of_a_sourced_workspace_go_first(empty: Shell, tmp_path: Path) -> None:
    """Who has built geometry2 runs that."""
    real = tmp_path / "install" / "lib" / "tf2_ros" / "tf2_echo"
    marker = tmp_path / "install/share/ament_index/resource_index/packages/tf2_ros"
    for place in (real, marker):
        place.parent.mkdir(parents=True)
    real.write_text("#!/bin/sh\necho the real one: $*\n")
    real.chmod(real.stat().st_mode | stat.S_IXUSR)
    marker.touch()
    ran = empty("run", "tf2_ros", "tf2_echo", "a", "b", AMENT_PREFIX_PATH=str(tmp_path / "install"))
    assert ran.out == "the real one: a b\n"


# --- what is shown -----------------------------------------------------------------------------

NOW_NS = 12 * SECOND_NS


def heard(*moving: tuple[str, str, float], static: tuple[tuple[str, str], ...] = ()) -> FramesHeard:
    """Steps with their times, and those that never move."""
    frames = FramesHeard(lambda: NOW_NS)
    for parent, child, time_s in moving:
        frames.set_transform(step(parent, child, time_s), "test")
    for parent, child in static:
        frames.set_transform_static(step(parent, child), "test")
    return frames


DRIVES = [("odom", "base_link", 10 + part / 10) for part in range(11)]


def test_the_tree_in_words() -> None:
    """Each frame below its parent, with how often and how old."""
    frames = heard(
        *DRIVES,
        ("map", "odom", 11.5),
        static=(("base_link", "laser"), ("base_link", "camera"), ("camera", "lens")),
    )
    assert words(frames, NOW_NS).splitlines() == [
        "map",
        "└─ odom                          once, 0.50 s old",
        "   └─ base_link                  10.0 Hz, 1.00 s old",
        "      ├─ laser                   static",
        "      └─ camera                  static",
        "         └─ lens                 static",
    ]
    assert frames.faults() == []
    plain = words(frames, NOW_NS, "latin-1").splitlines()
    assert plain[3].startswith("      |- laser   ")
    assert plain[5].startswith("         `- lens   ")


def test_the_picture_has_a_box_for_each_frame() -> None:
    """None lies on another, also of names that are no XML."""
    frames = heard(*DRIVES, static=(("base_link", "<b>"), ("base_link", 'say "c"'), ("x", "y")))
    picture = ElementTree.fromstring(svg(frames, NOW_NS))
    boxes = [e.attrib for e in picture.iter() if e.tag.endswith("rect") and "rx" in e.attrib]
    assert len(boxes) == 6
    assert len({(box["x"], box["y"]) for box in boxes}) == 6
    texts = {element.text for element in picture.iter() if element.tag.endswith("text")}
    assert {"<b>", 'say "c"', "odom"} <= texts
    assert '"base_link" -> "say \\"c\\""' in graphviz(frames, NOW_NS)


def test_long_names_have_room() -> None:
    """Their boxes do not touch."""
    names = [f"{side}_gripper_fingertip_contact_sensor_link" for side in ("left", "right")]
    frames = heard(static=tuple(("hand", name) for name in names))
    boxes = [e.attrib for e in ElementTree.fromstring(svg(frames, NOW_NS)) if "rx" in e.attrib]
    _, left, right = sorted(boxes, key=lambda box: float(box["y"]))
    assert float(left["x"]) + float(left["width"]) < float(right["x"])


@pytest.mark.parametrize(
    ("frames", "says"),
    [
        (
            heard(("odom", "base_link", 1.0), ("map", "base_link", 2.0)),
            "'base_link' has several parents: 'odom', 'map'.",
        ),
        (
            heard(("odom", "laser", 1.0), static=(("odom", "laser"),)),
            "'laser' comes on /tf and on /tf_static.",
        ),
        (
            heard(static=(("odom", "base_link"), ("lidar", "laser"))),
            "These are 2 trees, with the roots 'odom', 'lidar'.",
        ),
        (
            heard(static=(("a", "b"), ("b", "a"), ("odom", "base_link"))),
            "These frames go round in a loop: 'b', 'a'.",
        ),
    ],
)
def test_what_does_not_fit_is_told(frames: FramesHeard, says: str) -> None:
    """One sentence, which names the frames."""
    (told,) = frames.faults()
    assert told.startswith(says)
