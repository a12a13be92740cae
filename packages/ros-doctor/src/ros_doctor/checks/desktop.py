"""Windows on the screen: rviz2, rqt and the terminal inside VS Code."""

from __future__ import annotations

from ros_doctor.finding import Finding, advice, do, not_applicable, ok, say, warning
from ros_doctor.machine import Machine, exists
from ros_doctor.mends import startup_file, unset
from ros_doctor.registry import check
from ros_doctor.ros import APT_PREFIX
from ros_doctor.surroundings import container, wsl

SNAP_VARIABLES = ("GTK_PATH", "GIO_MODULE_DIR", "GTK_EXE_PREFIX", "LD_LIBRARY_PATH")


@check(
    "snap-terminal",
    "The terminal is not inside a snap",
    looks_at="GTK_PATH and other variables that a snap program leaves behind",
    lesson="01-install#editor",
    rows=(25,),
)
def snap_terminal(machine: Machine) -> Finding:
    """In VS Code's terminal: 'libpthread.so.0: undefined symbol: __libc_pthread_init'."""
    names = [name for name in SNAP_VARIABLES if "/snap/" in machine.env.get(name, "")]
    if not names:
        return ok("No trace of a snap.")
    return warning(
        f"{names[0]} comes from a snap program, most likely VS Code.",
        *unset(machine, *names),
        say("For good: install VS Code from its .deb file instead of the snap."),
    )


@check(
    "wayland",
    "Windows of ROS can open under Wayland",
    looks_at="XDG_SESSION_TYPE, WAYLAND_DISPLAY, QT_QPA_PLATFORM, and whether rviz2 is there",
    lesson="01-install#windows-on-screen",
    rows=(26,),
)
def wayland(machine: Machine) -> Finding:
    """rviz2 crashes when it starts, or its window stays empty."""
    on_wayland = (
        machine.env.get("XDG_SESSION_TYPE") == "wayland" or "WAYLAND_DISPLAY" in machine.env
    )
    if not on_wayland:
        return ok("The screen is not Wayland's.")
    if not exists(machine.path(f"{APT_PREFIX}/bin/rviz2")):
        return not_applicable("rviz2 is not installed")
    if machine.env.get("QT_QPA_PLATFORM") == "xcb":
        return ok("Qt uses xcb.")
    line = "export QT_QPA_PLATFORM=xcb"
    return advice(
        "This screen is Wayland's. rviz2 needs another way to it.",
        do(line, "In this terminal:"),
        do(f'echo "{line}" >> {startup_file(machine)}', "And for every new terminal, once:"),
    )


@check(
    "display",
    "Programs can open a window",
    looks_at="DISPLAY and WAYLAND_DISPLAY",
    lesson="01-install#windows-on-screen",
)
def display(machine: Machine) -> Finding:
    """rqt_graph ends: 'could not connect to display'."""
    if not machine.linux or machine.env.get("DISPLAY") or machine.env.get("WAYLAND_DISPLAY"):
        return ok("There is a screen.")
    if machine.env.get("SSH_CONNECTION"):
        return advice(
            "You are on another computer through ssh. It cannot open windows on your screen.",
            do("./roslings graph --save graph.png", "Save a picture instead of a window:"),
        )
    where = "this container" if container(machine) else "WSL" if wsl(machine) else "this terminal"
    return advice(
        f"There is no screen in {where}. Labs work; rqt_graph and rviz2 do not.",
        do("./roslings graph --save graph.png", "Save a picture instead of a window:"),
    )
