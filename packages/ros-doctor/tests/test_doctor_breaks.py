"""The break-it exercises: each is ill at first, and well after the mend that it teaches."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from clinic import Clinic, change_text

from ros_doctor.breaks import cli
from ros_doctor.breaks.exercises import EXERCISES, Exercise
from ros_doctor.breaks.grade import MARK, ExerciseGrade, grade, what_is_lost
from ros_doctor.breaks.injuries import HEALTHY, NoColcon, build
from ros_doctor.machine import this_machine
from ros_doctor.registry import all_checks, find_check
from skips import skip_without


def mend_setup_py(workspace: Path) -> None:
    copy_back(workspace, "setup.py")


def clear_src(workspace: Path) -> None:
    for name in ("build", "install", "log"):
        shutil.rmtree(workspace / "src" / name)


MENDS: dict[int, Callable[[Path], None]] = {
    1: lambda ws: change_text(ws / "src/greeter/setup.py", ":mian", ":main"),
    2: lambda ws: copy_back(ws, "setup.cfg"),
    3: lambda ws: copy_back(ws, "package.xml"),
    4: mend_setup_py,
    5: lambda ws: (ws / "src/greeter_backup/COLCON_IGNORE").touch(),
    6: clear_src,
}
WORKSPACE = [one for one in EXERCISES if not one.in_terminal and not one.builds]
TERMINAL = [one for one in EXERCISES if one.in_terminal]


def copy_back(workspace: Path, name: str) -> None:
    shutil.copy(HEALTHY / "src/greeter" / name, workspace / "src/greeter" / name)


@pytest.fixture
def at_home(clinic: Clinic, monkeypatch: pytest.MonkeyPatch) -> Clinic:
    """The command line believes that it runs on the clinic's machine."""
    monkeypatch.setattr(cli, "this_machine", lambda: clinic.machine)
    return clinic.change(user=os.getuid())


def folder_of(clinic: Clinic, exercise: Exercise) -> Path:
    return clinic.machine.home / "roslings_breaks" / f"{exercise.number}-{exercise.name}"


def graded(clinic: Clinic, exercise: Exercise) -> ExerciseGrade:
    return grade(exercise, folder_of(clinic, exercise), clinic.machine)


def test_there_are_ten() -> None:
    assert [one.number for one in EXERCISES] == list(range(1, 11))
    for exercise in EXERCISES:
        assert all(find_check(id) for id in exercise.checks)


@pytest.mark.parametrize("exercise", WORKSPACE, ids=[one.name for one in WORKSPACE])
def test_a_workspace_is_ill_until_it_is_mended(at_home: Clinic, exercise: Exercise) -> None:
    number = str(exercise.number)
    assert cli.main([number]) == 0
    assert cli.main([number, "--check"]) == 1
    MENDS[exercise.number](folder_of(at_home, exercise))
    assert graded(at_home, exercise) == ExerciseGrade(True)
    assert cli.main([number, "--check"]) == 0


@pytest.mark.parametrize("exercise", TERMINAL, ids=[one.name for one in TERMINAL])
def test_a_terminal_is_ill_until_it_is_mended(at_home: Clinic, exercise: Exercise) -> None:
    number = str(exercise.number)
    assert cli.main([number]) == 0
    assert "not the injured one" in graded(at_home, exercise).reason
    script = (folder_of(at_home, exercise) / "injure.sh").read_text()
    sourced = [
        line.removeprefix("export ").split("=") for line in script.splitlines() if "=" in line
    ]
    at_home.set(**{name: value for name, value in sourced})
    assert at_home.env[MARK] == number
    assert cli.main([number, "--check"]) == 1
    for name, _ in exercise.variables:
        del at_home.env[name]
    assert cli.main([number, "--check"]) == 0


def test_the_script_of_a_terminal_is_a_shell_script(at_home: Clinic) -> None:
    cli.main(["8"])
    script = folder_of(at_home, EXERCISES[7]) / "injure.sh"
    words = f"set -eu; . '{script}'; echo $ROS_DOMAIN_ID"
    done = subprocess.run(["sh", "-c", words], capture_output=True, text=True, check=True)
    assert done.stdout == "seven\n"


REAL = this_machine()
STATIC = [
    check.id for check in all_checks() if check.theme == "workspace" and check.id != "ws-owner"
]


@pytest.mark.slow
def test_the_exercise_of_the_old_build_is_built_for_real(tmp_path: Path) -> None:
    exercise = EXERCISES[6]
    machine = replace(REAL, env={**REAL.env, "ROSLINGS_BREAKS": str(tmp_path)})
    folder = tmp_path / "7-old-build"
    try:
        cli._injure(exercise, folder, machine)
    except cli.WrongUseOfBreak as problem:
        assert isinstance(problem.__cause__, NoColcon)
        skip_without("colcon")
        raise
    ill = grade(exercise, folder, machine)
    assert ill == ExerciseGrade(
        False, "greeter/hello.py of greeter was changed after the last build."
    )
    build(folder, machine)
    assert grade(exercise, folder, machine) == ExerciseGrade(True)
    assert [path.name for path in tmp_path.iterdir()] == ["7-old-build"]


