"""The computer itself: system, Python, disk, memory, clock, container, sandbox."""

from __future__ import annotations

import datetime
import os
import re

from ros_doctor.finding import (
    Finding,
    MendStep,
    advice,
    do,
    fault,
    not_applicable,
    ok,
    say,
    unknown,
    warning,
)
from ros_doctor.machine import ExaminedMachine, exists
from ros_doctor.mends import (
    NEWEST_PYTHON,
    OLDEST_PYTHON,
    container_way,
    container_with,
    install_program,
    quoted,
    wheels_fit,
)
from ros_doctor.registry import check
from ros_doctor.ros import find_ros
from ros_doctor.surroundings import codespace, container, outlives, release, wsl
from ros_doctor.texts import said

MEGA = 1_000_000
GIGA = 1_000_000_000
ENVIRONMENT_BYTES = 300 * MEGA  # the wheels are 183 MB; a build and the logs come on top
COMFORTABLE_BYTES = 2 * GIGA
SMALL_MEMORY_BYTES = 500 * MEGA  # a graded lab holds five Python processes of 64 MB
SMALL_SHARED_BYTES = 60 * MEGA  # Docker gives 64 MiB; a camera's pictures fill that at once
COURSE_WRITTEN = datetime.datetime(2025, 6, 1, tzinfo=datetime.timezone.utc).timestamp()
CLOCK_SLACK_S = 120.0


@check(
    "system",
    "This system can have ROS 2 Jazzy",
    looks_at="/etc/os-release, the processor, the C library and Python",
    lesson="01-install#three-ways",
    rows=(3,),
)
def system(machine: ExaminedMachine) -> Finding:
    """apt says: 'E: Unable to locate package ros-jazzy-desktop'."""
    name = release(machine).name
    if find_ros(machine):
        return ok(said("doctor.computer.system.ok", "{name}: ROS 2 Jazzy is here.", name=name))
    if release(machine).has_jazzy_in_apt:
        return ok(
            said("doctor.computer.system.ok_2", "{name}: Jazzy can come from apt.", name=name)
        )
    if wheels_fit(machine):
        return ok(
            said(
                "doctor.computer.system.ok_3",
                "{name}: apt has no Jazzy for it, but the wheels work here.",
                name=name,
            )
        )
    return fault(
        said(
            "doctor.computer.system.fault",
            "{name} on {architecture}: apt has Jazzy only for Ubuntu 24.04, and the "
            "wheels need Linux on x86-64.",
            name=name,
            architecture=machine.architecture,
        ),
        *container_way(machine),
    )


@check(
    "python",
    "Python is one of 3.10 to 3.14",
    looks_at="the version of the Python that runs the doctor",
    lesson="01-install#three-ways",
)
def python(machine: ExaminedMachine) -> Finding:
    """The course stops at once, or pip says 'No matching distribution found'."""
    version = machine.interpreter.version
    text = ".".join(str(part) for part in version)
    if OLDEST_PYTHON <= version[:2] <= NEWEST_PYTHON:
        return ok(said("doctor.computer.python.ok", "Python {text}.", text=text))
    return fault(
        said(
            "doctor.computer.python.fault",
            "This is Python {text}. The course needs 3.10, 3.11, 3.12, 3.13 or 3.14.",
            text=text,
        ),
        say(
            said(
                "doctor.computer.python.say",
                "Install one of these versions beside yours. ./roslings then finds it by itself.",
            )
            if machine.has_course
            else said(
                "doctor.computer.python.say_alone", "Install one of these versions beside yours."
            )
        ),
        do(
            f"cd {quoted(machine.clone)}\n./roslings doctor" if machine.has_course else "ros-doctor"
        ),
    )


