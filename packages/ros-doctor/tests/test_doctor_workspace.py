"""The checks of a workspace: a healthy package, injured in one place each."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from clinic import Clinic, assert_absent, assert_ill, assert_well, change_text, ordinary_user

from ros_doctor.finding import Status
from ros_doctor.packages import WorkspacePackage, entry_point, read_setup
from ros_doctor.registry import all_checks
from skips import needs

STATIC = [check.id for check in all_checks() if check.theme == "workspace"]


@pytest.mark.parametrize("id", STATIC)
def test_an_empty_home_has_no_workspace(clinic: Clinic, id: str) -> None:
    clinic.change(workspace=clinic.root / "nothing")
    assert_absent(clinic.look(id))


@pytest.mark.parametrize("id", STATIC)
def test_a_healthy_built_workspace_needs_no_mend(clinic: Clinic, id: str) -> None:
    clinic.installed(clinic.package())
    clinic.give_to_student()
    assert not clinic.look(id).status.needs_a_mend, clinic.look(id)


def test_ill_ws_xml(clinic: Clinic) -> None:
    change_text(clinic.package() / "package.xml", "</package>", "<package>")
    assert_ill(clinic.look("ws-xml"), "fault", "is not valid XML", "nano")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("student@example.com", "student", "email 'student'"),
        ("<version>0.0.1", "<version>1", "three numbers"),
        ("<name>greeter", "<name>my greeter", "my greeter"),
        ("<license>Apache-2.0", "<license>", "<license> is missing"),
    ],
)
def test_ill_ws_xml__one_field(clinic: Clinic, old: str, new: str, said: str) -> None:
    change_text(clinic.package() / "package.xml", old, new)
    assert_ill(clinic.look("ws-xml"), "fault", said)


def test_well_ws_xml(clinic: Clinic) -> None:
    clinic.package()
    assert_well(clinic.look("ws-xml"))


def test_ill_ws_twins(clinic: Clinic) -> None:
    clinic.package()
    clinic.package("greeter_backup")
    assert_ill(clinic.look("ws-twins"), "fault", "are called greeter", "COLCON_IGNORE")


def test_well_ws_twins(clinic: Clinic) -> None:
    clinic.package()
    (clinic.package("greeter_backup") / "COLCON_IGNORE").touch()
    assert_well(clinic.look("ws-twins"))


def test_ill_ws_syntax(clinic: Clinic) -> None:
    change_text(clinic.package() / "greeter/hello.py", "def main() -> None:", "def main() -> None")
    assert_ill(clinic.look("ws-syntax"), "fault", "hello.py, line 8", "nano +8")


def test_well_ws_syntax(clinic: Clinic) -> None:
    clinic.package()
    assert_well(clinic.look("ws-syntax"))


def test_ill_ws_setup_cfg(clinic: Clinic) -> None:
    (clinic.package() / "setup.cfg").unlink()
    assert_ill(clinic.look("ws-setup-cfg"), "fault", "is missing", "script_dir=$base/lib/greeter")


def test_ill_ws_setup_cfg__of_another_package(clinic: Clinic) -> None:
    change_text(clinic.package() / "setup.cfg", "lib/greeter", "lib/chatter")
    assert_ill(clinic.look("ws-setup-cfg"), "fault", "does not say $base/lib/greeter")


def test_well_ws_setup_cfg(clinic: Clinic) -> None:
    clinic.package()
    assert_well(clinic.look("ws-setup-cfg"))


def test_ill_ws_marker(clinic: Clinic) -> None:
    (clinic.package() / "resource/greeter").unlink()
    assert_ill(clinic.look("ws-marker"), "fault", "is missing", "touch")


def test_ill_ws_marker__not_installed(clinic: Clinic) -> None:
    line = '("share/ament_index/resource_index/packages", ["resource/" + package_name]),'
    change_text(clinic.package() / "setup.py", line, "")
    assert_ill(clinic.look("ws-marker"), "fault", "does not install", "['resource/greeter']")


def test_well_ws_marker(clinic: Clinic) -> None:
    clinic.package()
    assert_well(clinic.look("ws-marker"))


@pytest.mark.parametrize(
    ("new", "said"),
    [
        ("hello = greeter.hello:mian", "has no mian(). There is main"),
        ("hello = greeter.helo:main", "wants the file greeter/helo.py. There is greeter/hello.py"),
        ("hello = greeter/hello.py", "must look like"),
    ],
)
def test_ill_ws_entry_points(clinic: Clinic, new: str, said: str) -> None:
    change_text(clinic.package() / "setup.py", "hello = greeter.hello:main", new)
    assert_ill(clinic.look("ws-entry-points"), "fault", said, "colcon build")


def test_ill_ws_entry_points__broken_setup_py(clinic: Clinic) -> None:
    change_text(clinic.package() / "setup.py", "zip_safe=True,", "zip_safe=True")
    assert_ill(clinic.look("ws-entry-points"), "fault", "not valid Python", "nano")


def test_well_ws_entry_points(clinic: Clinic) -> None:
    folder = clinic.package()
    assert_well(clinic.look("ws-entry-points"))
    change_text(folder / "greeter/hello.py", "def main()", "from other import *\n\n\ndef go()")
    assert_well(clinic.look("ws-entry-points"))


def test_ill_ws_depends(clinic: Clinic) -> None:
    change_text(clinic.package() / "package.xml", "  <depend>std_msgs</depend>\n", "")
    finding = clinic.look("ws-depends")
    assert_ill(finding, "warning", "imports std_msgs", "<depend>std_msgs</depend>")


def test_ill_ws_depends__of_the_system(clinic: Clinic) -> None:
    with (clinic.package() / "greeter/hello.py").open("a") as file:
        file.write("\nimport cv2\n")
    assert_ill(clinic.look("ws-depends"), "warning", "opencv", "<depend>python3-opencv</depend>")


def test_ill_ws_depends__on_an_installed_package(clinic: Clinic) -> None:
    (clinic.package() / "greeter/more.py").write_text("from robot_msgs.msg import Arm\n")
    assert_well(clinic.look("ws-depends"))
    clinic.file("/course/.venv/share/robot_msgs/package.xml")
    assert_ill(clinic.look("ws-depends"), "warning", "robot_msgs")


def test_well_ws_depends(clinic: Clinic) -> None:
    with (clinic.package() / "greeter/hello.py").open("a") as file:
        file.write("\nimport json\nfrom . import other\nfrom greeter import hello\nimport secret\n")
    assert_well(clinic.look("ws-depends"))


def test_ill_ws_launch(clinic: Clinic) -> None:
    (clinic.package() / "launch/two.launch.py").touch()
    finding = clinic.look("ws-launch")
    assert_ill(finding, "fault", "launch/two.launch.py", "('share/greeter/launch', ['launch/two")


def test_well_ws_launch(clinic: Clinic) -> None:
    folder = clinic.package()
    assert_well(clinic.look("ws-launch"))
    change_text(folder / "setup.py", '["launch/greet.launch.xml"]', 'glob("launch/*.launch.*")')
    (folder / "launch/two.launch.py").touch()
    assert_well(clinic.look("ws-launch"))


def test_a_setup_py_that_computes_is_not_guessed(clinic: Clinic) -> None:
    folder = clinic.package()
    change_text(folder / "setup.py", '["launch/greet.launch.xml"]', "launch_files()")
    assert_well(clinic.look("ws-launch"))
    assert_well(clinic.look("ws-marker"))


@needs("root")
def test_ill_ws_owner(clinic: Clinic) -> None:
    clinic.installed(clinic.package())
    clinic.give_to_student()
    os.chown(clinic.machine.workspace / "install/greeter", 0, 0)
    assert_ill(clinic.look("ws-owner"), "fault", "install/greeter belongs to root", "chown -R")


def test_ill_ws_owner__a_folder_of_the_system(clinic: Clinic) -> None:
    """`/usr` belongs to root everywhere, so it stands for a workspace built with sudo."""
    (clinic.root / "ws").symlink_to("/usr")
    assert_ill(clinic.change(workspace=clinic.root / "ws/lib").look("ws-owner"), "fault", "root")


def test_well_ws_owner(clinic: Clinic) -> None:
    assert_absent(clinic.change(user=0).look("ws-owner"))
    clinic.give_to_student()
    assert_well(clinic.change(user=1000).look("ws-owner"))


@pytest.mark.parametrize("place", ["src", "src/greeter"])
def test_ill_ws_in_src(clinic: Clinic, place: str) -> None:
    clinic.package()
    clinic.file(f"/home/sam/roslings_ws/{place}/build/COLCON_IGNORE")
    assert_ill(clinic.look("ws-in-src"), "warning", place, "rm -rf")


def test_well_ws_in_src(clinic: Clinic) -> None:
    folder = clinic.package()
    (folder / "build").mkdir()  # a folder of the student's own
    clinic.file("/home/sam/roslings_ws/build/COLCON_IGNORE")
    assert_well(clinic.look("ws-in-src"))


def test_ill_ws_built(clinic: Clinic) -> None:
    clinic.package()
    assert_ill(clinic.look("ws-built"), "advice", "greeter is not built", "colcon build")


@pytest.mark.parametrize(
    ("names", "said"),
    [
        (["waver"], "greeter and waver are not built"),
        (["waver", "bower"], "bower, greeter and waver are not built"),
    ],
)
def test_ill_ws_built__names_every_package(clinic: Clinic, names: list[str], said: str) -> None:
    """Who copied three packages learns of all three at once."""
    for name in ["greeter", *names]:
        folder = clinic.package(name)
        change_text(folder / "package.xml", "<name>greeter</name>", f"<name>{name}</name>")
    assert_ill(clinic.look("ws-built"), "advice", said, "colcon build")


def test_ill_ws_built__one_of_two(clinic: Clinic) -> None:
    """What is built is not named."""
    clinic.installed(clinic.package())
    change_text(clinic.package("waver") / "package.xml", "greeter</name>", "waver</name>")
    finding = clinic.look("ws-built")
    assert_ill(finding, "advice", "waver is not built", "colcon build")
    assert "greeter" not in finding.found


def test_well_ws_built(clinic: Clinic) -> None:
    clinic.installed(clinic.package())
    assert_well(clinic.look("ws-built"))


@pytest.mark.parametrize(
    ("name", "old", "new", "said"),
    [
        ("greeter/hello.py", '"Hello"', '"Good day"', "greeter/hello.py"),
        ("package.xml", "greets", "greets all", "package.xml"),
        ("setup.py", '"hello = ', '"hi = greeter.hello:main", "hello = ', "entry_points"),
        ("launch/greet.launch.xml", 'name="hello"', 'name="hi"', "greet.launch.xml"),
    ],
)
def test_ill_ws_stale(clinic: Clinic, name: str, old: str, new: str, said: str) -> None:
    folder = clinic.package()
    clinic.installed(folder)
    change_text(folder / name, old, new)
    assert_ill(clinic.look("ws-stale"), "warning", said, "colcon build")


def test_ill_ws_stale__a_new_file(clinic: Clinic) -> None:
    folder = clinic.package()
    clinic.installed(folder)
    (folder / "greeter/bye.py").touch()
    assert_ill(clinic.look("ws-stale"), "warning", "greeter/bye.py")


def test_well_ws_stale(clinic: Clinic) -> None:
    folder = clinic.package()
    prefix = clinic.installed(folder)
    os.utime(folder / "greeter/hello.py")  # a newer time with the same content is no change
    assert_well(clinic.look("ws-stale"))
    shutil.rmtree(prefix / "lib/python3.12/site-packages/greeter")  # as with --symlink-install
    (prefix / "lib/python3.12/site-packages/greeter.egg-link").touch()
    change_text(folder / "greeter/hello.py", '"Hello"', '"Good day"')
    assert_well(clinic.look("ws-stale"))


def test_ill_ws_python(clinic: Clinic) -> None:
    prefix = clinic.installed(clinic.package())
    (prefix / "lib/python3.12").rename(prefix / "lib/python3.10")
    assert_ill(clinic.look("ws-python"), "warning", "python3.10", "rm -rf build install log")


def test_well_ws_python(clinic: Clinic) -> None:
    clinic.installed(clinic.package())
    assert_well(clinic.look("ws-python"))


def test_a_package_outside_src_is_found(clinic: Clinic) -> None:
    folder = clinic.package()
    clinic.change(workspace=folder.parent)
    (folder / "setup.cfg").unlink()
    assert clinic.look("ws-setup-cfg").status == Status.FAULT


def test_nothing_of_the_student_is_run(clinic: Clinic) -> None:
    trap = f"open({str(clinic.root / 'ran')!r}, 'w')\n"
    folder = clinic.package()
    for name in ("setup.py", "greeter/hello.py", "greeter/__init__.py"):
        text = (folder / name).read_text()
        (folder / name).write_text(f"{text}\n{trap}")
    for id in STATIC:
        clinic.look(id)
    assert not (clinic.root / "ran").exists()


def test_an_odd_setup_py_is_read(tmp_path: Path) -> None:
    path = tmp_path / "setup.py"
    path.write_text(
        "import os\nfrom setuptools import setup as go, setup\nfrom glob import glob\n"
        "n = 'x'\na = a\n"
        "setup(name=n, data_files=[(os.path.join('share', n), ['package.xml'] + glob('*.py'))],\n"
        "      entry_points={'console_scripts': [f'{n} = {n}.node:main']})\n"
    )
    setup = read_setup(path)
    assert setup.installed == ("package.xml", "setup.py")
    assert setup.entry_points == (entry_point("x = x.node:main"),)


@pytest.mark.parametrize("text", ["", "setup(**settings())", "setup(entry_points=a)\na = a", "\0"])
def test_a_strange_setup_py_is_no_accident(tmp_path: Path, text: str) -> None:
    (tmp_path / "setup.py").write_text(text)
    assert WorkspacePackage(tmp_path).setup is not None


def test_the_mend_of_a_missing_setup_cfg_works_when_it_is_typed(clinic: Clinic) -> None:
    """The commands run as they stand on the screen, with their indentation."""
    path = clinic.package() / "setup.cfg"
    healthy = path.read_text()
    path.unlink()
    typed = clinic.look("ws-setup-cfg").mend[0].command
    indented = "\n".join(f"      {line}" for line in typed.splitlines())
    subprocess.run(["sh", "-c", indented], check=True)
    assert path.read_text() == healthy
    assert_well(clinic.look("ws-setup-cfg"))


def test_an_odd_workspace_stops_no_check(clinic: Clinic) -> None:
    """Loops of links, folders where files belong, bytes that are no text, empty files."""
    folder = clinic.package()
    (folder.parent / "loop").symlink_to(folder.parent)
    (folder / "setup.cfg").unlink()
    (folder / "setup.cfg").mkdir()
    (folder / "greeter/odd.py").write_bytes(b"\xff\xfe\x00 = \x80")
    (folder / "greeter/gone.py").symlink_to("/nowhere")
    (folder / "launch/x.launch.py").mkdir()
    (folder.parent / "other").mkdir()
    (folder.parent / "other/package.xml").write_bytes(b"")
    os.mkdir(os.fsencode(folder.parent) + b"/\xff")  # noqa: PTH102  a name that is no text
    for id in STATIC:
        assert clinic.look(id).status != Status.UNKNOWN, clinic.look(id)


@pytest.mark.parametrize("name", ["src/greeter", "src", ""])
def test_a_closed_folder_is_named_and_stops_no_check(clinic: Clinic, name: str) -> None:
    clinic.installed(clinic.package())
    closed = clinic.machine.workspace / name
    closed.chmod(0)
    with ordinary_user():
        found = [clinic.look(id) for id in STATIC]
    closed.chmod(0o755)
    texts = [one.found for one in found]
    assert not any("the check itself failed" in text for text in texts)
    if name != "src/greeter":
        assert any(text.startswith(f"you may not open {closed}") for text in texts)
