"""The checks of ROS itself."""

from __future__ import annotations

import base64

import pytest
from clinic import (
    COMPILED,
    TODAY,
    Clinic,
    assert_absent,
    assert_ill,
    assert_well,
    change_text,
    public_key,
)

from ros_doctor.openpgp import NotAKey, key_ends

KEY = "/usr/share/keyrings/ros-archive-keyring.gpg"
YEAR = 31_536_000


def test_ill_ros_found(clinic: Clinic) -> None:
    clinic.no_ros()
    assert_ill(clinic.look("ros-found"), "fault", "no ROS 2 Jazzy", "./roslings check topics")


def test_ill_ros_found__not_sourced(clinic: Clinic) -> None:
    finding = clinic.apt(sourced=False).look("ros-found")
    assert_ill(finding, "fault", "does not know it", "source /opt/ros/jazzy/setup.bash")


def test_ill_ros_found__zsh(clinic: Clinic) -> None:
    finding = clinic.apt(sourced=False).look("ros-found", SHELL="/usr/bin/zsh")
    assert_ill(finding, "fault", "does not know it", ">> ~/.zshrc")


def test_ill_ros_found__on_a_raspberry_pi(clinic: Clinic) -> None:
    finding = clinic.no_ros().change(architecture="aarch64").look("ros-found")
    assert_ill(finding, "fault", "no ROS 2 Jazzy", "apt install -y ros-jazzy-desktop")


def test_ill_ros_found__wheels_in_another_terminal(clinic: Clinic) -> None:
    finding = clinic.look("ros-found", PATH=str(clinic.root / "usr/bin"))
    assert_ill(finding, "advice", "by itself", "/course/setup.bash")


def test_well_ros_found(clinic: Clinic) -> None:
    assert_well(clinic.look("ros-found"))
    assert_well(clinic.apt(sourced=True).look("ros-found"))


def test_ill_one_ros(clinic: Clinic) -> None:
    clinic.file("/home/sam/.bashrc", "alias l=ls\nsource /opt/ros/humble/setup.bash\n")
    clinic.set(AMENT_PREFIX_PATH="/opt/ros/jazzy", LD_LIBRARY_PATH="/opt/ros/humble/lib")
    finding = clinic.look("one-ros")
    assert_ill(finding, "fault", "mixes humble and jazzy", "source /opt/ros/jazzy/setup.bash")
    assert any("line 2 of ~/.bashrc" in step.text for step in finding.mend)


def test_ill_one_ros__another(clinic: Clinic) -> None:
    assert_ill(clinic.look("one-ros", ROS_DISTRO="humble"), "fault", "uses humble")


def test_well_one_ros(clinic: Clinic) -> None:
    assert_well(clinic.look("one-ros"))
    assert_well(clinic.look("one-ros", ROS_DISTRO="jazzy", PATH="/opt/ros/jazzy/bin:/usr/bin"))


def test_ill_apt_key(clinic: Clinic) -> None:
    made = int(TODAY) - 6 * YEAR
    clinic.file(KEY).write_bytes(public_key(made, 5 * YEAR))
    finding = clinic.look("apt-key")
    assert_ill(finding, "fault", "ended on 2025-", "ros2-apt-source")


def test_ill_apt_key__an_empty_file(clinic: Clinic) -> None:
    clinic.file(KEY)
    assert_ill(clinic.look("apt-key"), "fault", "unreadable", "ros2-apt-source")


@pytest.mark.parametrize("life", [10 * YEAR, None])
def test_well_apt_key(clinic: Clinic, life: int | None) -> None:
    assert_absent(clinic.look("apt-key"))
    clinic.file(KEY).write_bytes(public_key(int(TODAY) - YEAR, life))
    assert_well(clinic.look("apt-key"))


def test_an_armoured_key_is_read() -> None:
    text = base64.b64encode(public_key(1000, 500))
    block = b"-----BEGIN PGP PUBLIC KEY BLOCK-----\nVersion: 1\n\n" + text + b"\n=abcd\n"
    assert key_ends(block + b"-----END PGP PUBLIC KEY BLOCK-----\n") == 1500


@pytest.mark.parametrize("content", [b"", b"\0\0", b"\xc6", b"-----BEGIN PGP", b"\xff" * 40])
def test_what_is_no_key_is_refused(content: bytes) -> None:
    with pytest.raises(NotAKey):
        key_ends(content)


