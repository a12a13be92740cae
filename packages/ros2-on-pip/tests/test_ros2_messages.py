"""Hearing, measuring and saying messages."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest
from terminal import DEAF, Shell, ours

pytestmark = pytest.mark.slow

QUIET_END = 2
"""The exit code of the real ros2 after Ctrl-C."""


def test_echo(stage: Shell) -> None:
    """YAML, and a line of three dashes."""
    ran = stage("topic", "echo", "--once", "/cmd_vel")
    assert ran.out == (
        "header:\n  stamp:\n    sec: 0\n    nanosec: 0\n  frame_id: base\n"
        "twist:\n  linear:\n    x: 1.5\n    y: 0.0\n    z: 0.0\n"
        "  angular:\n    x: 0.0\n    y: 0.0\n    z: 0.0\n---\n"
    )
    assert (ran.code, ran.err) == (0, "")


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (("/cmd_vel", "--field", "twist.linear"), "x: 1.5\ny: 0.0\nz: 0.0\n---\n"),
        (("/cmd_vel", "--field", "header.frame_id"), "base\n---\n"),
        (("/scan", "--field", "ranges[2]"), "2.0\n---\n"),
        (("/cmd_vel", "--csv"), "0,0,base,1.5,0.0,0.0,0.0,0.0,0.0\n"),
        (
            ("/cmd_vel", "--field", "twist.linear", "--flow-style"),
            "x: 1.5\ny: 0.0\nz: 0.0\n---\n",
        ),
        (("/scan", "--field", "intensities"), "array('f')\n---\n"),
    ],
)
def test_echo_in_other_shapes(stage: Shell, words: tuple[str, ...], expected: str) -> None:
    """Fields, lists, CSV, one line."""
    assert stage("topic", "echo", "--once", *words).out == expected


def test_echo_cuts_long_lists_as_the_real_tool_does(stage: Shell) -> None:
    """After 128 elements, unless all are asked for; or only their number."""
    cut = stage("topic", "echo", "--once", "/scan").lines
    assert cut.count("- '...'") == 1
    assert sum(line.startswith("- ") for line in cut) == 128 + 1
    whole = stage("topic", "echo", "--once", "-f", "/scan").lines
    assert sum(line.startswith("- ") for line in whole) == 200
    counted = stage("topic", "echo", "--once", "--no-arr", "/scan").lines
    assert "ranges: '<sequence type: float, length: 200>'" in counted


def test_echo_of_a_field_that_is_not_there(stage: Shell) -> None:
    """Said before any message is waited for."""
    ran = stage("topic", "echo", "/cmd_vel", "--field", "twist.lineer.x")
    assert ran.code == 1
    assert "Invalid field 'twist.lineer.x': there is no 'lineer'. Did you mean linear?" in ran.err


def test_quality_that_cannot_match_is_said_at_once(stage: Shell) -> None:
    """A reliable listener hears nothing from a best effort publisher."""
    with stage.start("topic", "echo", "/scan", "--qos-reliability", "reliable") as echo:
        echo.wait_for(
            "WARNING: No message can come from node rover: it offers reliability BEST_EFFORT,"
            " and RELIABLE is asked for."
        )
        assert echo.interrupt() == QUIET_END


@pytest.mark.parametrize(
    ("words", "started", "code"),
    [
        (("topic", "echo", "/chatter"), "Hello World", QUIET_END),
        (("bag", "record", "/chatter"), "All requested topics are subscribed", 0),
    ],
)
def test_ctrl_c_ends_what_a_script_started_in_the_background(
    stage: Shell, tmp_path: Path, words: tuple[str, ...], started: str, code: int
) -> None:
    """There a program starts deaf to it."""
    here = Shell(stage.environment, tmp_path)
    with here.program([*DEAF, *ours(*words)]) as running:
        running.wait_for(started)
        assert running.interrupt() == code


def test_ctrl_c_is_quiet(stage: Shell) -> None:
    """No traceback, the real tool's exit code."""
    with stage.start("topic", "echo", "/chatter") as echo:
        echo.wait_for("Hello World")
        assert echo.interrupt() == QUIET_END
    assert "Traceback" not in echo.text
    assert "KeyboardInterrupt" not in echo.text


def test_closed_pipe_is_quiet(stage: Shell) -> None:
    """`ros2 topic echo /chatter | head -1`."""
    reading, writing = os.pipe()
    process = subprocess.Popen(
        ours("topic", "echo", "/chatter"),
        env=stage.environment,
        cwd=stage.folder,
        stdout=writing,
        stderr=subprocess.PIPE,
        text=True,
    )
    os.close(writing)
    with os.fdopen(reading) as head:
        assert head.readline().startswith("data: 'Hello World")
    _, complaint = process.communicate(timeout=60)
    assert complaint == ""
    assert process.returncode == 0


