"""The checks of boards, cameras, the Pi, the screen and the notebook."""

from __future__ import annotations

import errno
import grp
import json
import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from clinic import Clinic, assert_absent, assert_ill, assert_well, ordinary_user

from ros_doctor.checks.hardware import _serial_mend, open_problem
from ros_doctor.finding import Status

PI_5 = "Raspberry Pi 5 Model B Rev 1.0\0"


@pytest.fixture
def board(clinic: Clinic) -> Iterator[Path]:
    """A board at /dev/ttyACM0: a real pseudo-terminal behind the name."""
    master, slave = os.openpty()
    port = clinic.root / "dev/ttyACM0"
    port.symlink_to(os.ttyname(slave))
    os.close(slave)
    yield port
    os.close(master)


def test_ill_serial_found(clinic: Clinic) -> None:
    clinic.file("/sys/bus/usb/devices/1-2/idVendor", "1a86\n")
    assert_ill(clinic.look("serial-found"), "warning", "A board (CH340)")
    clinic.file("/usr/lib/udev/rules.d/90-brltty-usb-generic.rules")
    assert_ill(clinic.look("serial-found"), "fault", "brltty", "apt remove brltty")


def test_ill_serial_found__in_a_virtual_machine(clinic: Clinic) -> None:
    clinic.file("/sys/class/dmi/id/product_name", "VirtualBox\n")
    assert_ill(clinic.look("serial-found"), "advice", "virtual machine (VirtualBox)")


def test_ill_serial_found__in_wsl(clinic: Clinic) -> None:
    clinic.file("/proc/sys/kernel/osrelease", "5.15.153.1-microsoft-standard-WSL2\n")
    assert_ill(clinic.look("serial-found"), "advice", "WSL", "usbipd attach --wsl")


def test_ill_serial_found__in_a_container(clinic: Clinic) -> None:
    clinic.file("/.dockerenv")
    assert_ill(clinic.look("serial-found"), "advice", "No board", "--device=/dev/ttyACM0")
    clinic.file("/sys/bus/usb/devices/1-2/idVendor", "2341\n")
    assert_ill(clinic.look("serial-found"), "advice", "Arduino", "--device")


def test_well_serial_found(clinic: Clinic) -> None:
    assert_absent(clinic.look("serial-found"))
    clinic.file("/dev/ttyUSB0")
    assert_well(clinic.look("serial-found"))


def test_ill_serial_open(clinic: Clinic) -> None:
    port = clinic.file("/dev/ttyACM0")
    port.chmod(0)
    tty = grp.getgrnam("tty").gr_gid
    if os.getuid() == 0:
        os.chown(port, 0, tty)
    with ordinary_user():
        finding = clinic.look("serial-open")
    mend = "usermod -aG" if os.getuid() == 0 else ""
    assert_ill(finding, "fault", "You may not use /dev/ttyACM0", mend)


def test_ill_serial_open__in_a_group_that_nobody_should_join(clinic: Clinic) -> None:
    clinic.file("/dev/ttyACM0").chmod(0)
    with ordinary_user():
        finding = clinic.look("serial-open")
    typed = "chmod a+rw /dev/ttyACM0" if os.getuid() == 0 else ""
    assert_ill(finding, "fault", "You may not use /dev/ttyACM0", typed)


def test_ill_serial_open__gone(clinic: Clinic) -> None:
    (clinic.root / "dev/ttyACM0").symlink_to(clinic.root / "dev/gone")
    assert_ill(clinic.look("serial-open"), "fault", "No such file")


def test_ill_serial_open__in_use(clinic: Clinic, board: Path) -> None:
    (clinic.root / "proc/4242/fd").mkdir(parents=True)
    (clinic.root / "proc/4242/fd/5").symlink_to(os.path.realpath(board))
    assert_ill(clinic.look("serial-open"), "advice", "in use by program 4242", "ps -p 4242")


def test_a_port_that_another_program_locked_is_in_use() -> None:
    finding = _serial_mend("/dev/ttyACM0", Path("/dev/ttyACM0"), errno.EBUSY)
    assert_ill(finding, "advice", "in use", "fuser")


def test_well_serial_open(clinic: Clinic, board: Path) -> None:
    assert_well(clinic.look("serial-open"))
    board.unlink()
    assert_absent(clinic.look("serial-open"))


def test_opening_a_device_leaves_nothing_open(board: Path) -> None:
    before = len(list(Path("/proc/self/fd").iterdir()))
    assert open_problem(board) == 0
    assert len(list(Path("/proc/self/fd").iterdir())) == before


def test_ill_camera(clinic: Clinic) -> None:
    clinic.file("/dev/video0").chmod(0)
    with ordinary_user():
        finding = clinic.look("camera")
    assert_ill(finding, "fault", "You may not use /dev/video0")


def test_well_camera(clinic: Clinic) -> None:
    assert_absent(clinic.look("camera"))
    clinic.file("/dev/video0")
    assert_well(clinic.look("camera"))


def test_ill_pi(clinic: Clinic) -> None:
    clinic.file("/proc/device-tree/model", "Raspberry Pi 3 Model B Plus Rev 1.3\0")
    assert_ill(clinic.change(architecture="aarch64").look("pi"), "advice", "slow")
    assert_ill(clinic.change(architecture="armv7l").look("pi"), "fault", "32 bits")


def test_well_pi(clinic: Clinic) -> None:
    assert_absent(clinic.look("pi"))
    clinic.file("/proc/device-tree/model", PI_5)
    assert_well(clinic.change(architecture="aarch64").look("pi"))


