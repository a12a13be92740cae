"""Boards, cameras, the Raspberry Pi."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from pathlib import Path

from ros_doctor.finding import (
    Finding,
    advice,
    do,
    fault,
    not_applicable,
    ok,
    say,
    unknown,
    warning,
)
from ros_doctor.machine import ExaminedMachine, read_text
from ros_doctor.mends import container_with
from ros_doctor.registry import check
from ros_doctor.surroundings import container, pi_model, release, virtual_machine, wsl
from ros_doctor.texts import said

SERIAL_PATTERNS = ("ttyACM*", "ttyUSB*", "cu.usbmodem*", "cu.usbserial*")
# USB numbers of the chips on Arduino boards and their copies.
SERIAL_CHIPS = {
    "2341": "Arduino",
    "2a03": "Arduino",
    "1a86": "CH340",
    "0403": "FTDI",
    "10c4": "CP210x",
}
HOT_C = 80.0  # a Raspberry Pi slows itself down from here on
OLD_PIS = ("Raspberry Pi 3", "Raspberry Pi 2", "Raspberry Pi Model", "Raspberry Pi Zero")


def serial_ports(machine: ExaminedMachine) -> list[Path]:
    """Return the serial ports of boards that are plugged in."""
    folder = machine.path("/dev")
    return sorted(path for pattern in SERIAL_PATTERNS for path in folder.glob(pattern))


def open_problem(path: Path) -> int:
    """Open a device as a program would, without waiting, and close it; return errno or 0."""
    try:
        handle = os.open(path, os.O_RDWR | os.O_NONBLOCK | getattr(os, "O_NOCTTY", 0))
    except OSError as problem:
        return problem.errno or errno.EIO
    os.close(handle)
    return 0


@check(
    "serial-found",
    "A board that is plugged in has a serial port",
    looks_at="/dev/ttyACM*, /dev/ttyUSB*, and the chips on the USB bus",
    lesson="06-serial-bridge#find-the-port",
    rows=(28,),
)
def serial_found(machine: ExaminedMachine) -> Finding:
    """'could not open port /dev/ttyACM0: No such file or directory'."""
    ports = serial_ports(machine)
    if ports:
        return ok(
            said(
                "doctor.hardware.serial_found.ok",
                "There is {names}.",
                names=", ".join(port.name for port in ports),
            )
        )
    chip = _serial_chip(machine)
    if chip and container(machine):
        return advice(
            said(
                "doctor.hardware.serial_found.advice",
                "A board ({chip}) is plugged in, but this container was not given its port.",
                chip=chip,
            ),
            container_with("--device=/dev/ttyUSB0"),
        )
    return _portless(machine, chip) if chip else _no_board(machine)


def _portless(machine: ExaminedMachine, chip: str) -> Finding:
    again = say(said("doctor.hardware.portless.say", "Then pull the plug and put it in again."))
    if any(machine.path("/usr/lib/udev/rules.d").glob("*brltty*")):
        return fault(
            said(
                "doctor.hardware.portless.fault",
                "A board ({chip}) is plugged in, but it has no port. brltty may have taken it.",
                chip=chip,
            ),
            do(
                "sudo apt remove brltty",
                said("doctor.hardware.portless.do", "Remove brltty. It is for Braille displays:"),
            ),
            again,
        )
    return warning(
        said(
            "doctor.hardware.portless.warning",
            "A board ({chip}) is plugged in, but it has no port.",
            chip=chip,
        ),
        say(
            said(
                "doctor.hardware.portless.say_2",
                "Try another cable and another USB port. Some cables only charge.",
            )
        ),
    )


def _serial_chip(machine: ExaminedMachine) -> str:
    for path in machine.path("/sys/bus/usb/devices").glob("*/idVendor"):
        maker = SERIAL_CHIPS.get(read_text(path).strip(), "")
        if maker:
            return maker
    return ""


def _no_board(machine: ExaminedMachine) -> Finding:
    none = said(
        "doctor.hardware.no_board", "No board is visible. Day 6 has a stand-in without hardware."
    )
    if wsl(machine):
        return advice(
            said(
                "doctor.hardware.no_board.advice",
                "{none} WSL does not show USB devices by itself.",
                none=none,
            ),
            do(
                "winget install usbipd\nusbipd list\nusbipd bind --busid 1-4\n"
                "usbipd attach --wsl --busid 1-4",
                said(
                    "doctor.hardware.no_board.do",
                    "With a board: in PowerShell as administrator, with your board's number:",
                ),
            ),
        )
    if container(machine):
        return advice(none, container_with("--device=/dev/ttyACM0"))
    program = virtual_machine(machine)
    if program:
        return advice(
            said(
                "doctor.hardware.no_board.advice_3",
                "{none} This is a virtual machine ({program}).",
                none=none,
                program=program,
            ),
            say(
                said(
                    "doctor.hardware.no_board.say",
                    "With a board: in {program}, hand its USB device to this machine.",
                    program=program,
                )
            ),
        )
    return not_applicable(
        said(
            "doctor.hardware.no_board.not_applicable",
            "no board is plugged in; day 6 has a stand-in without hardware",
        )
    )


@check(
    "serial-open",
    "Each serial port opens",
    looks_at="each port, by opening it; this restarts an Arduino, as every opening does",
    lesson="06-serial-bridge#permission",
    rows=(27,),
)
def serial_open(machine: ExaminedMachine) -> Finding:
    """'could not open port /dev/ttyACM0: [Errno 13] Permission denied'."""
    ports = serial_ports(machine)
    if not ports:
        return not_applicable(
            said("doctor.hardware.serial_open.not_applicable", "there is no serial port")
        )
    for port in ports:
        shown = f"/dev/{port.name}"
        user = _holder(machine, port)
        if user:
            return advice(
                said(
                    "doctor.hardware.serial_open.advice",
                    "{shown} is in use by program {user}. Only one program can use a board.",
                    shown=shown,
                    user=user,
                ),
                do(
                    f"ps -p {user} -o pid,comm,args",
                    said(
                        "doctor.hardware.serial_open.do", "See which one it is, and end it there:"
                    ),
                ),
            )
        problem = open_problem(port)
        if problem:
            return _serial_mend(shown, port, problem)
    return ok(
        said("doctor.hardware.serial_open.ok_if", "{count} open.", count=len(ports))
        if len(ports) > 1
        else said("doctor.hardware.serial_open.ok_else", "/dev/{name} opens.", name=ports[0].name)
    )


def _serial_mend(shown: str, port: Path, problem: int) -> Finding:
    if problem == errno.EBUSY:
        return advice(
            said(
                "doctor.hardware.serial_mend.advice",
                "{shown} is in use by another program.",
                shown=shown,
            ),
            do(
                f"fuser -v {shown}",
                said("doctor.hardware.serial_mend.do", "See which one it is, and end it there:"),
            ),
        )
    if problem not in (errno.EACCES, errno.EPERM):
        return fault(
            said(
                "doctor.hardware.serial_mend.fault",
                "{shown} does not open: {os}.",
                shown=shown,
                os=os.strerror(problem),
            ),
            say(
                said(
                    "doctor.hardware.serial_mend.say",
                    "Pull the plug, wait for two seconds, and put it in again.",
                )
            ),
        )
    return _forbidden(shown, port)


def _forbidden(shown: str, device: Path) -> Finding:
    group = _group(device)
    if group in ("", "root"):  # as a container shows a device of its host
        return fault(
            said("doctor.hardware.forbidden.fault", "You may not use {shown}.", shown=shown),
            do(
                f"sudo chmod a+rw {shown}", said("doctor.hardware.forbidden.do", "Open it for all:")
            ),
        )
    return fault(
        said(
            "doctor.hardware.forbidden.fault_2",
            "You may not use {shown}. It belongs to the group {group}.",
            shown=shown,
            group=group,
        ),
        do(
            f'sudo usermod -aG {group} "$USER"',
            said("doctor.hardware.forbidden.do_2", "Join that group:"),
        ),
        say(
            said(
                "doctor.hardware.forbidden.say",
                "Log out of the computer and log in again. Only then does it count.",
            )
        ),
    )


def _group(path: Path) -> str:
    """Return the name of the group that owns a device, or "" where it has no name."""
    import grp

    try:
        return grp.getgrgid(path.stat().st_gid).gr_name
    except (KeyError, OSError):
        return ""


def _holder(machine: ExaminedMachine, device: Path) -> str:
    """Return the number of a program of yours that holds the device open, or ""."""
    real = os.path.realpath(device)
    for folder in machine.path("/proc").glob("[0-9]*/fd"):
        if folder.parent.name == str(os.getpid()) or not os.access(folder, os.R_OK):
            continue
        if any(os.path.realpath(link) == real for link in _links(folder)):
            return folder.parent.name
    return ""


def _links(folder: Path) -> Iterator[Path]:
    try:
        yield from folder.iterdir()
    except OSError:  # the program has just ended
        return


@check(
    "camera",
    "Each camera opens",
    looks_at="/dev/video*, by opening each for a moment",
    lesson="07-pi-camera#camera",
)
def camera(machine: ExaminedMachine) -> Finding:
    """The picture stays black: 'can't open camera by index'."""
    devices = sorted(machine.path("/dev").glob("video*"))
    if not devices:
        return not_applicable(
            said(
                "doctor.hardware.camera.not_applicable",
                "no camera is plugged in; day 7 has a stand-in without hardware",
            )
        )
    for device in devices:
        problem = open_problem(device)
        shown = f"/dev/{device.name}"
        if problem in (errno.EACCES, errno.EPERM):
            return _forbidden(shown, device)
        if problem == errno.EBUSY:
            return advice(
                said("doctor.hardware.camera.advice", "{shown} is in use.", shown=shown),
                say(
                    said("doctor.hardware.camera.say", "Close the program that shows its picture.")
                ),
            )
    return ok(
        said("doctor.hardware.camera.ok_if", "{count} video devices open.", count=len(devices))
        if len(devices) > 1
        else said("doctor.hardware.camera.ok_else", "{shown} opens.", shown=shown)
    )