def test_hz(stage: Shell) -> None:
    """The real tool's two lines, and one on losses."""
    with stage.start("topic", "hz", "/chatter") as hz:
        hz.wait_for(r"^average rate: \d+\.\d{3}$")
        hz.wait_for(r"^\tmin: \d\.\d{3}s max: \d+\.\d{3}s std dev: \d+\.\d{5}s window: \d+$")
        hz.wait_for(r"^\tlost: \d+ of \d+ messages$")
        assert hz.interrupt() == QUIET_END


def test_hz_waits_for_a_topic(empty: Shell) -> None:
    """As the real tool: a warning, and then it waits."""
    with empty.start("topic", "hz", "/chatter", "--window", "5") as hz:
        hz.wait_for(r"WARNING: topic \[/chatter\] does not appear to be published yet")
        with empty.start("topic", "pub", "-r", "20", "/chatter", "std_msgs/msg/String"):
            hz.wait_for("window: 5")


def test_bw(stage: Shell) -> None:
    """Bytes a second and sizes."""
    with stage.start("topic", "bw", "/cmd_vel") as bw:
        bw.wait_for(r"^Subscribed to \[/cmd_vel\]$")
        bw.wait_for(r"^[\d.]+ (B|KB)/s from \d+ messages$")
        bw.wait_for(r"^\tMessage size mean: [\d.]+ K?B min: [\d.]+ K?B max: [\d.]+ K?B$")


def test_pub_once(stage: Shell) -> None:
    """It waits for a listener, so the message arrives."""
    ran = stage("topic", "pub", "--once", "/heard", "std_msgs/msg/String", "{data: salt}")
    shown = [line for line in ran.lines if not line.startswith("Waiting for at least 1")]
    assert shown == [
        "publisher: beginning loop",
        "publishing #1: std_msgs.msg.String(data='salt')",
        "",
    ]
    stage.wait_heard("salt")


def test_pub_several_times(stage: Shell) -> None:
    """`-t 3`, of which every second is printed; a short type name is enough."""
    ran = stage(
        "topic", "pub", "-t", "3", "-r", "50", "-p", "2", "heard", "std_msgs/String", "data: pepper"
    )
    assert "publishing #2: std_msgs.msg.String(data='pepper')" in ran.lines
    assert "publishing #1" not in ran.out
    stage.wait_heard("pepper", times=3)


def test_pub_in_a_loop_until_ctrl_c(stage: Shell) -> None:
    """The usual way to use it."""
    words = ("topic", "pub", "-r", "50", "/heard", "std_msgs/msg/String", "{data: 5}")
    with stage.start(*words) as pub:
        pub.wait_for(r"publishing #3: std_msgs.msg.String\(data='5'\)")
        assert pub.interrupt() == QUIET_END


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("std_msgs/msg/String", "{data: [}"), "  {data: [}\n          ^"),
        (("std_msgs/msg/String", "data:hey"), "Put a space after the colon."),
        (("std_msgs/msg/String", "{dat: x}"), "has no field 'dat'. Did you mean data?"),
        (("geometry_msgs/msg/Twist", "{linear: {x: fast}}"), "linear.x: it needs a number"),
        (("geometry_msgs/msg/Twist", "{linear: 3}"), "linear: it needs {x: ..., y: ..., z: ...}"),
        (("std_msgs/msg/UInt8", "{data: 256}"), "256 is out of range: uint8 goes from 0 to 255"),
        (("Twist",), "Did you mean geometry_msgs/msg/Twist?"),
        (("std_msgs/msg/Sting",), "Did you mean std_msgs/msg/String?"),
    ],
)
def test_pub_says_what_is_wrong_with_the_values(
    empty: Shell, words: tuple[str, ...], said: str
) -> None:
    """The place of the fault, before anything is published."""
    ran = empty("topic", "pub", "--once", "/x", *words)
    assert (ran.code, ran.out) == (1, "")
    assert said in ran.err


def test_pub_to_a_misspelt_topic(stage: Shell) -> None:
    """Nobody listens there: the near miss is named while it waits."""
    words = ("topic", "pub", "--once", "/herd", "std_msgs/msg/String")
    with stage.start(*words) as pub:
        pub.wait_for(r"Waiting for at least 1 matching subscription\(s\)...")
        pub.wait_for("No node subscribes to '/herd'. Did you mean /heard?")
