"""Build the sketch and the program that runs it, once, into a cache."""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from roslings_rover.errors import DeviceTrouble

APT_LINE = (
    "sudo apt install gcc-avr avr-libc arduino-core-avr libsimavr-dev libelf-dev gcc libc6-dev"
    " pkg-config"
)
ARDUINO = Path("/usr/share/arduino/hardware/arduino/avr")
RUNNER = Path(__file__).with_name("runner.c")
MCU = ("-mmcu=atmega2560", "-DF_CPU=16000000L")
DEFINES = (
    "-DARDUINO=10819",
    "-DARDUINO_AVR_MEGA2560",
    "-DARDUINO_ARCH_AVR",
    "-DDECIMAL_DIG=__DECIMAL_DIG__",  # Debian's Arduino core asks for it, its compiler lacks it
)
SMALL = ("-Os", "-w", "-ffunction-sections", "-fdata-sections")
CPLUSPLUS = ("-std=gnu++11", "-fno-exceptions", "-fno-threadsafe-statics", "-fpermissive")


class CannotBuild(DeviceTrouble):
    """The sketch or its runner cannot be built here."""


@dataclass(frozen=True)
class BuiltSketch:
    """A sketch for the ATmega2560, and the program that runs it."""

    sketch: Path
    runner: Path


def missing() -> list[str]:
    """What the emulated board needs and is not installed: programs and folders."""
    programs = [name for name in ("avr-gcc", "avr-g++", "gcc", "pkg-config") if not _which(name)]
    folders = [str(ARDUINO)] if not (ARDUINO / "cores" / "arduino").is_dir() else []
    headers = [] if "pkg-config" in programs or _has_simavr() else ["libsimavr"]
    return [*programs, *folders, *headers]


def built(sketch: Path) -> BuiltSketch:
    """Build `sketch` (a .ino), or find what was built of it before. Raises CannotBuild."""
    if not sketch.is_file():
        raise CannotBuild(f"There is no sketch {sketch}. Give the path of an .ino file.")
    if lacking := missing():
        raise CannotBuild(f"The emulated board needs {', '.join(lacking)}. Type: {APT_LINE}")
    folder = _cache() / _fingerprint(sketch)
    done = BuiltSketch(folder / "sketch.elf", folder / "runner")
    if not (done.sketch.is_file() and done.runner.is_file()):
        _build(sketch, folder)
    return done


def _build(sketch: Path, folder: Path) -> None:
    """Built beside its place and then renamed: a half built folder is never used."""
    making = folder.with_name(f"{folder.name}.{os.getpid()}")
    making.mkdir(parents=True, exist_ok=True)
    try:
        _build_sketch(sketch, making)
        _build_runner(making)
        with suppress(OSError):  # another process was quicker: what it built is the same
            making.rename(folder)
    finally:
        shutil.rmtree(making, ignore_errors=True)


def _build_sketch(sketch: Path, folder: Path) -> None:
    core = ARDUINO / "cores" / "arduino"
    include = (f"-I{core}", f"-I{ARDUINO / 'variants' / 'mega'}")
    common = (*MCU, *DEFINES, *SMALL, *include, "-c")
    program = folder / "sketch.cpp"
    program.write_text(f"#include <Arduino.h>\n{sketch.read_text('utf-8')}", "utf-8")
    _run(["avr-gcc", *common, "-std=gnu11", *_sorted(core, "*.c")], folder)
    _run(["avr-gcc", *common, "-x", "assembler-with-cpp", *_sorted(core, "*.S")], folder)
    _run(["avr-g++", *common, *CPLUSPLUS, str(program), *_sorted(core, "*.cpp")], folder)
    objects = _sorted(folder, "*.o")
    _run(["avr-gcc", *MCU, "-Os", "-Wl,--gc-sections", "-o", "sketch.elf", *objects, "-lm"], folder)


def _build_runner(folder: Path) -> None:
    flags = _run(["pkg-config", "--cflags", "--libs", "simavr"], folder).split()
    compiler = ["gcc", "-O2", "-Wall", "-Wno-unused-parameter", str(RUNNER), "-o", "runner"]
    _run([*compiler, *flags, "-lelf", "-lm"], folder)


def _run(command: Sequence[str], folder: Path) -> str:
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode:
        first = "\n".join(done.stderr.strip().splitlines()[:5])
        raise CannotBuild(f"{command[0]} failed:\n{first}\nMend what it names, or: {APT_LINE}")
    return done.stdout


def _sorted(folder: Path, pattern: str) -> Iterable[str]:
    return [str(path) for path in sorted(folder.glob(pattern))]


def _which(name: str) -> str | None:
    return shutil.which(name)


def _has_simavr() -> bool:
    asked = subprocess.run(["pkg-config", "--exists", "simavr"], capture_output=True, check=False)
    return asked.returncode == 0


def _cache() -> Path:
    base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "roslings" / "firmware"


def _fingerprint(sketch: Path) -> str:
    """Changes with the sketch, the runner and how they are built."""
    read = b"".join(path.read_bytes() for path in (sketch, RUNNER, Path(__file__)))
    return hashlib.sha256(read).hexdigest()[:16]