@check(
    "pi",
    "The Raspberry Pi is strong enough",
    looks_at="/proc/device-tree/model and the size of the memory",
    lesson="reference/real-robot#prepare-the-pi",
)
def pi(machine: ExaminedMachine) -> Finding:
    """Every command takes long, or a program ends with 'Killed'."""
    model = pi_model(machine)
    if not model:
        return not_applicable(
            said("doctor.hardware.pi.not_applicable", "this is not a Raspberry Pi")
        )
    if "64" not in machine.architecture:
        return fault(
            said(
                "doctor.hardware.pi.fault",
                "{model} runs a system of 32 bits. Jazzy needs one of 64 bits.",
                model=model,
            ),
            say(
                said(
                    "doctor.hardware.pi.say",
                    "Write Ubuntu 24.04 (64 bits) to the card, with Raspberry Pi Imager.",
                )
            ),
        )
    if model.startswith(OLD_PIS):
        return advice(
            said("doctor.hardware.pi.advice", "{model} is slow for ROS 2.", model=model),
            say(
                said(
                    "doctor.hardware.pi.say_2",
                    "Use it without a desktop. Look at pictures and graphs on your laptop.",
                )
            ),
        )
    return ok(model)


@check(
    "pi-power",
    "The Raspberry Pi gets enough power and stays cool",
    looks_at="vcgencmd get_throttled, and the temperature of the processor",
    lesson="reference/real-robot#prepare-the-pi",
    live=True,
)
def pi_power(machine: ExaminedMachine) -> Finding:
    """A lightning sign on the screen, and rates that drop after some minutes."""
    if not pi_model(machine):
        return not_applicable(
            said("doctor.hardware.pi_power.not_applicable", "this is not a Raspberry Pi")
        )
    heat = machine.read("/sys/class/thermal/thermal_zone0/temp").strip()
    celsius = int(heat) / 1000 if heat.isdigit() else 0.0
    known = _throttled(machine)
    flags = known or 0
    if flags & LOW_VOLTAGE:
        return warning(
            said("doctor.hardware.pi_power.warning", "The power supply is too weak."),
            say(said("doctor.hardware.pi_power.say", "Use the supply made for your Pi.")),
        )
    if flags & SLOWED or celsius >= HOT_C:
        return warning(
            said(
                "doctor.hardware.pi_power.warning_2",
                "The Pi is hot ({celsius:.0f} C) and slows itself down.",
                celsius=celsius,
            ),
            say(
                said(
                    "doctor.hardware.pi_power.say_2",
                    "Give it a fan or a heat sink, and take it out of a closed box.",
                )
            ),
        )
    if known is None:
        return unknown(
            said(
                "doctor.hardware.pi_power.unknown",
                "vcgencmd did not answer: sudo apt install libraspberrypi-bin",
            )
        )
    return ok(
        said(
            "doctor.hardware.pi_power.ok",
            "{celsius:.0f} C, and the power is good.",
            celsius=celsius,
        )
    )


