"""What a launch file may lean on where processes are started, and told to end."""

from __future__ import annotations

import signal
from pathlib import Path
from typing import Any

import pytest
from launch_shop import is_gone, package, pid_of, written
from launched import Launch, actions, handlers, logged, subs
from terminal import Shell

pytestmark = pytest.mark.slow

Out = pytest.CaptureFixture[str]
FILE = """\
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([Node(package='mine', executable='{}', output='screen'{})])
"""
STAYS = "#!/bin/sh\ntrap 'echo heard INT' INT\ntrap 'echo heard TERM; exit 7' TERM\n" + (
    "echo here\nwhile :; do sleep 0.05; done\n"
)


@pytest.fixture
def mine(empty: Shell, tmp_path: Path) -> Shell:
    """A terminal with a package whose program hears SIGINT and ends at SIGTERM."""
    return package(empty, tmp_path, stays=STAYS, ends="#!/bin/sh\necho ended\n")


def shell(text: str, **more: Any) -> Any:
    """A process of `sh`."""
    return actions.ExecuteProcess(cmd=["sh", "-c", text], **{"output": "screen", **more})


def test_events_of_a_process_tell_of_it(launch: Launch) -> None:
    """Which action, by which name, number and words, where, and how it has ended."""
    told: list[Any] = []
    target = shell("exit 3", name="worker", cwd=str(launch.folder), additional_env={"MOOD": "gay"})
    code = launch.run(
        target,
        actions.RegisterEventHandler(
            handlers.OnProcessStart(target_action=target, on_start=lambda e, c: told.append(e))
        ),
        actions.RegisterEventHandler(
            handlers.OnProcessExit(target_action=target, on_exit=lambda e, c: told.append(e))
        ),
    )
    started, exited = told
    for event in told:
        assert event.action is target
        assert (event.process_name, event.cwd) == ("worker-1", str(launch.folder))
        assert event.cmd == ["sh", "-c", "exit 3"]
        assert event.env["MOOD"] == "gay"
    assert started.pid == exited.pid > 1
    assert (exited.returncode, code) == (3, 1)


def test_a_signal_is_a_return_code_below_zero(launch: Launch, capsys: Out) -> None:
    """As subprocess has it, and the line on the screen too."""
    codes: list[int] = []
    exited = handlers.OnProcessExit(on_exit=lambda event, context: codes.append(event.returncode))
    launch.run(actions.RegisterEventHandler(exited), shell("kill -9 $$"))
    assert codes == [-9]
    assert "exit code -9, cmd 'sh -c kill -9 $$']." in capsys.readouterr().out


def test_on_exit_takes_actions_and_functions(launch: Launch, capsys: Out) -> None:
    """Each gets done when the process has ended, before the launch does."""
    launch.run(
        shell("true", on_exit=[actions.LogInfo(msg="list")]),
        shell("true", on_exit=lambda event, context: actions.LogInfo(msg="function")),
        shell("true", on_exit=actions.LogInfo(msg="one")),
    )
    assert sorted(logged(capsys)) == ["function", "list", "one"]


def test_a_handler_is_for_its_target_alone(launch: Launch, capsys: Out) -> None:
    """A function chooses some, and without a target it is for all."""
    one, two = shell("true", name="one"), shell("true", name="two")

    def line(word: str, target: Any) -> Any:
        said = actions.LogInfo(msg=[word, subs.LocalSubstitution("event.process_name")])
        return actions.RegisterEventHandler(
            handlers.OnProcessExit(target_action=target, on_exit=[said])
        )

    launch.run(line("its ", one), line("chosen ", lambda a: a is two), line("all ", None), one, two)
    assert sorted(logged(capsys)) == ["all one-1", "all two-2", "chosen two-2", "its one-1"]


def test_output_is_heard_as_bytes(launch: Launch) -> None:
    """By stream; a handler of output gets the event alone."""
    heard: list[tuple[str, bytes, bool, bool]] = []

    def note(event: Any) -> None:
        heard.append((event.process_name, event.text, event.from_stdout, event.from_stderr))

    talks = shell("echo out; echo err >&2")
    output = handlers.OnProcessIO(target_action=talks, on_stdout=note, on_stderr=note)
    launch.run(actions.RegisterEventHandler(output), talks)
    assert sorted(heard) == [
        ("sh-1", b"err\n", False, True),
        ("sh-1", b"out\n", True, False),
    ]