@check(
    "disk-space",
    "There is room on the disk",
    looks_at="the free space where the course and the workspace lie",
    lesson="01-install#needs",
)
def disk_space(machine: ExaminedMachine) -> Finding:
    """A download or a build stops: 'No space left on device'."""
    where = machine.workspace if exists(machine.workspace) else machine.home
    try:
        free = min(machine.free_bytes(path) for path in (where, machine.clone))
    except OSError as problem:
        return unknown(
            said(
                "doctor.computer.disk_space.unknown",
                "The free space could not be read: {problem}.",
                problem=problem,
            )
        )
    text = said("doctor.computer.disk_space.ok", "{free:.1f} GB are free.", free=free / GIGA)
    mend = (
        say(
            said(
                "doctor.computer.disk_space.say",
                "Delete what you do not need. This lists the largest folders in your home:",
            )
        ),
        do("du -xh -d 2 ~ | sort -h | tail -n 15"),
    )
    if free < ENVIRONMENT_BYTES:
        return fault(
            said(
                "doctor.computer.disk_space.fault",
                "Only {free} MB are free. The course needs 300 MB.",
                free=free // MEGA,
            ),
            *mend,
        )
    return (
        ok(text)
        if free >= COMFORTABLE_BYTES
        else advice(
            said("doctor.computer.disk_space.advice", "{text} That is little.", text=text), *mend
        )
    )


@check(
    "memory",
    "There is enough memory",
    looks_at="MemAvailable in /proc/meminfo",
    lesson="01-install#needs",
)
def memory(machine: ExaminedMachine) -> Finding:
    """Programs end with 'Killed', or the computer hardly answers."""
    for line in machine.read("/proc/meminfo").splitlines():
        if line.startswith("MemAvailable:"):
            free = int(line.split()[1]) * 1024
            break
    else:
        return not_applicable(
            said(
                "doctor.computer.memory.not_applicable",
                "only Linux tells its free memory in /proc/meminfo",
            )
        )
    if free >= SMALL_MEMORY_BYTES:
        return ok(said("doctor.computer.memory.ok", "{free:.1f} GB are free.", free=free / GIGA))
    return warning(
        said(
            "doctor.computer.memory.warning",
            "Only {free} MB of memory are free. A lab needs 500 MB.",
            free=free // MEGA,
        ),
        say(
            said(
                "doctor.computer.memory.say",
                "Close the browser and other large programs. This lists the largest ones:",
            )
        ),
        do("ps -eo rss,comm --sort=-rss | head"),
    )


@check(
    "clock",
    "The clock is right",
    looks_at="today's date, and files of the workspace that are dated in the future",
    lesson="reference/real-robot#clock",
)
def clock(machine: ExaminedMachine) -> Finding:
    """Downloads fail with 'certificate is not yet valid', or messages look too old for ROS."""
    today = datetime.datetime.fromtimestamp(machine.now).date()
    mend = (
        say(
            said(
                "doctor.computer.clock.say",
                "Connect to the internet. Then let the computer set its clock:",
            )
        ),
        do("sudo timedatectl set-ntp true\ntimedatectl"),
    )
    if machine.now < COURSE_WRITTEN:
        return fault(
            said(
                "doctor.computer.clock.fault",
                "The clock says {today}. That is in the past.",
                today=today,
            ),
            *mend,
        )
    source = machine.workspace / "src"
    newest = max((path.lstat().st_mtime for path in source.glob("*/*.*")), default=0.0)
    if newest > machine.now + CLOCK_SLACK_S:
        return warning(
            said(
                "doctor.computer.clock.warning",
                "The clock says {today}, but your workspace has files from later than now.",
                today=today,
            ),
            *mend,
        )
    return ok(said("doctor.computer.clock.ok", "Today is {today}.", today=today))