def test_ill_apt_release(clinic: Clinic) -> None:
    line = "deb [arch=amd64] http://packages.ros.org/ros2/ubuntu jammy main\n"
    clinic.file("/etc/apt/sources.list.d/ros2.list", line)
    finding = clinic.look("apt-release")
    assert_ill(finding, "fault", "packages of jammy", "rm /etc/apt/sources.list.d/ros2.list")


def test_ill_apt_release__new_form(clinic: Clinic) -> None:
    clinic.ubuntu("22.04", "jammy")
    text = "Types: deb\nURIs: http://packages.ros.org/ros2/ubuntu\nSuites: noble\n"
    clinic.file("/etc/apt/sources.list.d/ros2.sources", text)
    assert_ill(clinic.look("apt-release"), "warning", "This system is jammy", "rm ")


def test_well_apt_release(clinic: Clinic) -> None:
    assert_absent(clinic.look("apt-release"))
    text = "# deb http://packages.ros.org/ros2/ubuntu jammy main\n"
    text += "deb http://packages.ros.org/ros2/ubuntu noble main\n"
    clinic.file("/etc/apt/sources.list.d/ros2.list", text)
    assert_well(clinic.look("apt-release"))


def test_ill_rclpy_python(clinic: Clinic) -> None:
    clinic.apt(sourced=True).program("python3", "echo 3 13")
    finding = clinic.look("rclpy-python")
    assert_ill(finding, "fault", "for Python 3.12, but python3 is 3.13", "type -a python3")


def test_ill_rclpy_python__the_wheels(clinic: Clinic) -> None:
    folder = clinic.packages() / "rclpy"
    (folder / COMPILED.format(312)).rename(folder / COMPILED.format(311))
    assert_ill(clinic.look("rclpy-python"), "fault", "3.11, but", "rm -rf .venv")


def test_ill_rclpy_python__nothing_compiled(clinic: Clinic) -> None:
    (clinic.packages() / "rclpy" / COMPILED.format(312)).unlink()
    assert_ill(clinic.look("rclpy-python"), "fault", "broken", "./roslings check")


def test_well_rclpy_python(clinic: Clinic) -> None:
    assert_well(clinic.look("rclpy-python"))
    assert_well(clinic.apt(sourced=True).look("rclpy-python"))


def test_ill_middleware(clinic: Clinic) -> None:
    finding = clinic.look("middleware", RMW_IMPLEMENTATION="rmw_cyclonedds_cpp")
    assert_ill(finding, "fault", "not installed", "unset RMW_IMPLEMENTATION")


def test_ill_middleware__the_wheel_is_missing(clinic: Clinic) -> None:
    (clinic.root / "course/.venv/lib/librmw_fastrtps_cpp.so").unlink()
    assert_ill(clinic.look("middleware"), "fault", "is missing", "./roslings check topics")


def test_well_middleware(clinic: Clinic) -> None:
    assert_well(clinic.look("middleware"))


def test_ill_conda(clinic: Clinic) -> None:
    clinic.program("python3", folder="/home/sam/miniconda3/bin")
    path = f"{clinic.root}/home/sam/miniconda3/bin:{clinic.env['PATH']}"
    finding = clinic.look("conda", CONDA_PREFIX="/home/sam/miniconda3", PATH=path)
    assert_ill(finding, "fault", "miniconda3/bin/python3", "conda deactivate")


def test_well_conda(clinic: Clinic) -> None:
    assert_well(clinic.look("conda"))


def test_ill_empy(clinic: Clinic) -> None:
    clinic.file("/home/sam/.local/lib/python3.12/site-packages/em/__init__.py", "def cli(): ...")
    finding = clinic.apt(sourced=True).look("empy")
    assert_ill(finding, "fault", "another program", "empy==3.3.4")


def test_ill_empy__version_4(clinic: Clinic) -> None:
    clinic.apt(sourced=True)
    clinic.file("/home/sam/.local/lib/python3.12/site-packages/em.py", EMPY_4)
    adapter = "/opt/ros/jazzy/lib/python3.12/site-packages/rosidl_adapter/resource/__init__.py"
    clinic.file(adapter, "import em\n")
    assert_ill(clinic.look("empy"), "warning", "empy 4", "uninstall -y em empy")


