"""Launch files in XML and YAML."""

from __future__ import annotations

from pathlib import Path

import pytest
from launch_shop import is_gone, package, pid_of, written
from terminal import DEAF, Shell, ours

from ros2_on_pip.words import NOT_READ_HERE

XML = """\
<launch>
  <arg name="topic" default="news" description="where to talk"/>
  <let name="space" value="$(var topic)_space"/>
  <log message="In $(dirname) with $(env ROS_DOMAIN_ID)"/>
  <group>
    <push_ros_namespace namespace="$(var space)"/>
    <node pkg="demo_nodes_py" exec="talker" name="speaker">
      <remap from="chatter" to="/$(var topic)"/>
      <param name="depth.inner" value="2"/>
    </node>
  </group>
  <node pkg="demo_nodes_py" exec="listener"><remap from="chatter" to="$(var topic)"/></node>
</launch>
"""
YAML = """\
launch:
- arg: {name: topic, default: news}
- let: {name: space, value: $(var topic)_space}
- log: {message: In $(dirname) with $(env ROS_DOMAIN_ID)}
- group:
  - push_ros_namespace: {namespace: $(var space)}
  - node:
      pkg: demo_nodes_py
      exec: talker
      name: speaker
      remap:
      - {from: chatter, to: /$(var topic)}
      param:
      - {name: depth.inner, value: 2}
- node:
    pkg: demo_nodes_py
    exec: listener
    remap:
    - {from: chatter, to: $(var topic)}
"""


@pytest.mark.parametrize(("name", "text"), [("a.launch.xml", XML), ("a.launch.yaml", YAML)])
def test_launch_of_two_nodes(empty: Shell, tmp_path: Path, name: str, text: str) -> None:
    """Started, renamed, prefixed; one Ctrl-C ends both cleanly."""
    written(tmp_path, name, text)
    with empty.start("launch", name, "topic:=weather") as launch:
        launch.wait_for(rf"^\[INFO\] \[launch.user\]: In {tmp_path} with \d+$")
        launch.wait_for(r"^\[INFO\] \[talker-1\]: process started with pid \[\d+\]$")
        launch.wait_for(r"^\[talker-1\] \[INFO\] \[[\d.]+\] \[weather_space.speaker\]: Publishing")
        launch.wait_for(r"^\[listener-2\] \[INFO\] \[[\d.]+\] \[listener\]: I heard: ")
        assert empty("topic", "list").lines[-1] == "/weather"
        assert launch.interrupt(whole_group=True) == 0
        launch.wait_for(r"^\[WARNING\] \[launch\]: user interrupted with ctrl-c \(SIGINT\)$")
        launch.wait_for(r"^\[INFO\] \[talker-1\]: process has finished cleanly \[pid \d+\]$")
        launch.wait_for(r"^\[INFO\] \[listener-2\]: process has finished cleanly \[pid \d+\]$")
    assert "Traceback" not in launch.text


def test_a_launch_in_the_background_hears_ctrl_c(empty: Shell, tmp_path: Path) -> None:
    """And so do its nodes, which end cleanly."""
    written(tmp_path, "a.launch.xml", XML)
    with empty.program([*DEAF, *ours("launch", "a.launch.xml", "topic:=weather")]) as launch:
        launch.wait_for(r"I heard: ")
        assert launch.interrupt() == 0
        launch.wait_for("process has finished cleanly", times=2)


@pytest.fixture
def programs(empty: Shell, tmp_path: Path) -> Shell:
    """A terminal with the package `mine`: one program crashes, one stays deaf to Ctrl-C."""
    return package(
        empty,
        tmp_path,
        crashes='#!/bin/sh\necho "with $*"; exit 3\n',
        stays="#!/bin/sh\ntrap '' INT; echo here; while :; do sleep 0.1; done\n",
    )