# Bits of `vcgencmd get_throttled`, from the Raspberry Pi documentation (os, "vcgencmd").
LOW_VOLTAGE = 1 << 0 | 1 << 16  # now, or since the start
SLOWED = 1 << 1 | 1 << 2 | 1 << 3


def _throttled(machine: ExaminedMachine) -> int | None:
    ran = machine.run("vcgencmd", "get_throttled")
    words = ran.output.strip().partition("=")[2] if ran and ran.code == 0 else ""
    try:
        return int(words, 16)
    except ValueError:
        return None


@check(
    "pi-camera",
    "libcamera knows the camera of a Raspberry Pi 5",
    looks_at="the file ipa_rpi_pisp.so, which only the Raspberry Pi's libcamera has",
    lesson="reference/real-robot#the-ribbon-camera",
    rows=(29,),
)
def pi_camera(machine: ExaminedMachine) -> Finding:
    """camera_ros ends: 'no cameras available'."""
    if not pi_model(machine).startswith("Raspberry Pi 5"):
        return not_applicable(
            said("doctor.hardware.pi_camera.not_applicable", "this is not a Raspberry Pi 5")
        )
    if any(_has_pisp(folder) for folder in _library_folders(machine)):
        return ok(said("doctor.hardware.pi_camera.ok", "libcamera has the part for the Pi 5."))
    if release(machine).id != "ubuntu":
        return advice(
            said("doctor.hardware.pi_camera.advice", "libcamera has no part for the Pi 5."),
            do("sudo apt install libcamera-ipa"),
        )
    return warning(
        said(
            "doctor.hardware.pi_camera.warning",
            "The libcamera of this system does not know the Pi 5.",
        ),
        say(
            said(
                "doctor.hardware.pi_camera.say",
                "Build the Raspberry Pi's own libcamera, beside camera_ros. First get "
                "what it needs:",
            )
        ),
        do(
            "sudo apt install -y python3-colcon-meson meson ninja-build \\\n"
            "  python3-yaml python3-ply python3-jinja2 libgnutls28-dev openssl"
        ),
        do(
            "mkdir -p ~/camera_ws/src\n"
            "cd ~/camera_ws/src\n"
            "git clone https://github.com/raspberrypi/libcamera.git\n"
            "git clone https://github.com/christianrauch/camera_ros.git\n"
            "cd ..\n"
            "rosdep install -y --from-paths src --ignore-src \\\n"
            "  --rosdistro jazzy --skip-keys=libcamera\n"
            "colcon build",
            said("doctor.hardware.pi_camera.do", "Then build it, in a workspace of its own:"),
        ),
        do(
            "source ~/camera_ws/install/setup.bash",
            said("doctor.hardware.pi_camera.do_2", "In each terminal that uses the camera:"),
        ),
    )


def _library_folders(machine: ExaminedMachine) -> Iterator[Path]:
    for name in ("usr/lib", "usr/local/lib", "opt/ros/jazzy/lib"):
        yield machine.root / name
    for workspace in (machine.home / "camera_ws", machine.workspace):
        yield workspace / "install/libcamera/lib"


def _has_pisp(folder: Path) -> bool:
    """Look in a library folder and one level below, where Debian keeps each processor's."""
    return any(any(folder.glob(pattern)) for pattern in (PISP, "*/" + PISP))


PISP = "libcamera/ipa/ipa_rpi_pisp.so"