def test_a_process_comes_back_as_often_as_it_may(launch: Launch, capsys: Out) -> None:
    """Under the same name, also after a clean end; each end is told to handlers."""
    ends: list[int] = []
    exited = handlers.OnProcessExit(on_exit=lambda event, context: ends.append(event.pid))
    launch.run(
        actions.RegisterEventHandler(exited),
        shell("true", respawn=True, respawn_max_retries=2, respawn_delay=0.01),
    )
    assert len(set(ends)) == 3
    assert capsys.readouterr().out.count("[sh-1]: process started with pid") == 3


def test_a_shutdown_sends_sigint_and_waits(launch: Launch, capsys: Out) -> None:
    """A process that ends by itself then hears no more; its end is heard of."""
    polite = "trap 'echo bye; exit 0' INT; echo here; while :; do sleep 0.05; done"
    target = shell(polite)
    started = handlers.OnProcessIO(
        target_action=target,
        on_stdout=lambda event: actions.Shutdown() if event.text == b"here\n" else None,
    )
    assert launch.run(target, actions.RegisterEventHandler(started)) == 0
    told = capsys.readouterr().out
    assert "[INFO] [sh-1]: sending signal 'SIGINT' to process[sh-1]" in told
    assert told.index("[sh-1] bye") < told.index("[sh-1]: process has finished cleanly")
    assert "SIGTERM" not in told


def test_a_process_that_stays_is_told_harder(mine: Shell, tmp_path: Path) -> None:
    """SIGINT first, SIGTERM after the time that it has; a second Ctrl-C changes nothing."""
    written(tmp_path, "a.launch.py", FILE.format("stays", ", sigterm_timeout='1.0'"))
    with mine.start("launch", "a.launch.py") as launch:
        launch.wait_for(r"^\[stays-1\] here$")
        launch.process.send_signal(signal.SIGINT)
        launch.wait_for(r"^\[stays-1\] heard INT$")
        launch.process.send_signal(signal.SIGINT)
        launch.wait_for(r"user interrupted with ctrl-c \(SIGINT\) again, ignoring\.\.\.$")
        launch.wait_for(r"^\[stays-1\] heard TERM$")
        assert launch.wait() == 0
    order = [line for line in launch.lines if "heard" in line or "escalating" in line]
    assert [line.split()[-1].strip("'") for line in order] == ["INT", "SIGTERM", "TERM"]
    assert is_gone(pid_of(launch, "stays-1"))


def test_ctrl_c_is_no_fault_of_the_launch(mine: Shell, tmp_path: Path) -> None:
    """Exit 0, as after a clean end; 1 where the file cannot be carried out."""
    written(tmp_path, "ends.launch.py", FILE.format("ends", ""))
    written(tmp_path, "wrong.launch.py", FILE.format("ends", ", colour='red'"))
    assert mine("launch", "ends.launch.py").code == 0
    assert mine("launch", "wrong.launch.py").code == 1
    written(tmp_path, "stays.launch.py", FILE.format("stays", ", sigterm_timeout='0.2'"))
    with mine.start("launch", "stays.launch.py") as launch:
        launch.wait_for(r"^\[stays-1\] here$")
        assert launch.interrupt() == 0


def test_all_output_is_shown_to_who_asks(mine: Shell, tmp_path: Path) -> None:
    """By the option -a, and by the variable that it sets."""
    quiet = FILE.format("ends", "").replace(", output='screen'", "")
    written(tmp_path, "a.launch.py", quiet)
    assert "[ends-1] ended" not in mine("launch", "a.launch.py").lines
    assert "[ends-1] ended" in mine("launch", "-a", "a.launch.py").lines
    shown = mine("launch", "a.launch.py", OVERRIDE_LAUNCH_PROCESS_OUTPUT="screen")
    assert "[ends-1] ended" in shown.lines


def test_what_a_process_prints_is_kept(launch: Launch) -> None:
    """In launch.log, or in a log of its own, below the folder of this launch."""
    launch.run(
        shell("echo one", output="log"),
        shell("echo two", output="own_log", name="other"),
    )
    folder = Path(launch.filled(subs.LaunchLogDir()))
    assert "[sh-1] one\n" in (folder / "launch.log").read_text()
    assert "two\n" in (folder / "other-2.log").read_text()