def test_a_crash_is_reported_and_the_others_go_on(programs: Shell, tmp_path: Path) -> None:
    """The exit code and the command, as the real tool tells them; the parameters in a file."""
    written(
        tmp_path,
        "two.launch.xml",
        """<launch>
  <node pkg="mine" exec="crashes" namespace="x" args="-a 'b c'" output="screen">
    <param name="n" value="1.5"/>
  </node>
  <node pkg="mine" exec="stays" output="screen"/>
</launch>""",
    )
    with programs.start("launch", "two.launch.xml") as launch:
        launch.wait_for(r"^\[crashes-1\] with -a b c --ros-args -r __ns:=/x --params-file \S+$")
        died = r"process has died \[pid \d+, exit code 3, cmd '.*crashes -a .*'\]\."
        launch.wait_for(rf"^\[ERROR\] \[crashes-1\]: {died}$")
        launch.wait_for("^.stays-2. here$")
        launch.process.send_signal(2)
        launch.wait_for(r"failed to terminate '5' seconds after receiving 'SIGINT', escalating")
        assert launch.wait() == 0
    assert is_gone(pid_of(launch, "stays-2"))


def test_launch_ends_with_its_last_node(programs: Shell, tmp_path: Path) -> None:
    """Exit 1 where one of them crashed."""
    written(tmp_path, "one.launch.xml", '<launch><node pkg="mine" exec="crashes"/></launch>')
    assert programs("launch", "one.launch.xml").code == 1


def test_arguments_are_shown(empty: Shell, tmp_path: Path) -> None:
    """`--show-args`."""
    written(tmp_path, "a.launch.xml", XML)
    assert empty("launch", "--show-args", "a.launch.xml").out == (
        "Arguments (pass arguments as '<name>:=<value>'):\n\n"
        "    'topic':\n        where to talk\n        (default: 'news')\n"
    )


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            "$(dirname)",
            "$(param x)",
            "line 4: $(param ...) is right in Jazzy, and not in this launch: it",
        ),
        (
            "<log message",
            "<ros_timer period",
            "line 4: 'ros_timer' is right in Jazzy, and not in this",
        ),
        (
            "group>",
            "node_container>",
            "line 5: 'node_container' is right in Jazzy, and not in this",
        ),
    ],
)
def test_what_only_the_full_ros_reads_has_a_code_of_its_own(
    empty: Shell, tmp_path: Path, old: str, new: str, said: str
) -> None:
    """Right there, so no mistake: who judges must not count it as one."""
    written(tmp_path, "a.launch.xml", XML.replace(old, new))
    ran = empty("launch", "a.launch.xml")
    assert ran.code == NOT_READ_HERE
    assert said in ran.err
    assert "sudo apt install ros-jazzy-ros-base). Use instead: " in ran.err


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("exec=", "exe=", "line 7: 'node' has no attribute 'exe' here. Did you mean exec?"),
        ("<log", "<logg", "line 4: there is no 'logg'. Did you mean log?"),
        ("$(var space)", "$(var spcae)", "line 6: launch configuration 'spcae' does not exist"),
        ("$(dirname)", "$(dirnam)", "line 4: there is no $(dirnam ...). Did you mean dirname?"),
        ("</group>", "", "line 13: no valid XML: mismatched tag"),
        (' default="news"', "", "line 2: Required launch argument 'topic' (description: 'where"),
        ("demo_nodes_py", "demo_node_py", "Package 'demo_node_py' not found. Did you mean demo"),
    ],
)
def test_a_faulty_file_names_the_place(
    empty: Shell, tmp_path: Path, old: str, new: str, said: str
) -> None:
    """The line, and what was meant; nothing is started."""
    written(tmp_path, "a.launch.xml", XML.replace(old, new))
    ran = empty("launch", "a.launch.xml")
    assert ran.code == 1
    assert said in ran.err
    assert "process started" not in ran.out


def test_launch_from_a_package(programs: Shell, tmp_path: Path) -> None:
    """The file in its share folder, another file included, and what is there instead."""
    share = tmp_path / "share" / "mine" / "launch"
    share.mkdir(parents=True)
    written(share, "inner.launch.yaml", "launch:\n- log: {message: inner $(var who)}\n")
    written(
        share,
        "outer.launch.xml",
        """<launch>
  <include file="$(find-pkg-share mine)/launch/inner.launch.yaml">
    <arg name="who" value="me"/>
  </include>
  <log message="not shown" if="false"/>
  <log message="shown" unless="$(env NOT_SET false)"/>
</launch>""",
    )
    ran = programs("launch", "mine", "outer.launch.xml")
    assert ran.lines[2:] == ["[INFO] [launch.user]: inner me", "[INFO] [launch.user]: shown"]
    missing = programs("launch", "mine", "uter.launch.xml")
    assert missing.code == 1
    assert "Did you mean outer.launch.xml?" in missing.err
