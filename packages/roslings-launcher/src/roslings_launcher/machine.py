"""Is there a ROS wheel for this machine? Facts first, then one judgement on them.

The wheels exist for Linux on x86-64 with glibc 2.28 or newer, CPython 3.10 to 3.14.
"""

import os
import platform
import struct
import sys
import sysconfig
from dataclasses import dataclass

from roslings_launcher.errors import LauncherTrouble

OLDEST_GLIBC = (2, 28)
PYTHONS = ((3, 10), (3, 14))

_WSL = "Use the Linux that Windows brings: wsl --install Ubuntu-24.04, and run this again there."
_APT = "On Ubuntu 24.04: install ROS 2 Jazzy with apt, source it, and run this again."
_BUILD = "Use a container: docker build -t roslings -f .devcontainer/Containerfile{on} ."
_RUN = "docker run -it --rm -p 8888:8888 -v roslings:/work roslings"
_CONTAINER = (_BUILD.format(on=""), _RUN)
_CONTAINER_OF_APT = (_BUILD.format(on=" --build-arg BASE=ros:jazzy"), _RUN)


@dataclass(frozen=True)
class WheelPlatform:
    """What decides whether a wheel fits: made by `this_machine`, or by a test."""

    system: str  # "Linux", "Darwin", "Windows"
    architecture: str  # "x86_64", "aarch64", ...
    bits: int  # of Python, not of the processor
    glibc: tuple[int, ...]  # (2, 39); empty where the C library is another
    python: tuple[int, int]
    cpython: bool  # the usual build: not PyPy, not free-threaded


def this_machine() -> WheelPlatform:
    """The machine and the Python that this runs on."""
    return WheelPlatform(
        system=platform.system(),
        architecture=platform.machine(),
        bits=struct.calcsize("P") * 8,
        glibc=_glibc(),
        python=sys.version_info[:2],
        cpython=sys.implementation.name == "cpython"
        and not sysconfig.get_config_var("Py_GIL_DISABLED"),
    )


def _glibc() -> tuple[int, ...]:
    try:
        words = (os.confstr("CS_GNU_LIBC_VERSION") or "").split()
    except (AttributeError, ValueError, OSError):
        return ()
    return tuple(int(n) for n in words[-1].split(".") if n.isdigit()) if words else ()


def require_unix(machine: WheelPlatform) -> None:
    """Nothing where scripts of a shell run.

    Raises:
        LauncherTrouble: this is Windows itself, not the Linux in it.
    """
    if machine.system == "Windows":
        raise LauncherTrouble("roslings does not run on Windows itself.", _WSL, *_CONTAINER)


def require_wheels(machine: WheelPlatform) -> None:
    """Nothing where the ROS wheels fit `machine`; else the other way to take.

    Raises:
        LauncherTrouble: there are no wheels for this machine.
    """
    x86 = machine.architecture in ("x86_64", "AMD64")
    if machine.system != "Linux":
        way = _CONTAINER if x86 else _CONTAINER_OF_APT
        raise LauncherTrouble(f"There are no ROS wheels for {_named(machine.system)}.", *way)
    if not x86:
        raise LauncherTrouble(
            f"There are no ROS wheels for {machine.architecture}.", _APT, *_CONTAINER_OF_APT
        )
    if machine.bits != 64:
        raise LauncherTrouble("This Python has 32 bits, and the ROS wheels 64.", _APT, *_CONTAINER)
    _require_libc(machine.glibc)
    _require_python(machine)


def _named(system: str) -> str:
    return {"Darwin": "macOS"}.get(system, system or "this system")


def _require_libc(glibc: tuple[int, ...]) -> None:
    if not glibc:
        raise LauncherTrouble(
            "The ROS wheels need glibc, and this Linux has another C library.", *_CONTAINER
        )
    if glibc < OLDEST_GLIBC:
        raise LauncherTrouble(
            f"The ROS wheels need glibc {_dotted(OLDEST_GLIBC)} or newer, and this Linux has "
            f"{_dotted(glibc)}.",
            *_CONTAINER,
        )


def _require_python(machine: WheelPlatform) -> None:
    if not machine.cpython:
        raise LauncherTrouble(
            "The ROS wheels need the usual CPython, and this is another build.", _OTHER
        )
    if not PYTHONS[0] <= machine.python <= PYTHONS[1]:
        raise LauncherTrouble(
            f"The ROS wheels need Python {_dotted(PYTHONS[0])} to {_dotted(PYTHONS[1])}, and this "
            f"is {_dotted(machine.python)}.",
            _OTHER,
            _APT,
            *_CONTAINER,
        )


_OTHER = "Install Python 3.12, or name it: ROSLINGS_PYTHON=/path/to/python3.12 ./roslings"


def _dotted(version: tuple[int, ...]) -> str:
    return ".".join(map(str, version))
