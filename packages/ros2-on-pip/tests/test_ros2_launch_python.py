"""Launch files in Python: what a student gets wrong, what is not there, and how a launch ends."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path

import pytest
from launch_shop import is_gone, package, pid_of, written
from terminal import Shell, eventually

from ros2_on_pip.words import NOT_READ_HERE

pytestmark = pytest.mark.slow

GOOD = """\
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('side', default_value='left', description='Where.', choices=['left']),
        LogInfo(msg='hello'),
        Node(package='mine', executable='teller'),
    ])
"""
PARENT = f"""#!{sys.executable}
import signal, subprocess, time
signal.signal(signal.SIGINT, signal.SIG_DFL)
saving = 'trap "sleep 0.5; echo saved; exit" INT; echo ready; while :; do sleep 0.1; done'
subprocess.Popen(["sh", "-c", saving])
time.sleep(600)
"""
CTRL_C = "[WARNING] [launch]: user interrupted with ctrl-c (SIGINT)"


@pytest.fixture
def mine(empty: Shell, tmp_path: Path) -> Shell:
    """A terminal with the package `mine`, which has the executable `teller`."""
    return package(
        empty,
        tmp_path,
        nurse="#!/bin/sh\nsleep 600 &\necho child $!\nwait\n",
        parent=PARENT,
        deaf="#!/bin/sh\ntrap '' INT TERM\necho here\nwhile :; do sleep 0.1; done\n",
    )


FAULTS = [
    ("msg='hello'),", "msg='hello')", "line 9: no valid Python: "),
    ("import Node", "import Nod", "line 3: 'launch_ros.actions' has no 'Nod'. Did you mean Node?"),
    ("from launch_ros.actions", "from launch.actions", "Write: from launch_ros.actions import"),
    ("from launch_ros.actions import Node", "", "line 10: the name 'Node' is not known. It needs"),
    ("from launch import", "from lunch import", "line 1: there is no module 'lunch'. Did you mean"),
    ("package=", "pkg=", "line 10: Node has no 'pkg'. It is called package"),
    ("executable=", "exeutable=", "Did you mean executable?"),
    (", executable='teller'", "", "line 10: Node needs more: executable"),
    ("'teller'", "'teler'", "line 10: No executable found: package 'mine' has no 'teler'. Did you"),
    ("'mine'", "'mien'", "line 10: Package 'mien' not found. Did you mean mine?"),
    (
        "default_value='left', ",
        "",
        "line 8: Required launch argument 'side' (description: 'Where.'",
    ),
    ("'left', desc", "2, desc", "line 8: default_value of 'side' must be a text or a substitution"),
    (
        "['left']",
        "['right']",
        "line 8: Provided default_value \"left\" of 'side' is not in provided",
    ),
    ("Node(pack", "Node(parameters={'a': 1}, pack", "parameters must be a list of dictionaries"),
    ("Node(pack", "Node(parameters=[{'a': [1, 'b']}], pack", "line 10: parameter 'a': [1, 'b']:"),
    ("Node(pack", "Node(parameters=['no.yaml'], pack", "there is no parameter file no.yaml"),
    ("Node(pack", "Node(remappings=['a'], pack", "each of the remappings has two names"),
    ("Node(pack", "Node(name='a/b', pack", "What stands before the / belongs into namespace"),
    ("Node(pack", "Node(namespace='2nd', pack", "'/2nd' is no namespace"),
    ("Node(pack", "Node(output='scren', pack", "output is 'screen', 'log' or 'both'"),
    ("Node(pack", "Node(condition=True, pack", "condition must be IfCondition(...)"),
    ("LogInfo(msg='hello')", "LogInfo", "takes actions, such as Node(...), and not <class"),
    ("LogInfo(msg='hello')", "[LogInfo(msg='a')]", "Put a star before the inner one: *actions"),
    ("    return Launch", "    Launch", "line 6: generate_launch_description() returns nothing"),
    ("_description()", "_descripton()", "the file has no function generate_launch_description()"),
    ("    return Launch", "    1 / 0\n    return Launch", "line 7: ZeroDivisionError: division"),
    (
        "    return LaunchDescription([",
        "    twice = Node(package='mine', executable='teller')\n"
        "    return LaunchDescription([twice, twice,",
        "line 7: this Node is carried out a second time. Write Node(...) once more",
    ),
    ("    return Launch", "    exit()\n    return Launch", "the launch file ends Python itself"),
]


@pytest.mark.parametrize(("old", "new", "said"), FAULTS)
def test_a_fault_is_told_with_its_line(
    mine: Shell, tmp_path: Path, old: str, new: str, said: str
) -> None:
    """File, line, mistake and next step; no traceback, and nothing is started."""
    assert old in GOOD
    written(tmp_path, "a.launch.py", GOOD.replace(old, new))
    ran = mine("launch", "a.launch.py")
    assert ran.code == 1
    assert ran.err.startswith("[ERROR] [launch]: a.launch.py, line ")
    assert said in ran.err
    assert "Traceback" not in ran.err
    assert "process started" not in ran.out


def test_a_traceback_for_who_wants_it(mine: Shell, tmp_path: Path) -> None:
    """`--debug` shows it before the line that tells."""
    written(
        tmp_path, "a.launch.py", GOOD.replace("    return Launch", "    1 / 0\n    return Launch")
    )
    ran = mine("launch", "--debug", "a.launch.py")
    assert ran.err.startswith("Traceback (most recent call last)")
    assert "a.launch.py, line 7: ZeroDivisionError" in ran.err


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("from launch_ros.actions import ComposableNodeContainer", "a Node(...) for each node"),
        ("from launch_ros.actions import LifecycleNode", "ros2 lifecycle set NODE configure"),
        ("from launch.actions import ForLoop", "a for loop of Python"),
        ("import launch.logging", "LogInfo(msg=...)"),
        ("import launch; launch.LaunchService()", "the command ros2 launch"),
    ],
)
def test_what_is_not_here_says_what_to_use(
    mine: Shell, tmp_path: Path, line: str, said: str
) -> None:
    """With an exit code of its own: who judges must not count it as a mistake."""
    written(tmp_path, "a.launch.py", f"{line}\n{GOOD}")
    ran = mine("launch", "a.launch.py")
    assert ran.code == NOT_READ_HERE
    assert ran.err.count("\n") == 1
    assert "line 1: '" in ran.err
    assert (
        " is right in Jazzy, and not in this launch: it needs the full ros2 on Ubuntu 24.04 (sudo"
        in ran.err
    )
    assert said in ran.err


def test_a_fault_in_what_is_done_later_ends_all(mine: Shell, tmp_path: Path) -> None:
    """An event handler of the student's fails while nodes run."""
    handler = (
        "RegisterEventHandler(OnProcessStart(on_start=lambda event, context: 1 / 0)),\n"
        "        LogInfo(msg='hello')"
    )
    text = GOOD.replace("LogInfo(msg='hello')", handler)
    text = text.replace("import Decl", "import RegisterEventHandler, Decl")
    text = text.replace("'teller')", "'teller', arguments=['stay'])")
    imported = "from launch.event_handlers import OnProcessStart\n"
    written(tmp_path, "a.launch.py", f"{imported}{text}")
    ran = mine("launch", "a.launch.py")
    assert ran.code == 1
    assert "[ERROR] [launch]: a.launch.py, line 10: ZeroDivisionError: division by zero." in ran.out
    assert "[teller-1]: sending signal 'SIGINT' to process[teller-1]" in ran.out