@check(
    "shared-memory",
    "Shared memory (/dev/shm) works",
    looks_at="the size of /dev/shm, and whether you may write there",
    lesson="03-topics/step-by-step#same-machine",
)
def shared_memory(machine: ExaminedMachine) -> Finding:
    """Nodes see each other, but no message arrives; 'Failed to create segment' is printed."""
    if not machine.linux:
        return not_applicable(
            said("doctor.computer.shared_memory.not_applicable", "only Linux has /dev/shm")
        )
    folder = machine.path("/dev/shm")
    if not os.access(folder, os.W_OK, effective_ids=os.access in os.supports_effective_ids):
        return fault(
            said(
                "doctor.computer.shared_memory.fault",
                "You may not write to /dev/shm. Nodes on one machine exchange messages through it.",
            ),
            do(
                "sudo mount -t tmpfs -o mode=1777 tmpfs /dev/shm",
                said("doctor.computer.shared_memory.do", "Give everybody a new one:"),
            ),
        )
    free = machine.free_bytes(folder)
    if free >= SMALL_SHARED_BYTES:
        return ok(
            said(
                "doctor.computer.shared_memory.ok",
                "{free} MB are free in /dev/shm.",
                free=free // MEGA,
            )
        )
    return warning(
        said(
            "doctor.computer.shared_memory.warning",
            "Only {free} MB are free in /dev/shm.",
            free=free // MEGA,
        ),
        *_more_shared_memory(machine),
    )


def _more_shared_memory(machine: ExaminedMachine) -> tuple[MendStep, ...]:
    if container(machine):
        return (container_with("--shm-size=512m"),)
    return (
        say(
            said(
                "doctor.computer.more_shared_memory.say",
                "Old nodes that were ended by force leave files there. With no node running:",
            )
        ),
        do("rm -f /dev/shm/fastrtps_* /dev/shm/sem.fastrtps_*"),
    )


@check(
    "container",
    "The doctor can see the whole machine",
    looks_at="signs of a container: CODESPACES, /.dockerenv, /run/.containerenv, /proc/1/cgroup",
    lesson="01-install#container",
)
def in_container(machine: ExaminedMachine) -> Finding:
    """A board, a camera or a window that works outside does not work in here."""
    kind = container(machine)
    if not kind:
        return ok(said("doctor.computer.in_container.ok", "No container."))
    if codespace(machine):
        return _in_codespace()
    lost = "" if outlives(machine, machine.workspace) else f" {_lost(machine)}"
    return advice(
        said(
            "doctor.computer.in_container.advice",
            "This is a container ({kind}). The doctor cannot see the host's "
            "firewall, clock service or USB ports from in here.{lost}",
            kind=kind,
            lost=lost,
        ),
        say(
            said(
                "doctor.computer.in_container.say",
                "Only if you need a robot or a board. ttyACM0 is the board's port:",
            )
        ),
        container_with("--network=host --ipc=host", "--device=/dev/ttyACM0"),
    )


def _lost(machine: ExaminedMachine) -> str:
    text = "Your work in {workspace} is in it too: it is gone when the container is removed."
    return said("doctor.computer.lost", text, workspace=machine.workspace)


def _in_codespace() -> Finding:
    return advice(
        said(
            "doctor.computer.in_codespace.advice",
            "This is a codespace: a container on a computer of GitHub's. No robot, "
            "board or camera is near it.",
        ),
        do(
            "./roslings lab --no-browser",
            said(
                "doctor.computer.in_codespace.do",
                "For lessons, type this and open port 8888 (PORTS):",
            ),
        ),
        do(
            "./roslings pack topics",
            said(
                "doctor.computer.in_codespace.do_2",
                "GitHub deletes codespaces that rest. Download your work:",
            ),
        ),
    )


