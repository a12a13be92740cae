"""Packages of message types, built on this machine by the colcon that builds students' packages."""

import os
import re
import shutil
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from roslings_launcher.errors import LauncherTrouble
from roslings_launcher.place import CoursePlace
from roslings_launcher.virtual import Virtual

# The wheels were made in a container, and some of their files tell CMake where its Python was.
_THEIR_PYTHON = re.compile(r'/opt/python/[^;"\s/]+/include/python3\.\d+t?')
_THEIR_NUMPY = re.compile(r'/[^;"\s]*/site-packages/numpy/_?core/include')

GENERATORS_CONFIG = "share/rosidl_default_generators/cmake/rosidl_default_generatorsConfig.cmake"
_WITHOUT_CPP = """
# Added by roslings. rclpy loads no C++ typesupports, and they take a third of a build.
list(FILTER AMENT_EXTENSIONS_rosidl_generate_idl_interfaces EXCLUDE REGEX "cpp")
"""

# Run by the environment's Python.
_ASK = "import sysconfig, numpy; print(sysconfig.get_path('include')); print(numpy.get_include())"


@dataclass(frozen=True)
class Headers:
    """Where the C headers of the environment's Python and numpy are."""

    python: str
    numpy: str


@dataclass(frozen=True)
class InterfaceBuild:
    """Builds for `virtual`, the environment of `place`."""

    place: CoursePlace
    virtual: Virtual
    sourced: bool
    """A ROS is sourced, and brings what the build needs."""

    def require_compiler(self) -> None:
        """Nothing where C and C++ can be compiled.

        Raises:
            LauncherTrouble: something is missing.
        """
        if not (_program("CC", "cc", "gcc", "clang") and _program("CXX", "c++", "g++", "clang++")):
            raise LauncherTrouble(
                "Message types of one's own are compiled, and this computer has no C and C++ "
                "compiler.",
                "On Ubuntu and Debian: sudo apt install build-essential",
                "Then run the same command again.",
            )
        if self.sourced and not _sourced_generators():
            raise LauncherTrouble(
                "The ROS of this terminal has no generators of message types.",
                "sudo apt install ros-jazzy-rosidl-default-generators",
            )

    def require_headers(self) -> None:
        """Nothing where the C headers of the environment's Python are there.

        Raises:
            LauncherTrouble: they are not.
        """
        header = Path(self.headers().python, "Python.h")
        if not header.is_file():
            version = header.parent.name
            raise LauncherTrouble(
                f"The C headers of this Python are missing: {header}",
                f"On Ubuntu and Debian: sudo apt install {version}-dev",
                "Or take another Python: ROSLINGS_PYTHON=/path/to/python3.12 ./roslings",
            )

    def prepare(self) -> None:
        """The generators of the wheels work on this machine, and make what rclpy loads.

        Their files name this machine's headers, not those of the container they were made in.
        """
        if self.sourced:
            return
        headers = self.headers()
        for file in self.virtual.folder.glob("share/*/cmake/*.cmake"):
            text = file.read_text(encoding="utf-8")
            mended = _THEIR_NUMPY.sub(headers.numpy, _THEIR_PYTHON.sub(headers.python, text))
            if file == self.virtual.folder / GENERATORS_CONFIG and _WITHOUT_CPP not in mended:
                mended += _WITHOUT_CPP
            if mended != text:
                file.write_text(mended, encoding="utf-8")

    def headers(self) -> Headers:
        """Those of the environment's Python.

        Raises:
            LauncherTrouble: it has no numpy.
        """
        done = subprocess.run(
            [self.virtual.python, "-c", _ASK],
            cwd=os.sep,
            env=self._environment(Path(os.sep)),
            capture_output=True,
            stdin=subprocess.DEVNULL,
            text=True,
            check=False,
        )
        if done.returncode != 0:
            raise LauncherTrouble(
                "The environment's Python does not find numpy.",
                f"Make the environment anew: rm -rf {self.place.name}, and run this again.",
            )
        return Headers(*done.stdout.splitlines())

    def build(self, sources: Sequence[Path], scratch: Path, settings: Sequence[str] = ()) -> Path:
        """Build the packages in `sources`; colcon's install folder, in `scratch`.

        Raises:
            LauncherTrouble: the build failed.
        """
        for source in sources:
            shutil.copytree(source, scratch / "src" / source.name)
        done = subprocess.run(
            [*self._command(), *settings],
            cwd=scratch,
            env=self._environment(scratch),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
            text=True,
            check=False,
        )
        if done.returncode != 0:
            log = self.place.root / f"{self.place.name}.interfaces.log"
            log.write_text(done.stdout, encoding="utf-8")
            raise LauncherTrouble(
                f"The message types could not be built: {_complaint(done.stdout)}",
                f"Read the last lines of {log.name}, and run the same command again.",
            )
        return scratch / "install"

    def _command(self) -> list[str]:
        own = self.virtual.folder / "bin" / "colcon"
        colcon = str(own) if own.is_file() else "colcon"
        words = ["build", "--base-paths", "src", "--merge-install"]
        words += ["--event-handlers", "console_direct+"]
        settings = [
            f"-DPython3_EXECUTABLE={self.virtual.python}",
            "-DCMAKE_BUILD_TYPE=Release",
            "-DBUILD_TESTING=OFF",
            "--no-warn-unused-cli",
        ]
        return [colcon, *words, "--cmake-args", *settings]

    def _environment(self, home: Path) -> dict[str, str]:
        """A sourced ROS is reached by its variables; the wheels want none of the user's."""
        kept = ("PATH", "CC", "CXX", "LD_LIBRARY_PATH", "LANG")
        inherited = {name: os.environ[name] for name in kept if name in os.environ}
        path = f"{self.virtual.folder / 'bin'}{os.pathsep}{os.environ.get('PATH', os.defpath)}"
        if self.sourced:
            return {**os.environ, "HOME": str(home), "PATH": path}
        inherited.pop("LD_LIBRARY_PATH", None)  # another environment's, perhaps
        prefix = {"AMENT_PREFIX_PATH": str(self.virtual.folder)}
        return {**inherited, **prefix, "HOME": str(home), "PATH": path}


def _program(variable: str, *names: str) -> str | None:
    chosen = os.environ.get(variable, "").split()[:1]
    return next((found for name in (*chosen, *names) if (found := shutil.which(name))), None)


def _sourced_generators() -> bool:
    prefixes = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    return any(Path(p, "share/rosidl_default_generators").is_dir() for p in prefixes if p)


def _complaint(output: str) -> str:
    """The first error of the build, else its last line."""
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    errors = [line for line in lines if re.search(r"\berror\b", line, re.IGNORECASE)]
    return (errors or lines[-1:] or ["it said nothing"])[0]