def test_arguments_and_the_tree_are_shown(mine: Shell, tmp_path: Path) -> None:
    """`--show-args` and `--print` start nothing."""
    written(tmp_path, "a.launch.py", GOOD)
    shown = mine("launch", "a.launch.py", "-s")
    assert shown.lines == [
        "Arguments (pass arguments as '<name>:=<value>'):",
        "",
        "    'side':",
        "        Where. Valid choices are: ['left']",
        "        (default: 'left')",
    ]
    assert mine("launch", "a.launch.py", "--print").lines == [
        "LaunchDescription",
        "├── DeclareLaunchArgument('side', default 'left')",
        "├── LogInfo('hello')",
        "└── Node(package='mine', executable='teller')",
    ]


def test_arguments_of_included_files_are_shown(mine: Shell, tmp_path: Path) -> None:
    """Those that a condition brings have a star; a file without arguments says so."""
    written(tmp_path, "a.launch.py", GOOD)
    written(
        tmp_path,
        "b.launch.xml",
        """<launch>
  <arg name="deep" default="$(env HOME)"><choice value="a"/></arg>
  <group if="false"><include file="$(dirname)/a.launch.py"/></group>
</launch>""",
    )
    assert mine("launch", "b.launch.xml", "--show-args").lines[1:] == [
        "",
        "    'deep':",
        "        One of: ['a']",
        "        (default: EnvVar('HOME'))",
        "",
        "    'side':*",
        "        Where. Valid choices are: ['left']",
        "        (default: 'left')",
        "",
        "* argument(s) which are only used if specific conditions occur",
    ]
    written(tmp_path, "c.launch.xml", "<launch/>")
    assert mine("launch", "c.launch.xml", "-s").lines[1:] == ["", "  No arguments."]


def test_an_unknown_argument_is_told(mine: Shell, tmp_path: Path) -> None:
    """It would change nothing."""
    written(tmp_path, "a.launch.py", GOOD)
    ran = mine("launch", "a.launch.py", "sid:=left")
    assert "has no argument 'sid'. Did you mean side?" in ran.err
    assert ran.code == 0


def test_nothing_is_written_beside_the_file(mine: Shell, tmp_path: Path) -> None:
    """No folder __pycache__ in the student's package."""
    folder = tmp_path / "launch"
    folder.mkdir()
    written(folder, "a.launch.py", GOOD)
    assert mine("launch", "launch/a.launch.py").code == 0
    assert [file.name for file in folder.iterdir()] == ["a.launch.py"]


