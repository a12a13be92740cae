"""Windows on the screen: rviz2, rqt and the terminal inside VS Code."""

from __future__ import annotations

from ros_doctor.finding import Finding, advice, do, not_applicable, ok, say, warning
from ros_doctor.machine import ExaminedMachine, exists
from ros_doctor.mends import startup_file, unset
from ros_doctor.registry import check
from ros_doctor.ros import APT_PREFIX
from ros_doctor.surroundings import container, wsl
from ros_doctor.texts import said

SNAP_VARIABLES = ("GTK_PATH", "GIO_MODULE_DIR", "GTK_EXE_PREFIX", "LD_LIBRARY_PATH")


@check(
    "snap-terminal",
    "The terminal is not inside a snap",
    looks_at="GTK_PATH and other variables that a snap program leaves behind",
    lesson="01-install#editor",
    rows=(25,),
)
def snap_terminal(machine: ExaminedMachine) -> Finding:
    """In VS Code's terminal: 'libpthread.so.0: undefined symbol: __libc_pthread_init'."""
    names = [name for name in SNAP_VARIABLES if "/snap/" in machine.env.get(name, "")]
    if not names:
        return ok(said("doctor.desktop.snap_terminal.ok", "No trace of a snap."))
    return warning(
        said(
            "doctor.desktop.snap_terminal.warning",
            "{names} comes from a snap program, most likely VS Code.",
            names=names[0],
        ),
        *unset(machine, *names),
        say(
            said(
                "doctor.desktop.snap_terminal.say",
                "For good: install VS Code from its .deb file instead of the snap.",
            )
        ),
    )


@check(
    "wayland",
    "Windows of ROS can open under Wayland",
    looks_at="XDG_SESSION_TYPE, WAYLAND_DISPLAY, QT_QPA_PLATFORM, and whether rviz2 is there",
    lesson="01-install#windows-on-screen",
    rows=(26,),
)
def wayland(machine: ExaminedMachine) -> Finding:
    """rviz2 crashes when it starts, or its window stays empty."""
    on_wayland = (
        machine.env.get("XDG_SESSION_TYPE") == "wayland" or "WAYLAND_DISPLAY" in machine.env
    )
    if not on_wayland:
        return ok(said("doctor.desktop.wayland.ok", "The screen is not Wayland's."))
    if not exists(machine.path(f"{APT_PREFIX}/bin/rviz2")):
        return not_applicable(
            said("doctor.desktop.wayland.not_applicable", "rviz2 is not installed")
        )
    if machine.env.get("QT_QPA_PLATFORM") == "xcb":
        return ok(said("doctor.desktop.wayland.ok_2", "Qt uses xcb."))
    line = "export QT_QPA_PLATFORM=xcb"
    return advice(
        said(
            "doctor.desktop.wayland.advice",
            "This screen is Wayland's. rviz2 needs another way to it.",
        ),
        do(line, said("doctor.desktop.wayland.do", "In this terminal:")),
        do(
            f'echo "{line}" >> {startup_file(machine)}',
            said("doctor.desktop.wayland.do_2", "And for every new terminal, once:"),
        ),
    )


@check(
    "display",
    "Programs can open a window",
    looks_at="DISPLAY and WAYLAND_DISPLAY",
    lesson="01-install#windows-on-screen",
)
def display(machine: ExaminedMachine) -> Finding:
    """rqt_graph ends: 'could not connect to display'."""
    if not machine.linux or machine.env.get("DISPLAY") or machine.env.get("WAYLAND_DISPLAY"):
        return ok(said("doctor.desktop.display.ok", "There is a screen."))
    if machine.env.get("SSH_CONNECTION"):
        return advice(
            said(
                "doctor.desktop.display.advice",
                "You are on another computer through ssh. It cannot open windows on your screen.",
            ),
            do(
                "./roslings graph --save graph.png",
                said("doctor.desktop.display.do", "Save a picture instead of a window:"),
            ),
        )
    return advice(
        _no_screen(machine),
        do(
            "./roslings graph --save graph.png",
            said("doctor.desktop.display.do_2", "Save a picture instead of a window:"),
        ),
    )


def _no_screen(machine: ExaminedMachine) -> str:
    if container(machine):
        text = "There is no screen in this container. Labs work; rqt_graph and rviz2 do not."
        return said("doctor.desktop.display.container", text)
    if wsl(machine):
        text = "There is no screen in WSL. Labs work; rqt_graph and rviz2 do not."
        return said("doctor.desktop.display.wsl", text)
    text = "There is no screen in this terminal. Labs work; rqt_graph and rviz2 do not."
    return said("doctor.desktop.display.terminal", text)
