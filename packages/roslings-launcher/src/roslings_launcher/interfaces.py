"""The course's own message types, built once by colcon and kept with the environment.

A lab may hold ROS packages of types in `labs/LAB/interfaces/PACKAGE`, and the rover has those that
no wheel brings in its own `interfaces/PACKAGE`. What Python needs of them is
compiled code, one for each Python, so no file of this course can hold it: it is built here, by
the same colcon as a student's package.

On the wheels the result goes into the environment itself, as the types of a wheel do. Beside a
sourced ROS it lies in the folder `overlay`, which `./roslings` and `setup.bash` add to the paths.
"""

import hashlib
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from roslings_launcher.errors import Trouble, say
from roslings_launcher.place import Place
from roslings_launcher.progress import going_on
from roslings_launcher.virtual import Virtual

GROUP = "interfaces"
PARTS = ("include", "lib", "share")
_SOURCES = ("labs/*/interfaces/*", "packages/*/src/*/interfaces/*")
_STAMP = "interfaces.stamp"
_LAST_LINES = 8

# The wheels were made in a container, and some of their files tell CMake where its Python was.
_THEIR_PYTHON = re.compile(r'/opt/python/[^;"\s/]+/include/python3\.\d+t?')
_THEIR_NUMPY = re.compile(r'/[^;"\s]*/site-packages/numpy/_?core/include')

# Run by the environment's Python.
_ASK = "import sysconfig, numpy; print(sysconfig.get_path('include')); print(numpy.get_include())"


@dataclass(frozen=True)
class Headers:
    """Where the C headers of the environment's Python and numpy are."""

    python: str
    numpy: str


@dataclass(frozen=True)
class Interfaces:
    """The packages of types in the course of `place`, and their place in `virtual`."""

    place: Place
    virtual: Virtual
    sourced: bool
    """A ROS is sourced, and brings what the build needs."""

    @property
    def sources(self) -> list[Path]:
        """The folder of each package that must be built: a sourced ROS may bring some of them."""
        return [folder for folder in packages_of(self.place.root) if not self._brought(folder.name)]

    def _brought(self, package: str) -> bool:
        prefixes = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if self.sourced else ()
        others = (Path(prefix) for prefix in prefixes if prefix and Path(prefix) != self.prefix)
        return any((prefix / "share" / package).is_dir() for prefix in others)

    @property
    def prefix(self) -> Path:
        """Where they are installed."""
        return self.virtual.folder / "overlay" if self.sourced else self.virtual.folder

    @property
    def stand(self) -> bool:
        """They are built as their sources and the pins now are."""
        try:
            return self._stamp.read_text(encoding="utf-8") == self._fingerprint()
        except OSError:
            return False

    def build(self) -> None:
        """Afterwards they stand.

        Raises:
            Trouble: there is no compiler, or the build failed.
        """
        if not self.sources or self.stand:
            return
        self.require_compiler()
        self.require_headers()
        names = ", ".join(source.name for source in self.sources)
        say(f"Building the message types of {names}, once. This takes about half a minute.")
        self._stamp.unlink(missing_ok=True)
        self.name_headers()
        with (
            tempfile.TemporaryDirectory(prefix="roslings-") as scratch,
            going_on(lambda: "Building"),
        ):
            self._install(self._built(Path(scratch)))
        self._stamp.write_text(self._fingerprint(), encoding="utf-8")

    def require_compiler(self) -> None:
        """Nothing where C and C++ can be compiled.

        Raises:
            Trouble: something is missing.
        """
        if not (_program("CC", "cc", "gcc", "clang") and _program("CXX", "c++", "g++", "clang++")):
            raise Trouble(
                "Message types of one's own are compiled, and this computer has no C and C++ "
                "compiler.",
                "On Ubuntu and Debian: sudo apt install build-essential",
                "Then run the same command again.",
            )
        if self.sourced and not _sourced_generators():
            raise Trouble(
                "The ROS of this terminal has no generators of message types.",
                "sudo apt install ros-jazzy-rosidl-default-generators",
            )

    def require_headers(self) -> None:
        """Nothing where the C headers of the environment's Python are there.

        Raises:
            Trouble: they are not.
        """
        header = Path(self._headers().python, "Python.h")
        if not header.is_file():
            version = header.parent.name
            raise Trouble(
                f"The C headers of this Python are missing: {header}",
                f"On Ubuntu and Debian: sudo apt install {version}-dev",
                "Or take another Python: ROSLINGS_PYTHON=/path/to/python3.12 ./roslings",
            )

    def name_headers(self) -> None:
        """The files of the wheels name this machine's headers, not those of their container."""
        if self.sourced:
            return
        headers = self._headers()
        for file in self.virtual.folder.glob("share/*/cmake/*.cmake"):
            text = file.read_text(encoding="utf-8")
            mended = _THEIR_NUMPY.sub(headers.numpy, _THEIR_PYTHON.sub(headers.python, text))
            if mended != text:
                file.write_text(mended, encoding="utf-8")

    @property
    def _stamp(self) -> Path:
        return self.virtual.folder / _STAMP

    def _fingerprint(self) -> str:
        """The same for the same sources, pins and Python."""
        sums = [hashlib.sha256(self.place.constraints.read_bytes()).hexdigest()]
        for name, file in files_of(self.place.root):
            sums.append(f"{hashlib.sha256(file.read_bytes()).hexdigest()} {name}")
        return "\n".join([self.virtual.site.parent.name, str(self.sourced), *sums]) + "\n"

    def _headers(self) -> Headers:
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
            raise Trouble(
                "The environment's Python does not find numpy.",
                f"Make the environment anew: rm -rf {self.place.name}, and run this again.",
            )
        return Headers(*done.stdout.splitlines())

    def _built(self, scratch: Path) -> Path:
        """colcon's install folder, in `scratch`."""
        for source in self.sources:
            shutil.copytree(source, scratch / "src" / source.name)
        done = subprocess.run(
            self._command(),
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
            raise Trouble(
                f"The message types could not be built: {_complaint(done.stdout)}",
                f"Read the last lines of {log.name}, and run the same command again.",
            )
        return scratch / "install"

    def _command(self) -> list[str]:
        own = self.virtual.folder / "bin" / "colcon"
        colcon = str(own) if own.is_file() else "colcon"
        words = ["build", "--merge-install", "--event-handlers", "console_direct+"]
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

    def _install(self, built: Path) -> None:
        """Into the prefix, without the setup scripts that colcon writes beside."""
        for part in PARTS:
            if (built / part).is_dir():
                shutil.copytree(built / part, self.prefix / part, dirs_exist_ok=True)


def packages_of(root: Path) -> list[Path]:
    """The folder of each package of types in the course."""
    found = [manifest for place in _SOURCES for manifest in root.glob(f"{place}/package.xml")]
    return sorted(manifest.parent for manifest in found)


def files_of(root: Path) -> Iterator[tuple[str, Path]]:
    """Every file of the packages of types, with its name from the package's folder on."""
    for folder in sorted(folder for place in _SOURCES for folder in root.glob(place)):
        for file in sorted(folder.rglob("*")):
            if file.is_file():
                yield str(file.relative_to(folder.parent)), file


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