def on_a_pi(clinic: Clinic, flags: str, heat: str) -> Clinic:
    clinic.file("/proc/device-tree/model", PI_5)
    clinic.file("/sys/class/thermal/thermal_zone0/temp", heat)
    clinic.program("vcgencmd", f'test "$1" = get_throttled && echo throttled={flags}')
    return clinic


@pytest.mark.parametrize("flags", ["0x1", "0x50005", "0x10000"])
def test_ill_pi_power(clinic: Clinic, flags: str) -> None:
    assert_ill(on_a_pi(clinic, flags, "45000").look("pi-power"), "warning", "power supply")


@pytest.mark.parametrize(("flags", "heat"), [("0x4", "70000"), ("0x0", "83500")])
def test_ill_pi_power__hot(clinic: Clinic, flags: str, heat: str) -> None:
    assert_ill(on_a_pi(clinic, flags, heat).look("pi-power"), "warning", "hot")


def test_well_pi_power(clinic: Clinic) -> None:
    assert_absent(clinic.look("pi-power"))
    assert_well(on_a_pi(clinic, "0x0", "51540").look("pi-power"))


def test_a_pi_that_does_not_answer_is_not_guessed(clinic: Clinic) -> None:
    on_a_pi(clinic, "0x0", "51540").program("vcgencmd", "exit 255")
    assert clinic.look("pi-power").status == Status.UNKNOWN


def test_ill_pi_camera(clinic: Clinic) -> None:
    clinic.file("/proc/device-tree/model", PI_5)
    finding = clinic.look("pi-camera")
    assert_ill(finding, "warning", "does not know the Pi 5", "raspberrypi/libcamera")


def test_well_pi_camera(clinic: Clinic) -> None:
    assert_absent(clinic.look("pi-camera"))
    clinic.file("/proc/device-tree/model", PI_5)
    clinic.file("/home/sam/camera_ws/install/libcamera/lib/libcamera/ipa/ipa_rpi_pisp.so")
    assert_well(clinic.look("pi-camera"))


def test_well_pi_camera__of_the_system(clinic: Clinic) -> None:
    clinic.file("/proc/device-tree/model", PI_5)
    clinic.file("/usr/lib/aarch64-linux-gnu/libcamera/ipa/ipa_rpi_pisp.so")
    assert_well(clinic.look("pi-camera"))


def test_ill_snap_terminal(clinic: Clinic) -> None:
    finding = clinic.look("snap-terminal", GTK_PATH="/snap/code/172/usr/lib/gtk-3.0")
    assert_ill(finding, "warning", "VS Code", "unset GTK_PATH")


def test_well_snap_terminal(clinic: Clinic) -> None:
    assert_well(clinic.look("snap-terminal"))


def test_ill_wayland(clinic: Clinic) -> None:
    clinic.file("/opt/ros/jazzy/bin/rviz2")
    finding = clinic.look("wayland", XDG_SESSION_TYPE="wayland")
    assert_ill(finding, "advice", "rviz2", "export QT_QPA_PLATFORM=xcb")


def test_well_wayland(clinic: Clinic) -> None:
    assert_well(clinic.look("wayland", XDG_SESSION_TYPE="x11"))
    assert_absent(clinic.look("wayland", WAYLAND_DISPLAY="wayland-0"))
    clinic.file("/opt/ros/jazzy/bin/rviz2")
    assert_well(clinic.look("wayland", QT_QPA_PLATFORM="xcb"))


def test_ill_display(clinic: Clinic) -> None:
    del clinic.env["DISPLAY"]
    assert_ill(clinic.look("display"), "advice", "no screen", "graph --save")
    finding = clinic.look("display", SSH_CONNECTION="192.0.2.1 5 192.0.2.2 22")
    assert_ill(finding, "advice", "ssh", "graph --save")


def test_well_display(clinic: Clinic) -> None:
    assert_well(clinic.look("display"))


def test_ill_jupyter(clinic: Clinic) -> None:
    clinic.program("jupyter-lab")
    assert_ill(clinic.look("jupyter"), "warning", "does not know rclpy", "./roslings lab")


def test_well_jupyter(clinic: Clinic) -> None:
    assert_absent(clinic.look("jupyter"))
    clinic.program("jupyter-lab", folder="/course/.venv/bin")
    assert_well(clinic.look("jupyter"))


def add_kernel(clinic: Clinic, where: str, python: str) -> None:
    words = [python, "-m", "ipykernel_launcher", "-f", "{connection_file}"]
    clinic.file(f"{where}/share/jupyter/kernels/python3/kernel.json", json.dumps({"argv": words}))


def test_ill_kernel(clinic: Clinic) -> None:
    add_kernel(clinic, "/home/sam/.local", "/gone/bin/python")
    assert_ill(clinic.look("kernel"), "fault", "/gone/bin/python", "rm -r")


def test_ill_kernel__without_ros(clinic: Clinic) -> None:
    other = clinic.program("python", folder="/other/bin")
    add_kernel(clinic, "/home/sam/.local", str(other))
    assert_ill(clinic.look("kernel"), "warning", "has rclpy", "./roslings lab")


def test_well_kernel(clinic: Clinic) -> None:
    assert_absent(clinic.look("kernel"))
    add_kernel(clinic, "/course/.venv", "python")
    assert_well(clinic.look("kernel"))


@pytest.mark.parametrize("text", ["", "[]", "{", '{"argv": 5}', '{"argv": []}'])
def test_a_broken_kernel_note_is_passed_over(clinic: Clinic, text: str) -> None:
    clinic.file("/home/sam/.local/share/jupyter/kernels/odd/kernel.json", text)
    assert_absent(clinic.look("kernel"))