def test_a_real_package_is_taken_where_there_is_one(mine: Shell, tmp_path: Path) -> None:
    """Ours are found last; and outside of a launch nobody finds them."""
    folder = tmp_path / "real" / "launch_ros"
    folder.mkdir(parents=True)
    (folder / "__init__.py").write_text("")
    (folder / "actions.py").write_text("raise ImportError('the real one')\n")
    written(tmp_path, "a.launch.py", GOOD)
    path = f"{mine.environment['PYTHONPATH']}:{tmp_path / 'real'}"
    assert "line 3: ImportError: the real one" in mine("launch", "a.launch.py", PYTHONPATH=path).err


def test_ctrl_c_ends_a_launch_file_that_hangs(mine: Shell, tmp_path: Path) -> None:
    """In the student's own loop, before anything is started."""
    endless = "    print('round and round', flush=True)\n    while True: pass\n    return Launch"
    written(tmp_path, "a.launch.py", GOOD.replace("    return Launch", endless))
    with mine.start("launch", "a.launch.py") as launch:
        launch.wait_for("round and round")
        assert launch.interrupt() == 2
    assert "Traceback" not in launch.text


def test_what_a_node_has_started_ends_with_it(mine: Shell, tmp_path: Path) -> None:
    """Also where the node itself is ended first."""
    text = GOOD.replace("'teller'", "'nurse', output='screen', sigterm_timeout='0.3'")
    written(tmp_path, "a.launch.py", text)
    with mine.start("launch", "a.launch.py") as launch:
        launch.wait_for(r"^\[nurse-1\] child \d+$")
        child = int(launch.lines[-1].split()[-1])
        assert not is_gone(child)
        os.kill(pid_of(launch, "nurse-1"), signal.SIGKILL)
        launch.wait_for(r"^\[ERROR\] \[nurse-1\]: process has died \[pid \d+, exit code -9, cmd")
        assert launch.wait() == 1
        assert is_gone(child)


def test_what_hears_no_signal_is_killed(mine: Shell, tmp_path: Path) -> None:
    """SIGINT, then SIGTERM, then SIGKILL, each after the time that the launch file says."""
    more = "'deaf', output='screen', sigterm_timeout='0.2', sigkill_timeout='0.3'"
    written(tmp_path, "a.launch.py", GOOD.replace("'teller'", more))
    with mine.start("launch", "a.launch.py") as launch:
        launch.wait_for(r"^\[deaf-1\] here$")
        assert launch.interrupt() == 0
    told = [line.partition("]: ")[2] for line in launch.lines[launch.lines.index(CTRL_C) + 1 :]]
    late = "process[deaf-1] failed to terminate"
    assert told[:4] == [
        f"{late} '0.2' seconds after receiving 'SIGINT', escalating to 'SIGTERM'",
        "sending signal 'SIGTERM' to process[deaf-1]",
        f"{late} '0.5' seconds after receiving 'SIGTERM', escalating to 'SIGKILL'",
        "sending signal 'SIGKILL' to process[deaf-1]",
    ]
    assert "exit code -9" in told[4]


def test_what_a_node_has_started_ends_in_its_own_time(mine: Shell, tmp_path: Path) -> None:
    """Its parent is gone at Ctrl-C, and what it still has to say is heard."""
    text = GOOD.replace("'teller'", "'parent', output='screen'")
    written(tmp_path, "a.launch.py", text)
    with mine.start("launch", "a.launch.py") as launch:
        launch.wait_for(r"^\[parent-1\] ready$")
        assert launch.interrupt() == 0
    dead = next(n for n, line in enumerate(launch.lines) if "[parent-1]: process has died" in line)
    assert launch.lines.index("[parent-1] saved") > dead


def test_a_killed_launch_leaves_no_node(mine: Shell, tmp_path: Path) -> None:
    """The kernel ends them."""
    written(tmp_path, "a.launch.py", GOOD.replace("'teller')", "'teller', arguments=['stay'])"))
    with mine.start("launch", "a.launch.py") as launch:
        launch.wait_for("told")
        launch.process.kill()
        launch.wait()
        node = pid_of(launch, "teller-1")
        eventually(lambda: is_gone(node))


def test_a_killed_node_comes_back_by_respawn(mine: Shell, tmp_path: Path) -> None:
    """Under the same name on the screen, with a new number; Ctrl-C ends it for good."""
    more = "'teller', arguments=['stay'], respawn=True)"
    written(tmp_path, "a.launch.py", GOOD.replace("'teller')", more))
    with mine.start("launch", "a.launch.py") as launch:
        launch.wait_for("told")
        first = pid_of(launch, "teller-1")
        os.kill(first, signal.SIGKILL)
        launch.wait_for("told", times=2)
        second = pid_of(launch, "teller-1")
        assert second != first
        assert launch.interrupt() == 0
        assert is_gone(second)
    launch.wait_for(r"^\[INFO\] \[teller-1\]: process has finished cleanly")