@check(
    "wsl",
    "WSL is version 2",
    looks_at="the name of the kernel, and where the course lies",
    lesson="01-install#windows",
    rows=(23,),
)
def wsl_version(machine: ExaminedMachine) -> Finding:
    """Under Windows, nodes start but never find each other."""
    version = wsl(machine)
    if not version:
        return not_applicable(
            said("doctor.computer.wsl_version.not_applicable", "this is not Windows's WSL")
        )
    if version == 2 and machine.has_course and re.match("/mnt/[a-z]/", str(machine.clone)):
        return advice(
            said(
                "doctor.computer.wsl_version.advice",
                "{clone} lies on Windows's own disk. From WSL that is many times slower.",
                clone=machine.clone,
            ),
            do(
                f"cp -r {quoted(machine.clone)} ~/roslings\ncd ~/roslings",
                said("doctor.computer.wsl_version.do", "Copy it into Linux:"),
            ),
        )
    if version == 2:
        return ok(
            said("doctor.computer.wsl_version.ok", "WSL 2. Lessons open in Windows's browser.")
        )
    name = machine.env.get("WSL_DISTRO_NAME", "Ubuntu-24.04")
    return fault(
        said(
            "doctor.computer.wsl_version.fault",
            "This is WSL 1. It has no Linux kernel, and ROS needs one.",
        ),
        do(
            f"wsl --set-version {name} 2",
            said("doctor.computer.wsl_version.do_2", "In Windows, open PowerShell and type:"),
        ),
    )


@check(
    "sandbox",
    "Programs can run in a sandbox",
    looks_at="whether bubblewrap (bwrap) can really start a program in its own namespaces",
    lesson="01-install#sandbox",
    live=True,
)
def sandbox(machine: ExaminedMachine) -> Finding:
    """'bwrap: setting up uid map: Permission denied', or labs run without their own network."""
    if not machine.linux:
        return not_applicable(
            said("doctor.computer.sandbox.not_applicable", "only Linux has this kind of sandbox")
        )
    if machine.which("bwrap") is None:
        return advice(
            said(
                "doctor.computer.sandbox.advice",
                "bubblewrap is not installed. Labs work without it, but less well apart.",
            ),
            *install_program(machine, "bubblewrap"),
        )
    ran = machine.run("bwrap", "--unshare-user", "--unshare-net", "--ro-bind", "/", "/", "true")
    if ran and ran.code == 0:
        return ok(
            said("doctor.computer.sandbox.ok", "bubblewrap starts a program in its own namespaces.")
        )
    silent = said("doctor.computer.sandbox.silent", "bwrap did not answer")
    return _why_no_sandbox(machine, ran.output.strip() if ran else silent)


def _why_no_sandbox(machine: ExaminedMachine, words: str) -> Finding:
    if machine.read("/proc/sys/kernel/apparmor_restrict_unprivileged_userns").strip() == "1":
        return advice(
            said(
                "doctor.computer.why_no_sandbox.advice",
                "AppArmor forbids the sandbox, as Ubuntu does since 23.10. Labs still work.",
            ),
            say(said("doctor.computer.why_no_sandbox.say", "Allow it for bubblewrap alone:")),
            do(
                "sudo apt install apparmor-profiles\n"
                "sudo cp /usr/share/apparmor/extra-profiles/bwrap-userns-restrict \\\n"
                "  /etc/apparmor.d/\n"
                "sudo systemctl reload apparmor"
            ),
        )
    if machine.read("/proc/sys/user/max_user_namespaces").strip() == "0":
        return advice(
            said(
                "doctor.computer.why_no_sandbox.advice_2",
                "The kernel allows no user namespaces. Labs still work, but less well apart.",
            ),
            do(
                "sudo sysctl -w user.max_user_namespaces=10000",
                said("doctor.computer.why_no_sandbox.do", "Allow them until the next start:"),
            ),
        )
    if container(machine):
        return not_applicable(
            said(
                "doctor.computer.why_no_sandbox.not_applicable",
                "a container forbids a sandbox inside it; labs work without",
            )
        )
    return advice(
        said(
            "doctor.computer.why_no_sandbox.advice_3",
            "bubblewrap does not start. It says: {said}",
            said=words[:200],
        ),
        say(
            said(
                "doctor.computer.why_no_sandbox.say_2",
                "Labs work without it. Show this line to your instructor.",
            )
        ),
    )