EMPY_4 = "__version__ = '4.2'\n\nclass Interpreter:\n    pass\n"


def test_well_empy(clinic: Clinic) -> None:
    assert_absent(clinic.look("empy"))
    (clinic.packages() / "em.py").write_text("__version__ = '3.3.4'\nclass Interpreter: ...\n")
    assert_well(clinic.look("empy"))
    (clinic.packages() / "em.py").write_text(EMPY_4)
    assert_well(clinic.look("empy"))


def test_ill_compiler(clinic: Clinic) -> None:
    clinic.program("apt")
    clinic.program("gcc")
    assert_ill(clinic.look("compiler"), "advice", "no lab does", "build-essential")


def test_ill_compiler__beside_an_installed_ros(clinic: Clinic) -> None:
    clinic.program("apt")
    finding = clinic.apt(sourced=True).look("compiler")
    assert_ill(finding, "advice", "those of day 5", "build-essential")


def test_well_compiler(clinic: Clinic) -> None:
    clinic.program("gcc")
    clinic.program("g++")
    assert_well(clinic.look("compiler"))


def test_ill_colcon(clinic: Clinic) -> None:
    finding = clinic.apt(sourced=True).look("colcon")
    assert_ill(finding, "fault", "not installed", "python3-colcon-common-extensions")


def test_ill_colcon__only_that_of_the_course(clinic: Clinic) -> None:
    clinic.apt(sourced=True).program("colcon", folder="/course/.venv-apt/bin")
    finding = clinic.look("colcon")
    assert_ill(finding, "advice", "colcon of its own", "python3-colcon-common-extensions")


def test_ill_colcon__without_its_ros_part(clinic: Clinic) -> None:
    (clinic.packages() / "colcon_ros/__init__.py").unlink()
    (clinic.packages() / "colcon_ros").rmdir()
    assert_ill(clinic.look("colcon"), "warning", "colcon-ros", "./roslings check")


def test_well_colcon(clinic: Clinic) -> None:
    assert_well(clinic.look("colcon"))


def test_ill_setuptools(clinic: Clinic) -> None:
    clinic.apt(sourced=True)
    (clinic.root / "home/sam/.local/lib/python3.12/site-packages").mkdir(parents=True)
    clinic.file("/home/sam/.local/lib/python3.12/site-packages/setuptools-80.9.0.dist-info/RECORD")
    assert_ill(clinic.look("setuptools"), "warning", "80.9.0", "uninstall")


def test_well_setuptools(clinic: Clinic) -> None:
    assert_absent(clinic.look("setuptools"))
    (clinic.packages() / "setuptools-79.0.1.dist-info").mkdir()
    assert_well(clinic.look("setuptools"))


def test_ill_environment(clinic: Clinic) -> None:
    clinic.file("/old/course/roslings")
    clinic.file("/old/course/.venv/bin/activate")
    finding = clinic.look("environment", VIRTUAL_ENV=f"{clinic.root}/old/course/.venv")
    assert_ill(finding, "fault", "another copy", "deactivate")


def test_ill_environment__gone(clinic: Clinic) -> None:
    assert_ill(clinic.look("environment", VIRTUAL_ENV="/gone/.venv"), "fault", "is gone")


def test_ill_environment__moved(clinic: Clinic) -> None:
    script = clinic.root / "course/.venv/bin/activate"
    change_text(script, str(clinic.root), "/somewhere/else")
    assert_ill(clinic.look("environment"), "fault", "moved or copied", "rm -rf .venv")


def test_well_environment(clinic: Clinic) -> None:
    assert_well(clinic.look("environment"))
    assert_well(clinic.look("environment", VIRTUAL_ENV=f"{clinic.root}/course/.venv"))


@pytest.mark.parametrize(("name", "said"), [("my course", "a space"), ("\u00fcbung", "'\u00fc'")])
def test_ill_course_path(clinic: Clinic, name: str, said: str) -> None:
    finding = clinic.change(clone=clinic.root / name).look("course-path")
    assert_ill(finding, "fault", said, "mv ")


def test_well_course_path(clinic: Clinic) -> None:
    assert_well(clinic.look("course-path"))