def test_without_colcon_the_old_build_says_what_to_do(
    at_home: Clinic, capsys: pytest.CaptureFixture[str]
) -> None:
    at_home.no_ros()
    assert cli.main(["7"]) == 2
    assert "--explain colcon" in capsys.readouterr().err
    assert not folder_of(at_home, EXERCISES[6]).exists()


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("package.xml", "package.xml is gone"),
        ("setup.py", "setup.py is gone"),
        ("greeter/hello.py", "hello.py is gone"),
        ("launch/greet.launch.xml", "greet.launch.xml is gone"),
    ],
)
def test_throwing_away_is_no_mend(tmp_path: Path, name: str, said: str) -> None:
    shutil.copytree(HEALTHY, tmp_path / "ws")
    assert what_is_lost(tmp_path / "ws") == ""
    (tmp_path / "ws/src/greeter" / name).unlink()
    assert said in what_is_lost(tmp_path / "ws")


def test_removing_the_program_or_the_import_is_no_mend(tmp_path: Path) -> None:
    shutil.copytree(HEALTHY, tmp_path / "ws")
    setup = tmp_path / "ws/src/greeter/setup.py"
    change_text(setup, '            "hello = greeter.hello:main",\n', "")
    assert "no program called hello" in what_is_lost(tmp_path / "ws")
    copy_back(tmp_path / "ws", "setup.py")
    hello = tmp_path / "ws/src/greeter/greeter/hello.py"
    change_text(hello, "from std_msgs.msg import String\n", "")
    assert "imports less" in what_is_lost(tmp_path / "ws")
    change_text(hello, "import rclpy", "import (rclpy")
    assert "has an error in line" in what_is_lost(tmp_path / "ws")


def test_one_mend_that_breaks_another_thing_is_not_enough(at_home: Clinic) -> None:
    cli.main(["2"])
    folder = folder_of(at_home, EXERCISES[1])
    copy_back(folder, "setup.cfg")
    (folder / "src/greeter/resource/greeter").unlink()
    assert "resource/greeter" in graded(at_home, EXERCISES[1]).reason


def test_work_is_never_overwritten(at_home: Clinic, capsys: pytest.CaptureFixture[str]) -> None:
    cli.main(["1"])
    setup = folder_of(at_home, EXERCISES[0]) / "src/greeter/setup.py"
    setup.write_text("# my work\n")
    capsys.readouterr()
    assert cli.main(["1"]) == 0
    said = capsys.readouterr().out
    assert setup.read_text() == "# my work\n"
    assert "Nothing was changed" in said
    assert "rm -r " in said


def test_the_students_workspace_is_never_touched(at_home: Clinic) -> None:
    at_home.package()
    before = {path: path.lstat().st_mtime_ns for path in at_home.machine.workspace.rglob("*")}
    for exercise in WORKSPACE + TERMINAL:
        cli.main([str(exercise.number)])
        cli.main([str(exercise.number), "--check"])
    after = {path: path.lstat().st_mtime_ns for path in at_home.machine.workspace.rglob("*")}
    assert after == before


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["11"], "from 1 to 10"),
        (["0"], "from 1 to 10"),
        (["one"], "--list"),
        (["3", "--check"], "has not begun. Type ./roslings break 3"),
    ],
)
def test_wrong_use_says_what_to_type(
    at_home: Clinic, capsys: pytest.CaptureFixture[str], words: list[str], said: str
) -> None:
    assert cli.main(words) == 2
    assert said in capsys.readouterr().err


def test_a_folder_that_cannot_be_written_is_named(
    at_home: Clinic, capsys: pytest.CaptureFixture[str]
) -> None:
    at_home.set(ROSLINGS_BREAKS=str(at_home.file("/a-file") / "breaks"))
    assert cli.main(["1"]) == 2
    assert "Set ROSLINGS_BREAKS" in capsys.readouterr().err


def test_the_list_and_the_tasks_fit_the_screen(
    at_home: Clinic, capsys: pytest.CaptureFixture[str]
) -> None:
    at_home.set(ROSLINGS_BREAKS="/b")
    machine = replace(at_home.machine, clone=Path("/r"))
    for exercise in EXERCISES:
        for line in cli.task_lines(exercise, Path("/b/9-discovery"), machine):
            assert len(line) <= 80, line
    assert cli.main([]) == 0
    listed = capsys.readouterr().out
    assert all(exercise.title in listed for exercise in EXERCISES)


def test_the_healthy_package_is_healthy(clinic: Clinic) -> None:
    clinic.package()
    for id in STATIC:
        assert clinic.look(id).status.value in ("ok", "not applicable", "advice"), id
